use std::ops::Range;

use guideway_spline::mem::{CHUNK_LEN, prefetch_address, prefetch_ahead};
use guideway_spline::{Bounds, Point, Real, greater, lesser};
use rayon::prelude::*;

use super::{Geometry, Points, between};

/// Boxes of the control points of all paths, which hold their curves, in the precision of the points.
#[derive(Clone, Debug)]
pub struct Hulls(Boxes);

#[derive(Clone, Debug)]
enum Boxes {
    F64(Vec<Bounds<f64>>),
    F32(Vec<Bounds<f32>>),
}

impl Geometry {
    /// Where each path lies, in meters. Found when it is first asked for after a change: all points are read once, by all
    /// threads.
    pub fn hulls(&self) -> &Hulls {
        self.hulls.get_or_init(|| {
            Hulls(match &self.points {
                Points::F64(points) => Boxes::F64(self.boxes(points)),
                Points::F32(points) => Boxes::F32(self.boxes(points)),
            })
        })
    }

    fn boxes<T: Real>(&self, points: &[Point<T>]) -> Vec<Bounds<T>> {
        let mut boxes = Vec::new();
        let points_of = |path| self.points_of(&self.runs_of(&(path..path + 1)));
        add(&mut boxes, 0..self.path_count(), points, points_of);
        boxes
    }
}

/// Adds the boxes of runs that have none yet, where run `i` has the points up to `ends[i]`: for [`Geometry::with_hulls`].
/// Takes all threads, and least time where the points were just written.
///
/// # Panics
/// When the ends fall, or lie behind the last point.
pub fn add_boxes<T: Real>(boxes: &mut Vec<Bounds<T>>, points: &[Point<T>], ends: &[u32]) {
    let points_of = |run| between(ends, &(run..run + 1));
    add(boxes, boxes.len()..ends.len(), points, points_of);
}

fn add<T: Real>(
    boxes: &mut Vec<Bounds<T>>,
    rows: Range<usize>,
    points: &[Point<T>],
    points_of: impl Fn(usize) -> Range<usize> + Sync,
) {
    let of_row = |row| {
        let points = &points[points_of(row)];
        prefetch_ahead(points);
        Bounds::of_slice(points).unwrap_or(none())
    };
    boxes.par_extend(rows.into_par_iter().map(of_row));
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
    /// Heap bytes held.
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

    /// Whether there are no paths.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Where all paths lie, in meters; none if they have no points.
    pub fn all(&self) -> Option<Bounds<f64>> {
        match &self.0 {
            Boxes::F64(boxes) => shown(all(boxes)),
            Boxes::F32(boxes) => shown(all(boxes)),
        }
    }

    /// Where some paths lie, in meters; none if they have no points.
    ///
    /// # Panics
    /// When one is not below [`Self::len`].
    #[inline]
    pub fn of(
        &self,
        paths: impl IntoIterator<Item = usize, IntoIter: Clone>,
    ) -> Option<Bounds<f64>> {
        let paths = paths.into_iter();
        match &self.0 {
            Boxes::F64(boxes) => shown(some(boxes, paths)),
            Boxes::F32(boxes) => shown(some(boxes, paths)),
        }
    }
}

fn all<T: Real>(boxes: &[Bounds<T>]) -> Bounds<T> {
    let chunks = boxes.par_chunks(CHUNK_LEN).map(|chunk| {
        prefetch_ahead(chunk);
        chunk.iter().copied().fold(none(), both)
    });
    chunks.reduce(none, both)
}

#[inline]
fn some<T: Real>(boxes: &[Bounds<T>], paths: impl Iterator<Item = usize> + Clone) -> Bounds<T> {
    // They may lie anywhere.
    (paths.clone()).for_each(|path| prefetch_address(&boxes[path]));
    paths.fold(none(), |all, path| both(all, boxes[path]))
}

/// The box of no points.
fn none<T: Real>() -> Bounds<T> {
    Bounds {
        min: Point::new(T::infinity(), T::infinity()),
        max: Point::new(T::neg_infinity(), T::neg_infinity()),
    }
}

/// The smallest box that holds both, none of whose numbers is NaN.
#[inline]
fn both<T: Real>(a: Bounds<T>, b: Bounds<T>) -> Bounds<T> {
    Bounds {
        min: Point::new(lesser(a.min.x, b.min.x), lesser(a.min.y, b.min.y)),
        max: Point::new(greater(a.max.x, b.max.x), greater(a.max.y, b.max.y)),
    }
}

#[inline]
fn shown<T: Real>(Bounds { min, max }: Bounds<T>) -> Option<Bounds<f64>> {
    (min.x <= max.x).then(|| Bounds {
        min: min.to_f64(),
        max: max.to_f64(),
    })
}
