//! One frame as the device is told of it.

use guideway_scene::{LineRule, Scene};
use guideway_scene::{RenderError, Style, View};
use guideway_spline::{Bounds, Point};

use super::NAME;
use super::canvas::Canvas;
use super::level::Level;
use super::pack::device_color;
use super::paint::Paint;
use super::params::{ENOUGH_THREADS, FrameParams, MOST_THREADS_A_LINE, Samples, TILE_PX};
use super::prepared::Facts;
use super::room::Room;
use super::window::Window;

/// Farthest that a line may be from its curve, in pixels of its level: the borders of a stroke move by as much.
const TOLERANCE_PX: f32 = 1.0 / 30.0;
/// Half the width of the thinnest stroke that few samples do for, in pixels.
const COARSE_RADIUS_PX: f64 = 0.25;
/// Farthest that single precision may move a line, in pixels.
const MOST_ROUNDING_PX: f64 = 0.1;
/// Farthest that steps may move a control point, in pixels of the level along an axis.
const MOST_STEP_OFF_PX: f64 = 1.0 / 128.0;

/// Which lines a frame is drawn from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Lines {
    /// Those of what its window shows, behind so many that are kept.
    OfWindow(u32),
    /// Those of all that its level reaches, so that they can be kept.
    OfLevel,
    /// So many that are there.
    Kept(u32),
    /// So many that are there, but those of so many clusters that were touched are struck out, and others added.
    Renewed(u32, u32),
}

impl Lines {
    /// Where those that are made begin.
    pub(super) fn first(self) -> u32 {
        match self {
            Self::OfWindow(first) => first,
            Self::OfLevel | Self::Kept(_) | Self::Renewed(..) => self.there(),
        }
    }

    /// How many are drawn that are there.
    pub(super) fn there(self) -> u32 {
        match self {
            Self::OfWindow(_) | Self::OfLevel => 0,
            Self::Kept(lines) | Self::Renewed(lines, _) => lines,
        }
    }
}

/// A view of a scene.
pub(super) struct Shot<'a> {
    pub(super) view: &'a View,
    pub(super) style: &'a Style,
    /// What its lines are made for.
    pub(super) level: Level,
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
        let widest_px = |px_per_m| {
            let radius_px = |width_m| style.line_rule.radius_px(width_m, px_per_m);
            f64::max(radius_px(None), radius_px(facts.widest_m))
        };
        let level = Level::of(view, widest_px);
        let off_px = 0.5 / level.steps_a_px();
        if off_px > MOST_ROUNDING_PX {
            return Err(RenderError::Unsupported {
                method: NAME,
                what: format!(
                    "strokes that reach {:.0} pixels far: their ends would be off by {off_px:.1} pixels",
                    widest_px(view.px_per_m()),
                ),
                remedy: "Zoom out, limit widths in pixels, or use `--method cpu`.".to_owned(),
            });
        }
        Ok(Self {
            view,
            style,
            level,
            scene,
            facts,
        })
    }

    /// The largest steps of points that are not too coarse for it: what is rounded is off by half of one.
    pub(super) fn most_step_m(&self) -> f32 {
        (2.0 * MOST_STEP_OFF_PX / self.level.px_per_m).min(f64::from(f32::MAX)) as f32
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

    /// How far from its curve a stroke may leave a mark.
    fn reach_px(&self, width_m: Option<f32>) -> f64 {
        self.radius_px(width_m) + 1.0
    }

    /// Where in the world a stroke has to be to leave a mark on the picture.
    pub(super) fn seen_m(&self, width_m: Option<f32>) -> Bounds<f64> {
        let picture = self.view.world_bounds();
        picture.inflated(self.reach_px(width_m) / self.view.px_per_m())
    }

    /// The tiles that strokes within a box may leave a mark on, those without a width of their own too.
    pub(super) fn marked_tiles(
        &self,
        hull_m: Bounds<f64>,
        width_m: Option<f32>,
        canvas: &Canvas,
    ) -> Window {
        let reach_px = self.reach_px(None).max(self.reach_px(width_m));
        let [min, max] = [hull_m.min, hull_m.max].map(|p| self.view.pixel_from_world(p));
        let tiles = |low_px: f64, high_px: f64, tiles: u32| {
            // Numbers below zero become zero.
            let tile = |px: f64| (px / f64::from(TILE_PX)).floor();
            let (low, high) = (tile(low_px - reach_px), tile(high_px + reach_px));
            (low as u32).min(tiles)..((high + 1.0) as u32).min(tiles)
        };
        Window {
            columns: tiles(min.x, max.x, canvas.columns),
            // The picture's y goes down.
            rows: tiles(max.y, min.y, canvas.rows),
        }
    }

    /// What the device reads for a window of the picture, if its buffer of pixels begins with a row of tiles. Lines are made
    /// of what it shows, or of all that the level reaches, unless they are there; then the list of each tile may have places for
    /// so many.
    pub(super) fn params(
        &self,
        canvas: &Canvas,
        room: &Room,
        window: &Window,
        first_row: u32,
        lines: Lines,
        list_room: u32,
    ) -> FrameParams {
        let level = &self.level;
        let center = level.center_m;
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
        let (origin, ratio) = (level.origin_px(self.view), level.px_a_px(self.view));
        let in_level = |x_px: u32, y_px: u32| {
            let from_middle = (Point::new(f64::from(x_px), f64::from(y_px)) - origin) * ratio;
            [from_middle.x as f32, from_middle.y as f32]
        };
        let size = canvas.size;
        let first = [window.columns.start, window.rows.start].map(|at| at * TILE_PX);
        let end = [window.columns.end, window.rows.end].map(|at| at * TILE_PX);
        let drawn_low_px = in_level(first[0], first[1]);
        let drawn_high_px = in_level(end[0].min(size.width()), end[1].min(size.height()));
        let reach_px = level.reach_px.map(|px| px as f32);
        let (made_low_px, made_high_px) = match lines {
            Lines::OfLevel | Lines::Renewed(..) => (reach_px.map(|px| -px), reach_px),
            Lines::OfWindow(_) | Lines::Kept(_) => (drawn_low_px, drawn_high_px),
        };
        let keeps_lines = matches!(lines, Lines::OfLevel | Lines::Renewed(..));
        let kept_lines = lines.there();
        let touched = match lines {
            Lines::Renewed(_, touched) => touched,
            Lines::OfWindow(_) | Lines::OfLevel | Lines::Kept(_) => 0,
        };
        let threads_a_line = ENOUGH_THREADS / kept_lines.max(1);
        let threads_a_line = threads_a_line.clamp(1, MOST_THREADS_A_LINE);
        FrameParams {
            center_high_m: [high.x, high.y],
            center_low_m: [low.x, low.y],
            reach_px,
            made_low_px,
            made_high_px,
            drawn_low_px,
            drawn_high_px,
            line_origin_px: [origin.x as f32, origin.y as f32],
            level_px_per_m: level.px_per_m as f32,
            level_px_a_px: ratio as f32,
            px_a_level_px: ratio.recip() as f32,
            px_per_m: self.view.px_per_m() as f32,
            radius_px: self.radius_px(None) as f32,
            least_radius_px: limits_px[0] as f32,
            most_radius_px: limits_px[1] as f32,
            tolerance_px: TOLERANCE_PX,
            clusters: self.facts.clusters,
            styles: self.facts.styles,
            width_px: size.width(),
            height_px: size.height(),
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
            first_line: lines.first(),
            keeps_lines: u32::from(keeps_lines),
            touched,
            kept_lines,
            threads_a_line,
            list_room,
            steps_a_px: level.steps_a_px() as f32,
            px_a_step: (level.steps_a_px() * ratio).recip() as f32,
            padding: 0,
        }
    }
}
