//! Stacks the layers of a backdrop into one frame per strip, or writes them as vector graphics.

use std::io;
use std::sync::Arc;

use guideway_cpu::Areas;
use guideway_scene::Budget;
use guideway_scene::{
    Cancel, DrawList, Frame, FrameSize, LineRule, Method, Prepared, Rgba, Scene, Strip, Style, View,
};
use guideway_spline::Bounds;

use super::floor_plan::{FloorPlan, PreparedFloorPlan};
use super::swept::{self, SweptAreas, SweptReport, VisibleAreas};
use crate::ComposeError;
use crate::blend::{composite_over, fade};
use crate::overlay::PreparedOverlay;
use crate::page::Page;
use crate::vector::{write_draw_list, write_faded_paths};

/// The layers below the paths of a picture, bottom first.
#[derive(Clone, Default)]
pub struct Backdrop {
    /// A drawing or an image of the hall.
    pub floor_plan: Option<FloorPlan>,
    /// Share of the background that is mixed into the floor plan, from 0 to 1.
    pub floor_plan_fade: f64,
    /// Shapes over the floor plan, such as the grid of a window.
    pub lines: DrawList,
    /// The areas that a vehicle sweeps along paths of the topmost scene.
    pub swept: Option<SweptAreas>,
    /// Other scenes, bottom first.
    pub others: Vec<OtherScene>,
}

/// A scene below the paths of a picture.
#[derive(Clone)]
pub struct OtherScene {
    /// Its paths.
    pub scene: Arc<Scene>,
    /// Their widths.
    pub line_rule: LineRule,
    /// Their opacity, from 0 to 1.
    pub opacity: f64,
}

impl OtherScene {
    /// The style of its paths among the others of a picture.
    fn style(&self, of_picture: &Style) -> Style {
        Style {
            line_rule: self.line_rule,
            ..*of_picture
        }
    }
}

impl Backdrop {
    /// Bounding box of all layers in meters; `None` if they are empty.
    pub(crate) fn bounds(&self, scene: &Scene) -> Option<Bounds<f64>> {
        let plan = self.floor_plan.as_ref().and_then(FloorPlan::bounds);
        let swept = self.swept.as_ref();
        let swept = swept.and_then(|swept| swept::bounds(scene, swept.vehicle));
        let others = self.others.iter().filter_map(|other| other.scene.bounds());
        let all = [plan, swept].into_iter().flatten().chain(others);
        all.reduce(Bounds::union)
    }

    /// Resolves the layers for a view.
    ///
    /// # Errors
    /// When swept areas are requested and no path has one, or they exceed the budget.
    pub(crate) fn visible(
        &self,
        scene: &Scene,
        view: &View,
        budget: &Budget,
    ) -> Result<VisibleBackdrop<'_>, ComposeError> {
        let areas = self.swept.as_ref().map(|swept| {
            let rows = swept.rows.as_deref().unwrap_or(scene.draw_order());
            VisibleAreas::new(scene.layout(), rows, swept.vehicle, view, budget)
        });
        Ok(VisibleBackdrop {
            backdrop: self,
            areas: areas.transpose()?,
        })
    }
}

/// A backdrop with the swept areas of one view.
pub(crate) struct VisibleBackdrop<'b> {
    backdrop: &'b Backdrop,
    areas: Option<VisibleAreas>,
}

impl VisibleBackdrop<'_> {
    /// Prepares the layers for rendering. Grid and zones are drawn below the lines of the backdrop.
    pub(crate) fn prepare(
        &self,
        [grid, zones]: [&DrawList; 2],
        method: &dyn Method,
        budget: &Budget,
        style: &Style,
        view: &View,
    ) -> Result<PreparedBackdrop, ComposeError> {
        let floor_plan = self.backdrop.floor_plan.as_ref();
        let floor_plan = floor_plan.map(|plan| plan.prepare(budget));
        let lines = [grid, zones, &self.backdrop.lines].into_iter();
        let lines = lines.filter(|lines| !lines.is_empty());
        let others = self.backdrop.others.iter();
        let style = Style {
            background: Rgba::from_u32(0),
            ..*style
        };
        let others = others.map(|other| {
            Ok::<_, ComposeError>(PreparedScene {
                paths: method.prepare(Arc::clone(&other.scene), budget)?,
                style: other.style(&style),
                opacity: other.opacity,
            })
        });
        let prepared = PreparedBackdrop {
            floor_plan: floor_plan.transpose()?,
            floor_plan_fade: self.backdrop.floor_plan_fade,
            lines: lines
                .map(|lines| PreparedOverlay::new(lines, view))
                .collect(),
            areas: self.areas.as_ref().map(VisibleAreas::outlines),
            others: others.collect::<Result<_, _>>()?,
            scratch: Frame::new(FrameSize::new(1, 1)?),
        };
        Ok(prepared)
    }

    /// Writes the layers as elements of a page.
    pub(crate) fn write(
        &self,
        [grid, zones]: [&DrawList; 2],
        view: &View,
        style: &Style,
        page: &mut impl Page,
    ) -> io::Result<()> {
        if let Some(plan) = &self.backdrop.floor_plan {
            let fade = self.backdrop.floor_plan_fade;
            page.begin_group("floor plan", 1.0 - fade.clamp(0.0, 1.0))?;
            plan.write(view, page)?;
            page.end_group()?;
        }
        for (lines, label) in [
            (grid, "grid"),
            (zones, "zones"),
            (&self.backdrop.lines, "grid"),
        ] {
            write_draw_list(lines, label, page)?;
        }
        if let Some(areas) = &self.areas {
            areas.write(view, page)?;
        }
        for other in &self.backdrop.others {
            let style = other.style(style);
            write_faded_paths(&other.scene, view, &style, other.opacity, page)?;
        }
        Ok(())
    }

    /// Number of paths with and without a swept area; `None` if none were requested.
    pub(crate) fn into_report(self) -> Option<SweptReport> {
        self.areas.map(|areas| areas.report)
    }
}

/// A backdrop that renders strip by strip.
pub(crate) struct PreparedBackdrop {
    floor_plan: Option<PreparedFloorPlan>,
    floor_plan_fade: f64,
    lines: Vec<PreparedOverlay>,
    areas: Option<Areas>,
    others: Vec<PreparedScene>,
    /// One of the other scenes, before it is composited.
    scratch: Frame,
}

/// A scene of a backdrop, with its style on a transparent background.
struct PreparedScene {
    paths: Box<dyn Prepared>,
    style: Style,
    opacity: f64,
}

impl PreparedBackdrop {
    /// Returns `true` if there is no layer.
    pub(crate) fn is_empty(&self) -> bool {
        self.floor_plan.is_none()
            && self.lines.is_empty()
            && self.areas.is_none()
            && self.others.is_empty()
    }

    /// Renders all layers over `background`. Resizes `frame` to the strip.
    ///
    /// # Errors
    /// When a layer cannot be rendered.
    pub(crate) fn render(
        &mut self,
        strip: &Strip,
        background: Rgba,
        frame: &mut Frame,
    ) -> Result<(), ComposeError> {
        frame.resize(strip.size());
        match &mut self.floor_plan {
            Some(plan) => {
                plan.render(strip, background, frame)?;
                fade_into(background, self.floor_plan_fade, frame);
            }
            None => frame.pixels_mut().fill(background.to_u32().to_be_bytes()),
        }
        for lines in &self.lines {
            lines.draw(strip, frame);
        }
        if let Some(areas) = &self.areas {
            swept::draw(areas, strip, frame);
        }
        for other in &mut self.others {
            let PreparedScene {
                paths,
                style,
                opacity,
            } = other;
            paths.render_strip(strip, style, &Cancel::default(), &mut self.scratch)?;
            fade(&mut self.scratch, *opacity);
            composite_over(frame, &mut self.scratch);
            std::mem::swap(frame, &mut self.scratch);
        }
        Ok(())
    }
}

/// Mixes `fade` parts of the background, from 0 to 1, into all pixels of a frame.
fn fade_into(background: Rgba, fade: f64, frame: &mut Frame) {
    if fade <= 0.0 {
        return;
    }
    let below = background.to_u32().to_be_bytes().map(f64::from);
    let fade = fade.min(1.0);
    for pixel in frame.pixels_mut() {
        for (channel, below) in pixel.iter_mut().zip(below) {
            *channel = (f64::from(*channel) * (1.0 - fade) + below * fade).round() as u8;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn faded_pixels_lie_between_plan_and_background() {
        let faded = |fade| {
            let mut frame = Frame::new(FrameSize::new(1, 1).unwrap());
            frame.pixels_mut()[0] = [0, 100, 200, 255];
            fade_into(Rgba::WHITE, fade, &mut frame);
            frame.pixels()[0]
        };
        assert_eq!(faded(0.0), [0, 100, 200, 255]);
        assert_eq!(faded(0.25), [64, 139, 214, 255]);
        assert_eq!((faded(1.0), faded(7.0)), ([255; 4], [255; 4]));
    }
}
