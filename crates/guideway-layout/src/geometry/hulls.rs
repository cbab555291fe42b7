//! Hulls: bounding boxes of the control points of each path, which contain its curve.

use std::ops::Range;

use guideway_spline::mem::{CHUNK_LEN, prefetch_address, prefetch_ahead};
use guideway_spline::{Bounds, Point, Real, greater, lesser};
use rayon::prelude::*;

use super::buffers::{Points, elements_of};

/// Paths per task of a query: fewer are not worth a task.
const TASK_PATHS: usize = 1 << 14;

/// Bounding box of the control points of each path, in the precision of the points.
///
/// The box contains the curve, because a B-spline lies in the convex hull of its control points.
#[derive(Clone, Debug)]
pub struct Hulls(Boxes);

#[derive(Clone, Debug)]
enum Boxes {
    F64(Vec<Bounds<f64>>),
    F32(Vec<Bounds<f32>>),
}

/// Appends the boxes of the runs that have none yet, where run `i` has the points up to `ends[i]`.
///
/// The result is for [`Geometry::with_hulls`](super::Geometry::with_hulls). The function uses all
/// threads; it is fastest right after the points were written, while they are in the cache.
///
/// # Panics
/// When the ends decrease or exceed the number of points.
pub fn append_hulls<T: Real>(boxes: &mut Vec<Bounds<T>>, points: &[Point<T>], ends: &[u32]) {
    let points_of = |run| elements_of(ends, &(run..run + 1));
    append(boxes, boxes.len()..ends.len(), points, points_of);
}

fn append<T: Real>(
    boxes: &mut Vec<Bounds<T>>,
    rows: Range<usize>,
    points: &[Point<T>],
    points_of: impl Fn(usize) -> Range<usize> + Sync,
) {
    let of_row = |row| {
        let points = &points[points_of(row)];
        prefetch_ahead(points);
        hull_of(points)
    };
    boxes.par_extend(rows.into_par_iter().map(of_row));
}

/// Box of the points of a path.
#[inline]
pub(super) fn hull_of<T: Real>(points: &[Point<T>]) -> Bounds<T> {
    Bounds::of_slice(points).unwrap_or(empty())
}

impl From<Vec<Bounds<f32>>> for Hulls {
    fn from(boxes: Vec<Bounds<f32>>) -> Self {
        Self(Boxes::F32(boxes))
    }
}

impl From<Vec<Bounds<f64>>> for Hulls {
    fn from(boxes: Vec<Bounds<f64>>) -> Self {
        Self(Boxes::F64(boxes))
    }
}

impl Hulls {
    /// Hulls of `paths` paths, where `points_of` yields the range of the points of each.
    pub(super) fn new(
        points: &Points,
        paths: usize,
        points_of: impl Fn(usize) -> Range<usize> + Sync,
    ) -> Self {
        fn boxes<T: Real>(
            points: &[Point<T>],
            paths: usize,
            points_of: impl Fn(usize) -> Range<usize> + Sync,
        ) -> Vec<Bounds<T>> {
            let mut boxes = Vec::new();
            append(&mut boxes, 0..paths, points, points_of);
            boxes
        }
        match points {
            Points::F64(points) => boxes(points, paths, points_of).into(),
            Points::F32(points) => boxes(points, paths, points_of).into(),
        }
    }

    /// The boxes, if they are in `f64`.
    pub(super) fn wide_mut(&mut self) -> Option<&mut [Bounds<f64>]> {
        match &mut self.0 {
            Boxes::F64(boxes) => Some(boxes),
            Boxes::F32(_) => None,
        }
    }

    /// The boxes, if they are in `f32`.
    pub(super) fn narrow_mut(&mut self) -> Option<&mut [Bounds<f32>]> {
        match &mut self.0 {
            Boxes::F32(boxes) => Some(boxes),
            Boxes::F64(_) => None,
        }
    }

    /// Heap bytes in use.
    pub(super) fn heap_bytes(&self) -> usize {
        match &self.0 {
            Boxes::F64(boxes) => boxes.capacity() * size_of::<Bounds<f64>>(),
            Boxes::F32(boxes) => boxes.capacity() * size_of::<Bounds<f32>>(),
        }
    }

    /// Number of paths.
    pub fn len(&self) -> usize {
        match &self.0 {
            Boxes::F64(boxes) => boxes.len(),
            Boxes::F32(boxes) => boxes.len(),
        }
    }

    /// Returns `true` if there are no paths.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Box of all paths, in meters; `None` if they have no points.
    pub fn all(&self) -> Option<Bounds<f64>> {
        match &self.0 {
            Boxes::F64(boxes) => non_empty(union_of_all(boxes)),
            Boxes::F32(boxes) => non_empty(union_of_all(boxes)),
        }
    }

    /// The paths whose box meets one of `queries`, boxes in meters, in ascending order.
    ///
    /// Cost: O(paths * queries), without a look at any curve.
    pub fn meeting(&self, queries: &[Bounds<f64>]) -> Vec<u32> {
        if queries.is_empty() {
            return Vec::new();
        }
        match &self.0 {
            Boxes::F64(boxes) => meeting(boxes, queries),
            Boxes::F32(boxes) => meeting(boxes, queries),
        }
    }

    /// Box of many paths, in meters, by all threads; `None` if they have no points.
    ///
    /// # Panics
    /// When a path is not below [`Self::len`].
    pub fn of_rows(&self, paths: &[u32]) -> Option<Bounds<f64>> {
        let of_task = |paths: &[u32]| self.of(paths.iter().map(|&path| path as usize));
        if paths.len() <= TASK_PATHS {
            return of_task(paths);
        }
        let boxes = paths.par_chunks(TASK_PATHS).filter_map(of_task);
        boxes.reduce_with(Bounds::union)
    }

    /// Box of some paths, in meters; `None` if they have no points.
    ///
    /// # Panics
    /// When a path is not below [`Self::len`].
    #[inline]
    pub fn of(
        &self,
        paths: impl IntoIterator<Item = usize, IntoIter: Clone>,
    ) -> Option<Bounds<f64>> {
        let paths = paths.into_iter();
        match &self.0 {
            Boxes::F64(boxes) => non_empty(union_of(boxes, paths)),
            Boxes::F32(boxes) => non_empty(union_of(boxes, paths)),
        }
    }
}

fn meeting<T: Real>(boxes: &[Bounds<T>], queries: &[Bounds<f64>]) -> Vec<u32> {
    let meets = |of: &Bounds<T>| {
        let of = Bounds {
            min: of.min.to_f64(),
            max: of.max.to_f64(),
        };
        queries.iter().any(|query| of.intersects(*query))
    };
    let chunks = boxes.par_chunks(TASK_PATHS).enumerate();
    let chunks = chunks.flat_map_iter(|(chunk, boxes)| {
        let rows = boxes.iter().zip(chunk * TASK_PATHS..);
        let met = rows.filter(|(of, _)| meets(of));
        met.map(|(_, row)| row as u32)
    });
    chunks.collect()
}

fn union_of_all<T: Real>(boxes: &[Bounds<T>]) -> Bounds<T> {
    let chunks = boxes.par_chunks(CHUNK_LEN).map(|chunk| {
        prefetch_ahead(chunk);
        chunk.iter().copied().fold(empty(), union)
    });
    chunks.reduce(empty, union)
}

#[inline]
fn union_of<T: Real>(boxes: &[Bounds<T>], paths: impl Iterator<Item = usize> + Clone) -> Bounds<T> {
    // The paths may be scattered, which defeats the hardware prefetcher.
    (paths.clone()).for_each(|path| prefetch_address(&boxes[path]));
    paths.fold(empty(), |all, path| union(all, boxes[path]))
}

/// The box of no points, the neutral element of [`union`].
fn empty<T: Real>() -> Bounds<T> {
    Bounds {
        min: Point::new(T::infinity(), T::infinity()),
        max: Point::new(T::neg_infinity(), T::neg_infinity()),
    }
}

/// As [`Bounds::union`], faster, for boxes without NaN.
#[inline]
fn union<T: Real>(a: Bounds<T>, b: Bounds<T>) -> Bounds<T> {
    Bounds {
        min: Point::new(lesser(a.min.x, b.min.x), lesser(a.min.y, b.min.y)),
        max: Point::new(greater(a.max.x, b.max.x), greater(a.max.y, b.max.y)),
    }
}

#[inline]
fn non_empty<T: Real>(Bounds { min, max }: Bounds<T>) -> Option<Bounds<f64>> {
    (min.x <= max.x).then(|| Bounds {
        min: min.to_f64(),
        max: max.to_f64(),
    })
}
