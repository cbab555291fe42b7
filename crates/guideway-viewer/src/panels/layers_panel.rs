//! The Layers tab: open files with their levels and kinds of elements, and the floor plan.

use std::path::Path;

use eframe::egui::collapsing_header::CollapsingState;
use eframe::egui::{Align, Button, Color32, Id, Label, Layout, RichText, Ui};
use guideway_document::{Document, Group};
use guideway_layout::shown_path;
use guideway_scene::{Rgba, Table};

use super::group_list;
use super::slider::slider;
use crate::action::Action;
use crate::backdrop::FloorPlanLayer;
use crate::display_settings::DisplaySettings;
use crate::files::{Layer, LayerLook, OpenFiles};
use crate::language::{counted, t, translated};

/// Shows the tab. Returns the level or vehicle type under the pointer, with the index of its file.
pub(super) fn show(
    ui: &mut Ui,
    files: &mut OpenFiles,
    floor_plan: &mut FloorPlanLayer,
    settings: &DisplaySettings,
    actions: &mut Vec<Action>,
) -> Option<(usize, Group)> {
    let mut hovered = None;
    let (active, count) = (files.active_index(), files.layers().len());
    if count == 0 {
        ui.label(t("No file is open"));
    }
    for (index, layer) in files.layers_mut().iter_mut().enumerate() {
        let id = Id::unique(("layer", layer.path()));
        let row = LayerRow {
            index,
            count,
            is_active: index == active,
        };
        let look = layer.look.clone();
        CollapsingState::load_with_default_open(ui.ctx(), id, true)
            .show_header(ui, |ui| row.show(ui, layer, actions))
            .body(|ui| {
                let group = row.show_details(ui, layer, settings, actions);
                hovered = group.map(|group| (index, group)).or(hovered.take());
            });
        if layer.look.color != look.color {
            actions.push(Action::Recolor);
        }
    }
    show_floor_plan(ui, floor_plan);
    hovered
}

/// The place of a file in the list.
struct LayerRow {
    index: usize,
    count: usize,
    is_active: bool,
}

impl LayerRow {
    /// Shows visibility, name, and the buttons that move and close the file.
    fn show(&self, ui: &mut Ui, layer: &mut Layer, actions: &mut Vec<Action>) {
        let checkbox = ui.checkbox(&mut layer.is_visible, "");
        checkbox.on_hover_text(t("Show this file"));
        let right = Layout::right_to_left(Align::Center);
        ui.with_layout(right, |ui| {
            let close = ui.small_button("×");
            if close.on_hover_text(t("Close this file")).clicked() {
                actions.push(Action::Close(self.index));
            }
            if self.count > 1 {
                self.show_order(ui, actions);
            }
            ui.with_layout(Layout::left_to_right(Align::Center), |ui| {
                let mark = if layer.is_changed() { "*" } else { "" };
                let name = format!("{}{mark}", layer.name());
                let button = Button::selectable(self.is_active, name).truncate();
                let path = shown_path(layer.path());
                let hint = match self.is_active {
                    true => format!("{path}\n{}", t("This file is edited, and drawn on top")),
                    false => format!("{path}\n{}", t("A click edits this file from now on")),
                };
                if ui.add(button).on_hover_text(hint).clicked() {
                    actions.push(Action::Activate(self.index));
                }
            });
        });
    }

    fn show_order(&self, ui: &mut Ui, actions: &mut Vec<Action>) {
        for (glyph, by, hint) in [
            ("↓", 1, t("Draw this file below the next one")),
            ("↑", -1, t("Draw this file above the one before")),
        ] {
            // The first of the list is on top, as in other programs.
            let to = self.index.checked_add_signed(by);
            let to = to.filter(|to| *to < self.count);
            let button = ui.add_enabled(
                to.is_some(),
                Button::new(RichText::new(glyph).monospace()).small(),
            );
            if let (true, Some(to)) = (button.on_hover_text(hint).clicked(), to) {
                actions.push(Action::MoveLayer {
                    from: self.index,
                    to,
                });
            }
        }
    }

    fn show_details(
        &self,
        ui: &mut Ui,
        layer: &mut Layer,
        settings: &DisplaySettings,
        actions: &mut Vec<Action>,
    ) -> Option<Group> {
        if let Some(document) = layer.document() {
            ui.add(Label::new(RichText::new(contents(document)).small()).truncate());
        }
        let look = &mut layer.look;
        ui.horizontal_wrapped(|ui| {
            for (name, is_on) in kinds(look) {
                ui.toggle_value(is_on, name);
            }
        });
        ui.horizontal(|ui| {
            slider(ui, &mut look.opacity).on_hover_text(t("Opacity of this file"));
            show_color(ui, look, settings);
        });
        let document = layer.document()?;
        group_list::show(ui, (self.index, self.is_active), document, actions)
    }
}

/// Names and switches of the kinds of elements.
fn kinds(look: &mut LayerLook) -> [(&'static str, &mut bool); 5] {
    [
        (t("Paths"), &mut look.has_paths),
        (t("Nodes"), &mut look.has_nodes),
        (t("Stations"), &mut look.has_stations),
        (t("Names"), &mut look.has_names),
        (t("Arrows"), &mut look.has_arrows),
    ]
}

/// The color of a file, with a button that returns to that of the display settings.
fn show_color(ui: &mut Ui, look: &mut LayerLook, settings: &DisplaySettings) {
    let color = look.color.or(settings.scene_options().color);
    let Rgba { r, g, b, .. } = color.unwrap_or(Rgba::BLACK);
    let mut picked = Color32::from_rgb(r, g, b);
    let button = ui.color_edit_button_srgba(&mut picked);
    let button = button.on_hover_text(t("Color of the paths that have none of their own"));
    if button.changed() {
        look.color = Some(Rgba::opaque(picked.r(), picked.g(), picked.b()));
    }
    if look.color.is_some() && ui.small_button(t("Default color")).clicked() {
        look.color = None;
    }
}

/// `326 paths, 206 nodes, 67 stations; 2 paths hidden`.
fn contents(document: &Document) -> String {
    let (scene, layout) = (document.scene(), document.layout());
    let places = |of: Table| {
        let count = of.row_count(layout) - scene.removed(of).count();
        counted(count as u64, of.element())
    };
    let paths = counted(scene.path_count() as u64, "path");
    let (nodes, stations) = (places(Table::Nodes), places(Table::Stations));
    let mut text = format!("{paths}, {nodes}, {stations}");
    let refused = layout.refused.len();
    for (count, what) in [
        (scene.hidden_count(), t("hidden")),
        (refused, t("not drawable")),
    ] {
        if count > 0 {
            let count = counted(count as u64, "path");
            text += &format!("; {count} {what}");
        }
    }
    text
}

fn show_floor_plan(ui: &mut Ui, floor_plan: &mut FloorPlanLayer) {
    if floor_plan.text().is_empty() {
        return;
    }
    ui.separator();
    let label = match floor_plan.is_reading() {
        true => t("Floor plan (loading)"),
        false => t("Floor plan"),
    };
    ui.checkbox(&mut floor_plan.is_visible, label);
    let text = floor_plan.text();
    let placement = floor_plan.placement();
    let file = placement.as_ref().map_or(text, |plan| plan.file.as_str());
    let name = Path::new(file)
        .file_name()
        .map(|name| name.to_string_lossy());
    let plan = Label::new(RichText::new(name.unwrap_or(file.into())).small());
    ui.add(plan.truncate()).on_hover_text(text);
    if let Some(error) = floor_plan.error() {
        ui.colored_label(ui.visuals().error_fg_color, translated(error));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tests::services::lanes;

    #[test]
    fn contents_count_what_is_there() {
        let mut document = Document::new(lanes(3).into(), &Default::default()).unwrap();
        assert_eq!(contents(&document), "3 paths, 6 nodes, 0 stations");
        document.select([1].into_iter().collect(), Default::default());
        document.hide_selection();
        let text = contents(&document);
        assert_eq!(text, "3 paths, 6 nodes, 0 stations; 1 path hidden");
    }
}
