//! [`RunPoints`]: the control points of one run, in the precision of their buffer.

use guideway_spline::mem::prefetched_chunks;
use guideway_spline::{Bounds, Point, Real};
use rayon::prelude::*;

/// Control points per task of a parallel loop; shorter slices stay on the calling thread.
pub(crate) const POINTS_PER_TASK: usize = 1 << 14;

/// The control points of one run, in the precision of their buffer.
#[derive(Clone, Copy, Debug)]
pub enum RunPoints<'a> {
    /// Stored as `f64`.
    F64(&'a [Point<f64>]),
    /// Stored as `f32`.
    F32(&'a [Point<f32>]),
}

impl<'a> RunPoints<'a> {
    /// Number of control points.
    #[inline]
    pub fn len(&self) -> usize {
        match self {
            Self::F64(p) => p.len(),
            Self::F32(p) => p.len(),
        }
    }

    /// Returns `true` if there are no control points, which no run of a layout has.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// One control point, in meters.
    ///
    /// # Panics
    /// When `index` is not below [`Self::len`].
    #[inline]
    pub fn get(&self, index: usize) -> Point<f64> {
        match self {
            Self::F64(p) => p[index],
            Self::F32(p) => p[index].to_f64(),
        }
    }

    /// The control points in order, in meters.
    pub fn iter(self) -> impl ExactSizeIterator<Item = Point<f64>> + Clone + 'a {
        (0..self.len()).map(move |i| self.get(i))
    }

    /// Box of the control points, in meters, computed in their precision; `None` if there are none.
    pub fn bounds(self) -> Option<Bounds<f64>> {
        match self {
            Self::F64(points) => bounds(points),
            Self::F32(points) => bounds(points).map(|narrow| Bounds {
                min: narrow.min.to_f64(),
                max: narrow.max.to_f64(),
            }),
        }
    }

    /// The cubic segments in order, four control points each.
    pub fn segments(
        self,
    ) -> impl DoubleEndedIterator<Item = [Point<f64>; 4]> + ExactSizeIterator + Clone + 'a {
        let count = self.len().saturating_sub(3);
        (0..count).map(move |i| {
            [
                self.get(i),
                self.get(i + 1),
                self.get(i + 2),
                self.get(i + 3),
            ]
        })
    }
}

#[inline]
fn bounds<T: Real>(points: &[Point<T>]) -> Option<Bounds<T>> {
    if points.len() <= POINTS_PER_TASK {
        return Bounds::of_slice(points);
    }
    let of_part = |part: &[Point<T>]| {
        let boxes = prefetched_chunks(part).filter_map(Bounds::of_slice);
        boxes.reduce(Bounds::union)
    };
    let parts = points.par_chunks(POINTS_PER_TASK).filter_map(of_part);
    parts.reduce_with(Bounds::union)
}
