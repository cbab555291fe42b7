//! The Find tab: search by name, and selection by query.

use eframe::egui::{Key, TextEdit, Ui};
use guideway_document::SelectMode;

use crate::action::Action;
use crate::files::{Layer, OpenFiles};
use crate::language::{t, translated};
use crate::selection::Find;

/// Shows the section.
pub(super) fn show(ui: &mut Ui, files: &OpenFiles, find: &mut Find, actions: &mut Vec<Action>) {
    let label = ui.label(t("Name"));
    let field = TextEdit::singleline(&mut find.name)
        .hint_text(t("path, node, station, level or vehicle type"));
    let field = ui.add(field).labelled_by(label.id);
    if std::mem::take(&mut find.wants_focus) {
        field.request_focus();
    }
    if field.changed() {
        actions.push(Action::Search);
    }
    let is_entered = |ui: &Ui| ui.input(|input| input.key_pressed(Key::Enter));
    if field.lost_focus() && is_entered(ui) {
        find.zooms_to_first = true;
    }
    if let Some(document) = files.document() {
        let layout = document.layout();
        for element in find.results(document) {
            let kind = t(element.table_row().0.element());
            if ui.link(format!("{kind} {}", element.id(layout))).clicked() {
                actions.push(Action::ZoomTo(element));
            }
        }
        for group in find.groups(document) {
            let (kind, id) = (t(group.kind()), group.id(layout).unwrap_or_default());
            if ui.link(format!("{kind} {id}")).clicked() {
                actions.push(Action::ZoomToGroup(group.clone()));
            }
        }
        for more in find.more() {
            ui.weak(more);
        }
    }
    let label = ui.label(t("Query"));
    let field = TextEdit::singleline(&mut find.query).hint_text("maxSpeed > 1 and id ~ dock");
    let field = ui.add(field).labelled_by(label.id);
    if field.changed() {
        find.query_error = None;
    }
    if field.lost_focus() && is_entered(ui) {
        actions.push(Action::SelectByQuery(SelectMode::Replace));
    }
    ui.horizontal(|ui| {
        for (label, mode) in [
            (t("Select matches"), SelectMode::Replace),
            (t("Add"), SelectMode::Add),
            (t("Remove"), SelectMode::Remove),
        ] {
            if ui.button(label).clicked() {
                actions.push(Action::SelectByQuery(mode));
            }
        }
        if files.active().is_some_and(Layer::is_busy) {
            ui.spinner();
        }
    });
    if let Some(error) = &find.query_error {
        ui.colored_label(ui.visuals().error_fg_color, translated(error));
    }
}
