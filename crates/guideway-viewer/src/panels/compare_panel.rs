//! The comparison: the other file, and the list of what is gone, new and changed.

use eframe::egui::{ComboBox, Link, RichText, ScrollArea, Ui};

use crate::action::Action;
use crate::canvas::change_color;
use crate::compare::{ChangeKind, Changed, Comparison};
use crate::files::OpenFiles;
use crate::language::{grouped, say, t};

const ROW_HEIGHT: f32 = 18.0;

/// Shows the view.
pub(super) fn show(
    ui: &mut Ui,
    files: &OpenFiles,
    comparison: &mut Comparison,
    actions: &mut Vec<Action>,
) {
    let Some(active) = files.active().filter(|_| files.layers().len() > 1) else {
        ui.label(t(
            "Open another file to compare with; changes are those from it to this one",
        ));
        return;
    };
    ui.horizontal(|ui| {
        ui.label(say!("Changes of {name} from", name = active.name()));
        let other = comparison.other(files).map(|(_, layer)| layer.name());
        let text = other.unwrap_or_else(|| t("choose a file…").to_owned());
        let chosen = ComboBox::from_id_salt("other file").selected_text(text);
        chosen.show_ui(ui, |ui| {
            for (index, layer) in files.layers().iter().enumerate() {
                let is_other = index != files.active_index();
                let is_chosen = comparison.with.as_deref() == Some(layer.path());
                if is_other && ui.selectable_label(is_chosen, layer.name()).clicked() {
                    comparison.with = Some(layer.path().to_owned());
                }
            }
        });
        if comparison.is_busy() {
            ui.spinner();
        }
        if let Some(Ok(changed)) = comparison.changed(files) {
            show_counts(ui, changed);
        }
    });
    let other = comparison.other(files).map(|(index, _)| index);
    match (comparison.changed(files), other) {
        (Some(Ok(changed)), Some(other)) => show_lines(ui, changed, other, actions),
        (Some(Err(error)), _) => {
            ui.label(error);
        }
        _ => {}
    }
}

fn show_counts(ui: &mut Ui, changed: &Changed) {
    for (kind, name) in [
        (ChangeKind::Gone, t("gone")),
        (ChangeKind::New, t("new")),
        (ChangeKind::Changed, t("changed")),
    ] {
        let count = grouped(changed.count(kind) as u64);
        let text = RichText::new(format!("{count} {name}"));
        ui.label(text.color(change_color(kind)));
    }
    if changed.lines.is_empty() && changed.groups.is_empty() {
        ui.label(t("The files mean the same"));
    }
}

fn show_lines(ui: &mut Ui, changed: &Changed, other: usize, actions: &mut Vec<Action>) {
    let count = changed.groups.len() + changed.lines.len();
    let scroll = ScrollArea::vertical().auto_shrink(false);
    scroll.show_rows(ui, ROW_HEIGHT, count, |ui, rows| {
        for number in rows {
            let Some(line) = number.checked_sub(changed.groups.len()) else {
                ui.label(&changed.groups[number]);
                continue;
            };
            let line = &changed.lines[line];
            let text = RichText::new(&line.text).color(change_color(line.kind));
            if ui.add(Link::new(text)).clicked() {
                actions.push(match line.kind {
                    ChangeKind::Gone => Action::FlyTo(other, line.element),
                    _ => Action::ZoomTo(line.element),
                });
            }
        }
    });
}
