use guideway_spline::{Bounds, Point, Real, greater, lesser};
use rayon::prelude::*;

use super::{Geometry, Points};

/// Boxes of the control points of all paths, which hold their curves, in the precision of the points.
#[derive(Clone, Debug)]
pub struct Hulls(Boxes);

#[derive(Clone, Debug)]
enum Boxes {
    F64(Vec<Bounds<f64>>),
    F32(Vec<Bounds<f32>>),
}

impl Geometry {
    /// Where each path lies, in metres: all points are read once, by all threads.
    pub fn hulls(&self) -> Hulls {
        Hulls(match &self.points {
            Points::F64(points) => Boxes::F64(self.boxes(points)),
            Points::F32(points) => Boxes::F32(self.boxes(points)),
        })
    }

    fn boxes<T: Real>(&self, points: &[Point<T>]) -> Vec<Bounds<T>> {
        let rows = (0..self.path_count()).into_par_iter();
        let of_row = |row| {
            let points = &points[self.points_of(&self.runs_of(&(row..row + 1)))];
            Bounds::of_slice(points).unwrap_or(none())
        };
        rows.map(of_row).collect()
    }
}

impl Hulls {
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

    /// Where all paths lie, in metres; none if they have no points.
    pub fn all(&self) -> Option<Bounds<f64>> {
        match &self.0 {
            Boxes::F64(boxes) => shown(boxes.par_iter().copied().reduce(none, both)),
            Boxes::F32(boxes) => shown(boxes.par_iter().copied().reduce(none, both)),
        }
    }

    /// Where some paths lie, in metres; none if they have no points.
    ///
    /// # Panics
    /// When one is not below [`Self::len`].
    #[inline]
    pub fn of(&self, paths: impl IntoIterator<Item = usize>) -> Option<Bounds<f64>> {
        let paths = paths.into_iter();
        match &self.0 {
            Boxes::F64(boxes) => shown(paths.fold(none(), |all, path| both(all, boxes[path]))),
            Boxes::F32(boxes) => shown(paths.fold(none(), |all, path| both(all, boxes[path]))),
        }
    }
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
