//! Local coordinates of a scene: `f32` meters from the center of its bounds, under a uniform grid.
//!
//! Input: the scene. Output: origin, bounds, rounding error and grid parameters.

use guideway_scene::{FrameSize, LineRule, Scene, View};
use guideway_spline::{Bounds, Point};

use crate::options::{Binning, GridOptions};
use crate::params::GridParams;

/// Size of the picture of the whole scene for which lists are built.
const PLANNED_PX: (u32, u32) = (1920, 1080);

/// Local origin and extent of a scene.
#[derive(Clone, Copy, Debug)]
pub struct LocalScene {
    /// Origin of local coordinates, in world coordinates.
    center_m: Point<f64>,
    /// Bounds of the curves, in local coordinates.
    pub bounds_m: Bounds<f64>,
    /// Largest absolute local coordinate of a control point.
    reach_m: f64,
    /// Longest side of the bounds of one segment's control points.
    segment_m: f64,
    /// Segments of all drawn paths.
    pub segments: u64,
}

impl LocalScene {
    /// Measures a scene.
    pub fn of(scene: &Scene) -> Self {
        let origin = Point::new(0.0, 0.0);
        let empty = Bounds {
            min: origin,
            max: origin,
        };
        let bounds = scene.bounds().unwrap_or(empty);
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
                local.include_hull(hull);
            }
            local.segments += 1;
        }
        local
    }

    /// Extends the bounds and the rounding error by the control points of a moved segment.
    pub fn include_segment(&mut self, control_m: &[[f32; 2]; 4]) {
        let point = |&[x, y]: &[f32; 2]| Point::new(f64::from(x), f64::from(y));
        if let Some(hull) = Bounds::of_points(control_m.iter().map(point)) {
            self.include_hull(hull);
            self.bounds_m = self.bounds_m.union(hull);
        }
    }

    fn include_hull(&mut self, hull: Bounds<f64>) {
        let distances = [hull.min.x, hull.min.y, hull.max.x, hull.max.y].map(f64::abs);
        self.reach_m = distances.into_iter().fold(self.reach_m, f64::max);
        self.segment_m = self.segment_m.max(hull.size().x).max(hull.size().y);
    }

    /// Converts a point to local coordinates.
    pub fn local_from_world(&self, point_m: Point<f64>) -> [f32; 2] {
        let local = (point_m - self.center_m).to_f32();
        [local.x, local.y]
    }

    /// Upper bound of a line's displacement by `f32` arithmetic, in pixels.
    ///
    /// derived: with u = 2^-24, rounding moves a coordinate up to X by at most u X: once as a
    /// control point, once as an end of a line, once as the center of the view and once as a pixel.
    /// Points and projections relative to a segment are off by at most 8 u times its size. The
    /// center of a view outside the scene is at most half a picture away from any pixel that shows
    /// the scene, which adds less than 0.01 pixels.
    pub(super) fn rounding_px(&self, px_per_m: f64) -> f64 {
        let unit = f64::from(f32::EPSILON) / 2.0;
        unit * (4.0 * self.reach_m + 8.0 * self.segment_m) * px_per_m + 0.01
    }

    /// Parameters of the grid over the bounds of the curves.
    pub(super) fn grid(&self, options: &GridOptions) -> GridParams {
        let cells = f64::from(options.cells);
        let size_m = self.bounds_m.size();
        // A side within the rounding error becomes a single cell.
        let min_side_m = cells * self.reach_m * f64::from(f32::EPSILON);
        let cells_per_m = |side_m: f64| {
            if side_m > min_side_m {
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

    /// Distance beyond its bounds at which a cell still lists a line: the radius of the thesis'
    /// line rule in a picture of the whole scene, which covers all closer views, but at most one
    /// cell. In views with wider lines, pixels also read neighbor cells: the same picture, but
    /// slower.
    fn binned_reach_m(&self, cells_per_m: [f64; 2], options: &GridOptions) -> f64 {
        let size = FrameSize::new(PLANNED_PX.0, PLANNED_PX.1);
        let whole = size.and_then(|size| View::fit(size, Some(self.bounds_m)));
        let visible_m = whole.map_or(0.0, |view| {
            let radius_px = LineRule::Thesis.radius_px(None, view.px_per_m());
            (radius_px + options.antialias.margin_px()) / view.px_per_m()
        });
        let shorter_side_m = 1.0 / cells_per_m[0].max(cells_per_m[1]);
        // The factor keeps rounding from shrinking the distance.
        (1.001 * visible_m).min(shorter_side_m)
    }
}

/// Upper bound of the cells that the lines of a segment overlap, up to rounding.
pub(super) struct CellBound {
    /// Cells of all lines together.
    pub(super) entries: u64,
    /// Rows of cells that one line overlaps.
    pub(super) rows: u32,
}

impl CellBound {
    /// Bounds the cells of a segment.
    ///
    /// derived: the derivative of a uniform cubic B-spline is a mean of the differences of its
    /// control points, so no line is longer than the longest difference divided by the number of
    /// lines; and no line leaves the bounds of the control points.
    pub(super) fn of_segment(
        control_m: &[[f32; 2]; 4],
        grid: &GridParams,
        options: &GridOptions,
    ) -> Self {
        let lines = options.lines_per_segment();
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
