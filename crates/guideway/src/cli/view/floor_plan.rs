//! A floor plan that stays prepared, for the window to render at every change of the view.

use std::sync::{Mutex, PoisonError};

use guideway::compose::{ComposeError, FloorPlan, PreparedFloorPlan};
use guideway::layout::UserError;
use guideway::scene::{Budget, Frame, Rgba, Strip, View};
use guideway::spline::Bounds;

/// The floor plan of the window.
pub(super) struct WindowFloorPlan {
    plan: FloorPlan,
    prepared: Mutex<PreparedFloorPlan>,
}

impl WindowFloorPlan {
    pub(super) fn new(plan: FloorPlan) -> Result<Self, ComposeError> {
        Ok(Self {
            prepared: Mutex::new(plan.prepare(&Budget::default())?),
            plan,
        })
    }

    /// The plan, for exports.
    pub(super) fn plan(&self) -> &FloorPlan {
        &self.plan
    }
}

impl guideway_viewer::FloorPlan for WindowFloorPlan {
    fn bounds(&self) -> Option<Bounds<f64>> {
        self.plan.bounds()
    }

    fn draw(&self, view: &View) -> Result<Frame, UserError> {
        let mut frame = Frame::new(view.size());
        let mut prepared = self.prepared.lock().unwrap_or_else(PoisonError::into_inner);
        prepared.render(&Strip::whole(view), Rgba::from_u32(0), &mut frame)?;
        Ok(frame)
    }
}
