//! The settings that no menu has: theme, grid, file dialogs.

use eframe::egui::{Align2, Checkbox, ComboBox, Context, DragValue, Grid, Ui, Window};

use crate::action::Action;
use crate::display_settings::{DisplaySettings, GRID_STEPS_M, ThemeChoice};
use crate::language::{Language, t};
use crate::units::{LengthUnit, SpeedUnit};

/// Grid step when the user first sets one, in meters.
const FIRST_STEP_M: f64 = 1.0;

/// The dialog.
#[derive(Default)]
pub(crate) struct SettingsDialog {
    pub(crate) is_open: bool,
}

impl SettingsDialog {
    /// Shows the dialog if it is open; changes apply at once.
    pub(crate) fn show(&mut self, ctx: &Context, settings: &mut DisplaySettings) -> Option<Action> {
        if !self.is_open {
            return None;
        }
        let before = settings.theme;
        let window = Window::new(t("Settings")).open(&mut self.is_open);
        let window = window.pivot(Align2::CENTER_CENTER);
        let window = window.default_pos(ctx.content_rect().center());
        window.resizable(false).show(ctx, |ui| {
            Grid::new("settings").num_columns(2).show(ui, |ui| {
                theme(ui, settings);
                language(ui, settings);
                speeds(ui, settings);
                lengths(ui, settings);
                grid_step(ui, settings);
                ui.label(t("File names"));
                let asks = &mut settings.uses_desktop_dialogs;
                ui.add(Checkbox::new(asks, t("ask in the dialogs of the desktop")));
                ui.end_row();
            });
        });
        (settings.theme != before).then_some(Action::ApplyTheme)
    }
}

fn theme(ui: &mut Ui, settings: &mut DisplaySettings) {
    ui.label(t("Theme"));
    ui.horizontal(|ui| {
        for (choice, name) in [
            (ThemeChoice::System, t("as the desktop")),
            (ThemeChoice::Light, t("light")),
            (ThemeChoice::Dark, t("dark")),
        ] {
            ui.radio_value(&mut settings.theme, choice, name);
        }
    });
    ui.end_row();
}

fn language(ui: &mut Ui, settings: &mut DisplaySettings) {
    let name = |language: Option<Language>| language.map_or(t("as the desktop"), Language::name);
    let all = std::iter::once(None).chain(Language::ALL.map(Some));
    choice(
        ui,
        "language",
        "Language",
        &mut settings.language,
        all,
        name,
    );
}

fn speeds(ui: &mut Ui, settings: &mut DisplaySettings) {
    let (unit, all) = (&mut settings.speed_unit, SpeedUnit::ALL);
    choice(ui, "speeds", t("Speeds in"), unit, all, SpeedUnit::name);
}

fn lengths(ui: &mut Ui, settings: &mut DisplaySettings) {
    let (unit, all) = (&mut settings.length_unit, LengthUnit::ALL);
    let label = t("Lengths of properties in");
    choice(ui, "lengths", label, unit, all, LengthUnit::name);
}

/// A row with a list of names, one per value. `id` is that of the list.
fn choice<T: Copy + PartialEq>(
    ui: &mut Ui,
    id: &str,
    label: &str,
    value: &mut T,
    all: impl IntoIterator<Item = T>,
    name: impl Fn(T) -> &'static str,
) {
    let label = ui.label(label);
    ComboBox::from_id_salt(id)
        .selected_text(name(*value))
        .show_ui(ui, |ui| {
            for known in all {
                ui.selectable_value(value, known, name(known));
            }
        })
        .response
        .labelled_by(label.id);
    ui.end_row();
}

fn grid_step(ui: &mut Ui, settings: &mut DisplaySettings) {
    ui.label(t("Grid lines"));
    ui.horizontal(|ui| {
        let mut is_given = settings.grid_step_m.is_some();
        if ui.checkbox(&mut is_given, t("every")).clicked() {
            settings.grid_step_m = is_given.then_some(FIRST_STEP_M);
        }
        let mut step_m = settings.grid_step_m.unwrap_or(FIRST_STEP_M);
        let field = DragValue::new(&mut step_m).range(GRID_STEPS_M).speed(0.05);
        if ui.add_enabled(is_given, field.suffix(" m")).changed() {
            settings.grid_step_m = Some(step_m);
        }
    });
    ui.end_row();
}
