//! Affine maps of paths, in place; boxes and rounding errors of the result; the coordinate check.

use guideway_spline::mem::prefetched_chunks;
use guideway_spline::{Affine, Bounds, Point};
use rayon::prelude::*;

use super::buffers::{Points, elements_of};
use super::hulls::Hulls;
use super::parts::{PathPoints, for_each_path};
use super::store::Geometry;
use crate::RunPoints;

impl Geometry {
    /// Maps the curves of some paths, in the precision of the buffer. Keeps the hulls up to date if
    /// they are known. All threads share the work where rows ascend.
    ///
    /// # Panics
    /// When a path is not below [`Self::path_count`].
    pub fn transform(&mut self, paths: impl IntoIterator<Item = usize>, by: Affine) {
        let paths: Vec<u32> = paths.into_iter().map(|path| path as u32).collect();
        self.visit_paths(
            &paths,
            &|points, _| map_points(points, |p| by.apply(p)),
            &|points, _| map_points(points, |p| by.apply(p.to_f64()).to_f32()),
        );
    }

    /// Calls a function for the points of each path, of either precision, with the index of the
    /// path in `paths`. Keeps known hulls up to date.
    pub(super) fn visit_paths(
        &mut self,
        paths: &[u32],
        visit_wide: &(impl Fn(&mut [Point<f64>], usize) + Sync),
        visit_narrow: &(impl Fn(&mut [Point<f32>], usize) + Sync),
    ) {
        let (run_ends, path_ends) = (&self.run_ends, &self.path_ends);
        let points_of = |path: usize| {
            let runs = match path_ends {
                None => path..path + 1,
                Some(ends) => elements_of(ends, &(path..path + 1)),
            };
            elements_of(run_ends, &runs)
        };
        let hulls = self.hulls.get_mut();
        let is_known = match &mut self.points {
            Points::F64(points) => {
                let hulls = hulls.and_then(Hulls::wide_mut);
                let is_known = hulls.is_some();
                let all = PathPoints::all(points, hulls);
                for_each_path(all, paths, &points_of, visit_wide);
                is_known
            }
            Points::F32(points) => {
                let hulls = hulls.and_then(Hulls::narrow_mut);
                let is_known = hulls.is_some();
                let all = PathPoints::all(points, hulls);
                for_each_path(all, paths, &points_of, visit_narrow);
                is_known
            }
        };
        if !is_known {
            self.hulls.take();
        }
    }

    /// A box that contains every point of `bounds` after [`Self::transform`].
    ///
    /// Exact despite rounding: an affine map is monotone along each axis, and so is rounding, so no
    /// mapped point passes the mapped corners.
    pub fn mapped_bounds(&self, bounds: Bounds<f64>, by: Affine) -> Bounds<f64> {
        let [first, corners @ ..] = bounds.corners().map(|corner| {
            let mapped = by.apply(corner);
            let rounded = match &self.points {
                Points::F64(_) => mapped,
                Points::F32(_) => mapped.to_f32().to_f64(),
            };
            Bounds {
                min: rounded,
                max: rounded,
            }
        });
        corners.into_iter().fold(first, Bounds::union)
    }

    /// Upper bound of the rounding error of points in the box `mapped`, per axis, in meters.
    pub fn rounding_m(&self, mapped: Bounds<f64>) -> f64 {
        let farthest = mapped.corners().map(|p| p.x.abs().max(p.y.abs()));
        let half_step = match &self.points {
            Points::F64(_) => f64::EPSILON / 2.0,
            Points::F32(_) => f64::from(f32::EPSILON) / 2.0,
        };
        farthest.into_iter().fold(0.0, f64::max) * half_step
    }

    /// The first path without a curve, or with a coordinate that is not finite or whose absolute
    /// value exceeds `limit_m`.
    pub fn first_out_of_range(&self, limit_m: f64) -> Option<usize> {
        self.first_path(|path| self.runs(path).len() == 0 || !self.is_within(path, limit_m))
    }

    /// The first path with a coordinate that is not finite or whose absolute value exceeds
    /// `limit_m`. A path without a curve has none.
    pub fn first_beyond(&self, limit_m: f64) -> Option<usize> {
        self.first_path(|path| !self.is_within(path, limit_m))
    }

    fn first_path(&self, is_found: impl Fn(usize) -> bool + Sync) -> Option<usize> {
        let paths = (0..self.path_count()).into_par_iter();
        paths.find_first(|&path| is_found(path))
    }

    fn is_within(&self, path: usize, limit_m: f64) -> bool {
        let is_within = |p: Point<f64>| (p.x.abs() <= limit_m) & (p.y.abs() <= limit_m);
        let is_run_within = |run: RunPoints<'_>| match run {
            RunPoints::F64(points) => {
                let mut chunks = prefetched_chunks(points).flatten();
                chunks.all(|&p| is_within(p))
            }
            RunPoints::F32(points) => {
                let mut chunks = prefetched_chunks(points).flatten();
                chunks.all(|p| is_within(p.to_f64()))
            }
        };
        self.runs(path).all(is_run_within)
    }
}

/// Replaces each point by its image.
fn map_points<T: Copy>(points: &mut [T], map: impl Fn(T) -> T) {
    points.iter_mut().for_each(|p| *p = map(*p));
}
