//! The head of the Properties tab: what is selected, and moves, copies and rotations by numbers.

use eframe::egui::{DragValue, Label, Ui};
use guideway_document::Elements;

use crate::action::Action;
use crate::files::{Layer, OpenFiles};
use crate::language::{say, t};
use crate::selection::{ExactEdit, counts};

/// Shows the head: without a selection its summary alone.
pub(super) fn show(
    ui: &mut Ui,
    files: &OpenFiles,
    exact: &mut ExactEdit,
    actions: &mut Vec<Action>,
) {
    let text = match files.document() {
        Some(document) => summary(document.selected()),
        None if files.active().is_some_and(Layer::is_busy) => {
            t("An edit is in progress").to_owned()
        }
        None => t("No layout is open").to_owned(),
    };
    ui.add(Label::new(text).truncate());
    // While an edit has the document, the fields stay: further edits wait for it.
    exact.is_shown = match files.document() {
        Some(document) => document.selected().has_elements(),
        None => exact.is_shown && files.active().is_some(),
    };
    if exact.is_shown {
        show_exact_edits(ui, exact, actions);
    }
}

/// Moves, copies and rotations of the selection by numbers.
fn show_exact_edits(ui: &mut Ui, exact: &mut ExactEdit, actions: &mut Vec<Action>) {
    ui.horizontal(|ui| {
        ui.label(t("Offset"));
        ui.add(DragValue::new(&mut exact.by_x_m).speed(0.1).suffix(" m"));
        ui.add(DragValue::new(&mut exact.by_y_m).speed(0.1).suffix(" m"));
        if ui.button(t("Move")).clicked() {
            actions.push(Action::Edit(exact.move_selection()));
        }
    });
    ui.horizontal(|ui| {
        let suffix = match exact.copies {
            1 => t(" copy"),
            _ => t(" copies"),
        };
        let copies = DragValue::new(&mut exact.copies).range(1..=1000);
        ui.add(copies.suffix(suffix));
        if ui.button(t("Copy, one offset apart")).clicked() {
            actions.push(Action::Edit(exact.copy_selection()));
        }
    });
    ui.horizontal(|ui| {
        ui.add(DragValue::new(&mut exact.angle_deg).suffix("°"));
        if ui.button(t("Rotate about its center")).clicked() {
            actions.push(Action::Edit(exact.rotate_selection()));
        }
    });
}

/// `3 paths, 2 nodes and 1 station selected`.
pub(super) fn summary(selected: &Elements) -> String {
    let counts = counts(selected);
    match counts.split_last() {
        None => t("Nothing is selected").to_owned(),
        Some((last, [])) => say!("{counts} selected", counts = last),
        Some((last, others)) => {
            let counts = others.join(", ") + t(" and ") + last;
            say!("{counts} selected", counts)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn summary_counts_each_kind() {
        let mut selected = Elements::of_paths([1, 2]);
        assert_eq!(summary(&selected), "2 paths selected");
        selected.stations.insert(7);
        assert_eq!(summary(&selected), "2 paths and 1 station selected");
        selected.vehicle_types.insert("tug".into());
        let text = "2 paths, 1 station and 1 vehicle type selected";
        assert_eq!(summary(&selected), text);
        assert_eq!(summary(&Elements::default()), "Nothing is selected");
    }
}
