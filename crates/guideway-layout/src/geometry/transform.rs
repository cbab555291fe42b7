//! Affine maps of paths, in place; boxes and rounding errors of the result; the coordinate check.

use guideway_spline::mem::{CHUNK_LEN, prefetch_ahead, prefetched_chunks};
use guideway_spline::{Affine, Bounds, Point};
use rayon::prelude::*;

use super::buffers::{Points, consecutive};
use super::parts::for_each_part;
use super::store::Geometry;
use crate::RunPoints;
use crate::run_points::POINTS_PER_TASK;

impl Geometry {
    /// Maps the curves of some paths, in the precision of the buffer. Fastest for rows in order.
    ///
    /// # Panics
    /// When a path is not below [`Self::path_count`].
    pub fn transform(&mut self, paths: impl IntoIterator<Item = usize>, by: Affine) {
        self.hulls.take();
        let parts = consecutive(paths).map(|rows| (self.points_of(&self.runs_of(&rows)), ()));
        let parts: Vec<_> = parts.collect();
        match &mut self.points {
            Points::F64(points) => for_each_part(points, &parts, &|points, ()| {
                map_points(points, |p| by.apply(p));
            }),
            Points::F32(points) => for_each_part(points, &parts, &|points, ()| {
                map_points(points, |p| by.apply(p.to_f64()).to_f32());
            }),
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

/// Replaces each point by its image, on all threads if there are many.
fn map_points<T: Copy + Send>(points: &mut [T], map: impl Fn(T) -> T + Sync) {
    let map_chunks = |points: &mut [T]| {
        for chunk in points.chunks_mut(CHUNK_LEN) {
            prefetch_ahead(chunk);
            chunk.iter_mut().for_each(|p| *p = map(*p));
        }
    };
    if points.len() <= POINTS_PER_TASK {
        map_chunks(points);
    } else {
        points.par_chunks_mut(POINTS_PER_TASK).for_each(map_chunks);
    }
}
