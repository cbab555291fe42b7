//! The drawing bar: current level, snapping, grid step, and the properties of new paths.

use eframe::egui::{ComboBox, DragValue, Id, Label, Ui};
use guideway_document::{Document, levels_by_height};
use guideway_layout::Direction;

use super::new_edges::NewEdgesPanel;
use super::still_part::StillPart;
use crate::action::Action;
use crate::display_settings::DisplaySettings;
use crate::editing::EditTask;
use crate::files::OpenFiles;
use crate::language::{Language, direction_name, language, say, t};
use crate::tools::Tools;

/// Steps of the grid to choose from, in meters.
const GRID_STEPS_M: [f64; 8] = [0.05, 0.1, 0.25, 0.5, 1.0, 2.0, 5.0, 10.0];

/// The parts whose fields the bar edits.
pub(crate) struct DrawingBar<'a> {
    pub(crate) files: &'a OpenFiles,
    pub(crate) tools: &'a mut Tools,
    pub(crate) settings: &'a mut DisplaySettings,
    pub(crate) new_edges: &'a mut NewEdgesPanel,
}

/// All that the bar shows while its list and the window of new paths are closed.
#[derive(PartialEq)]
pub(crate) struct DrawingKey {
    language: Language,
    /// Index of the active file, with revision and level of its document.
    file: usize,
    document: Option<(u64, Option<u32>)>,
    snaps: [bool; 2],
    grid_step_m: Option<f64>,
    direction: Direction,
    vehicle_types: Vec<String>,
}

impl DrawingBar<'_> {
    /// Shows the bar and returns the actions of clicks.
    pub(crate) fn show(&mut self, ui: &mut Ui, still: &mut StillPart<DrawingKey>) -> Vec<Action> {
        let mut actions = Vec::new();
        if self.new_edges.is_open {
            self.lay_out(ui, &mut actions);
            return actions;
        }
        let (document, template) = (self.files.document(), &self.tools.template);
        let types = template.vehicle_types.iter();
        let key = DrawingKey {
            language: language(),
            file: self.files.active_index(),
            document: document.map(|document| (document.revision(), document.level())),
            snaps: [self.tools.snaps.to_objects, self.tools.snaps.to_grid],
            grid_step_m: self.settings.grid_step_m,
            direction: template.direction,
            vehicle_types: types.map(|(name, _)| name.clone()).collect(),
        };
        still.show(ui, key, |ui| self.lay_out(ui, &mut actions));
        actions
    }

    fn lay_out(&mut self, ui: &mut Ui, actions: &mut Vec<Action>) {
        ui.horizontal(|ui| {
            let document = self.files.document();
            if let Some(document) = document.filter(|d| !d.layout().levels.is_empty()) {
                show_level(ui, document, actions);
                ui.separator();
            }
            ui.add(Label::new(t("Snap to")).selectable(false));
            ui.checkbox(&mut self.tools.snaps.to_objects, t("paths"))
                .on_hover_text(t(
                    "Ends, middles, crossings, tangents and perpendiculars; Alt snaps to nothing",
                ));
            let grid = ui.checkbox(&mut self.tools.snaps.to_grid, t("grid of"));
            self.show_grid_step(ui, grid.id);
            ui.separator();
            let template = &self.tools.template;
            let types: Vec<&str> = (template.vehicle_types.iter())
                .map(|(name, _)| name.as_str())
                .collect();
            let types = match types.is_empty() {
                true => t("all vehicle types").to_owned(),
                false => types.join(", "),
            };
            let direction = direction_name(template.direction);
            let text = say!("New paths: {direction}, {types}", direction, types);
            let button = ui.selectable_label(self.new_edges.is_open, text);
            let button =
                button.on_hover_text(t("Direction, vehicle types and speeds of what is drawn"));
            if button.clicked() {
                self.new_edges.is_open ^= true;
            }
            if self.new_edges.is_open {
                let (at, document) = (button.rect.left_bottom(), self.files.document());
                let template = &mut self.tools.template;
                self.new_edges.show(ui.ctx(), at, document, template);
            }
        });
    }

    /// The step of the grid: chosen, typed, or following the scale.
    fn show_grid_step(&mut self, ui: &mut Ui, label: Id) {
        let step_m = &mut self.settings.grid_step_m;
        let text = |step_m: Option<f64>| match step_m {
            Some(step_m) => format!("{step_m} m"),
            None => t("automatic").to_owned(),
        };
        ComboBox::from_id_salt("grid step")
            .selected_text(text(*step_m))
            .width(80.0)
            .show_ui(ui, |ui| {
                let each = GRID_STEPS_M.map(Some).into_iter();
                for choice in std::iter::once(None).chain(each) {
                    ui.selectable_value(step_m, choice, text(choice));
                }
                if let Some(step_m) = step_m {
                    let value = DragValue::new(step_m).speed(0.01).suffix(" m");
                    ui.add(value.range(0.001..=1000.0)).labelled_by(label);
                }
            })
            .response
            .labelled_by(label);
    }
}

/// The level that is shown and drawn on.
fn show_level(ui: &mut Ui, document: &Document, actions: &mut Vec<Action>) {
    let levels = &document.layout().levels;
    let name = |row: u32| levels[row as usize].name_or_id();
    let shown = document.level();
    let text = shown.map_or(t("all"), name);
    let label = ui.add(Label::new(t("Level")).selectable(false));
    ComboBox::from_id_salt("level")
        .selected_text(text)
        .show_ui(ui, |ui| {
            let each = levels_by_height(document.layout()).into_iter().map(Some);
            for level in std::iter::once(None).chain(each) {
                let text = level.map_or(t("all"), name);
                if ui.selectable_label(shown == level, text).clicked() {
                    let show = EditTask::view_change(move |document| document.show_level(level));
                    actions.push(Action::Edit(show));
                }
            }
        })
        .response
        .labelled_by(label.id)
        .on_hover_text(t("Shows this level only, and draws on it"));
}
