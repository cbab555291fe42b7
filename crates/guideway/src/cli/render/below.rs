use std::io::{self, Write};
use std::sync::Arc;

use guideway::cpu::Areas;
use guideway::envelope::Source;
use guideway::formats::svg::Page;
use guideway::render::{Cancel, DrawList, Frame, FrameSize, Method, Prepared, Strip, Style, View};
use guideway::scene::{Rgba, Scene};
use guideway::spline::Bounds;

use super::floor_plan::{Floor, FloorPlan};
use super::sheet::Laid;
use super::swept::{self, Swept, SweptReport};
use super::{Wishes, floor_plan, sheet, vector};
use crate::cli::Failure;

/// What lies below the paths, from the lowest: the floor plan, lines, the areas that vehicles sweep, other scenes.
#[derive(Default)]
pub(crate) struct Below {
    pub(crate) floor_plan: Option<FloorPlan>,
    pub(crate) lines: DrawList,
    pub(crate) envelope: Option<Source>,
    /// The paths that have areas; all that are drawn if unset.
    pub(crate) swept: Option<Vec<u32>>,
    pub(crate) others: Vec<Arc<Scene>>,
}

impl Below {
    /// The box of all of it.
    pub(super) fn bounds(&self, scene: &Scene) -> Option<Bounds<f64>> {
        let plan = self.floor_plan.as_ref().and_then(FloorPlan::bounds);
        let swept = self
            .envelope
            .and_then(|source| swept::bounds(scene, source));
        let others = self.others.iter().filter_map(|other| other.bounds());
        let all = [plan, swept].into_iter().flatten().chain(others);
        all.reduce(Bounds::union)
    }

    /// What of it is seen.
    pub(super) fn seen(&self, scene: &Scene, view: &View) -> Result<Seen<'_>, Failure> {
        let rows = self.swept.as_deref().unwrap_or(scene.draw_order());
        let swept = self
            .envelope
            .map(|source| Swept::new(scene.layout(), rows, source, view));
        Ok(Seen {
            below: self,
            swept: swept.transpose()?,
        })
    }
}

/// What of it is seen in a view.
pub(super) struct Seen<'b> {
    below: &'b Below,
    swept: Option<Swept>,
}

impl Seen<'_> {
    /// Makes it ready to be drawn; none if there is nothing.
    pub(super) fn ground(
        &self,
        method: &dyn Method,
        wishes: &Wishes,
        view: &View,
    ) -> Result<Option<Ground<'_>>, Failure> {
        let floor_plan = self.below.floor_plan.as_ref();
        let floor = floor_plan.map(|plan| plan.prepare(&wishes.budget));
        let others = self.below.others.iter();
        let others = others.map(|other| method.prepare(Arc::clone(other), &wishes.budget));
        let ground = Ground {
            floor: floor.transpose()?,
            lines: Some(&self.below.lines)
                .filter(|lines| **lines != DrawList::default())
                .map(|lines| Laid::new(lines, view)),
            areas: self.swept.as_ref().map(Swept::areas),
            others: others.collect::<Result<_, _>>()?,
            style: Style {
                background: Rgba::from_u32(0),
                ..wishes.style
            },
            frame: Frame::new(FrameSize::new(1, 1)?),
        };
        let Ground {
            floor,
            lines,
            areas,
            others,
            ..
        } = &ground;
        let is_there = floor.is_some() || lines.is_some() || areas.is_some() || !others.is_empty();
        Ok(is_there.then_some(ground))
    }

    /// Writes it below what follows on a page.
    pub(super) fn write(
        &self,
        view: &View,
        style: &Style,
        page: &mut Page<'_, impl Write>,
    ) -> io::Result<()> {
        if let Some(plan) = &self.below.floor_plan {
            plan.write(view, page)?;
        }
        sheet::write(&self.below.lines, "grid", page)?;
        if let Some(swept) = &self.swept {
            swept.write(view, vector::STEP_PX, page)?;
        }
        for other in &self.below.others {
            vector::write_paths(other, view, style, page)?;
        }
        Ok(())
    }

    pub(super) fn report(self) -> Option<SweptReport> {
        self.swept.map(|swept| swept.report)
    }
}

/// What lies below, ready to be drawn strip by strip.
pub(super) struct Ground<'b> {
    floor: Option<Floor>,
    lines: Option<Laid<'b>>,
    areas: Option<Areas>,
    others: Vec<Box<dyn Prepared>>,
    /// How the others look: over nothing.
    style: Style,
    /// One of the others.
    frame: Frame,
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
        if let Some(lines) = &self.lines {
            lines.onto(strip, frame);
        }
        if let Some(areas) = &self.areas {
            swept::lay(areas, strip, frame);
        }
        for other in &mut self.others {
            other.render_strip(strip, &self.style, &Cancel::default(), &mut self.frame)?;
            // Both ways round: what was below comes to lie under it.
            floor_plan::lay_over(frame, &mut self.frame);
            std::mem::swap(frame, &mut self.frame);
        }
        Ok(())
    }
}
