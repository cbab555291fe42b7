//! The drawing bar: current level, snapping, grid step, and the properties of new paths.

use eframe::egui::{Checkbox, ComboBox, DragValue, Id, Label, PopupCloseBehavior, Ui};
use guideway_document::{Document, levels_by_height};
use guideway_layout::Direction;

use super::new_edges::NewEdgesPanel;
use super::still_part::StillPart;
use crate::action::Action;
use crate::canvas::Canvas;
use crate::display_settings::{DisplaySettings, GRID_STEPS_M};
use crate::editing::EditTask;
use crate::files::OpenFiles;
use crate::language::{Language, direction_name, language, say, t};
use crate::tools::Tools;

/// Steps of the grid to choose from, in meters.
const STEP_CHOICES_M: [f64; 8] = [0.05, 0.1, 0.25, 0.5, 1.0, 2.0, 5.0, 10.0];

/// Height of the list of steps, in points: all of them, and the field below.
const STEPS_HEIGHT: f32 = 320.0;

/// The parts whose fields the bar edits.
pub(crate) struct DrawingBar<'a> {
    pub(crate) files: &'a OpenFiles,
    pub(crate) canvas: &'a Canvas,
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
    has_grid: bool,
    /// The step of the grid that the user gave, and the one that is shown.
    grid_steps_m: [Option<f64>; 2],
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
            has_grid: self.settings.has_grid,
            grid_steps_m: [self.settings.grid_step_m, self.shown_step_m()],
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
            let grid = Checkbox::new(&mut self.tools.snaps.to_grid, t("grid of"));
            let grid = ui.add_enabled(self.settings.has_grid, grid);
            let grid = grid.on_disabled_hover_text(t("The grid is hidden; G shows it"));
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

    /// Distance of the grid lines in the present view, in meters.
    fn shown_step_m(&self) -> Option<f64> {
        let view = self.canvas.camera.view()?;
        Some(self.settings.grid_step_m(&view, self.canvas.px_per_point()))
    }

    /// The step of the grid: chosen, typed, or following the scale.
    fn show_grid_step(&mut self, ui: &mut Ui, label: Id) {
        let text = step_text(self.settings.grid_step_m, self.shown_step_m());
        let step_m = &mut self.settings.grid_step_m;
        ComboBox::from_id_salt("grid step")
            .selected_text(text)
            .width(120.0)
            .height(STEPS_HEIGHT)
            // A click on the field begins to type.
            .close_behavior(PopupCloseBehavior::CloseOnClickOutside)
            .show_ui(ui, |ui| {
                let each = STEP_CHOICES_M.map(Some).into_iter();
                for choice in std::iter::once(None).chain(each) {
                    let choice_text = step_text(choice, None);
                    if ui.selectable_value(step_m, choice, choice_text).clicked() {
                        ui.close();
                    }
                }
                if let Some(step_m) = step_m {
                    let value = DragValue::new(step_m).speed(0.01).suffix(" m");
                    ui.add(value.range(GRID_STEPS_M)).labelled_by(label);
                }
            })
            .response
            .labelled_by(label);
    }
}

/// `0.5 m`, `automatic (5 m)`; where the lines of a given step would be too close, also the step
/// that is shown: `0.05 m (0.5 m shown)`.
fn step_text(given_m: Option<f64>, shown_m: Option<f64>) -> String {
    // Powers of ten are not exact.
    let meters = |step_m: f64| format!("{} m", (step_m * 1e9).round() / 1e9);
    match (given_m.map(meters), shown_m.map(meters)) {
        (None, None) => t("automatic").to_owned(),
        (None, Some(step)) => say!("automatic ({step})", step),
        (Some(step), Some(shown)) if shown != step => {
            say!("{step} ({shown} shown)", step, shown)
        }
        (Some(step), _) => step,
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn step_tells_what_is_given_and_what_is_shown() {
        for (given_m, shown_m, text) in [
            (None, None, "automatic"),
            (None, Some(5.0), "automatic (5 m)"),
            (Some(0.05), Some(0.05), "0.05 m"),
            (Some(1.1), Some(1.1 * 10.0), "1.1 m (11 m shown)"),
            (Some(0.25), None, "0.25 m"),
        ] {
            assert_eq!(step_text(given_m, shown_m), text);
        }
    }
}
