//! A text that is being typed into a field, the edit that it will become, and its preview.

use std::sync::Arc;

use guideway_document::{Document, PathSet, PropertyRef};
use guideway_layout::Direction;
use guideway_scene::Table;

use super::field::{FieldKind, MAX_COMPARED};
use super::typed_value::TypedValue;
use crate::editing::EditTask;

/// The fact or property that a field edits.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Subject {
    /// The name of the only selected element.
    Name,
    /// The names of the nodes that serve the only selected station, with commas between.
    Nodes,
    /// This direction of paths, whatever the text.
    Direction(Direction),
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

type DocumentEdit = Box<dyn FnOnce(&mut Document) -> Result<(), String> + Send>;

impl Target {
    /// The edit that a confirmed text becomes.
    ///
    /// # Errors
    /// Why the field does not take the text.
    pub(super) fn edit(self, text: &str) -> Result<EditTask, String> {
        self.document_edit(text).map(EditTask::edit)
    }

    /// Shows what the edit would do; `None` where the drawing shows nothing of it, or where it
    /// would take longer than a key press. An empty text removes a property, which only Enter does.
    pub(super) fn preview(&self, text: &str) -> Option<EditTask> {
        let is_shown = match self.subject {
            Subject::Name => false,
            Subject::Direction(_) | Subject::Nodes => true,
            Subject::Property { .. } => !text.trim().is_empty(),
        };
        if !is_shown || self.rows.len() > MAX_COMPARED as u64 {
            return None;
        }
        let edit = self.clone().document_edit(text).ok()?;
        Some(EditTask::preview(edit))
    }

    fn document_edit(self, text: &str) -> Result<DocumentEdit, String> {
        let Self { of, rows, subject } = self;
        match subject {
            Subject::Name => {
                let (id, row) = (text.trim().to_owned(), rows.min());
                Ok(Box::new(move |document| {
                    let renamed = row.map_or(Ok(()), |row| document.rename(of, row, &id));
                    renamed.map_err(|error| error.to_string())
                }))
            }
            Subject::Nodes => {
                let (text, row) = (text.to_owned(), rows.min());
                Ok(Box::new(move |document| {
                    let ids = text.split(',').map(str::trim).filter(|id| !id.is_empty());
                    let ids: Vec<&str> = ids.collect();
                    let set = row.map_or(Ok(()), |row| document.set_station_nodes(row, &ids));
                    set.map_err(|error| error.to_string())
                }))
            }
            Subject::Direction(direction) => Ok(Box::new(move |document| {
                let set = document.set_direction(&rows, direction);
                set.map_err(|error| error.to_string())
            })),
            Subject::Property {
                name,
                kind,
                unit,
                vehicle_type,
            } => {
                let value = TypedValue::parse(text, kind, unit)
                    .map_err(|expected| format!("{name}: {expected}"))?;
                Ok(Box::new(move |document| {
                    let property = PropertyRef {
                        of,
                        name: &name,
                        vehicle_type: vehicle_type.as_deref(),
                    };
                    let value = value.as_ref().map(TypedValue::as_value);
                    let set = document.set_property(property, &rows, value);
                    set.map_err(|error| error.to_string())
                }))
            }
        }
    }
}
