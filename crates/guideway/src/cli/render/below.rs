use std::io::{self, Write};

use guideway::cpu::Areas;
use guideway::envelope::Source;
use guideway::formats::svg::Page;
use guideway::render::{Budget, Frame, Strip, View};
use guideway::scene::{Rgba, Scene};
use guideway::spline::Bounds;

use super::floor_plan::{Floor, FloorPlan};
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
        let swept = self
            .envelope
            .map(|source| Swept::new(scene.layout(), scene.draw_order(), source, view));
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
    /// Makes it ready to be drawn; none if there is nothing.
    pub(super) fn ground(&self, budget: &Budget) -> Result<Option<Ground<'_>>, Failure> {
        let floor = self.floor_plan.map(|plan| plan.prepare(budget));
        let ground = Ground {
            floor: floor.transpose()?,
            areas: self.swept.as_ref().map(Swept::areas),
        };
        let is_there = ground.floor.is_some() || ground.areas.is_some();
        Ok(is_there.then_some(ground))
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

/// What lies below, ready to be drawn strip by strip.
pub(super) struct Ground<'b> {
    floor: Option<Floor<'b>>,
    areas: Option<Areas>,
}

impl Ground<'_> {
    /// Draws it alone.
    pub(super) fn draw(
        &mut self,
        strip: &Strip,
        background: Rgba,
        frame: &mut Frame,
    ) -> Result<(), Failure> {
        frame.resize(strip.size());
        match &mut self.floor {
            Some(floor) => floor.draw(strip, background, frame)?,
            None => frame.pixels_mut().fill(background.to_u32().to_be_bytes()),
        }
        if let Some(areas) = &self.areas {
            swept::lay(areas, strip, frame);
        }
        Ok(())
    }
}
