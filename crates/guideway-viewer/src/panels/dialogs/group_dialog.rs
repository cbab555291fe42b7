//! The dialog of a level or a vehicle type: creates, changes or deletes it.

use eframe::egui::{Context, Grid, Id, Key, Modal, TextEdit, Ui};
use guideway_document::{Document, LevelFacts};
use guideway_layout::{Attributes, ElementKind, Level, PROPERTIES, Property, Value};

use super::group_deletion::{Deletion, Subject};
use crate::action::{Action, GroupRequest};
use crate::editing::EditTask;
use crate::language::{say, t};
use crate::panels::properties::{FieldKind, TypedValue};
use crate::units::{shown_unit, shown_value};

/// Width of the fields, in points.
const FIELD_WIDTH: f32 = 200.0;
/// Width of the dialog, in points: a field beside the longest label.
const WIDTH: f32 = 360.0;

/// The dialog; open while it has a level or a vehicle type.
#[derive(Default)]
pub(crate) struct GroupDialog {
    open: Option<OpenGroup>,
}

struct OpenGroup {
    subject: Subject,
    title: &'static str,
    id: String,
    /// Name for people, and height in meters.
    level_facts: Option<[String; 2]>,
    properties: Vec<TypedProperty>,
    /// Identifiers of the others.
    others: Vec<String>,
    deletion: Deletion,
    is_deleting: bool,
    error: Option<String>,
    /// True if the first field takes the focus in the next frame.
    wants_focus: bool,
}

enum Answer {
    Ok,
    Delete,
    Cancel,
}

/// A property with its text.
struct TypedProperty {
    property: &'static Property,
    text: String,
    /// The text before typing.
    before: String,
}

impl GroupDialog {
    /// Opens the dialog for a level or a vehicle type of a document.
    pub(crate) fn ask(&mut self, request: GroupRequest, document: &Document) {
        self.open = match request {
            GroupRequest::NewLevel => Some(OpenGroup::level(document, None)),
            GroupRequest::Level(row) => {
                let exists = document.layout().levels.len() > row as usize;
                exists.then(|| OpenGroup::level(document, Some(row)))
            }
            GroupRequest::NewVehicleType => Some(OpenGroup::vehicle_type(document, None)),
            GroupRequest::VehicleType(name) => Some(OpenGroup::vehicle_type(document, Some(name))),
        };
    }

    pub(super) fn is_open(&self) -> bool {
        self.open.is_some()
    }

    pub(super) fn close(&mut self) {
        self.open = None;
    }

    /// Shows the dialog, and returns the edit of its answer. A wrong answer stays, with its error.
    pub(super) fn show(&mut self, ctx: &Context) -> Option<Action> {
        let open = self.open.as_mut()?;
        let mut answer = None;
        let modal = Modal::new(Id::unique("group")).show(ctx, |ui| {
            answer = match open.is_deleting {
                true => open.deletion_content(ui),
                false => open.content(ui),
            };
        });
        match answer {
            None if modal.should_close() => self.open = None,
            None => {}
            Some(Answer::Cancel) => self.open = None,
            Some(Answer::Delete) => open.is_deleting = true,
            Some(Answer::Ok) => match open.edit() {
                Ok(edit) => {
                    let renamed = open.renamed_type();
                    self.open = None;
                    return Some(match renamed {
                        Some((old, new)) => Action::RenameVehicleType { edit, old, new },
                        None => Action::Edit(edit),
                    });
                }
                Err(error) => (open.error, open.wants_focus) = (Some(error), true),
            },
        }
        None
    }
}

impl OpenGroup {
    fn level(document: &Document, row: Option<u32>) -> Self {
        let levels = &document.layout().levels;
        let level = row.and_then(|row| levels.get(row as usize));
        let height = level.and_then(|level| level.elevation_m);
        let others = levels
            .iter()
            .zip(0..)
            .filter(|(_, other)| Some(*other) != row);
        let others: Vec<(&Level, u32)> = others.collect();
        Self {
            title: match row {
                None => t("New level"),
                Some(_) => t("Level"),
            },
            id: level.map_or(String::new(), |level| level.id.clone()),
            level_facts: Some([
                level
                    .and_then(|level| level.name.clone())
                    .unwrap_or_default(),
                height.map_or(String::new(), |height| height.to_string()),
            ]),
            properties: Vec::new(),
            deletion: row.map_or_else(Deletion::default, |row| {
                Deletion::of_level(document, row, &others)
            }),
            others: others.iter().map(|(level, _)| level.id.clone()).collect(),
            subject: Subject::Level(row),
            is_deleting: false,
            error: None,
            wants_focus: true,
        }
    }

    fn vehicle_type(document: &Document, name: Option<String>) -> Self {
        let layout = document.layout();
        let of_name = |name: &String| layout.vehicle_types.iter().find(|t| t.id == *name);
        let attributes = name.as_ref().and_then(of_name).map(|t| &t.attributes);
        let others = layout.vehicle_type_names().into_iter();
        let others = others.filter(|other| name.as_deref() != Some(other));
        let others: Vec<String> = others.map(str::to_owned).collect();
        Self {
            title: match name {
                None => t("New vehicle type"),
                Some(_) => t("Vehicle type"),
            },
            id: name.clone().unwrap_or_default(),
            level_facts: None,
            properties: properties(attributes),
            deletion: name.as_ref().map_or_else(Deletion::default, |name| {
                Deletion::of_type(document, name, &others)
            }),
            others,
            subject: Subject::VehicleType(name),
            is_deleting: false,
            error: None,
            wants_focus: true,
        }
    }

    fn content(&mut self, ui: &mut Ui) -> Option<Answer> {
        ui.set_min_width(WIDTH);
        ui.strong(self.title);
        let mut enters = false;
        let focus = std::mem::take(&mut self.wants_focus);
        Grid::new("group").num_columns(2).show(ui, |ui| {
            enters |= field(ui, t("identifier"), &mut self.id, focus);
            if let Some([name, height]) = &mut self.level_facts {
                enters |= field(ui, t("name for people"), name, false);
                enters |= field(ui, t("height (m)"), height, false);
            }
            for TypedProperty { property, text, .. } in &mut self.properties {
                let label = match property.quantity() {
                    Some(quantity) => {
                        format!("{} ({})", property.name, shown_unit(quantity.unit()))
                    }
                    None => property.name.to_owned(),
                };
                enters |= field(ui, &label, text, false);
            }
        });
        self.show_error(ui);
        let mut answer = enters.then_some(Answer::Ok);
        ui.horizontal(|ui| {
            if ui.button(t("OK")).clicked() {
                answer = Some(Answer::Ok);
            }
            let is_new = matches!(
                self.subject,
                Subject::Level(None) | Subject::VehicleType(None)
            );
            if !is_new && ui.button(t("Delete…")).clicked() {
                answer = Some(Answer::Delete);
            }
            if ui.button(t("Cancel")).clicked() {
                answer = Some(Answer::Cancel);
            }
        });
        answer
    }

    fn deletion_content(&mut self, ui: &mut Ui) -> Option<Answer> {
        let mut answer = None;
        ui.set_min_width(WIDTH);
        self.deletion.show(ui);
        self.show_error(ui);
        ui.horizontal(|ui| {
            if ui.button(t("Delete")).clicked() {
                answer = Some(Answer::Ok);
            }
            if ui.button(t("Cancel")).clicked() {
                answer = Some(Answer::Cancel);
            }
        });
        answer
    }

    fn show_error(&self, ui: &mut Ui) {
        if let Some(error) = &self.error {
            ui.colored_label(ui.visuals().error_fg_color, error);
        }
    }

    /// The old and the new name of a vehicle type that the answer renames.
    fn renamed_type(&self) -> Option<(String, String)> {
        let Subject::VehicleType(Some(old)) = &self.subject else {
            return None;
        };
        let new = self.id.trim();
        (!self.is_deleting && new != old).then(|| (old.clone(), new.to_owned()))
    }

    /// The edit of the answer.
    fn edit(&self) -> Result<EditTask, String> {
        if self.is_deleting {
            return Ok(self.deletion.edit(&self.subject));
        }
        let id = self.id.trim().to_owned();
        if self.others.contains(&id) {
            return Err(say!("{id} is taken; choose another name", id));
        }
        let is_new_level = matches!(self.subject, Subject::Level(None));
        if id.is_empty() && !is_new_level {
            return Err(t("type a name of at least one character").into());
        }
        let mut values = Vec::new();
        let changed = self.properties.iter();
        for typed in changed.filter(|typed| typed.text != typed.before) {
            let unit = typed.property.quantity().map(|quantity| quantity.unit());
            let value = TypedValue::parse(&typed.text, FieldKind::Number, unit)?;
            values.push((typed.property.name, value));
        }
        let [name, height] = self.level_facts.clone().unwrap_or_default();
        let height_m = match TypedValue::parse(&height, FieldKind::Number, Some("m"))? {
            Some(TypedValue::Number(height_m)) => Some(height_m),
            _ => None,
        };
        let subject = self.subject.clone();
        Ok(EditTask::edit(move |document: &mut Document| {
            let values = values.iter().map(|(name, value)| {
                let value: Option<Value<'_>> = value.as_ref().map(TypedValue::as_value);
                (*name, value)
            });
            let values: Vec<_> = values.collect();
            let facts = LevelFacts {
                id: (!id.is_empty()).then_some(id.as_str()),
                name: Some(name.trim()),
                elevation_m: height_m,
                properties: &[],
            };
            match &subject {
                Subject::Level(None) => {
                    let row = document.create_level(&facts)?;
                    document.show_level(Some(row));
                    Ok(())
                }
                Subject::Level(Some(row)) => document.change_level(*row, &facts),
                Subject::VehicleType(None) => {
                    let given = values.into_iter().filter(|(_, value)| value.is_some());
                    document.create_vehicle_type(&id, &given.collect::<Vec<_>>())
                }
                Subject::VehicleType(Some(old)) => document.change_vehicle_type(old, &id, &values),
            }
        }))
    }
}

/// The numbers that a vehicle type may have everywhere, as texts.
fn properties(attributes: Option<&Attributes>) -> Vec<TypedProperty> {
    let of_types = PROPERTIES.iter().filter(|property| {
        let is_of_types = property.of.contains(&ElementKind::VehicleType);
        is_of_types && property.quantity().is_some()
    });
    let text = |property: &Property| {
        let value = attributes?.value(0, property.name)?;
        let unit = property.quantity().map(|quantity| quantity.unit());
        Some(shown_value(value, unit))
    };
    let typed = of_types.map(|property| {
        let text = text(property).unwrap_or_default();
        TypedProperty {
            property,
            before: text.clone(),
            text,
        }
    });
    typed.collect()
}

/// A labelled field. Returns `true` if Enter leaves it.
fn field(ui: &mut Ui, label: &str, text: &mut String, wants_focus: bool) -> bool {
    let label = ui.label(label);
    let field = TextEdit::singleline(text).desired_width(FIELD_WIDTH);
    let field = ui.add(field).labelled_by(label.id);
    ui.end_row();
    if wants_focus {
        field.request_focus();
    }
    field.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter))
}
