//! Fields of records, with a finding for each that is not as the format says.

use std::borrow::Cow;

use guideway_layout::Code;

use super::json::Field;
use super::map::{Mapper, found, within};
use crate::ReadError;
use crate::builder::At;

impl Mapper<'_> {
    /// A record in a list or field; says so if it is missing or of another type.
    pub(super) fn record<'f, T>(&mut self, field: &'f Field<T>, at: At<'_>) -> Option<&'f T> {
        if field.is_absent() {
            self.report_missing(at, "an object");
        }
        self.check_type(field, at, "an object");
        field.get()
    }

    /// A text that may be missing.
    pub(super) fn text<'f>(
        &mut self,
        field: &'f Field<Cow<'_, str>>,
        at: At<'_>,
    ) -> Result<Option<&'f str>, ReadError> {
        self.check_type(field, at, "a text");
        let text = field.get().map(AsRef::as_ref);
        self.builder.check_text(text.unwrap_or_default())?;
        Ok(text)
    }

    /// An identifier. Where there is none, the place in the file stands for it.
    pub(super) fn id<'f>(
        &mut self,
        field: &'f Field<Cow<'_, str>>,
        at: At<'_>,
        key: &str,
    ) -> Result<Cow<'f, str>, ReadError> {
        let at_key: At<'_> = &|| within(at, key);
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
    pub(super) fn number(&mut self, field: &Field<f64>, at: At<'_>) -> Option<f64> {
        if field.is_absent() {
            self.report_missing(at, "a number");
        }
        self.check_type(field, at, "a number");
        field.get().copied()
    }

    /// Says if a list is something else.
    pub(super) fn check_list<T>(&mut self, field: &Field<Vec<T>>, at: At<'_>, key: &str) {
        self.check_type(field, &|| within(at, key), "a list");
    }

    /// Says if a value is of another type than the field's.
    pub(super) fn check_type<T>(&mut self, field: &Field<T>, at: At<'_>, expected: &str) {
        let Some(kind) = field.wrong_kind() else {
            return;
        };
        let remedy = match field {
            Field::Converted(..) => "It is read as if it were one; correct the writer of the file",
            _ => "It is left out; correct the writer of the file",
        };
        let message = || found(kind, expected);
        self.builder.find(Code::WrongType, at, message, remedy);
    }

    /// Says if a key came twice in an object.
    pub(super) fn check_repeated(&mut self, key: Option<&'static str>, at: At<'_>) {
        if let Some(key) = key {
            let message = || format!("the key `{key}` is there more than once");
            let remedy = "The last one counts; remove the others";
            self.builder.find(Code::DuplicateKey, at, message, remedy);
        }
    }

    /// Says that something names a node that is not there.
    pub(super) fn report_unknown_node(&mut self, node: &str, by: &str, at: At<'_>) {
        let message =
            || format!("`{by}` names the node `{node}`, which is not there or has no position");
        let remedy = "Add the node, or correct the name";
        self.builder.find(Code::UnknownNode, at, message, remedy);
    }

    pub(super) fn report_missing(&mut self, at: At<'_>, expected: &str) {
        let message = || format!("{expected} is missing");
        let remedy = "Add it in the tool that wrote the file";
        self.builder.find(Code::MissingField, at, message, remedy);
    }
}
