//! The dialog of a new level or vehicle type.

use eframe::egui::{Context, Grid, Id, Key, Modal, TextEdit, Ui};
use guideway_document::{Document, LevelFacts};
use guideway_layout::{ElementKind, PROPERTIES, Property, Value};

use super::answer::Answer;
use crate::action::{Action, GroupRequest};
use crate::editing::EditTask;
use crate::language::{say, t};
use crate::panels::properties::{FieldKind, TypedValue};
use crate::units::shown_unit;

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
    of: GroupRequest,
    id: String,
    /// Name for people, and height in meters, of a level.
    level_facts: [String; 2],
    /// Properties of a vehicle type, with their texts.
    properties: Vec<(&'static Property, String)>,
    /// Identifiers of the others.
    others: Vec<String>,
    answer: Answer,
}

impl GroupDialog {
    /// Opens the dialog for a new level or vehicle type of a document.
    pub(crate) fn ask(&mut self, of: GroupRequest, document: &Document) {
        let layout = document.layout();
        let is_level = of == GroupRequest::NewLevel;
        let others: Vec<String> = match is_level {
            true => layout.levels.iter().map(|l| l.id.clone()).collect(),
            false => {
                let names = layout.vehicle_type_names().into_iter();
                names.map(str::to_owned).collect()
            }
        };
        let properties = match is_level {
            true => Vec::new(),
            false => properties(),
        };
        self.open = Some(OpenGroup {
            of,
            id: String::new(),
            level_facts: Default::default(),
            properties,
            others,
            answer: Answer::default(),
        });
    }

    pub(super) fn is_open(&self) -> bool {
        self.open.is_some()
    }

    pub(super) fn close(&mut self) {
        self.open = None;
    }

    /// Closes the dialog when the edit of its answer is complete. One that is refused stays, with
    /// the reason.
    pub(super) fn poll(&mut self) {
        self.open.take_if(|open| open.answer.poll());
    }

    /// Shows the dialog, and returns the edit of its answer. A wrong answer stays, with its error.
    pub(super) fn show(&mut self, ctx: &Context) -> Option<Action> {
        let open = self.open.as_mut()?;
        let mut choice = None;
        let modal = Modal::new(Id::unique("group")).show(ctx, |ui| choice = open.content(ui));
        match choice {
            None if modal.should_close() => self.open = None,
            Some(false) => self.open = None,
            Some(true) if !open.answer.is_running() => {
                let edit = open.edit();
                return open.answer.give(edit, ctx);
            }
            None | Some(true) => {}
        }
        None
    }
}

impl OpenGroup {
    /// Returns whether the answer is to count, once there is one.
    fn content(&mut self, ui: &mut Ui) -> Option<bool> {
        ui.set_min_width(WIDTH);
        let is_level = self.of == GroupRequest::NewLevel;
        ui.strong(match is_level {
            true => t("New level"),
            false => t("New vehicle type"),
        });
        let mut enters = false;
        let focus = self.answer.takes_focus();
        Grid::new("group").num_columns(2).show(ui, |ui| {
            enters |= field(ui, t("identifier"), &mut self.id, focus);
            if is_level {
                let [name, height] = &mut self.level_facts;
                enters |= field(ui, t("name for people"), name, false);
                enters |= field(ui, t("height (m)"), height, false);
            }
            for (property, text) in &mut self.properties {
                let label = match property.quantity() {
                    Some(quantity) => {
                        format!("{} ({})", property.name, shown_unit(quantity.unit()))
                    }
                    None => property.name.to_owned(),
                };
                enters |= field(ui, &label, text, false);
            }
        });
        self.answer.show_error(ui);
        let mut answer = enters.then_some(true);
        ui.horizontal(|ui| {
            if ui.button(t("OK")).clicked() {
                answer = Some(true);
            }
            if ui.button(t("Cancel")).clicked() {
                answer = Some(false);
            }
        });
        answer
    }

    /// The edit of the answer.
    fn edit(&self) -> Result<EditTask, String> {
        let id = self.id.trim().to_owned();
        if self.others.contains(&id) {
            return Err(say!("{id} is taken; choose another name", id));
        }
        let is_level = self.of == GroupRequest::NewLevel;
        if id.is_empty() && !is_level {
            return Err(t("type a name of at least one character").into());
        }
        let mut values = Vec::new();
        for (property, text) in &self.properties {
            let unit = property.quantity().map(|quantity| quantity.unit());
            let value = TypedValue::parse(text, FieldKind::Number, unit)?;
            values.extend(value.map(|value| (property.name, value)));
        }
        let [name, height] = self.level_facts.clone();
        let height_m = match TypedValue::parse(&height, FieldKind::Number, Some("m"))? {
            Some(TypedValue::Number(height_m)) => Some(height_m),
            _ => None,
        };
        Ok(EditTask::edit(move |document: &mut Document| {
            if !is_level {
                let values = values
                    .iter()
                    .map(|(name, value)| (*name, Some(value.as_value())));
                let values: Vec<(&str, Option<Value<'_>>)> = values.collect();
                return document.create_vehicle_type(&id, &values);
            }
            let row = document.create_level(&LevelFacts {
                id: (!id.is_empty()).then_some(id.as_str()),
                name: Some(name.trim()),
                elevation_m: height_m,
                properties: &[],
            })?;
            document.show_level(Some(row));
            Ok(())
        }))
    }
}

/// The numbers that a vehicle type may have everywhere, with empty texts.
fn properties() -> Vec<(&'static Property, String)> {
    let of_types = PROPERTIES.iter().filter(|property| {
        let is_of_types = property.of.contains(&ElementKind::VehicleType);
        is_of_types && property.quantity().is_some()
    });
    of_types.map(|property| (property, String::new())).collect()
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
