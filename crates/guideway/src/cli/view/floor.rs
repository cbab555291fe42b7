//! What lies below the layouts of the window.

use std::ffi::OsString;
use std::sync::{Mutex, PoisonError};

use guideway::layout::UserError;
use guideway::render::{Budget, Frame, Strip, View};
use guideway::scene::Rgba;
use guideway::spline::Bounds;
use guideway_viewer::FloorPlan;

use crate::cli::input::Input;
use crate::cli::render::{Floor, FloorPlan as Plan};
use crate::cli::{Failure, Output};

/// A floor plan, ready to be drawn.
pub(super) struct OnFloor {
    /// For exports.
    pub(super) plan: Plan,
    floor: Mutex<Floor>,
}

impl OnFloor {
    /// Reads what a person wrote.
    pub(super) fn read(plan: &str) -> Result<Self, Failure> {
        let plan = read(plan)?;
        Ok(Self {
            floor: Mutex::new(plan.prepare(&Budget::default())?),
            plan,
        })
    }
}

impl FloorPlan for OnFloor {
    fn bounds(&self) -> Option<Bounds<f64>> {
        self.plan.bounds()
    }

    fn draw(&self, view: &View) -> Result<Frame, UserError> {
        let mut frame = Frame::new(view.size());
        let mut floor = self.floor.lock().unwrap_or_else(PoisonError::into_inner);
        floor.draw(&Strip::whole(view), Rgba::from_u32(0), &mut frame)?;
        Ok(frame)
    }
}

/// Reads a floor plan, such as `hall.png@px-per-m=20`.
fn read(plan: &str) -> Result<Plan, Failure> {
    let input = Input::parse(OsString::from(plan)).map_err(|problem| {
        Failure::arguments(
            format!("`{plan}` is no floor plan: {problem}"),
            "Write a file and how it is put, such as `hall.png@px-per-m=20,offset=-3,-2`",
        )
    })?;
    Plan::read(&input, &Output::new(false, true))
}
