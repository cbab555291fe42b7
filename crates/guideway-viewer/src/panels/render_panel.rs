//! The Rendering section: render method, and the report of the last picture.

use eframe::egui::{ComboBox, Grid, Ui};

use crate::action::Action;
use crate::files::OpenFiles;
use crate::language::{say, t};
use crate::render_queue::MethodSelection;

/// Shows the section.
pub(super) fn show(
    ui: &mut Ui,
    files: &OpenFiles,
    methods: &MethodSelection,
    actions: &mut Vec<Action>,
) {
    if let Some(chosen) = show_methods(ui, methods) {
        actions.push(Action::SetMethod(chosen));
    }
    let Some(shown) = files.active().and_then(|layer| layer.picture.shown()) else {
        return;
    };
    let report = &shown.report;
    ui.label(report.to_string());
    Grid::new("stages").num_columns(2).show(ui, |ui| {
        for stage in &report.stages {
            ui.label(stage.name);
            ui.monospace(format!("{:.2} ms", stage.elapsed_ms));
            ui.end_row();
        }
        ui.label(t("request to picture"));
        ui.monospace(format!("{:.2} ms", shown.wall_ms));
        ui.end_row();
    });
    for note in &report.notes {
        ui.small(note);
    }
}

/// Shows the list of methods. Returns the clicked one; the inner `None` is the best.
fn show_methods(ui: &mut Ui, methods: &MethodSelection) -> Option<Option<String>> {
    let best = say!("automatic: {method}", method = methods.best());
    let mut clicked = None;
    ComboBox::from_label(t("Render method"))
        .selected_text(methods.chosen().unwrap_or(&best))
        .show_ui(ui, |ui| {
            let is_best = methods.chosen().is_none();
            if ui.selectable_label(is_best, &best).clicked() {
                clicked = Some(None);
            }
            for choice in methods.choices() {
                let is_available = choice.unavailable.is_none();
                let is_chosen = methods.chosen() == Some(choice.name.as_str());
                let label = ui.add_enabled_ui(is_available, |ui| {
                    ui.selectable_label(is_chosen, &choice.name)
                });
                let hover = choice.unavailable.as_ref().unwrap_or(&choice.summary);
                if label.inner.on_hover_text(hover).clicked() {
                    clicked = Some(Some(choice.name.clone()));
                }
            }
        });
    clicked
}
