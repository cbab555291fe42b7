//! The head of the View tab: colors, line widths, decorations, swept areas.

use eframe::egui::{ComboBox, DragValue, Slider, TextEdit, Ui};
use guideway_layout::{Attribute, Layout, Values};
use guideway_scene::{ColorBy, Palette};

use crate::action::Action;
use crate::backdrop::SweptAreasLayer;
use crate::display_settings::{DisplaySettings, MAX_WIDTH_M, MIN_PX_RANGE};
use crate::files::OpenFiles;
use crate::language::{t, translated};
use crate::typed_breaks::TypedBreaks;

/// Columns that color every layout, beside its attributes.
const BUILT_IN_COLUMNS: [&str; 3] = ["direction", "level", "vehicle_type"];

/// Width of lines when the user first sets one, in meters.
const FIRST_WIDTH_M: f64 = 0.05;
/// Width of the field of class breaks, in points: some six numbers.
const BREAKS_WIDTH: f32 = 130.0;
/// Change of a number of a column per point of a drag.
const DRAG_SPEED: f64 = 0.02;

/// Shows the section.
pub(super) fn show(
    ui: &mut Ui,
    files: &OpenFiles,
    settings: &mut DisplaySettings,
    swept_areas: &mut SweptAreasLayer,
    actions: &mut Vec<Action>,
) {
    let before = settings.clone();
    let columns = files.document().map_or(Vec::new(), |d| columns(d.layout()));
    let file_colors = t("as in the file");
    let color_by = settings.color_by.as_deref().unwrap_or(file_colors);
    let selected = columns.iter().find(|(name, _)| name == color_by);
    let selected = selected.map_or(color_by, |(_, label)| label).to_owned();
    ComboBox::from_label(t("Color"))
        .selected_text(selected)
        .show_ui(ui, |ui| {
            ui.selectable_value(&mut settings.color_by, None, file_colors);
            for (name, label) in columns {
                ui.selectable_value(&mut settings.color_by, Some(name), label);
            }
        });
    if settings.color_by != before.color_by {
        // The numbers of another column have another range and other classes.
        settings.range = [None; 2];
        settings.breaks = TypedBreaks::default();
    }
    if let Some(document) = files.document() {
        show_numbers(ui, document.layout(), settings);
    }
    ui.checkbox(&mut settings.is_thesis_rule, t("Line widths of the thesis"));
    ui.add_enabled_ui(!settings.is_thesis_rule, |ui| {
        show_width(ui, settings);
        let min_width = Slider::new(&mut settings.min_px, MIN_PX_RANGE).suffix(" pt");
        ui.add(min_width.text(t("Minimum")));
    });
    let mut shows_density = settings.shows_density();
    if ui.checkbox(&mut shows_density, t("Density")).clicked() {
        settings.set_density(shows_density);
    }
    ui.checkbox(&mut settings.has_arrows, t("Arrows"));
    ui.checkbox(&mut settings.has_symbols, t("Nodes and stations"));
    ui.checkbox(&mut settings.has_labels, t("Labels"));
    ui.checkbox(&mut settings.has_grid, t("Grid"));
    let mut is_dark = settings.is_dark;
    if ui.checkbox(&mut is_dark, t("Dark")).clicked() {
        settings.set_dark(is_dark);
    }
    ui.checkbox(&mut swept_areas.is_visible, t("Swept areas"));
    let label = ui.label(t(
        "Vehicle: LENGTHxWIDTH or LENGTHxWIDTH,REAR in meters, or `file`",
    ));
    ui.add(TextEdit::singleline(&mut swept_areas.vehicle_text))
        .labelled_by(label.id);
    if let Some(error) = swept_areas.error() {
        ui.colored_label(ui.visuals().error_fg_color, translated(error));
    }
    if before.theme != settings.theme {
        actions.push(Action::ApplyTheme);
    }
    if before.needs_other_scene(settings) {
        // A user who chooses colors wants to see them.
        settings.is_crowded = false;
        actions.push(Action::Recolor);
    }
}

/// Shows palette, range and class breaks, if numbers decide the colors.
fn show_numbers(ui: &mut Ui, layout: &Layout, settings: &mut DisplaySettings) {
    let column = settings.color_by.as_ref();
    let attribute = column.and_then(|column| layout.paths.column(column));
    let has_numbers = |of: &Attribute| matches!(of.values, Values::Int(_) | Values::Float(_));
    let Some(attribute) = attribute.filter(|attribute| has_numbers(attribute)) else {
        return;
    };
    ComboBox::from_label(t("Palette"))
        .selected_text(t(settings.palette.name()))
        .show_ui(ui, |ui| {
            for palette in Palette::ALL {
                ui.selectable_value(&mut settings.palette, palette, t(palette.name()));
            }
        });
    let by = ColorBy {
        column: attribute.name.clone(),
    };
    match settings.breaks.breaks() {
        Some(_) => {
            ui.weak(t("Class breaks take the place of a range"));
        }
        None => show_range(ui, layout, &by, settings),
    }
    show_breaks(ui, layout, &by, settings);
}

/// Shows the numbers at both ends of the palette.
fn show_range(ui: &mut Ui, layout: &Layout, by: &ColorBy, settings: &mut DisplaySettings) {
    let [from, to] = settings.range;
    let limits = [
        f64::MIN..=to.unwrap_or(f64::MAX),
        from.unwrap_or(f64::MIN)..=f64::MAX,
    ];
    let present = || by.range(layout).unwrap_or([0.0, 1.0]);
    ui.horizontal(|ui| {
        let ends = [t("Range from"), t("up to")]
            .into_iter()
            .zip(limits)
            .enumerate();
        for (end, (label, limits)) in ends {
            let is_given = settings.range[end].is_some();
            optional(ui, label, is_given, |is_given| {
                settings.range[end] = is_given.then(|| present()[end]);
            });
            if let Some(number) = &mut settings.range[end] {
                ui.add(DragValue::new(number).range(limits).speed(DRAG_SPEED));
            }
        }
    });
}

/// Shows the numbers between classes of colors, and what is wrong with their text.
fn show_breaks(ui: &mut Ui, layout: &Layout, by: &ColorBy, settings: &mut DisplaySettings) {
    let mut text = settings.breaks.text().to_owned();
    let label = ui.label(t("Class breaks"));
    ui.horizontal(|ui| {
        let field = TextEdit::singleline(&mut text)
            .hint_text("0.3, 0.6, 1")
            .desired_width(BREAKS_WIDTH);
        if ui.add(field).labelled_by(label.id).changed() {
            settings.breaks.set_text(text);
        }
        if ui.button(t("From the scale")).clicked() {
            let round = by.round_breaks(layout, settings.number_colors().range);
            settings.breaks = round.into();
        }
    });
    if let Some(error) = settings.breaks.error() {
        ui.colored_label(ui.visuals().error_fg_color, error);
    }
}

/// Shows the width of lines in meters, or that it is automatic.
fn show_width(ui: &mut Ui, settings: &mut DisplaySettings) {
    ui.horizontal(|ui| {
        let is_given = settings.width_m.is_some();
        optional(ui, t("Width"), is_given, |is_given| {
            settings.width_m = is_given.then_some(FIRST_WIDTH_M);
        });
        if let Some(width_m) = &mut settings.width_m {
            ui.add(Slider::new(width_m, 0.0..=MAX_WIDTH_M).suffix(" m"));
        }
    });
}

/// Shows whether a number is given, or else that it is automatic; `set` takes a change of that.
fn optional(ui: &mut Ui, label: &str, mut is_given: bool, set: impl FnOnce(bool)) {
    if ui.checkbox(&mut is_given, label).clicked() {
        set(is_given);
    }
    if !is_given {
        ui.weak(t("automatic"));
    }
}

/// Names of the columns that can color the paths of a layout, and labels with their units.
fn columns(layout: &Layout) -> Vec<(String, String)> {
    let paths = &layout.paths;
    let label = |name: &str| {
        paths
            .column(name)
            .map_or_else(String::new, Attribute::label)
    };
    let attributes = paths
        .column_names()
        .map(|name| (name.to_owned(), label(name)));
    let built_in = BUILT_IN_COLUMNS.map(|name| (name.to_owned(), name.to_owned()));
    attributes.chain(built_in).collect()
}
