//! The network of a drawing: what is joined, cut, named and left, before it is made.

use eframe::egui::{Button, ComboBox, DragValue, Grid, Label, RichText, ScrollArea, Ui};
use guideway_document::text_format::single_line;
use guideway_network::{DirectionRule, DrawingSources, NoteSource};

use super::new_edges::speed_field;
use crate::action::Action;
use crate::canvas::{CUT_COLOR, JOINED_COLOR, STATION_COLOR};
use crate::files::OpenFiles;
use crate::language::{grouped, say, t, translated};
use crate::network_draft::{NetworkDraft, toggle_source};

const LENGTHS_M: std::ops::RangeInclusive<f64> = 0.0..=100.0;
/// Smoothing distance when the user switches it on, in meters.
const SMOOTH_M: f64 = 0.02;
/// Characters of the name of a layer.
const NAME_CHARS: usize = 40;

/// Shows the view.
pub(super) fn show(
    ui: &mut Ui,
    files: &OpenFiles,
    draft: &mut NetworkDraft,
    actions: &mut Vec<Action>,
) {
    if files.active().is_none() {
        ui.label(t(
            "Open a drawing, such as a DXF file; its lines become the edges of a network",
        ));
        return;
    }
    let sources = draft.sources(files).unwrap_or_default();
    ui.horizontal_wrapped(|ui| {
        show_lengths(ui, draft);
        show_layers(ui, draft, &sources);
        let (stations, names) = (&mut draft.options.stations, &mut draft.options.names);
        show_notes(ui, t("Stations"), stations, &sources);
        show_notes(ui, t("Names of nodes"), names, &sources);
        ui.checkbox(&mut draft.options.two_way, t("Two-way"))
            .on_hover_text(t(
                "Vehicles drive in both directions; else as the lines were drawn",
            ));
    });
    show_result(ui, files, draft, actions);
}

/// A field with its label inside, so that a new line does not come between them.
fn length(ui: &mut Ui, label: &str, value_m: &mut f64) {
    let field = DragValue::new(value_m).range(LENGTHS_M).speed(0.005);
    let field = field.prefix(format!("{label} ")).suffix(" m");
    ui.add(field.max_decimals(3));
}

fn show_lengths(ui: &mut Ui, draft: &mut NetworkDraft) {
    let options = &mut draft.options;
    length(ui, t("Join ends within"), &mut options.weld_m);
    ui.label(t("Cut at"));
    ui.checkbox(&mut options.split_junctions, t("junctions"))
        .on_hover_text(t("Where the end of a line meets the middle of another"));
    ui.checkbox(&mut options.split_crossings, t("crossings"));
    let mut is_smooth = options.smooth_m.is_some();
    ui.checkbox(&mut is_smooth, t("Smooth within"))
        .on_hover_text(t("Chains of short lines become curves"));
    let mut smooth_m = options.smooth_m.unwrap_or(SMOOTH_M);
    if is_smooth {
        length(ui, "", &mut smooth_m);
    }
    options.smooth_m = is_smooth.then_some(smooth_m);
    length(ui, t("Notes reach"), &mut options.reach_m);
}

/// Shows a menu of the layers: which are used, at which speed and direction.
fn show_layers(ui: &mut Ui, draft: &mut NetworkDraft, sources: &DrawingSources) {
    let layers = sources.layers.iter();
    let used = layers.filter(|(name, _)| !draft.rule(name).leave).count();
    let text = say!("Layers: {used} of {all}", used, all = sources.layers.len());
    ui.menu_button(text, |ui| {
        ScrollArea::vertical().show(ui, |ui| {
            Grid::new("layers of the drawing").show(ui, |ui| {
                for (name, paths) in &sources.layers {
                    show_layer(ui, draft, name, *paths);
                    ui.end_row();
                }
            });
        });
    });
}

fn show_layer(ui: &mut Ui, draft: &mut NetworkDraft, name: &str, paths: u64) {
    let mut rule = draft.rule(name);
    let mut is_used = !rule.leave;
    let shown = match name {
        "" => t("(no layer)").to_owned(),
        name => single_line(name, NAME_CHARS),
    };
    ui.checkbox(&mut is_used, format!("{shown} ({})", grouped(paths)));
    rule.leave = !is_used;
    let mut has_speed = rule.max_speed_m_s.is_some();
    ui.checkbox(&mut has_speed, t("speed"));
    let mut speed_m_s = rule.max_speed_m_s.unwrap_or(1.0);
    ui.add_enabled_ui(has_speed, |ui| speed_field(ui, &mut speed_m_s));
    rule.max_speed_m_s = has_speed.then_some(speed_m_s);
    let directions = [
        (None, t("as all")),
        (Some(DirectionRule::Both), t("two-way")),
        (Some(DirectionRule::Forward), t("as drawn")),
        (Some(DirectionRule::Backward), t("against the drawing")),
    ];
    let chosen = directions
        .iter()
        .find(|(rule_of, _)| *rule_of == rule.direction);
    ComboBox::from_id_salt(("direction", name))
        .selected_text(chosen.map_or("", |(_, text)| text))
        .show_ui(ui, |ui| {
            for (direction, text) in directions {
                ui.selectable_value(&mut rule.direction, direction, text);
            }
        });
    if rule != draft.rule(name) {
        draft.set_rule(rule);
    }
}

/// Shows a menu of the notes of the drawing, to choose those with a meaning.
fn show_notes(ui: &mut Ui, what: &str, chosen: &mut Vec<NoteSource>, sources: &DrawingSources) {
    let text = match &chosen[..] {
        [] => say!("{what}: none", what),
        [one] => format!("{what}: {}", single_line(&one.to_string(), NAME_CHARS)),
        more => say!("{what}: {count} sources", what, count = more.len()),
    };
    ui.menu_button(text, |ui| {
        if sources.notes.is_empty() {
            ui.label(t("The drawing has no texts, blocks, points or circles"));
        }
        ScrollArea::vertical().show(ui, |ui| {
            for (source, notes) in &sources.notes {
                let name = single_line(&source.to_string(), NAME_CHARS);
                let mut is_chosen = chosen.contains(source);
                let text = format!("{name} ({})", grouped(*notes));
                if ui.checkbox(&mut is_chosen, text).changed() {
                    toggle_source(chosen, source);
                }
            }
        });
    });
}

fn show_result(ui: &mut Ui, files: &OpenFiles, draft: &NetworkDraft, actions: &mut Vec<Action>) {
    let network = draft.network(files);
    ui.horizontal(|ui| {
        let can_make = draft.is_ready(files) && network.is_some_and(|network| network.is_ok());
        let button = Button::new(t("Make the network"));
        let hint = t("As a new layout beside the drawing, which stays as it is");
        let button = ui.add_enabled(can_make, button).on_hover_text(hint);
        if button.clicked() {
            actions.push(Action::MakeNetwork);
        }
        ui.colored_label(JOINED_COLOR, t("joined"));
        ui.colored_label(CUT_COLOR, t("cut"));
        ui.colored_label(STATION_COLOR, t("station"));
        if draft.is_busy() {
            ui.spinner();
        }
    });
    match network {
        Some(Ok(drafted)) => {
            ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
                for (number, line) in drafted.lines.iter().enumerate() {
                    let line = RichText::new(translated(line));
                    let line = if number == 0 { line.strong() } else { line };
                    ui.add(Label::new(line).wrap());
                }
            });
        }
        Some(Err(error)) => {
            let color = ui.visuals().error_fg_color;
            ui.colored_label(color, translated(&error.message));
            ui.add(Label::new(translated(&error.remedy)).wrap());
        }
        None => {}
    }
}
