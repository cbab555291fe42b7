//! The scene as the device sees it: in `f32` meters from the middle of its box, under a uniform grid.

use guideway_scene::{FrameSize, View};
use guideway_scene::{LineRule, Scene};
use guideway_spline::{Bounds, Point};

use crate::options::{Binning, GridOptions};
use crate::params::GridParams;

/// The picture that lists are made for: it shows the whole scene.
const PLANNED_PX: (u32, u32) = (1920, 1080);

/// Place and size of a scene.
#[derive(Clone, Copy, Debug)]
pub(super) struct Local {
    /// Where the device's coordinates have their origin.
    center_m: Point<f64>,
    /// Box of the curves, from there.
    pub(super) bounds_m: Bounds<f64>,
    /// Greatest coordinate of a control point, from there.
    reach_m: f64,
    /// Longest side of a segment's control points' box.
    segment_m: f64,
    pub(super) segments: u64,
}

impl Local {
    pub(super) fn of(scene: &Scene) -> Self {
        let origin = Point::new(0.0, 0.0);
        let nowhere = Bounds {
            min: origin,
            max: origin,
        };
        let bounds = scene.bounds().unwrap_or(nowhere);
        let center_m = bounds.center();
        let mut local = Self {
            center_m,
            bounds_m: Bounds {
                min: bounds.min - center_m,
                max: bounds.max - center_m,
            },
            reach_m: 0.0,
            segment_m: 0.0,
            segments: 0,
        };
        let paths = &scene.layout().paths;
        let drawn = scene.draw_order().iter();
        let runs = drawn.flat_map(|&path| paths.get(path as usize).runs());
        for segment in runs.flat_map(|run| run.segments()) {
            if let Some(hull) = Bounds::of_points(segment.map(|p| p - center_m)) {
                let reaches = [hull.min.x, hull.min.y, hull.max.x, hull.max.y].map(f64::abs);
                local.reach_m = reaches.into_iter().fold(local.reach_m, f64::max);
                local.segment_m = local.segment_m.max(hull.size().x).max(hull.size().y);
            }
            local.segments += 1;
        }
        local
    }

    /// A point as the device sees it.
    pub(super) fn local_from_world(&self, point_m: Point<f64>) -> [f32; 2] {
        let local = (point_m - self.center_m).to_f32();
        [local.x, local.y]
    }

    /// How far from its place a line may appear because the device computes in `f32`, in pixels: a bound.
    ///
    /// With u = 2^-24, a coordinate up to X is rounded by at most u X: once as a control point, once as an
    /// end of a line, once as the middle of the view and once as a pixel. What is computed relative to a
    /// segment, its points and the projection on its lines, is off by at most 8 u of its size. The middle
    /// of a view that is off the scene is at most half a picture away from any pixel that meets it, which
    /// adds less than a hundredth of a pixel.
    pub(super) fn rounding_px(&self, px_per_m: f64) -> f64 {
        let unit = f64::from(f32::EPSILON) / 2.0;
        unit * (4.0 * self.reach_m + 8.0 * self.segment_m) * px_per_m + 0.01
    }

    /// The grid over the box of the curves.
    pub(super) fn grid(&self, options: &GridOptions) -> GridParams {
        let cells = f64::from(options.cells);
        let size_m = self.bounds_m.size();
        // A side that is hardly more than rounding is one cell.
        let least_m = cells * self.reach_m * f64::from(f32::EPSILON);
        let cells_per_m = |side_m: f64| {
            if side_m > least_m {
                cells / side_m
            } else {
                0.0
            }
        };
        let per_m = [cells_per_m(size_m.x), cells_per_m(size_m.y)];
        let reach_m = match options.binning {
            Binning::LineBox => 0.0,
            Binning::LineBoxWithRadius => self.binned_reach_m(per_m, options),
        };
        GridParams {
            origin_m: [self.bounds_m.min.x as f32, self.bounds_m.min.y as f32],
            cells_per_m: per_m.map(|c| c as f32),
            reach_m: reach_m as f32,
            padding: 0,
        }
    }

    /// How far beyond its box a line is entered: as far as it shows by the thesis' rule in a picture of the
    /// whole scene, and so in all closer ones, but at most a cell. Where a view's lines reach farther,
    /// pixels look into the cells beside their own too: what is seen is the same, but takes longer.
    fn binned_reach_m(&self, cells_per_m: [f64; 2], options: &GridOptions) -> f64 {
        let size = FrameSize::new(PLANNED_PX.0, PLANNED_PX.1);
        let whole = size.and_then(|size| View::fit(size, Some(self.bounds_m)));
        let shows_m = whole.map_or(0.0, |view| {
            let radius_px = LineRule::Thesis.radius_px(None, view.px_per_m());
            (radius_px + options.antialias.beyond_px()) / view.px_per_m()
        });
        let shorter_side_m = 1.0 / cells_per_m[0].max(cells_per_m[1]);
        // A hair more, so that rounding never takes it for less.
        (1.001 * shows_m).min(shorter_side_m)
    }
}

/// How many cells the lines of a segment meet: at most, but for rounding.
pub(super) struct Met {
    /// All lines together.
    pub(super) entries: u64,
    /// Rows of cells that one line meets.
    pub(super) rows: u32,
}

impl Met {
    /// The derivative of a uniform cubic B-spline is a mean of the differences of its control points, so
    /// none of its lines is longer than the longest difference over the number of lines; and none meets a
    /// cell that the box of all control points does not meet.
    pub(super) fn by(control_m: &[[f32; 2]; 4], grid: &GridParams, options: &GridOptions) -> Self {
        let lines = options.lines_a_segment();
        let cells = |axis: usize| {
            let reach_m = f64::from(grid.reach_m);
            let per_m = f64::from(grid.cells_per_m[axis]);
            let at = control_m.map(|point| f64::from(point[axis] - grid.origin_m[axis]));
            let steps = [at[1] - at[0], at[2] - at[1], at[3] - at[2]].map(f64::abs);
            let line_m = steps.into_iter().fold(0.0, f64::max) / f64::from(lines);
            let by_length = ((line_m + 2.0 * reach_m) * per_m).floor() + 2.0;
            let cell = |at_m: f64| (at_m * per_m).floor();
            let low = at.into_iter().fold(f64::INFINITY, f64::min) - reach_m;
            let high = at.into_iter().fold(f64::NEG_INFINITY, f64::max) + reach_m;
            let by_box = cell(high) - cell(low) + 1.0;
            by_length.min(by_box).min(f64::from(options.cells)) as u32
        };
        let (columns, rows) = (cells(0), cells(1));
        Self {
            entries: u64::from(lines) * u64::from(columns) * u64::from(rows),
            rows,
        }
    }
}
