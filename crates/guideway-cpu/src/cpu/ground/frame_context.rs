//! Frame context: scene, view, strip and style of one frame, and the widths and scales derived from
//! them.

use std::ops::Range;

use guideway_scene::{Cancel, LineRule, Rgba, Scene, Strip, Style, View};
use guideway_spline::{Bounds, Point};

use super::gesture::ShownGesture;
use super::simd::SimdLevel;
use super::snapped_view::{SnappedTransform, power_of_two_below};
use super::tile::TILE_PX;

/// Accuracy of flattened lines.
#[derive(Clone, Copy)]
struct FlattenQuality {
    /// Units of cached lines per pixel, at least; at most twice as many.
    units_per_px: f64,
    /// Largest distance of a line from its curve, in units.
    tolerance_units: f32,
}

impl FlattenQuality {
    /// All is one color: only the borders of strokes show. Lines are at most 1/9 px off their
    /// curve.
    const SOLID: Self = Self {
        units_per_px: 64.0,
        tolerance_units: 6.5,
    };
    /// Many strokes share a pixel, and their errors add up. Lines are at most 1/32 px off.
    const LAYERED: Self = Self {
        units_per_px: 256.0,
        tolerance_units: 8.0,
    };
}

/// Identifies cached lines: views of the same key draw the same lines.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct LineCacheKey {
    /// Unit of the vertices, in meters.
    pub(crate) unit_m: f64,
    /// Largest distance of a line from its curve, in units.
    pub(crate) tolerance_units: f32,
    /// True if curves that share end points were chained.
    pub(crate) chains_curves: bool,
}

/// Distance from its control points up to which a line may be drawn beside its stroke width, in
/// pixels.
const MARGIN_PX: f64 = 1.0 / 16.0;

/// Inset of strokes, in pixels per side, when the frame looks for pixels that stay full while the
/// view zooms in. Derived: 0.07 for points between samples, 1/16 for fixed-point borders in either
/// view, and the rims of pixels that the look-up leaves out.
const FULL_PIXEL_INSET_PX: f64 = 0.25;

/// Least and greatest own width of the drawn paths, in meters; `None` without own widths.
pub(crate) type OwnWidths = Option<(f32, f32)>;

/// The frame that is being drawn.
#[derive(Clone, Copy)]
pub(crate) struct FrameContext<'a> {
    pub(crate) scene: &'a Scene,
    /// The gesture that is shown.
    pub(crate) gesture: Option<&'a ShownGesture>,
    /// The part of the view that is drawn.
    pub(crate) strip: &'a Strip,
    pub(crate) view: &'a View,
    pub(crate) transform: SnappedTransform,
    pub(crate) style: &'a Style,
    pub(crate) cancel: &'a Cancel,
    pub(crate) own_widths: OwnWidths,
    pub(crate) simd: SimdLevel,
    /// The color of all paths, if it is one and opaque.
    pub(crate) solid: Option<Rgba>,
    /// Zoom factor up to which every stroke has to be at least as wide as it is drawn; `None` draws
    /// the stroke widths of the view.
    pub(crate) inset_for_zoom: Option<f64>,
}

// Strips are whole rows of tiles.
const _: () = assert!((Strip::STEP as usize).is_multiple_of(TILE_PX));

impl FrameContext<'_> {
    /// The range of some rows of tiles in the pixels of the strip.
    pub(crate) fn pixels_of(&self, tile_rows: &Range<usize>) -> Range<usize> {
        let (width, rows) = (self.strip.size().width() as usize, self.strip.rows());
        let pixels = |tile_row: usize| {
            let row = (tile_row * TILE_PX).min(rows.end as usize);
            (row - rows.start as usize) * width
        };
        pixels(tile_rows.start)..pixels(tile_rows.end)
    }

    /// Half the stroke width of a path, in pixels.
    pub(crate) fn radius_px(&self, path: u32) -> f64 {
        self.radius_of(self.scene.width_m(path))
    }

    /// Half the stroke width of the widest path, in pixels.
    pub(crate) fn max_radius_px(&self) -> f64 {
        let own = self.own_widths.map(|(_, max)| self.radius_of(Some(max)));
        self.radius_of(None).max(own.unwrap_or(0.0))
    }

    /// Half the stroke width of the thinnest path, in pixels.
    pub(crate) fn min_radius_px(&self) -> f64 {
        let own = self.own_widths.map(|(min, _)| self.radius_of(Some(min)));
        self.radius_of(None).min(own.unwrap_or(f64::INFINITY))
    }

    /// Half the stroke width in pixels, if all paths share one.
    pub(crate) fn common_radius_px(&self) -> Option<f64> {
        let common = self.radius_of(None);
        let is_common = |width_m| self.radius_of(Some(width_m)) == common;
        let all_are = self
            .own_widths
            .is_none_or(|(min, max)| is_common(min) && is_common(max));
        all_are.then_some(common)
    }

    fn radius_of(&self, width_m: Option<f32>) -> f64 {
        let rule: &LineRule = &self.style.line_rule;
        let radius_px = |px_per_m| rule.radius_px(width_m, px_per_m);
        let px_per_m = self.view.px_per_m();
        match self.inset_for_zoom {
            Some(zoom) => radius_px(px_per_m * zoom) / zoom - FULL_PIXEL_INSET_PX,
            None => radius_px(px_per_m),
        }
    }

    /// The frame with inset strokes: the neighborhood of every sample that they cover is covered in
    /// all views that are nearer by up to the factor `max_zoom`.
    pub(crate) fn with_inset_strokes(&self, max_zoom: f64) -> Self {
        Self {
            inset_for_zoom: Some(max_zoom),
            ..*self
        }
    }

    /// Unit of cached vertices, in meters: the greatest power of two up to a fraction of a pixel,
    /// so that it changes only where the scale doubles.
    pub(crate) fn unit_m(&self) -> f64 {
        power_of_two_below(1.0 / (self.quality().units_per_px * self.view.px_per_m()))
    }

    /// The key of lines that this frame can draw.
    pub(crate) fn cache_key(&self) -> LineCacheKey {
        LineCacheKey {
            unit_m: self.unit_m(),
            tolerance_units: self.quality().tolerance_units,
            chains_curves: self.solid.is_some() && self.own_widths.is_none(),
        }
    }

    fn quality(&self) -> FlattenQuality {
        if self.solid.is_some() {
            FlattenQuality::SOLID
        } else {
            FlattenQuality::LAYERED
        }
    }

    /// The part of the picture, in pixels, that paths within a box of control points may touch.
    pub(crate) fn touched_px(&self, bounds: Bounds<f64>) -> Bounds<f64> {
        let [a, b] = [bounds.min, bounds.max].map(|p| self.view.pixel_from_world(p));
        let corners = Bounds {
            min: Point::new(a.x, b.y),
            max: Point::new(b.x, a.y),
        };
        corners.inflated(self.max_radius_px() + MARGIN_PX)
    }

    /// The picture, in pixels.
    pub(crate) fn picture_px(&self) -> Bounds<f64> {
        let size = self.view.size();
        Bounds {
            min: Point::default(),
            max: Point::new(f64::from(size.width()), f64::from(size.height())),
        }
    }

    /// Box of the center lines that touch the picture, in pixels, with a pixel for rounding.
    pub(crate) fn clip_px(&self) -> Bounds<f64> {
        self.picture_px().inflated(self.max_radius_px() + 1.0)
    }
}
