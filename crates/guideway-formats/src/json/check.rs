//! Field checks: returns the values of record fields and reports a diagnostic per missing or
//! mistyped field.

use std::borrow::Cow;

use guideway_layout::{Code, Place};
use guideway_spline::Point;

use super::field::Field;
use crate::ReadError;
use crate::builder::{Builder, PlaceFn};

impl Builder<'_> {
    /// Returns a record; reports it if it is missing or of another type.
    pub(crate) fn record<'f, T>(&mut self, field: &'f Field<T>, at: PlaceFn<'_>) -> Option<&'f T> {
        if field.is_absent() {
            self.report_missing(at, "an object");
        }
        self.check_type(field, at, "an object");
        field.get()
    }

    /// Returns a string that may be missing.
    pub(crate) fn text<'f>(
        &mut self,
        field: &'f Field<Cow<'_, str>>,
        at: PlaceFn<'_>,
    ) -> Result<Option<&'f str>, ReadError> {
        self.check_type(field, at, "a string");
        let text = field.get().map(AsRef::as_ref);
        self.check_text(text.unwrap_or_default())?;
        Ok(text)
    }

    /// Returns an identifier; the place in the file is the substitute for a missing one.
    pub(crate) fn id<'f>(
        &mut self,
        field: &'f Field<Cow<'_, str>>,
        at: PlaceFn<'_>,
        key: &str,
    ) -> Result<Cow<'f, str>, ReadError> {
        let at_key: PlaceFn<'_> = &|| field_place(at, key);
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

    /// Returns a required number; reports it if it is missing or of another type.
    pub(crate) fn number(&mut self, field: &Field<f64>, at: PlaceFn<'_>) -> Option<f64> {
        if field.is_absent() {
            self.report_missing(at, "a number");
        }
        self.check_type(field, at, "a number");
        field.get().copied()
    }

    /// Reports a field that is not an array.
    pub(crate) fn check_array<T>(&mut self, field: &Field<T>, at: PlaceFn<'_>, key: &str) {
        self.check_type(field, &|| field_place(at, key), "an array");
    }

    /// Reports a field whose value has another type than expected.
    pub(crate) fn check_type<T>(&mut self, field: &Field<T>, at: PlaceFn<'_>, expected: &str) {
        let Some(kind) = field.wrong_type() else {
            return;
        };
        let remedy = match field {
            Field::Converted(..) => {
                "The value is converted; correct the application that wrote the file"
            }
            _ => "The value is ignored; correct the application that wrote the file",
        };
        let message = || format!("expected {expected}, found {kind}");
        self.report(Code::WrongType, at, message, remedy);
    }

    /// Reports a key that occurs more than once in an object.
    pub(crate) fn check_repeated(&mut self, key: Option<&'static str>, at: PlaceFn<'_>) {
        if let Some(key) = key {
            let message = || format!("the key `{key}` occurs more than once");
            let remedy = "The last one is used; remove the others";
            self.report(Code::DuplicateKey, at, message, remedy);
        }
    }

    /// Reports a reference to a node that is unknown or has no position.
    pub(crate) fn report_unknown_node(&mut self, node: &str, by: &str, at: PlaceFn<'_>) {
        let message = || {
            format!("`{by}` refers to the node `{node}`, which does not exist or has no position")
        };
        let remedy = "Add the node, or correct the name";
        self.report(Code::UnknownNode, at, message, remedy);
    }

    /// Returns a point if it is finite and within the coordinate limit; reports it if not.
    pub(crate) fn point(
        &mut self,
        x: &Field<f64>,
        y: &Field<f64>,
        at: PlaceFn<'_>,
    ) -> Option<Point<f64>> {
        let x = self.number(x, &|| field_place(at, "x"));
        let y = self.number(y, &|| field_place(at, "y"));
        let point = Point::new(x?, y?);
        self.check_point(point, at).then_some(point)
    }

    /// Reports a missing element.
    pub(crate) fn report_missing(&mut self, at: PlaceFn<'_>, expected: &str) {
        let message = || format!("{expected} is missing");
        let remedy = "Add it in the application that wrote the file";
        self.report(Code::MissingField, at, message, remedy);
    }
}

/// Iterates over the items of an array with their indices. A field that is not an array has none.
pub(crate) fn items<T>(
    list: &Field<Vec<Field<T>>>,
) -> impl ExactSizeIterator<Item = (usize, &Field<T>)> {
    list.get().map_or(&[][..], Vec::as_slice).iter().enumerate()
}

/// Returns the place of a field of the object at a place.
pub(crate) fn field_place(at: PlaceFn<'_>, field: &str) -> Place {
    Place::element(format!("{}.{field}", at().element))
}
