//! A text that is being typed into a field, and the edit that it will become.

use std::sync::Arc;

use guideway_document::{Document, PathSet, PropertyRef};
use guideway_scene::Table;

use super::field::FieldKind;
use super::typed_value::TypedValue;
use crate::editing::EditTask;

/// The fact or property that a field edits.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Subject {
    /// The name of the only selected element.
    Name,
    /// A property, for all vehicle types or for one.
    Property {
        name: String,
        kind: FieldKind,
        unit: Option<&'static str>,
        vehicle_type: Option<String>,
    },
}

/// A field of a selection.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Target {
    pub(super) of: Table,
    pub(super) rows: Arc<PathSet>,
    pub(super) subject: Subject,
}

/// A text that is being typed.
#[derive(Clone, Debug)]
pub(super) struct Draft {
    pub(super) target: Target,
    pub(super) text: String,
    /// The text before typing.
    pub(super) before: String,
}

impl Draft {
    /// The edit of the typed text; `None` if it is as before.
    ///
    /// # Errors
    /// Why the field does not take the text.
    pub(super) fn edit(self) -> Result<Option<EditTask>, String> {
        match self.text == self.before {
            true => Ok(None),
            false => self.target.edit(&self.text).map(Some),
        }
    }
}

impl Target {
    /// The edit that a confirmed text becomes.
    ///
    /// # Errors
    /// Why the field does not take the text.
    pub(super) fn edit(self, text: &str) -> Result<EditTask, String> {
        let Self { of, rows, subject } = self;
        match subject {
            Subject::Name => {
                let (id, row) = (text.trim().to_owned(), rows.min());
                Ok(EditTask::edit(move |document: &mut Document| {
                    row.map_or(Ok(()), |row| document.rename(of, row, &id))
                }))
            }
            Subject::Property {
                name,
                kind,
                unit,
                vehicle_type,
            } => {
                let value = TypedValue::parse(text, kind, unit)
                    .map_err(|expected| format!("{name}: {expected}"))?;
                Ok(EditTask::edit(move |document: &mut Document| {
                    let property = PropertyRef {
                        of,
                        name: &name,
                        vehicle_type: vehicle_type.as_deref(),
                    };
                    let value = value.as_ref().map(TypedValue::as_value);
                    document.set_property(property, &rows, value)
                }))
            }
        }
    }
}
