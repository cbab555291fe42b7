//! [`Bounds`]: axis-aligned boxes, of points and the tight ones of segments and runs.

use crate::{Point, Real, greater, lesser, uniform};

/// A closed axis-aligned box.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds<T> {
    /// Lower left corner.
    pub min: Point<T>,
    /// Upper right corner.
    pub max: Point<T>,
}

impl<T: Real> Bounds<T> {
    /// The smallest box that contains all points; `None` if there are no points.
    pub fn of_points(points: impl IntoIterator<Item = Point<T>>) -> Option<Self> {
        points
            .into_iter()
            .map(|p| Self { min: p, max: p })
            .reduce(Self::union)
    }

    /// As [`Self::of_points`], faster, for points in one slice.
    pub fn of_slice(points: &[Point<T>]) -> Option<Self> {
        // Independent minima, so that no point waits for the comparison of the one before.
        const LANES: usize = 4;
        let first = *points.first()?;
        let (mut min, mut max) = ([first; LANES], [first; LANES]);
        let (chunks, rest) = points.as_chunks::<LANES>();
        let mut add = |chunk: &[Point<T>]| {
            for ((min, max), p) in min.iter_mut().zip(&mut max).zip(chunk) {
                *min = Point::new(lesser(p.x, min.x), lesser(p.y, min.y));
                *max = Point::new(greater(p.x, max.x), greater(p.y, max.y));
            }
        };
        chunks.iter().for_each(|chunk| add(chunk));
        add(rest);
        let boxes = min.into_iter().zip(max).map(|(min, max)| Self { min, max });
        boxes.reduce(Self::union)
    }

    /// The smallest box that contains a segment of a uniform cubic B-spline, apart from rounding.
    ///
    /// [`Bounds::of_points`] of its control points is faster and wider.
    pub fn of_segment(p: &[Point<T>; 4]) -> Self {
        let at = |point| Self {
            min: point,
            max: point,
        };
        let ends = at(uniform::start(p)).union(at(uniform::end(p)));
        // The extremes of a coordinate are at the ends or where its derivative vanishes.
        let [x0, x1] = critical_parameters(p.map(|p| p.x));
        let [y0, y1] = critical_parameters(p.map(|p| p.y));
        [x0, x1, y0, y1]
            .into_iter()
            .filter(|&t| t > T::zero() && t < T::one())
            .fold(ends, |bounds, t| bounds.union(at(uniform::point(p, t))))
    }

    /// The smallest box that contains a run, apart from rounding; `None` for fewer than four
    /// points.
    pub fn of_run(points: &[Point<T>]) -> Option<Self> {
        points
            .array_windows()
            .map(Self::of_segment)
            .reduce(Self::union)
    }

    /// The smallest box that contains both.
    pub fn union(self, other: Self) -> Self {
        Self {
            min: Point::new(self.min.x.min(other.min.x), self.min.y.min(other.min.y)),
            max: Point::new(self.max.x.max(other.max.x), self.max.y.max(other.max.y)),
        }
    }

    /// The box grown by `margin` on every side.
    pub fn inflated(self, margin: T) -> Self {
        let by = Point::new(margin, margin);
        Self {
            min: self.min - by,
            max: self.max + by,
        }
    }

    /// Returns `true` if the two boxes share a point.
    pub fn intersects(self, other: Self) -> bool {
        self.min.x <= other.max.x
            && other.min.x <= self.max.x
            && self.min.y <= other.max.y
            && other.min.y <= self.max.y
    }

    /// Returns `true` if `point` is inside or on the border.
    pub fn contains(self, point: Point<T>) -> bool {
        self.min.x <= point.x
            && point.x <= self.max.x
            && self.min.y <= point.y
            && point.y <= self.max.y
    }

    /// The four corners.
    pub fn corners(self) -> [Point<T>; 4] {
        let Self { min, max } = self;
        [min, max, Point::new(min.x, max.y), Point::new(max.x, min.y)]
    }

    /// Width and height.
    pub fn size(self) -> Point<T> {
        self.max - self.min
    }

    /// The center.
    pub fn center(self) -> Point<T> {
        let half = T::of(0.5);
        Point::new(
            self.min.x * half + self.max.x * half,
            self.min.y * half + self.max.y * half,
        )
    }
}

/// Roots of the derivative of one coordinate of a segment; NaN or infinite where there is none.
fn critical_parameters<T: Real>(p: [T; 4]) -> [T; 2] {
    // 2 C'(t) = c + 2 b t + a t^2
    let (d0, d1, d2) = (p[1] - p[0], p[2] - p[1], p[3] - p[2]);
    let (a, b, c) = (d0 - d1 - d1 + d2, d1 - d0, d0 + d1);
    // Adding numbers of one sign avoids cancellation; the other root follows from the product c/a.
    // Source: Numerical Recipes, 5.6.
    let root = (b * b - a * c).sqrt();
    let q = -(b + root.copysign(b));
    [q / a, c / q]
}
