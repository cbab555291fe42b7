//! The floor plan: opens its file, routes clicks and drags to it, and shows its dialog.

use std::mem;
use std::path::Path;

use eframe::egui::{Context, Vec2};
use guideway_compose::FloorPlanKind;
use guideway_layout::shown_path;
use guideway_spline::{Bounds, Point};

use super::state::App;
use crate::action::Action;
use crate::backdrop::{PlanPlacement, PlanSize};
use crate::files::LayerContext;
use crate::panels::dialogs::floor_plan_window;
use crate::tools::PointerEvent;

/// Scale of an image until the user sets it, in pixels per meter.
const FIRST_PX_PER_M: f64 = 20.0;
/// Space between the dialog and the corner of the canvas at first, in points.
const PLAN_WINDOW_MARGIN: Vec2 = Vec2::splat(16.0);

impl App {
    /// Shows the floor plan of a text: a file, or a file and its placement. An empty text removes
    /// the present plan.
    pub(super) fn set_floor_plan(&mut self, text: &str) {
        let text = text.trim();
        let is_file = PlanPlacement::parse(text).is_some_and(|plan| plan.file == text);
        if is_file && !text.is_empty() {
            return self.set_floor_plan_file(Path::new(text));
        }
        self.replace_floor_plan(text);
    }

    /// Shows a file as the floor plan. The dialog opens for an image, whose scale the user has to
    /// set, and for a drawing without a unit once it is read.
    pub(super) fn set_floor_plan_file(&mut self, file: &Path) {
        let kind = FloorPlanKind::of_file(file);
        let is_image = matches!(kind, FloorPlanKind::Image | FloorPlanKind::PdfPage);
        let placement = PlanPlacement {
            file: shown_path(file),
            page: (kind == FloorPlanKind::PdfPage).then_some(1),
            size: match is_image {
                true => PlanSize::PxPerM(FIRST_PX_PER_M),
                false => PlanSize::Scale(1.0),
            },
            rotate_deg: 0.0,
            offset_m: Point::default(),
        };
        self.plan_editor.is_open = is_image;
        self.replace_floor_plan(&placement.text());
    }

    fn replace_floor_plan(&mut self, text: &str) {
        self.plan_editor.asks_unit = true;
        let LayerContext {
            services, repaint, ..
        } = &self.context;
        self.floor_plan.replace(text, services, repaint);
    }

    /// Shows the floor plan at another place.
    pub(super) fn place_floor_plan(&mut self, placement: &PlanPlacement) {
        let LayerContext {
            services, repaint, ..
        } = &self.context;
        let is_new = mem::take(&mut self.plan_editor.changes_unit);
        let plan = &mut self.floor_plan;
        plan.place(placement, is_new, services, repaint);
    }

    /// Takes the bounds of a floor plan that was read for the first time.
    pub(super) fn begin_floor_plan(&mut self, bounds: Bounds<f64>) {
        if self.files.layers().is_empty() {
            self.canvas.camera.fit(bounds);
        }
        let asks_unit = mem::take(&mut self.plan_editor.asks_unit);
        let is_assumed = self.floor_plan.assumed_unit_m().is_some_and(|assumed_m| {
            let placement = self.floor_plan.placement();
            placement.is_some_and(|plan| plan.is_in_unit(assumed_m, assumed_m))
        });
        self.plan_editor.is_open |= asks_unit && is_assumed;
    }

    /// Gives a pointer event to the floor plan. Returns `false` if it is none of its business.
    pub(super) fn point_at_plan(&mut self, event: PointerEvent) -> bool {
        let Some(view) = self.canvas.camera.view() else {
            return false;
        };
        let editor = &mut self.plan_editor;
        let (is_taken, placed) = editor.handle(event, &view, &mut self.floor_plan);
        if let Some(placement) = placed {
            self.place_floor_plan(&placement);
        }
        is_taken
    }

    /// Shows the dialog if it is open, and returns the actions of changes.
    pub(super) fn show_floor_plan_window(&mut self, ctx: &Context) -> Vec<Action> {
        let corner = self.canvas.screen().rect.max - PLAN_WINDOW_MARGIN;
        floor_plan_window::show(ctx, &mut self.plan_editor, &mut self.floor_plan, corner)
    }
}
