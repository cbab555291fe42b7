//! Fields that choose from what there is: words, directions, levels, vehicle types.

use std::sync::Arc;

use eframe::egui::{Button, Color32, ComboBox, Response, TextEdit, TextStyle, Ui};
use guideway_document::Document;
use guideway_layout::Direction;

use super::draft::{Subject, Target};
use super::field::Common;
use super::shown::Shown;
use crate::action::Action;
use crate::editing::EditTask;
use crate::language::{direction_name, t};

/// Width of the button behind a field, with the margins of both, in points.
const BUTTON_WIDTH: f32 = 42.0;

/// Width of a field with a button behind it, in points.
pub(super) fn field_width(ui: &Ui) -> f32 {
    (ui.available_width() - BUTTON_WIDTH).max(BUTTON_WIDTH)
}

/// Tells the whole text of a list under the pointer, if there is too little room for it.
fn tell_if_cut(ui: &Ui, list: Response, text: &str) {
    if !list.contains_pointer() {
        return;
    }
    let font = TextStyle::Button.resolve(ui.style());
    let painter = ui.painter();
    let whole = painter.layout_no_wrap(text.to_owned(), font, Color32::PLACEHOLDER);
    let spacing = ui.spacing();
    let beside_text = 2.0 * spacing.button_padding.x + spacing.icon_width + spacing.icon_spacing;
    let seen = list.rect.intersect(ui.clip_rect());
    if whole.size().x > seen.width() - beside_text {
        list.on_hover_text(text);
    }
}

/// A choice of words; an empty one removes the property. Returns the one under the pointer.
pub(super) fn choice(
    ui: &mut Ui,
    target: Target,
    value: &Common,
    words: &[&str],
    actions: &mut Vec<Action>,
) -> Option<(Target, String)> {
    let mut hovered = None;
    let shown = match value {
        Common::Same(value) => value,
        Common::None => t("none"),
        // There is less room than in a field.
        Common::Several => t("several"),
    };
    let combo = ComboBox::from_id_salt(format!("{:?}", target.subject));
    let combo = combo.selected_text(shown).truncate();
    let choices = |ui: &mut Ui| {
        for word in words.iter().copied().chain([""]) {
            let label = if word.is_empty() { t("none") } else { word };
            let response = ui.selectable_label(shown == label, label);
            if response.hovered() {
                hovered = Some((target.clone(), word.to_owned()));
            }
            if response.clicked() && shown != label {
                match target.clone().edit(word) {
                    Ok(edit) => actions.push(Action::Edit(edit)),
                    Err(error) => actions.push(Action::Notify(error)),
                }
            }
        }
    };
    // Long words must not push the button behind the field out of the panel.
    let width = field_width(ui);
    ui.scope(|ui| {
        ui.set_max_width(width);
        let list = combo.width(width).show_ui(ui, choices);
        tell_if_cut(ui, list.response, shown);
    });
    hovered
}

/// The direction of paths. Returns the one under the pointer.
pub(super) fn direction(
    ui: &mut Ui,
    shown: &Shown,
    actions: &mut Vec<Action>,
) -> Option<(Target, String)> {
    let mut hovered = None;
    let present = shown.facts.direction;
    let combo = ComboBox::from_id_salt("direction");
    let text = present.map_or(t("several values"), direction_name);
    combo.selected_text(text).show_ui(ui, |ui| {
        for direction in [Direction::Forward, Direction::Both] {
            let label = ui.selectable_label(present == Some(direction), direction_name(direction));
            let target = shown.target(Subject::Direction(direction));
            if label.hovered() {
                hovered = Some((target.clone(), String::new()));
            }
            if label.clicked() && present != Some(direction) {
                actions.extend(target.edit("").map(Action::Edit).ok());
            }
        }
        ui.separator();
        let reverse = ui.button(t("Reverse"));
        if reverse.on_hover_text(t("Exchange start and end")).clicked() {
            let rows = Arc::clone(&shown.rows);
            actions.push(Action::Edit(EditTask::edit(
                move |document: &mut Document| document.reverse(&rows),
            )));
        }
    });
    hovered
}

pub(super) fn level(ui: &mut Ui, shown: &Shown, actions: &mut Vec<Action>) {
    let name = |level: Option<u32>| match level {
        Some(level) => shown
            .levels
            .get(level as usize)
            .map_or(t("unknown"), |name| name),
        None => t("none"),
    };
    let present = shown.facts.level;
    let combo = ComboBox::from_id_salt(("level", shown.of.element()));
    let text = present.map_or(t("several values"), name);
    combo.selected_text(text).show_ui(ui, |ui| {
        let levels = shown.levels_by_height.iter().copied().map(Some);
        for level in levels.chain([None]) {
            let label = ui.selectable_label(present == Some(level), name(level));
            if label.clicked() && present != Some(level) {
                let elements = shown.elements();
                actions.push(Action::Edit(EditTask::edit(
                    move |document: &mut Document| document.set_level(&elements, level),
                )));
            }
        }
    });
}

/// A check box per vehicle type of the layout; none checked opens the paths to all.
pub(super) fn vehicle_types(
    ui: &mut Ui,
    shown: &Shown,
    new_type: &mut String,
    actions: &mut Vec<Action>,
) {
    let present = shown.facts.vehicle_types.as_deref();
    let text = match present {
        Some([]) => t("all").to_owned(),
        Some(types) => types.join(", "),
        None => t("several values").to_owned(),
    };
    let combo = ComboBox::from_id_salt("vehicle types")
        .selected_text(text.as_str())
        .truncate();
    let list = combo.show_ui(ui, |ui| {
        for name in &shown.facts.all_types {
            let types = present.unwrap_or_default();
            let mut is_on = types.contains(name);
            if ui.checkbox(&mut is_on, name).clicked() {
                let others = types.iter().filter(|other| *other != name);
                let types = others.chain(is_on.then_some(name)).cloned().collect();
                actions.push(set_types(shown, types));
            }
        }
        if ui.button(t("all")).clicked() {
            actions.push(set_types(shown, Vec::new()));
        }
        ui.horizontal(|ui| {
            let field = TextEdit::singleline(new_type).hint_text(t("new vehicle type"));
            ui.add(field.desired_width(120.0));
            let name = new_type.trim();
            let is_new = !name.is_empty() && !shown.facts.all_types.iter().any(|n| n == name);
            if ui.add_enabled(is_new, Button::new(t("Add"))).clicked() {
                let types = present.unwrap_or_default().iter().cloned();
                actions.push(set_types(shown, types.chain([name.to_owned()]).collect()));
                new_type.clear();
            }
        });
    });
    tell_if_cut(ui, list.response, &text);
}

fn set_types(shown: &Shown, types: Vec<String>) -> Action {
    let (of, rows) = (shown.of, Arc::clone(&shown.rows));
    Action::Edit(EditTask::edit(move |document: &mut Document| {
        let types: Vec<&str> = types.iter().map(String::as_str).collect();
        document.set_vehicle_types(of, &rows, &types)
    }))
}
