//! The Selection section: snapping, and moves, copies and rotations by numbers.

use eframe::egui::{DragValue, Ui};

use crate::action::Action;
use crate::files::OpenFiles;
use crate::selection::ExactEdit;
use crate::tools::Tools;

/// Shows the section.
pub(super) fn show(
    ui: &mut Ui,
    files: &OpenFiles,
    tools: &mut Tools,
    exact: &mut ExactEdit,
    actions: &mut Vec<Action>,
) {
    let count = files.document().map(|document| document.selection().len());
    ui.label(match count {
        Some(1) => "1 path selected".to_owned(),
        Some(count) => format!("{count} paths selected"),
        None => "No document to select in".to_owned(),
    });
    let snaps = &mut tools.snaps_to_grid;
    ui.checkbox(snaps, "Snap moves and new points to the grid");
    ui.horizontal(|ui| {
        ui.label("Offset");
        ui.add(DragValue::new(&mut exact.by_x_m).speed(0.1).suffix(" m"));
        ui.add(DragValue::new(&mut exact.by_y_m).speed(0.1).suffix(" m"));
        if ui.button("Move").clicked() {
            actions.push(Action::Edit(exact.move_selection()));
        }
    });
    ui.horizontal(|ui| {
        let suffix = match exact.copies {
            1 => " copy",
            _ => " copies",
        };
        let copies = DragValue::new(&mut exact.copies).range(1..=1000);
        ui.add(copies.suffix(suffix));
        if ui.button("Copy, one offset apart").clicked() {
            actions.push(Action::Edit(exact.copy_selection()));
        }
    });
    ui.horizontal(|ui| {
        ui.add(DragValue::new(&mut exact.angle_deg).suffix("°"));
        if ui.button("Rotate about its center").clicked() {
            actions.push(Action::Edit(exact.rotate_selection()));
        }
    });
}
