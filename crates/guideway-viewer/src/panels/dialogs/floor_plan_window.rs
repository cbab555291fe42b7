//! The dialog of the floor plan: size, place, opacity, lock, and the tasks by hand.

use eframe::egui::{
    Align2, Button, Context, DragValue, Grid, Key, Label, Pos2, Response, Slider, Ui, Window,
};
use guideway_spline::Point;

use crate::action::Action;
use crate::backdrop::{
    DRAWING_UNITS, FloorPlanLayer, PlanEditor, PlanPlacement, PlanSize, PlanTask,
};
use crate::command::Command;
use crate::language::{t, translated};

/// Range of the pixels per meter of an image, and of the scale of a drawing.
const SIZES: std::ops::RangeInclusive<f64> = 1e-6..=1e6;
/// Range of typed distances and offsets, in meters.
const MAX_M: f64 = 1e7;
/// Greatest page to choose.
const MAX_PAGE: u32 = 9_999;
/// Width of the dialog, in points.
const WIDTH: f32 = 280.0;

/// Shows the dialog if it is open, first with its lower right corner at `corner`, and returns the
/// actions of changes.
pub(crate) fn show(
    ctx: &Context,
    editor: &mut PlanEditor,
    plan: &mut FloorPlanLayer,
    corner: Pos2,
) -> Vec<Action> {
    let mut actions = Vec::new();
    if !editor.is_open {
        return actions;
    }
    let mut is_open = !plan.is_empty();
    let window = Window::new(t("Floor plan")).open(&mut is_open);
    window
        .resizable(false)
        .default_width(WIDTH)
        .pivot(Align2::RIGHT_BOTTOM)
        .default_pos(corner)
        .show(ctx, |ui| {
            ui.set_max_width(WIDTH);
            content(ui, editor, plan, &mut actions);
        });
    if editor.is_open && !is_open {
        editor.cancel(plan);
    }
    editor.is_open = is_open;
    actions
}

fn content(
    ui: &mut Ui,
    editor: &mut PlanEditor,
    plan: &mut FloorPlanLayer,
    actions: &mut Vec<Action>,
) {
    if let Some(error) = plan.error() {
        ui.colored_label(ui.visuals().error_fg_color, translated(error));
    }
    match plan.placement() {
        Some(placement) => {
            ui.add(Label::new(&placement.file).truncate())
                .on_hover_text(&placement.file);
            let bounds = plan.visible().and_then(|plan| plan.bounds());
            let middle_m = bounds.map(|bounds| bounds.center());
            let place = Place {
                present: &placement,
                middle_m,
            };
            if let Some(assumed_m) = plan.assumed_unit_m()
                && let Some(placement) = show_unit(ui, &placement, assumed_m, plan.is_locked)
            {
                editor.changes_unit = true;
                actions.push(Action::PlaceFloorPlan(placement));
            }
            if let Some(placement) = place.show(ui, plan.is_locked) {
                actions.push(Action::PlaceFloorPlan(placement));
            }
        }
        None => {
            ui.label(plan.text());
        }
    }
    ui.horizontal(|ui| {
        ui.checkbox(&mut plan.is_visible, t("Shown"));
        ui.checkbox(&mut plan.is_locked, t("Locked"));
    });
    let opacity = Slider::new(&mut plan.opacity, 0.0..=1.0).text(t("Opacity"));
    let opacity = opacity.custom_formatter(|opacity, _| format!("{:.0} %", 100.0 * opacity));
    ui.add(opacity.custom_parser(|text| {
        let percent = text.trim_end_matches(['%', ' ']).parse::<f64>();
        percent.ok().map(|percent| percent / 100.0)
    }));
    ui.separator();
    ui.add_enabled_ui(!plan.is_locked, |ui| {
        tasks(ui, editor, plan, actions);
    });
    ui.separator();
    ui.horizontal(|ui| {
        if ui.button(t("Another file…")).clicked() {
            actions.push(Action::Command(Command::FloorPlan));
        }
        if ui.button(t("Remove")).clicked() {
            actions.push(Action::SetFloorPlan(String::new()));
        }
    });
}

/// The unit of a drawing that does not state it, the assumed one first. Returns the placement after
/// a choice.
fn show_unit(
    ui: &mut Ui,
    present: &PlanPlacement,
    assumed_m: f64,
    is_locked: bool,
) -> Option<PlanPlacement> {
    ui.label(t(
        "The drawing does not state its unit. One of its units is:",
    ));
    let mut units = DRAWING_UNITS;
    units.sort_by_key(|(_, unit_m)| *unit_m != assumed_m);
    let mut new = None;
    ui.add_enabled_ui(!is_locked, |ui| {
        ui.horizontal(|ui| {
            for (sign, unit_m) in units {
                let is_present = present.is_in_unit(unit_m, assumed_m);
                let unit = ui.selectable_label(is_present, format!("1 {sign}"));
                if unit.clicked() && !is_present {
                    new = Some(present.in_unit(unit_m, assumed_m));
                }
            }
        });
    });
    new
}

/// The fields of size and place.
struct Place<'a> {
    present: &'a PlanPlacement,
    /// Middle of the plan, which a turn keeps where it is.
    middle_m: Option<Point<f64>>,
}

impl Place<'_> {
    /// Shows the fields and returns the placement after an edit.
    fn show(&self, ui: &mut Ui, is_locked: bool) -> Option<PlanPlacement> {
        let mut new = self.present.clone();
        ui.add_enabled_ui(!is_locked, |ui| {
            Grid::new("floor plan").num_columns(2).show(ui, |ui| {
                if let Some(page) = &mut new.page {
                    field(
                        ui,
                        t("Page"),
                        DragValue::new(page).range(1..=MAX_PAGE).speed(0.05),
                    );
                }
                let (label, value) = match &mut new.size {
                    PlanSize::PxPerM(px_per_m) => (t("Pixels per meter"), px_per_m),
                    PlanSize::Scale(scale) => (t("Scale"), scale),
                };
                let speed = 0.01 * value.abs().max(1e-3);
                let size = DragValue::new(value).range(SIZES).speed(speed);
                field(ui, label, size.max_decimals(6));
                let mut rotate_deg = new.rotate_deg;
                let turn = DragValue::new(&mut rotate_deg).suffix("°").speed(0.5);
                if field(ui, t("Rotation"), turn.range(-360.0..=360.0)).changed() {
                    let middle_m = self.middle_m.unwrap_or(new.offset_m);
                    new = new.turned_about(middle_m, rotate_deg - new.rotate_deg);
                }
                let Point { x, y } = &mut new.offset_m;
                for (label, value) in [("x", x), ("y", y)] {
                    let offset = DragValue::new(value).suffix(" m").speed(0.05);
                    field(ui, label, offset.range(-MAX_M..=MAX_M));
                }
            });
        });
        (new != *self.present).then_some(new)
    }
}

fn field(ui: &mut Ui, label: &str, value: DragValue<'_>) -> Response {
    let label = ui.label(label);
    let response = ui.add(value).labelled_by(label.id);
    ui.end_row();
    response
}

/// The tasks by hand, and what the present one waits for.
fn tasks(ui: &mut Ui, editor: &mut PlanEditor, plan: &FloorPlanLayer, actions: &mut Vec<Action>) {
    ui.horizontal(|ui| {
        let is_moving = matches!(editor.task, PlanTask::Move(_));
        if ui.selectable_label(is_moving, t("Move by hand")).clicked() {
            editor.toggle(PlanTask::Move(None));
        }
        let is_calibrating = matches!(editor.task, PlanTask::Calibrate(_));
        let calibrate = ui.selectable_label(is_calibrating, t("Scale by two points"));
        if calibrate.clicked() {
            editor.toggle(PlanTask::Calibrate(Vec::new()));
        }
    });
    let points = match &editor.task {
        PlanTask::None => return,
        PlanTask::Move(_) => {
            ui.label(t("Drag the plan; Escape ends."));
            return;
        }
        PlanTask::Calibrate(points) => points.len(),
    };
    if points < 2 {
        ui.label(t("Click two points whose distance you know."));
        return;
    }
    ui.horizontal(|ui| {
        let label = ui.label(t("Their distance"));
        let distance = DragValue::new(&mut editor.distance_m).suffix(" m");
        let distance = distance.range(0.0..=MAX_M).speed(0.05).max_decimals(4);
        let field = ui.add(distance).labelled_by(label.id);
        if std::mem::take(&mut editor.asks_distance) {
            field.request_focus();
        }
        let enters = field.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter));
        let calibrated = editor.calibrated(plan);
        let button = Button::new(t("Apply"));
        let applies = ui.add_enabled(calibrated.is_some(), button).clicked();
        if (applies || enters)
            && let Some(placement) = calibrated
        {
            actions.push(Action::PlaceFloorPlan(placement));
            editor.task = PlanTask::None;
        }
    });
}
