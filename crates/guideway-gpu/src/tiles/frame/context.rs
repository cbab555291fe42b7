//! A view of a scene: checks its precision, and computes the parameters of its frames.

use guideway_scene::{LineRule, RenderError, Style, View};
use guideway_spline::{Bounds, Point};

use super::capacity::Capacity;
use super::line_lod::LineLod;
use super::line_source::LineSource;
use super::window::Window;
use crate::tiles::constants::{MAX_THREADS_PER_LINE, Samples, TARGET_LINE_THREADS, TILE_PX};
use crate::tiles::layouts::FrameParams;
use crate::tiles::options::NAME;
use crate::tiles::paint_mode::PaintMode;
use crate::tiles::upload::facts::SceneFacts;
use crate::tiles::upload::pack::device_color;

/// Greatest distance of a line from its curve, in LOD pixels: the error of a stroke's borders.
const TOLERANCE_PX: f32 = 1.0 / 30.0;
/// Radius of the thinnest stroke that 64 samples per pixel suffice for, in pixels.
const MIN_COARSE_RADIUS_PX: f64 = 0.25;
/// Greatest error of a line by single precision, in pixels.
const MAX_ROUNDING_PX: f64 = 0.1;
/// Greatest error of a control point by its quantization, in LOD pixels along an axis.
const MAX_QUANTIZATION_PX: f64 = 1.0 / 128.0;

/// A view of a scene.
pub(crate) struct FrameContext<'a> {
    pub(crate) view: &'a View,
    pub(crate) style: &'a Style,
    /// The LOD of its lines.
    pub(crate) lod: LineLod,
    facts: SceneFacts,
}

/// The part of a picture that one window's parameters describe.
pub(crate) struct WindowJob<'a> {
    pub(crate) window: &'a Window,
    /// Tile row that the pixel buffer begins with.
    pub(crate) first_row: u32,
    pub(crate) lines: LineSource,
}

impl<'a> FrameContext<'a> {
    /// Checks that the device can draw the view.
    ///
    /// # Errors
    /// [`RenderError::Unsupported`] if single precision would visibly move paths.
    pub(crate) fn new(
        view: &'a View,
        style: &'a Style,
        facts: SceneFacts,
    ) -> Result<Self, RenderError> {
        // With u = 2^-24, a coordinate up to X from its cluster's origin is rounded by at most u X
        // as a control point, as its sum with the view's offset, as a pixel, and as a vertex.
        let unit = f64::from(f32::EPSILON) / 2.0;
        let rounding_px = 4.0 * unit * facts.reach_m * view.px_per_m();
        if rounding_px > MAX_ROUNDING_PX {
            return Err(RenderError::unsupported(
                NAME,
                format!(
                    "paths {:.0} m across at {:.3} mm per pixel: single precision would move them \
                     by {rounding_px:.1} pixels",
                    2.0 * facts.reach_m,
                    1e3 / view.px_per_m()
                ),
                "Zoom out, or use `--method cpu`.",
            ));
        }
        let greatest_radius_px = |px_per_m| {
            let radius_px = |width_m| style.line_rule.radius_px(width_m, px_per_m);
            f64::max(radius_px(None), radius_px(facts.widest_m))
        };
        let lod = LineLod::of(view, greatest_radius_px);
        let off_px = 0.5 / lod.steps_per_px();
        if off_px > MAX_ROUNDING_PX {
            return Err(RenderError::unsupported(
                NAME,
                format!(
                    "strokes that reach {:.0} pixels far: their ends would be off by {off_px:.1} \
                     pixels",
                    greatest_radius_px(view.px_per_m()),
                ),
                "Zoom out, limit widths in pixels, or use `--method cpu`.",
            ));
        }
        Ok(Self {
            view,
            style,
            lod,
            facts,
        })
    }

    /// Greatest quantization step that does not show: rounding is off by half a step.
    pub(crate) fn max_step_m(&self) -> f32 {
        (2.0 * MAX_QUANTIZATION_PX / self.lod.px_per_m).min(f64::from(f32::MAX)) as f32
    }

    /// Returns `true` if the quantization of some cluster would show.
    pub(crate) fn is_near(&self) -> bool {
        self.facts.greatest_step_m > self.max_step_m()
    }

    /// Returns `true` if lines need the draw ranks of their paths.
    pub(crate) fn needs_ranks(&self, paint: PaintMode) -> bool {
        paint != PaintMode::SingleColor || !self.facts.is_plain
    }

    fn radius_px(&self, width_m: Option<f32>) -> f64 {
        let rule = &self.style.line_rule;
        rule.radius_px(width_m, self.view.px_per_m())
    }

    /// The number of samples that the thinnest stroke needs.
    pub(crate) fn samples(&self) -> Samples {
        let thinnest_px = match self.style.line_rule {
            LineRule::World { min_px, .. } if self.facts.widest_m.is_some() => min_px / 2.0,
            _ => f64::INFINITY,
        };
        if self.radius_px(None).min(thinnest_px) < MIN_COARSE_RADIUS_PX {
            Samples::Fine
        } else {
            Samples::Coarse
        }
    }

    /// Distance from its curve up to which a stroke may touch a sample.
    fn reach_px(&self, width_m: Option<f32>) -> f64 {
        self.radius_px(width_m) + 1.0
    }

    /// World bounds in which a stroke may touch the picture.
    pub(crate) fn visible_bounds_m(&self, width_m: Option<f32>) -> Bounds<f64> {
        let picture = self.view.world_bounds();
        picture.inflated(self.reach_px(width_m) / self.view.px_per_m())
    }

    /// Tiles that strokes within a box may touch, of `columns` x `rows` tiles. `width_m` is their
    /// greatest width.
    pub(crate) fn touched_tiles(
        &self,
        bounds_m: Bounds<f64>,
        width_m: Option<f32>,
        [columns, rows]: [u32; 2],
    ) -> Window {
        // Some strokes may have no width of their own.
        let reach_px = self.reach_px(None).max(self.reach_px(width_m));
        let [min, max] = [bounds_m.min, bounds_m.max].map(|p| self.view.pixel_from_world(p));
        let tiles = |low_px: f64, high_px: f64, tiles: u32| {
            let tile = |px: f64| (px / f64::from(TILE_PX)).floor();
            let (low, high) = (tile(low_px - reach_px), tile(high_px + reach_px));
            // Conversions saturate at 0.
            (low as u32).min(tiles)..((high + 1.0) as u32).min(tiles)
        };
        Window {
            columns: tiles(min.x, max.x, columns),
            // The picture's y points down.
            rows: tiles(max.y, min.y, rows),
        }
    }

    /// Parameters of a window. `list_capacity` is the fixed length of each tile list, or 0.
    pub(crate) fn params(
        &self,
        job: &WindowJob<'_>,
        capacity: Capacity,
        list_capacity: u32,
    ) -> FrameParams {
        let (lod, window, lines) = (&self.lod, job.window, job.lines);
        let center = lod.center_m;
        let high = center.to_f32();
        let low = (center - high.to_f64()).to_f32();
        let limits_px = match self.style.line_rule {
            LineRule::World { min_px, max_px, .. } if self.facts.widest_m.is_some() => {
                [min_px / 2.0, max_px.max(min_px) / 2.0]
            }
            // No path has its own width.
            _ => [0.0, -1.0],
        };
        let origin = lod.origin_px(self.view);
        let ratio = lod.px_per_view_px(self.view);
        let in_lod = |x_px: u32, y_px: u32| {
            let from_center = (Point::new(f64::from(x_px), f64::from(y_px)) - origin) * ratio;
            [from_center.x as f32, from_center.y as f32]
        };
        let size = self.view.size();
        let first = [window.columns.start, window.rows.start].map(|tile| tile * TILE_PX);
        let end = [window.columns.end, window.rows.end].map(|tile| tile * TILE_PX);
        let window_low_px = in_lod(first[0], first[1]);
        let window_high_px = in_lod(end[0].min(size.width()), end[1].min(size.height()));
        let lod_reach_px = lod.reach_px.map(|px| px as f32);
        let fills_cache = matches!(lines, LineSource::Lod | LineSource::Refreshed(..));
        let (flatten_low_px, flatten_high_px) = if fills_cache {
            (lod_reach_px.map(|px| -px), lod_reach_px)
        } else {
            (window_low_px, window_high_px)
        };
        let dirty_clusters = match lines {
            LineSource::Refreshed(_, dirty) => dirty,
            LineSource::Window(_) | LineSource::Lod | LineSource::Cached(_) => 0,
        };
        let threads_per_line = TARGET_LINE_THREADS / lines.cached().max(1);
        FrameParams {
            center_high_m: [high.x, high.y],
            center_low_m: [low.x, low.y],
            lod_reach_px,
            flatten_low_px,
            flatten_high_px,
            window_low_px,
            window_high_px,
            lod_origin_px: [origin.x as f32, origin.y as f32],
            map_x: self.facts.map[0],
            map_y: self.facts.map[1],
            lod_px_per_m: lod.px_per_m as f32,
            lod_px_per_px: ratio as f32,
            px_per_lod_px: ratio.recip() as f32,
            px_per_m: self.view.px_per_m() as f32,
            radius_px: self.radius_px(None) as f32,
            min_radius_px: limits_px[0] as f32,
            max_radius_px: limits_px[1] as f32,
            tolerance_px: TOLERANCE_PX,
            clusters: self.facts.clusters,
            styles: self.facts.styles,
            width_px: size.width(),
            height_px: size.height(),
            first_column: window.columns.start,
            columns: window.columns.len() as u32,
            first_row: window.rows.start,
            rows: window.rows.len() as u32,
            first_pixel_row: job.first_row * TILE_PX,
            line_capacity: capacity.lines,
            reference_capacity: capacity.references,
            color: self.facts.color,
            background: device_color(self.style.background),
            max_step_m: self.max_step_m(),
            has_ranks: u32::from(capacity.has_ranks),
            first_line: lines.first_new(),
            caches_lines: u32::from(fills_cache),
            dirty_clusters,
            cached_lines: lines.cached(),
            threads_per_line: threads_per_line.clamp(1, MAX_THREADS_PER_LINE),
            list_capacity,
            steps_per_px: lod.steps_per_px() as f32,
            px_per_step: (lod.steps_per_px() * ratio).recip() as f32,
            padding: 0,
        }
    }
}
