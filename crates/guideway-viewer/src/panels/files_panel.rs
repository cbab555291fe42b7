//! The Files section: open files and floor plan.

use eframe::egui::{Label, RichText, Ui};
use guideway_layout::shown_path;

use crate::action::Action;
use crate::backdrop::FloorPlanLayer;
use crate::files::OpenFiles;

/// Shows the section.
pub(super) fn show(
    ui: &mut Ui,
    files: &mut OpenFiles,
    floor_plan: &mut FloorPlanLayer,
    actions: &mut Vec<Action>,
) {
    let (active, has_several) = (files.active_index(), files.layers().len() > 1);
    for (index, layer) in files.layers_mut().iter_mut().enumerate() {
        ui.horizontal(|ui| {
            let mark = if layer.is_changed() { "*" } else { "" };
            let name = format!("{}{mark}", layer.name());
            let label = ui.selectable_label(active == index, name);
            let path = shown_path(layer.path());
            if label.on_hover_text(path).clicked() {
                actions.push(Action::Activate(index));
            }
            ui.checkbox(&mut layer.is_visible, "shown");
            if has_several && !layer.is_changed() && ui.small_button("Close").clicked() {
                actions.push(Action::Close(index));
            }
        });
        if let Some(document) = layer.document() {
            let scene = document.scene();
            ui.small(format!(
                "{} paths, {} hidden, {} refused",
                scene.path_count(),
                scene.hidden_count(),
                document.layout().refused.len(),
            ));
        }
    }
    show_floor_plan(ui, floor_plan);
}

fn show_floor_plan(ui: &mut Ui, floor_plan: &mut FloorPlanLayer) {
    if floor_plan.text().is_empty() {
        return;
    }
    let label = match floor_plan.is_reading() {
        true => "floor plan (loading)",
        false => "floor plan",
    };
    ui.checkbox(&mut floor_plan.is_visible, label);
    let text = floor_plan.text();
    let plan = Label::new(RichText::new(text).small());
    ui.add(plan.truncate()).on_hover_text(text);
    if let Some(error) = floor_plan.error() {
        ui.colored_label(ui.visuals().error_fg_color, error);
    }
}
