//! The Properties tab: facts and properties of what is selected, as fields that edit.
//!
//! The drawing shows at once what is typed or pointed at. It becomes an edit when it is confirmed:
//! by Enter, by leaving its field, by a command, or by a press on the canvas. Escape takes it back.

mod curvature_plot;
mod draft;
mod entry;
mod facts;
mod field;
mod groups;
mod pickers;
mod shape;
mod shown;
mod typed_value;

use eframe::egui::{Button, Grid, Label, ScrollArea, Ui};
use guideway_document::Document;
use guideway_layout::{ElementKind, PROPERTIES, Property};
use guideway_scene::Table;

pub(super) use self::field::{FieldKind, kind_of};
pub(super) use self::typed_value::TypedValue;

use self::draft::{Subject, Target};
use self::entry::{Entry, name_width, show_name};
use self::field::{Common, Field, MAX_COMPARED};
use self::groups::ShownGroups;
use self::shown::Shown;
use crate::action::Action;
use crate::files::{Layer, OpenFiles};
use crate::language::{say, t, translated};
use crate::units::{Units, units};

/// Height of a window around its longest menu, in points.
const MENU_MARGIN: f32 = 32.0;

/// The section: what is shown, and the text that is being typed.
#[derive(Default)]
pub(crate) struct PropertiesPanel {
    /// Per kind of element, valid for one file and revision of its document.
    shown: Vec<Shown>,
    groups: Vec<ShownGroups>,
    key: Option<(usize, u64)>,
    entry: Entry,
    /// True if the panel was shown since the last call of [`Self::leave_if_hidden`].
    is_shown: bool,
    /// Properties that the selection gets once they have a value.
    added: Vec<(Table, &'static Property)>,
    /// Vehicle types that get a value of their own: table, property, type.
    added_types: Vec<(Table, String, String)>,
    /// Name of a vehicle type to add.
    new_type: String,
    /// The units of the values that are shown.
    units: Units,
}

impl PropertiesPanel {
    /// The edit of a text that was typed but not confirmed yet.
    pub(crate) fn commit(&mut self) -> Vec<Action> {
        self.entry.commit()
    }

    /// Returns `true` if a text is being typed.
    pub(crate) fn has_draft(&self) -> bool {
        self.entry.has_draft()
    }

    /// Takes back a text that was typed but not confirmed.
    pub(crate) fn discard(&mut self) -> Option<Action> {
        self.entry.discard()
    }

    /// As [`Self::commit`], if the panel was not shown since the last call: its field is left then.
    pub(crate) fn leave_if_hidden(&mut self) -> Vec<Action> {
        match std::mem::take(&mut self.is_shown) {
            true => Vec::new(),
            false => self.commit(),
        }
    }

    /// The panel is shown in this frame, if only as it was.
    pub(super) fn stay(&mut self) {
        self.is_shown = true;
    }

    /// Shows the fields of the selection, and in the drawing what is typed into them.
    pub(super) fn show(&mut self, ui: &mut Ui, files: &OpenFiles, actions: &mut Vec<Action>) {
        self.show_fields(ui, files, actions);
        self.entry.show_preview(actions);
    }

    fn show_fields(&mut self, ui: &mut Ui, files: &OpenFiles, actions: &mut Vec<Action>) {
        // While an edit has the document the fields stay; what is typed is queued behind the edit.
        if let Some(document) = files.document() {
            if document.selected().is_empty() {
                self.forget();
                self.added.clear();
                self.added_types.clear();
                ui.label(t(
                    "Select paths, nodes, stations, levels or vehicle types to see and edit them",
                ));
                return;
            }
            self.update(document, files.active_index());
        } else if !files.active().is_some_and(Layer::is_busy) {
            self.forget();
        }
        for groups in std::mem::take(&mut self.groups) {
            groups.show(ui, &mut self.entry, actions);
            self.groups.push(groups);
        }
        for shown in std::mem::take(&mut self.shown) {
            self.show_table(ui, &shown, actions);
            self.shown.push(shown);
        }
    }

    fn forget(&mut self) {
        self.shown.clear();
        self.groups.clear();
        self.key = None;
    }

    /// Reads the selection again after a change.
    fn update(&mut self, document: &Document, file: usize) {
        let revision = document.revision();
        // A field of which a preview is shown keeps its value and its place.
        let is_same = |(of_file, of_revision)| {
            of_file == file && (of_revision == revision || document.is_preview())
        };
        if self.units == units() && self.key.is_some_and(is_same) {
            return;
        }
        self.units = units();
        self.key = Some((file, revision));
        self.groups = ShownGroups::of_selection(document);
        let (layout, selected) = (document.layout(), document.selected());
        let tables = [Table::Paths, Table::Nodes, Table::Stations].into_iter();
        let tables = tables.filter(|&of| !selected.rows(of).is_empty());
        self.shown = tables.map(|of| Shown::new(layout, of, selected)).collect();
    }

    fn show_table(&mut self, ui: &mut Ui, shown: &Shown, actions: &mut Vec<Action>) {
        ui.strong(shown.heading());
        if let Some(shape) = &shown.shape {
            ui.label(&shape.text);
            curvature_plot::show(ui, &shape.bends, shape.length_m);
        }
        if shown.rows.len() > MAX_COMPARED as u64 {
            ui.small(say!(
                "Values are those of the first {count}",
                count = MAX_COMPARED
            ));
        }
        let element = shown.of.element();
        let grid = Grid::new(("properties", element)).num_columns(2);
        grid.min_col_width(name_width(ui)).show(ui, |ui| {
            self.show_facts(ui, shown, actions);
            let added = self.added.clone();
            let added = added.iter().filter(|(of, _)| *of == shown.of);
            let added = added.filter_map(|(_, property)| shown.empty_field(property));
            let fields = shown.fields.iter().cloned().chain(added);
            for field in fields {
                self.show_field(ui, shown, &field, actions);
            }
        });
        self.add_property(ui, shown);
    }

    fn show_facts(&mut self, ui: &mut Ui, shown: &Shown, actions: &mut Vec<Action>) {
        let facts = &shown.facts;
        if let Some(name) = &facts.name {
            ui.label(t("identifier"));
            let value = Common::Same(name.clone());
            self.entry
                .text_field(ui, shown.target(Subject::Name), &value, actions);
            ui.end_row();
        }
        if let Some(nodes) = &facts.nodes {
            let label = ui.label(t("nodes"));
            label.on_hover_text(t("Nodes that serve the station, with commas between"));
            let value = match nodes.is_empty() {
                true => Common::None,
                false => Common::Same(nodes.clone()),
            };
            self.entry
                .text_field(ui, shown.target(Subject::Nodes), &value, actions);
            ui.end_row();
        }
        if let Some([start, end]) = &facts.ends {
            for (label, node) in [(t("from node"), start), (t("to node"), end)] {
                ui.label(label);
                ui.add(Label::new(node).truncate());
                ui.end_row();
            }
        }
        if shown.of == Table::Paths {
            ui.label(t("direction"));
            let hovered = pickers::direction(ui, shown, actions);
            self.entry.want(hovered);
            ui.end_row();
        }
        if !shown.levels.is_empty() {
            ui.label(t("level"));
            pickers::level(ui, shown, actions);
            ui.end_row();
        }
        if shown.of == Table::Paths {
            ui.label(t("vehicle types"));
            pickers::vehicle_types(ui, shown, &mut self.new_type, actions);
            ui.end_row();
        }
    }

    /// One row for all vehicle types, and one for each with a value of its own.
    fn show_field(&mut self, ui: &mut Ui, shown: &Shown, field: &Field, actions: &mut Vec<Action>) {
        show_name(ui, field);
        ui.horizontal(|ui| {
            self.value_field(ui, shown, field, None, actions);
            self.add_type(ui, shown, field);
        });
        ui.end_row();
        for (vehicle_type, value) in &self.per_type(shown, field) {
            ui.add(Label::new(format!("    {vehicle_type}")).truncate());
            ui.horizontal(|ui| {
                let of_type = Some((vehicle_type, value));
                self.value_field(ui, shown, field, of_type, actions);
                let remove = ui.add_enabled(*value != Common::None, Button::new("×").small());
                let remove = remove.on_hover_text(t("Remove the value of this vehicle type"));
                if remove.clicked() {
                    let target = property_target(shown, field, Some(vehicle_type));
                    actions.extend(target.edit("").map(Action::Edit).ok());
                }
            });
            ui.end_row();
        }
    }

    /// The values per vehicle type, and empty ones of the types that the user added.
    fn per_type(&self, shown: &Shown, field: &Field) -> Vec<(String, Common)> {
        let added = self.added_types.iter().filter(|(of, name, vehicle_type)| {
            let is_there = || {
                field
                    .per_type
                    .iter()
                    .any(|(known, _)| known == vehicle_type)
            };
            (*of, name) == (shown.of, &field.name) && !is_there()
        });
        let added = added.map(|(_, _, vehicle_type)| (vehicle_type.clone(), Common::None));
        field.per_type.iter().cloned().chain(added).collect()
    }

    /// Offers a value of its own to each vehicle type that has none.
    fn add_type(&mut self, ui: &mut Ui, shown: &Shown, field: &Field) {
        let present = self.per_type(shown, field);
        let is_missing = |name: &&String| !present.iter().any(|(known, _)| known == *name);
        let missing: Vec<&String> = shown.types.iter().filter(is_missing).collect();
        if missing.is_empty() {
            return;
        }
        let menu = ui.menu_button("+", |ui| {
            for vehicle_type in missing {
                if ui.button(vehicle_type).clicked() {
                    let added = (shown.of, field.name.clone(), vehicle_type.clone());
                    self.added_types.push(added);
                    self.entry
                        .focus(property_target(shown, field, Some(vehicle_type)));
                    ui.close();
                }
            }
        });
        let hint = t("Add a value for one vehicle type");
        menu.response.on_hover_text(hint);
    }

    fn value_field(
        &mut self,
        ui: &mut Ui,
        shown: &Shown,
        field: &Field,
        per_type: Option<(&String, &Common)>,
        actions: &mut Vec<Action>,
    ) {
        let target = property_target(shown, field, per_type.map(|(name, _)| name));
        let value = per_type.map_or(&field.shared, |(_, value)| value);
        self.entry
            .typed_field(ui, target, (field.kind, value), actions);
    }

    /// Offers the known properties that no selected element has.
    fn add_property(&mut self, ui: &mut Ui, shown: &Shown) {
        let kind = match shown.of {
            Table::Paths => ElementKind::Path,
            Table::Nodes => ElementKind::Node,
            Table::Stations => ElementKind::Station,
        };
        ui.menu_button(t("Add property"), |ui| {
            // More of them than a low window has room for.
            let max_height = ui.ctx().content_rect().height() - MENU_MARGIN;
            let list = ScrollArea::vertical().max_height(max_height);
            list.show(ui, |ui| self.list_properties(ui, shown, kind));
        });
    }

    fn list_properties(&mut self, ui: &mut Ui, shown: &Shown, kind: ElementKind) {
        let properties = PROPERTIES.iter();
        for property in properties.filter(|property| property.of.contains(&kind)) {
            let is_shown = shown.fields.iter().any(|field| field.name == property.name);
            let button = ui.add_enabled(!is_shown, Button::new(property.name));
            if button.on_hover_text(translated(property.meaning)).clicked() {
                self.added.push((shown.of, property));
                // The user types its value next.
                if let Some(field) = shown.empty_field(property) {
                    self.entry.focus(property_target(shown, &field, None));
                }
                ui.close();
            }
        }
    }
}

/// The field of a property, for all vehicle types or for one.
fn property_target(shown: &Shown, field: &Field, vehicle_type: Option<&String>) -> Target {
    shown.target(Subject::Property {
        name: field.name.clone(),
        kind: field.kind,
        unit: field.unit,
        vehicle_type: vehicle_type.cloned(),
    })
}
