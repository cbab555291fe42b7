//! A text that is being typed into a field, the edit that it will become, and its preview.

use std::collections::BTreeSet;
use std::sync::Arc;

use guideway_document::{Document, LevelFact, PathSet, PropertyRef};
use guideway_layout::Direction;
use guideway_scene::Table;

use super::field::{FieldKind, MAX_COMPARED};
use super::typed_value::TypedValue;
use crate::action::{Action, TypeRename};
use crate::editing::EditTask;
use crate::language::t;

/// The fact or property that a field edits.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Subject {
    /// The name of the only selected element, level or vehicle type.
    Name,
    /// The name of levels for people.
    LevelName,
    /// The height of levels.
    Elevation,
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

/// The owners of a field.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Owners {
    Elements(Table, Arc<PathSet>),
    Levels(Arc<PathSet>),
    VehicleTypes(Arc<BTreeSet<String>>),
}

/// A field of a selection.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Target {
    pub(super) of: Owners,
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
    pub(super) fn edit(self) -> Result<Option<Action>, String> {
        if self.text == self.before {
            return Ok(None);
        }
        let renamed = self.target.vehicle_type().map(str::to_owned);
        let edit = self.target.edit(&self.text)?;
        Ok(Some(match renamed {
            Some(old) => {
                let new = self.text.trim().to_owned();
                Action::RenameVehicleType(edit, TypeRename { old, new })
            }
            None => Action::Edit(edit),
        }))
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
            Subject::Name | Subject::LevelName | Subject::Elevation => false,
            Subject::Direction(_) | Subject::Nodes => true,
            Subject::Property { .. } => !text.trim().is_empty(),
        };
        let Owners::Elements(_, rows) = &self.of else {
            return None;
        };
        if !is_shown || rows.len() > MAX_COMPARED as u64 {
            return None;
        }
        let edit = self.clone().document_edit(text).ok()?;
        Some(EditTask::preview(edit))
    }

    /// The vehicle type whose name the field has.
    fn vehicle_type(&self) -> Option<&str> {
        match &self.of {
            Owners::VehicleTypes(names) if self.subject == Subject::Name => {
                names.first().map(String::as_str)
            }
            _ => None,
        }
    }

    fn document_edit(self, text: &str) -> Result<DocumentEdit, String> {
        match self.of {
            Owners::Elements(of, rows) => element_edit(of, rows, self.subject, text),
            Owners::Levels(rows) => level_edit(rows, self.subject, text),
            Owners::VehicleTypes(names) => type_edit(names, self.subject, text),
        }
    }
}

fn level_edit(rows: Arc<PathSet>, subject: Subject, text: &str) -> Result<DocumentEdit, String> {
    let text = text.trim().to_owned();
    let (property, value) = match &subject {
        Subject::Elevation => (None, parsed("height", &text, FieldKind::Number, Some("m"))?),
        Subject::Property {
            name, kind, unit, ..
        } => (Some(name.clone()), parsed(name, &text, *kind, *unit)?),
        _ => (None, None),
    };
    Ok(Box::new(move |document| {
        let value = value.as_ref().map(TypedValue::as_value);
        let fact = match (&subject, &property) {
            (_, Some(property)) => LevelFact::Property(property, value),
            (Subject::Elevation, _) => LevelFact::Elevation(value.and_then(|v| v.number())),
            (Subject::LevelName, _) => LevelFact::Name(&text),
            _ => LevelFact::Id(&text),
        };
        let set = document.set_level_fact(&rows, fact);
        set.map_err(|error| error.to_string())
    }))
}

fn type_edit(
    names: Arc<BTreeSet<String>>,
    subject: Subject,
    text: &str,
) -> Result<DocumentEdit, String> {
    let text = text.trim().to_owned();
    if let Subject::Property {
        name, kind, unit, ..
    } = subject
    {
        let value = parsed(&name, &text, kind, unit)?;
        return Ok(Box::new(move |document| {
            let value = value.as_ref().map(TypedValue::as_value);
            let set = document.set_type_property(&names, &name, value);
            set.map_err(|error| error.to_string())
        }));
    }
    Ok(Box::new(move |document| {
        let mut names = names.iter();
        names
            .try_for_each(|name| document.change_vehicle_type(name, &text, &[]))
            .map_err(|error| error.to_string())
    }))
}

/// The value of a text in the field of this name.
fn parsed(
    name: &str,
    text: &str,
    kind: FieldKind,
    unit: Option<&'static str>,
) -> Result<Option<TypedValue>, String> {
    let value = TypedValue::parse(text, kind, unit);
    value.map_err(|expected| format!("{}: {expected}", t(name)))
}

fn element_edit(
    of: Table,
    rows: Arc<PathSet>,
    subject: Subject,
    text: &str,
) -> Result<DocumentEdit, String> {
    match subject {
        Subject::Name | Subject::LevelName | Subject::Elevation => {
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
            let value = parsed(&name, text, kind, unit)?;
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
