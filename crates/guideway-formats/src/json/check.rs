//! Fields of records, with a finding for each that is not as the format says.

use std::borrow::Cow;

use guideway_layout::{Code, Place, Value};
use guideway_spline::Point;

use super::attributes::{Attributes, Scalar};
use super::field::{Field, Kind};
use crate::ReadError;
use crate::builder::{Builder, PlaceFn, Table};

impl Builder<'_> {
    /// A record in a list or field; says so if it is missing or of another type.
    pub(crate) fn record<'f, T>(&mut self, field: &'f Field<T>, at: PlaceFn<'_>) -> Option<&'f T> {
        if field.is_absent() {
            self.report_missing(at, "an object");
        }
        self.check_type(field, at, "an object");
        field.get()
    }

    /// A text that may be missing.
    pub(crate) fn text<'f>(
        &mut self,
        field: &'f Field<Cow<'_, str>>,
        at: PlaceFn<'_>,
    ) -> Result<Option<&'f str>, ReadError> {
        self.check_type(field, at, "a text");
        let text = field.get().map(AsRef::as_ref);
        self.check_text(text.unwrap_or_default())?;
        Ok(text)
    }

    /// An identifier. Where there is none, the place in the file stands for it.
    pub(crate) fn id<'f>(
        &mut self,
        field: &'f Field<Cow<'_, str>>,
        at: PlaceFn<'_>,
        key: &str,
    ) -> Result<Cow<'f, str>, ReadError> {
        let at_key: PlaceFn<'_> = &|| within(at, key);
        match self.text(field, at_key)? {
            Some(id) => Ok(Cow::Borrowed(id)),
            None => {
                if field.is_absent() {
                    self.report_missing(at_key, "an identifier");
                }
                Ok(Cow::Owned(at().element))
            }
        }
    }

    /// A number that is needed.
    pub(crate) fn number(&mut self, field: &Field<f64>, at: PlaceFn<'_>) -> Option<f64> {
        if field.is_absent() {
            self.report_missing(at, "a number");
        }
        self.check_type(field, at, "a number");
        field.get().copied()
    }

    /// Says if a list is something else.
    pub(crate) fn check_list<T>(&mut self, field: &Field<T>, at: PlaceFn<'_>, key: &str) {
        self.check_type(field, &|| within(at, key), "a list");
    }

    /// Says if a value is of another type than the field's.
    pub(crate) fn check_type<T>(&mut self, field: &Field<T>, at: PlaceFn<'_>, expected: &str) {
        let Some(kind) = field.wrong_kind() else {
            return;
        };
        let remedy = match field {
            Field::Converted(..) => "It is read as if it were one; correct the writer of the file",
            _ => "It is left out; correct the writer of the file",
        };
        let message = || found(kind, expected);
        self.report(Code::WrongType, at, message, remedy);
    }

    /// Says if a key came twice in an object.
    pub(crate) fn check_repeated(&mut self, key: Option<&'static str>, at: PlaceFn<'_>) {
        if let Some(key) = key {
            let message = || format!("the key `{key}` is there more than once");
            let remedy = "The last one counts; remove the others";
            self.report(Code::DuplicateKey, at, message, remedy);
        }
    }

    /// Says that something names a node that is not there.
    pub(crate) fn report_unknown_node(&mut self, node: &str, by: &str, at: PlaceFn<'_>) {
        let message =
            || format!("`{by}` names the node `{node}`, which is not there or has no position");
        let remedy = "Add the node, or correct the name";
        self.report(Code::UnknownNode, at, message, remedy);
    }

    /// A point that can be drawn.
    pub(crate) fn point(
        &mut self,
        x: &Field<f64>,
        y: &Field<f64>,
        at: PlaceFn<'_>,
    ) -> Option<Point<f64>> {
        let x = self.number(x, &|| within(at, "x"));
        let y = self.number(y, &|| within(at, "y"));
        let point = Point::new(x?, y?);
        self.check_point(point, at).then_some(point)
    }

    /// Sets a text attribute of a row, if there is one.
    pub(crate) fn set_text(
        &mut self,
        table: Table,
        row: usize,
        name: &str,
        field: &Field<Cow<'_, str>>,
        at: PlaceFn<'_>,
    ) -> Result<(), ReadError> {
        match self.text(field, &|| within(at, name))? {
            Some(text) => self.set(table, row, name, Value::Text(text)),
            None => Ok(()),
        }
    }

    /// Sets a number of a row, if there is one.
    pub(crate) fn set_number(
        &mut self,
        table: Table,
        row: usize,
        name: &str,
        field: &Field<f64>,
        at: PlaceFn<'_>,
    ) -> Result<(), ReadError> {
        self.check_type(field, &|| within(at, name), "a number");
        match field.get() {
            Some(&number) => self.set(table, row, name, Value::Float(number)),
            None => Ok(()),
        }
    }

    /// Sets the attributes of a row.
    pub(crate) fn set_attributes(
        &mut self,
        table: Table,
        row: usize,
        attributes: &Attributes<'_>,
        at: PlaceFn<'_>,
    ) -> Result<(), ReadError> {
        for (name, field) in attributes.iter() {
            if let Some(kind) = field.wrong_kind() {
                let message = || format!("the attribute is {kind}, which no column can hold");
                let remedy = "It is left out; nothing else changes by that";
                self.report(Code::Attribute, &|| within(at, name), message, remedy);
            }
            let value = match field.get() {
                Some(Scalar::Truth(value)) => Value::Bool(*value),
                Some(Scalar::Number(value)) => Value::Float(*value),
                Some(Scalar::Count(value)) => Value::Int(*value),
                Some(Scalar::Text(value)) => {
                    self.check_text(value)?;
                    Value::Text(value)
                }
                None => continue,
            };
            self.set(table, row, name, value)?;
        }
        Ok(())
    }

    pub(crate) fn report_missing(&mut self, at: PlaceFn<'_>, expected: &str) {
        let message = || format!("{expected} is missing");
        let remedy = "Add it in the tool that wrote the file";
        self.report(Code::MissingField, at, message, remedy);
    }
}

/// The items of a list; none if it is not a list.
pub(crate) fn items<T>(
    list: &Field<Vec<Field<T>>>,
) -> impl ExactSizeIterator<Item = (usize, &Field<T>)> {
    list.get().map_or(&[][..], Vec::as_slice).iter().enumerate()
}

/// The place of a field of an object.
pub(crate) fn within(at: PlaceFn<'_>, field: &str) -> Place {
    Place::element(format!("{}.{field}", at().element))
}

/// Name of a kind that was found, for messages.
fn found(kind: Kind, expected: &str) -> String {
    format!("{expected} was expected, {kind} was found")
}
