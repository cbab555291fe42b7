use std::ops::Range;

use guideway_scene::{Cancel, Strip, Style, View};
use guideway_scene::{Rgba, Scene};
use guideway_spline::{Bounds, Point};

use super::canvas::TILE_PX;
use super::place::{Placement, power_of_two_below};
use super::vectors::LaneWidth;

/// How exactly lines are kept.
#[derive(Clone, Copy)]
struct Grain {
    /// Units of a pixel, at least; at most twice as many.
    units_a_px: f64,
    /// Farthest that a line may be from its curve, in units.
    tolerance: f32,
}

/// What kept lines are rounded to, in meters, and farthest that they may be from their curves, in units of that: views of the
/// same draw the same lines.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Precision {
    unit_m: f64,
    tolerance_units: f32,
    joins: bool,
}

/// Where all is one color, borders of strokes are seen alone: at most a ninth of a pixel off.
const SOLID: Grain = Grain {
    units_a_px: 64.0,
    tolerance: 6.5,
};
/// Where many strokes share a pixel, their errors add up: at most a 32nd of a pixel.
const LAYERED: Grain = Grain {
    units_a_px: 256.0,
    tolerance: 8.0,
};
/// How far from its curve's control points a line may be drawn beside its width, in pixels.
const MARGIN_PX: f64 = 1.0 / 16.0;

/// How much thinner, on either side, strokes are drawn to find what is full for certain. It holds for what lies between samples, at most 0.07 px
/// from one, for the sixteenths of a pixel that borders in whole numbers may be off in either view, and the sides of pixels that are not looked up.
const THINNER_PX: f64 = 0.25;

/// One scene, as one frame sees it.
#[derive(Clone, Copy)]
pub(super) struct Shot<'a> {
    pub(super) scene: &'a Scene,
    /// What is drawn of the view.
    pub(super) strip: &'a Strip,
    pub(super) view: &'a View,
    pub(super) place: Placement,
    pub(super) style: &'a Style,
    pub(super) cancel: &'a Cancel,
    pub(super) widths: Widths,
    pub(super) lane_width: LaneWidth,
    /// The color of all that is drawn, if it is one and opaque.
    pub(super) solid: Option<Rgba>,
    /// How much nearer the view is that strokes are thinner than all of; none if they are as wide as they have to be.
    pub(super) thinner_than: Option<f64>,
}

/// The least and the greatest width of paths that have one of their own, in meters; none if none has.
pub(super) type Widths = Option<(f32, f32)>;

/// Widths of all paths that are drawn.
pub(super) fn widths(scene: &Scene) -> Widths {
    scene.layout().paths.width_m()?;
    let own = scene
        .draw_order()
        .iter()
        .filter_map(|&path| scene.width_m(path));
    own.map(|width_m| (width_m, width_m))
        .reduce(|a, b| (a.0.min(b.0), a.1.max(b.1)))
}

/// Strips are whole rows of tiles.
const _: () = assert!((Strip::STEP as usize).is_multiple_of(TILE_PX));

impl Shot<'_> {
    /// Where some rows of tiles are among the pixels of the strip.
    pub(super) fn pixels_of(&self, tile_rows: &Range<usize>) -> Range<usize> {
        let (width, rows) = (self.strip.size().width() as usize, self.strip.rows());
        let pixels = |tile_row: usize| {
            let row = (tile_row * TILE_PX).min(rows.end as usize);
            (row - rows.start as usize) * width
        };
        pixels(tile_rows.start)..pixels(tile_rows.end)
    }

    /// Half the stroke width of a path.
    pub(super) fn radius_px(&self, path: u32) -> f64 {
        self.radius_of(self.scene.width_m(path))
    }

    /// Half the stroke width of the widest path.
    pub(super) fn widest_px(&self) -> f64 {
        let own = self.widths.map(|(_, most)| self.radius_of(Some(most)));
        self.radius_of(None).max(own.unwrap_or(0.0))
    }

    /// Half the stroke width of the thinnest path.
    pub(super) fn thinnest_px(&self) -> f64 {
        let own = self.widths.map(|(least, _)| self.radius_of(Some(least)));
        self.radius_of(None).min(own.unwrap_or(f64::INFINITY))
    }

    /// Half the stroke width, if it is that of all paths.
    pub(super) fn common_radius_px(&self) -> Option<f64> {
        let common = self.radius_of(None);
        let is_common = |width_m| self.radius_of(Some(width_m)) == common;
        let is_so = self
            .widths
            .is_none_or(|(least, most)| is_common(least) && is_common(most));
        is_so.then_some(common)
    }

    fn radius_of(&self, width_m: Option<f32>) -> f64 {
        let radius_px = |px_per_m| self.style.line_rule.radius_px(width_m, px_per_m);
        let px_per_m = self.view.px_per_m();
        match self.thinner_than {
            Some(nearer) => radius_px(px_per_m * nearer) / nearer - THINNER_PX,
            None => radius_px(px_per_m),
        }
    }

    /// The same with thinner strokes: all around the samples that they cover, those of views that are nearer by up to a
    /// factor cover all.
    pub(super) fn thinner(&self, nearer: f64) -> Self {
        Self {
            thinner_than: Some(nearer),
            ..*self
        }
    }

    /// What vertices that are kept are rounded to: the greatest power of two that is at most a given part
    /// of a pixel. It changes only where the scale has doubled.
    pub(super) fn unit_m(&self) -> f64 {
        power_of_two_below(1.0 / (self.grain().units_a_px * self.view.px_per_m()))
    }

    /// Farthest that a kept line may be from its curve, in units of [`Self::unit_m`].
    pub(super) fn tolerance_units(&self) -> f32 {
        self.grain().tolerance
    }

    pub(super) fn precision(&self) -> Precision {
        Precision {
            unit_m: self.unit_m(),
            tolerance_units: self.tolerance_units(),
            joins: self.joins(),
        }
    }

    /// Whether curves that go on from each other are drawn as one: of one color and one width nobody can tell.
    pub(super) fn joins(&self) -> bool {
        self.solid.is_some() && self.widths.is_none()
    }

    fn grain(&self) -> Grain {
        if self.solid.is_some() { SOLID } else { LAYERED }
    }

    /// Where in the picture a box of control points may leave a mark.
    pub(super) fn reach_px(&self, bounds: Bounds<f64>) -> Bounds<f64> {
        let [a, b] = [bounds.min, bounds.max].map(|p| self.view.pixel_from_world(p));
        let corners = Bounds {
            min: Point::new(a.x, b.y),
            max: Point::new(b.x, a.y),
        };
        corners.inflated(self.widest_px() + MARGIN_PX)
    }

    /// The picture, in pixels.
    pub(super) fn picture_px(&self) -> Bounds<f64> {
        let size = self.view.size();
        Bounds {
            min: Point::default(),
            max: Point::new(f64::from(size.width()), f64::from(size.height())),
        }
    }

    /// Where center lines leave a mark. A pixel is added so that the caps of lines that are cut there stay
    /// out of sight.
    pub(super) fn seen_px(&self) -> Bounds<f64> {
        self.picture_px().inflated(self.widest_px() + 1.0)
    }
}
