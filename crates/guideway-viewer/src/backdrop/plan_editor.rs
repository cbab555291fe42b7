//! Moves the floor plan by hand, and scales it by two points of known distance.

use guideway_scene::View;
use guideway_spline::Point;

use super::floor_plan_layer::FloorPlanLayer;
use super::plan_placement::PlanPlacement;
use crate::tools::PointerEvent;

/// The effect of clicks and drags on the floor plan.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) enum PlanTask {
    /// Nothing: they go to the tools.
    #[default]
    None,
    /// A drag, which began at this point of the world, moves the plan.
    Move(Option<Point<f64>>),
    /// Clicks name two points of the plan, in meters as it lies now.
    Calibrate(Vec<Point<f64>>),
}

/// The dialog of the floor plan and its task.
#[derive(Default)]
pub(crate) struct PlanEditor {
    pub(crate) is_open: bool,
    /// True if the dialog opens once the plan is read and does not state its unit.
    pub(crate) asks_unit: bool,
    /// True if the next change is the unit, by which the plan is a thousand times as large.
    pub(crate) changes_unit: bool,
    pub(crate) task: PlanTask,
    /// The typed distance of the two points, in meters.
    pub(crate) distance_m: f64,
    /// True if the field of the distance takes the focus in the next frame.
    pub(crate) asks_distance: bool,
}

impl PlanEditor {
    /// Starts a task, or ends it if it is in progress.
    pub(crate) fn toggle(&mut self, task: PlanTask) {
        let is_same = std::mem::discriminant(&task) == std::mem::discriminant(&self.task);
        self.task = if is_same { PlanTask::None } else { task };
    }

    /// Ends the task in progress; a plan being dragged goes back. Returns `false` if there is none.
    pub(crate) fn cancel(&mut self, plan: &mut FloorPlanLayer) -> bool {
        let task = std::mem::take(&mut self.task);
        if matches!(task, PlanTask::Move(Some(_))) {
            plan.shift_m = Point::default();
        }
        task != PlanTask::None
    }

    /// Handles a pointer event if a task is in progress. Returns whether it did, and the new place
    /// of the plan.
    pub(crate) fn handle(
        &mut self,
        event: PointerEvent,
        view: &View,
        plan: &mut FloorPlanLayer,
    ) -> (bool, Option<PlanPlacement>) {
        let world = |at_px| view.world_from_pixel(at_px);
        if plan.is_locked || plan.is_empty() {
            self.task = PlanTask::None;
        }
        let mut placed = None;
        match (&mut self.task, event) {
            (PlanTask::None, _) => return (false, None),
            (PlanTask::Move(from_m), PointerEvent::DragStarted(at_px)) => {
                *from_m = Some(world(at_px));
            }
            (PlanTask::Move(Some(from_m)), PointerEvent::Dragged(at_px, _)) => {
                plan.shift_m = world(at_px) - *from_m;
            }
            (PlanTask::Move(from_m), PointerEvent::DragEnded(_)) => {
                *from_m = None;
                let placement = plan.placement();
                placed = placement.map(|placement| placement.moved(plan.shift_m));
            }
            (PlanTask::Move(from_m), PointerEvent::Cancelled) => {
                *from_m = None;
                plan.shift_m = Point::default();
            }
            (PlanTask::Calibrate(points), PointerEvent::Clicked(at_px, _)) => {
                if points.len() == 2 {
                    points.clear();
                }
                points.push(world(at_px));
                if let [from, to] = points[..] {
                    self.distance_m = from.distance(to);
                    self.asks_distance = true;
                }
            }
            // The tools learn where the pointer is.
            (_, PointerEvent::Hover(_)) => return (false, None),
            _ => {}
        }
        (true, placed)
    }

    /// The place of the plan by which the two points have the typed distance.
    pub(crate) fn calibrated(&self, plan: &FloorPlanLayer) -> Option<PlanPlacement> {
        let PlanTask::Calibrate(points) = &self.task else {
            return None;
        };
        let &[from, to] = points.as_slice() else {
            return None;
        };
        plan.placement()?.calibrated([from, to], self.distance_m)
    }
}
