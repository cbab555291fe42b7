//! The fields of selected levels and vehicle types.

use std::collections::BTreeSet;
use std::sync::Arc;

use eframe::egui::{Grid, Ui};
use guideway_document::{Document, Group};
use guideway_layout::{Attributes, ElementKind, Level, PROPERTIES, Property, Value};

use super::draft::{Owners, Subject, Target};
use super::entry::{Entry, name_width, show_name};
use super::field::{Common, Field, common, empty_field, kind_of};
use crate::action::Action;
use crate::language::{counted, t};
use crate::selection::counts;
use crate::units::shown_unit;

/// The selected levels, or the selected vehicle types.
pub(super) struct ShownGroups {
    of: Owners,
    heading: String,
    /// The identifier, if there is one only.
    name: Option<String>,
    /// Name for people and height of levels.
    level_facts: Option<[Common; 2]>,
    fields: Vec<Field>,
    /// The elements that belong to them, and in which way.
    members: (&'static str, String),
}

impl ShownGroups {
    /// Reads the selected levels and vehicle types of a document.
    pub(super) fn of_selection(document: &Document) -> Vec<Self> {
        let selected = document.selected();
        let levels = (!selected.levels.is_empty()).then(|| Self::levels(document));
        let types = (!selected.vehicle_types.is_empty()).then(|| Self::vehicle_types(document));
        levels.into_iter().chain(types).collect()
    }

    fn levels(document: &Document) -> Self {
        let rows = &document.selected().levels;
        let all = &document.layout().levels;
        let chosen: Vec<&Level> = rows.iter().map(|row| &all[row as usize]).collect();
        let names = chosen.iter().map(|l| l.name.as_deref().map(Value::Text));
        let heights = chosen.iter().map(|l| l.elevation_m.map(Value::Float));
        let attributes: Vec<_> = chosen.iter().map(|l| Some(&l.attributes)).collect();
        Self {
            heading: counted(rows.len(), "level"),
            name: only(&chosen).map(|level| level.id.clone()),
            level_facts: Some([common(names, None), common(heights, Some("m"))]),
            fields: fields(&attributes, &[]),
            members: (t("on it"), members(document, rows.iter().map(Group::Level))),
            of: Owners::Levels(Arc::new(rows.clone())),
        }
    }

    fn vehicle_types(document: &Document) -> Self {
        let names: &BTreeSet<String> = &document.selected().vehicle_types;
        let table = &document.layout().vehicle_types;
        let attributes = names.iter().map(|name| {
            let known = table.iter().find(|known| known.id == *name);
            known.map(|known| &known.attributes)
        });
        let known = PROPERTIES.iter();
        let known = known.filter(|property| property.of.contains(&ElementKind::VehicleType));
        let groups = names.iter().cloned().map(Group::VehicleType);
        Self {
            heading: counted(names.len() as u64, "vehicle type"),
            name: only(names).cloned(),
            level_facts: None,
            fields: fields(&attributes.collect::<Vec<_>>(), &known.collect::<Vec<_>>()),
            members: (t("may use"), members(document, groups)),
            of: Owners::VehicleTypes(Arc::new(names.clone())),
        }
    }

    fn target(&self, subject: Subject) -> Target {
        Target {
            of: self.of.clone(),
            subject,
        }
    }
}

/// The only item, if there is one only.
fn only<T>(all: impl IntoIterator<Item = T>) -> Option<T> {
    let mut all = all.into_iter();
    all.next().filter(|_| all.next().is_none())
}

/// The number of elements that belong to groups.
fn members(document: &Document, groups: impl Iterator<Item = Group>) -> String {
    let counts = counts(&document.members_of_all(groups));
    match counts.is_empty() {
        true => t("nothing").to_owned(),
        false => counts.join(", "),
    }
}

/// The properties of tables of one row, and the known ones that none has.
fn fields(tables: &[Option<&Attributes>], known: &[&Property]) -> Vec<Field> {
    let mut fields: Vec<Field> = Vec::new();
    for column in tables.iter().flatten().flat_map(|table| table.iter()) {
        if fields.iter().any(|field| field.name == column.name) {
            continue;
        }
        let unit = column.quantity.map(|quantity| quantity.unit());
        let values = tables
            .iter()
            .map(|table| table.and_then(|t| t.value(0, &column.name)));
        fields.push(Field {
            name: column.name.clone(),
            unit,
            kind: kind_of(&column.name, &column.values),
            shared: common(values, unit),
            per_type: Vec::new(),
        });
    }
    let is_there = |name: &str| fields.iter().any(|field| field.name == name);
    let empty = known.iter().filter(|property| !is_there(property.name));
    let empty: Vec<Field> = empty.map(|property| empty_field(property)).collect();
    fields.extend(empty);
    fields
}

impl ShownGroups {
    /// Shows the fields.
    pub(super) fn show(&self, ui: &mut Ui, entry: &mut Entry, actions: &mut Vec<Action>) {
        ui.strong(&self.heading);
        let grid = Grid::new(("groups", &self.heading)).num_columns(2);
        grid.min_col_width(name_width(ui)).show(ui, |ui| {
            if let Some(name) = &self.name {
                let name = Common::Same(name.clone());
                ui.label(t("identifier"));
                entry.text_field(ui, self.target(Subject::Name), &name, actions);
                ui.end_row();
            }
            if let Some([name, height]) = &self.level_facts {
                ui.label(t("name for people"));
                entry.text_field(ui, self.target(Subject::LevelName), name, actions);
                ui.end_row();
                ui.label(format!("{} ({})", t("height"), shown_unit("m")));
                entry.text_field(ui, self.target(Subject::Elevation), height, actions);
                ui.end_row();
            }
            for field in &self.fields {
                self.show_field(ui, field, entry, actions);
            }
        });
        let (meaning, members) = &self.members;
        ui.label(format!("{meaning}: {members}"));
    }

    fn show_field(&self, ui: &mut Ui, field: &Field, entry: &mut Entry, actions: &mut Vec<Action>) {
        show_name(ui, field);
        let target = self.target(Subject::Property {
            name: field.name.clone(),
            kind: field.kind,
            unit: field.unit,
            vehicle_type: None,
        });
        entry.typed_field(ui, target, (field.kind, &field.shared), actions);
        ui.end_row();
    }
}
