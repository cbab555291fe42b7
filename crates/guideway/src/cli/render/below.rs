use std::io::{self, Write};

use guideway::envelope::Source;
use guideway::formats::svg::Page;
use guideway::render::{Budget, Frame, View};
use guideway::scene::{Rgba, Scene};
use guideway::spline::Bounds;

use super::floor_plan::FloorPlan;
use super::swept::{self, Swept, SweptReport};
use crate::cli::Failure;

/// What lies below the paths: the floor plan, and on it the areas that vehicles sweep.
#[derive(Default)]
pub(crate) struct Below {
    pub(super) floor_plan: Option<FloorPlan>,
    pub(super) envelope: Option<Source>,
}

impl Below {
    /// The box of all of it.
    pub(super) fn bounds(&self, scene: &Scene) -> Option<Bounds<f64>> {
        let plan = self.floor_plan.as_ref().and_then(FloorPlan::bounds);
        let swept = self
            .envelope
            .and_then(|source| swept::bounds(scene, source));
        [plan, swept].into_iter().flatten().reduce(Bounds::union)
    }

    /// What of it is seen.
    pub(super) fn seen(&self, scene: &Scene, view: &View) -> Result<Seen<'_>, Failure> {
        let swept = self.envelope.map(|source| Swept::new(scene, source, view));
        Ok(Seen {
            floor_plan: self.floor_plan.as_ref(),
            swept: swept.transpose()?,
        })
    }
}

/// What of it is seen in a view.
pub(super) struct Seen<'b> {
    floor_plan: Option<&'b FloorPlan>,
    swept: Option<Swept>,
}

impl Seen<'_> {
    /// Draws it alone; nothing if there is nothing.
    pub(super) fn draw(
        &self,
        view: &View,
        background: Rgba,
        budget: &Budget,
    ) -> Result<Option<Frame>, Failure> {
        let mut frame = match (self.floor_plan, &self.swept) {
            (Some(plan), _) => plan.draw(view, background, budget)?,
            (None, Some(_)) => {
                let mut frame = Frame::new(view.size());
                frame.pixels_mut().fill(background.to_u32().to_be_bytes());
                frame
            }
            (None, None) => return Ok(None),
        };
        if let Some(swept) = &self.swept {
            swept.draw(view, &mut frame);
        }
        Ok(Some(frame))
    }

    /// Writes it below what follows on a page.
    pub(super) fn write(
        &self,
        view: &View,
        step_px: f64,
        page: &mut Page<'_, impl Write>,
    ) -> io::Result<()> {
        if let Some(plan) = self.floor_plan {
            plan.write(view, page)?;
        }
        match &self.swept {
            Some(swept) => swept.write(view, step_px, page),
            None => Ok(()),
        }
    }

    pub(super) fn report(self) -> Option<SweptReport> {
        self.swept.map(|swept| swept.report)
    }
}
