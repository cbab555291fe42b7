//! One frame as the device is told of it.

use guideway_render::{RenderError, Style, View};
use guideway_scene::{LineRule, Scene};
use guideway_spline::{Bounds, Point};

use super::NAME;
use super::bound::Paint;
use super::canvas::Canvas;
use super::pack::device_color;
use super::params::{FrameParams, Samples, TILE_PX};
use super::prepared::Facts;
use super::room::Room;
use super::window::Window;

/// Farthest that a line may be from its curve, in pixels: the borders of a stroke move by as much.
const TOLERANCE_PX: f32 = 1.0 / 32.0;
/// Half the width of the thinnest stroke that few samples do for, in pixels.
const COARSE_RADIUS_PX: f64 = 0.25;
/// Farthest that single precision may move a line, in pixels.
const MOST_ROUNDING_PX: f64 = 0.1;
/// Farthest that steps may move a control point, in pixels along an axis.
const MOST_STEP_OFF_PX: f64 = 1.0 / 128.0;

/// Farthest that a line goes on where it is cut, beyond what its stroke reaches, in pixels; and some to spare.
const BEYOND_PX: f64 = 3.0;
/// Numbers that an end of a line is one of.
const LINE_STEPS: f64 = 8_388_608.0;

/// A view of a scene.
pub(super) struct Shot<'a> {
    pub(super) view: &'a View,
    pub(super) style: &'a Style,
    scene: &'a Scene,
    facts: Facts,
}

impl<'a> Shot<'a> {
    pub(super) fn new(
        view: &'a View,
        style: &'a Style,
        scene: &'a Scene,
        facts: Facts,
    ) -> Result<Self, RenderError> {
        // With u = 2^-24, a coordinate up to X from its cluster's origin is rounded by at most u X as a
        // control point, as its sum with the view's offset, as a pixel, and as a vertex of the curve.
        let unit = f64::from(f32::EPSILON) / 2.0;
        let rounding_px = 4.0 * unit * facts.reach_m * view.px_per_m();
        if rounding_px > MOST_ROUNDING_PX {
            return Err(RenderError::Unsupported {
                method: NAME,
                what: format!(
                    "paths {:.0} m across so large that a pixel is {:.3} mm: single precision would move \
                     them by {rounding_px:.1} pixels",
                    2.0 * facts.reach_m,
                    1e3 / view.px_per_m()
                ),
                remedy: "Zoom out, or use `--method cpu`.".to_owned(),
            });
        }
        let shot = Self {
            view,
            style,
            scene,
            facts,
        };
        let (low_px, steps_a_px) = shot.line_steps();
        if 0.5 / steps_a_px > MOST_ROUNDING_PX {
            return Err(RenderError::Unsupported {
                method: NAME,
                what: format!(
                    "strokes that reach {:.0} pixels far: their ends would be off by {:.1} pixels",
                    -low_px,
                    0.5 / steps_a_px
                ),
                remedy: "Zoom out, limit widths in pixels, or use `--method cpu`.".to_owned(),
            });
        }
        Ok(shot)
    }

    /// The largest steps of points that are not too coarse for it: what is rounded is off by half of one.
    pub(super) fn most_step_m(&self) -> f32 {
        (2.0 * MOST_STEP_OFF_PX / self.view.px_per_m()).min(f64::from(f32::MAX)) as f32
    }

    /// Whether points of some clusters are too coarse for it.
    pub(super) fn is_near(&self) -> bool {
        self.facts.greatest_step_m > self.most_step_m()
    }

    /// Whether lines need the ranks of their paths.
    pub(super) fn needs_ranks(&self, paint: Paint) -> bool {
        paint != Paint::One || !self.facts.is_plain
    }

    fn radius_px(&self, width_m: Option<f32>) -> f64 {
        self.style
            .line_rule
            .radius_px(width_m, self.view.px_per_m())
    }

    /// Where ends of lines are counted from, along both axes, and in how many steps a pixel: they lie within the picture
    /// and as far around it as strokes reach, where lines are cut. A power of two, so that pixels are whole steps.
    fn line_steps(&self) -> (f64, f64) {
        let widest_px = (self.radius_px(None)).max(self.radius_px(self.facts.widest_m));
        let beyond_px = widest_px.ceil() + BEYOND_PX;
        let size = self.view.size();
        let span_px = f64::from(size.width().max(size.height())) + 2.0 * beyond_px;
        (-beyond_px, (LINE_STEPS / span_px).log2().floor().exp2())
    }

    /// As many samples as the thinnest stroke needs.
    pub(super) fn samples(&self) -> Samples {
        let thinnest_px = match self.style.line_rule {
            LineRule::World { min_px, .. } if self.facts.widest_m.is_some() => min_px / 2.0,
            _ => f64::INFINITY,
        };
        if self.radius_px(None).min(thinnest_px) < COARSE_RADIUS_PX {
            Samples::Fine
        } else {
            Samples::Coarse
        }
    }

    /// Whether something within a box, and half its width around, may leave a mark.
    pub(super) fn is_seen(&self, hull_m: Bounds<f64>, width_m: Option<f32>) -> bool {
        let size = self.view.size();
        let corner = Point::new(f64::from(size.width()), f64::from(size.height()));
        let picture = Bounds {
            min: Point::default(),
            max: corner,
        };
        let seen = picture.inflated(self.radius_px(width_m) + 1.0);
        let corners = [hull_m.min, hull_m.max].map(|p| self.view.pixel_from_world(p));
        Bounds::of_points(corners).is_some_and(|hull| hull.intersects(seen))
    }

    /// What the device reads for a window of the picture, if its buffer of pixels begins with a row of tiles.
    pub(super) fn params(
        &self,
        canvas: &Canvas,
        room: &Room,
        window: &Window,
        first_row: u32,
    ) -> FrameParams {
        let size = self.view.size();
        let center = self.view.center_m();
        let high = center.to_f32();
        let low = (center - high.to_f64()).to_f32();
        let limits_px = match self.style.line_rule {
            LineRule::World { min_px, max_px, .. } if self.facts.widest_m.is_some() => {
                [min_px / 2.0, max_px.max(min_px) / 2.0]
            }
            // Nobody has a width of its own.
            _ => [0.0, -1.0],
        };
        let color = self.scene.draw_order().first();
        let color = color.map_or(0, |&path| device_color(self.scene.color(path)));
        let (line_low_px, steps_a_px) = self.line_steps();
        FrameParams {
            center_high_m: [high.x, high.y],
            center_low_m: [low.x, low.y],
            half_size_px: [size.width() as f32 / 2.0, size.height() as f32 / 2.0],
            px_per_m: self.view.px_per_m() as f32,
            radius_px: self.radius_px(None) as f32,
            least_radius_px: limits_px[0] as f32,
            most_radius_px: limits_px[1] as f32,
            tolerance_px: TOLERANCE_PX,
            clusters: self.facts.clusters,
            styles: self.facts.styles,
            width_px: canvas.size.width(),
            height_px: canvas.size.height(),
            first_column: window.columns.start,
            columns: window.columns.len() as u32,
            first_row: window.rows.start,
            rows: window.rows.len() as u32,
            pixels_row: first_row * TILE_PX,
            line_room: room.size.lines,
            reference_room: room.size.references,
            color,
            background: device_color(self.style.background),
            most_step_m: self.most_step_m(),
            has_ranks: u32::from(room.size.has_ranks),
            line_low_px: line_low_px as f32,
            steps_a_px: steps_a_px as f32,
            px_a_step: steps_a_px.recip() as f32,
            padding: 0,
        }
    }
}
