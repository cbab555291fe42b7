use crate::{Point, Real};

/// An axis-aligned box, its borders included.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds<T> {
    /// Lower left corner.
    pub min: Point<T>,
    /// Upper right corner.
    pub max: Point<T>,
}

impl<T: Real> Bounds<T> {
    /// The smallest box that holds all points; none if there are no points.
    pub fn of_points(points: impl IntoIterator<Item = Point<T>>) -> Option<Self> {
        points
            .into_iter()
            .map(|p| Self { min: p, max: p })
            .reduce(Self::union)
    }

    /// The smallest box that holds both.
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

    /// Whether the two boxes share a point.
    pub fn intersects(self, other: Self) -> bool {
        self.min.x <= other.max.x
            && other.min.x <= self.max.x
            && self.min.y <= other.max.y
            && other.min.y <= self.max.y
    }

    /// Whether `point` is inside or on the border.
    pub fn contains(self, point: Point<T>) -> bool {
        self.min.x <= point.x
            && point.x <= self.max.x
            && self.min.y <= point.y
            && point.y <= self.max.y
    }

    /// Width and height.
    pub fn size(self) -> Point<T> {
        self.max - self.min
    }

    /// The middle.
    pub fn center(self) -> Point<T> {
        let half = T::of(0.5);
        Point::new(
            self.min.x * half + self.max.x * half,
            self.min.y * half + self.max.y * half,
        )
    }
}
