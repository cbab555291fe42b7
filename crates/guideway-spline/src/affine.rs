//! [`Affine`]: affine maps of the plane, such as translations, rotations and reflections.

use crate::Point;

/// An affine map of the plane: `p` maps to `x * p.x + y * p.y + origin`.
///
/// B-splines are affinely invariant: mapping the control points maps the curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Affine {
    /// Image of the vector (1, 0).
    pub x: Point<f64>,
    /// Image of the vector (0, 1).
    pub y: Point<f64>,
    /// Image of the point (0, 0).
    pub origin: Point<f64>,
}

impl Affine {
    /// The map that moves no point.
    pub const IDENTITY: Self = Self {
        x: Point::new(1.0, 0.0),
        y: Point::new(0.0, 1.0),
        origin: Point::new(0.0, 0.0),
    };

    /// Moves every point by a vector.
    pub fn translation(by: Point<f64>) -> Self {
        Self {
            origin: by,
            ..Self::IDENTITY
        }
    }

    /// Rotates about a point, counter-clockwise for positive angles.
    pub fn rotation(angle_rad: f64, about: Point<f64>) -> Self {
        let (sin, cos) = angle_rad.sin_cos();
        Self::about(about, Point::new(cos, sin), Point::new(-sin, cos))
    }

    /// Scales along the axes about a fixed point.
    pub fn scale(x: f64, y: f64, about: Point<f64>) -> Self {
        Self::about(about, Point::new(x, 0.0), Point::new(0.0, y))
    }

    /// Reflects across the line through a point along `direction`, a vector of any nonzero length.
    pub fn mirror(through: Point<f64>, direction: Point<f64>) -> Self {
        let unit = direction * (1.0 / direction.norm());
        // p -> 2 (p . u) u - p.
        let (x, y) = (unit * (2.0 * unit.x), unit * (2.0 * unit.y));
        Self::about(through, x - Point::new(1.0, 0.0), y - Point::new(0.0, 1.0))
    }

    fn about(fixed: Point<f64>, x: Point<f64>, y: Point<f64>) -> Self {
        Self {
            x,
            y,
            origin: fixed - (x * fixed.x + y * fixed.y),
        }
    }

    /// Image of a point.
    #[inline]
    pub fn apply(self, p: Point<f64>) -> Point<f64> {
        self.x * p.x + self.y * p.y + self.origin
    }

    /// The composition that applies `self` first and `next` second.
    #[must_use]
    pub fn then(self, next: Self) -> Self {
        let direction = |d: Point<f64>| next.x * d.x + next.y * d.y;
        Self {
            x: direction(self.x),
            y: direction(self.y),
            origin: next.apply(self.origin),
        }
    }

    /// The vector that a pure translation moves every point by; `None` for all other maps.
    pub fn as_translation(self) -> Option<Point<f64>> {
        let is_translation = self.x == Self::IDENTITY.x && self.y == Self::IDENTITY.y;
        is_translation.then_some(self.origin)
    }

    /// Returns `true` if all coefficients are finite.
    pub fn is_finite(self) -> bool {
        self.x.is_finite() && self.y.is_finite() && self.origin.is_finite()
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::FRAC_PI_2;

    use super::*;

    fn is_near(a: Point<f64>, b: Point<f64>) -> bool {
        a.distance(b) < 1e-12
    }

    #[test]
    fn constructors_map_points_as_named() {
        let p = Point::new(3.0, 1.0);
        let about = Point::new(1.0, 1.0);
        assert!(is_near(Affine::IDENTITY.apply(p), p));
        let by = Point::new(-2.0, 0.5);
        assert_eq!(Affine::translation(by).as_translation(), Some(by));
        assert_eq!(Affine::rotation(0.1, about).as_translation(), None);
        assert_eq!(Affine::scale(1.0, 2.0, about).as_translation(), None);
        let rotated = Affine::rotation(FRAC_PI_2, about).apply(p);
        assert!(is_near(rotated, Point::new(1.0, 3.0)));
        let scaled = Affine::scale(2.0, 3.0, about).apply(p);
        assert!(is_near(scaled, Point::new(5.0, 1.0)));
        let mirrored = Affine::mirror(about, Point::new(5.0, 5.0)).apply(p);
        assert!(is_near(mirrored, Point::new(1.0, 3.0)));
    }

    #[test]
    fn then_composes_in_order() {
        let a = Affine::rotation(0.3, Point::new(2.0, -1.0));
        let b = Affine::scale(0.5, -2.0, Point::new(7.0, 1.0));
        let p = Point::new(-4.0, 9.0);
        assert!(is_near(a.then(b).apply(p), b.apply(a.apply(p))));
    }
}
