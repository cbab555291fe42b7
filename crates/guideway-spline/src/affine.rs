use crate::Point;

/// A map of the plane that keeps straight lines straight: `p` goes to `x * p.x + y * p.y + origin`.
///
/// A B-spline follows its control points under every such map: mapping them maps the curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Affine {
    /// Where (1, 0) goes, seen from [`Self::origin`].
    pub x: Point<f64>,
    /// Where (0, 1) goes, seen from [`Self::origin`].
    pub y: Point<f64>,
    /// Where (0, 0) goes.
    pub origin: Point<f64>,
}

impl Affine {
    /// Everything stays where it is.
    pub const IDENTITY: Self = Self {
        x: Point::new(1.0, 0.0),
        y: Point::new(0.0, 1.0),
        origin: Point::new(0.0, 0.0),
    };

    /// Moves by a distance.
    pub fn translation(by: Point<f64>) -> Self {
        Self {
            origin: by,
            ..Self::IDENTITY
        }
    }

    /// Turns about a point, from x toward y.
    pub fn rotation(angle_rad: f64, about: Point<f64>) -> Self {
        let (sin, cos) = angle_rad.sin_cos();
        Self::about(about, Point::new(cos, sin), Point::new(-sin, cos))
    }

    /// Scales along the axes, away from a point.
    pub fn scale(x: f64, y: f64, about: Point<f64>) -> Self {
        Self::about(about, Point::new(x, 0.0), Point::new(0.0, y))
    }

    /// Mirrors in the line through a point, in a direction of any length but zero.
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

    /// Where a point goes.
    #[inline]
    pub fn apply(self, p: Point<f64>) -> Point<f64> {
        self.x * p.x + self.y * p.y + self.origin
    }

    /// This map, and then another.
    #[must_use]
    pub fn then(self, next: Self) -> Self {
        let direction = |d: Point<f64>| next.x * d.x + next.y * d.y;
        Self {
            x: direction(self.x),
            y: direction(self.y),
            origin: next.apply(self.origin),
        }
    }

    /// The distance that it moves every point by; none if it does anything else.
    pub fn as_translation(self) -> Option<Point<f64>> {
        let moves_only = self.x == Self::IDENTITY.x && self.y == Self::IDENTITY.y;
        moves_only.then_some(self.origin)
    }

    /// Whether all of it is finite.
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
    fn maps_do_what_they_are_called() {
        let p = Point::new(3.0, 1.0);
        let about = Point::new(1.0, 1.0);
        assert!(is_near(Affine::IDENTITY.apply(p), p));
        let by = Point::new(-2.0, 0.5);
        assert_eq!(Affine::translation(by).as_translation(), Some(by));
        assert_eq!(Affine::rotation(0.1, about).as_translation(), None);
        assert_eq!(Affine::scale(1.0, 2.0, about).as_translation(), None);
        let turned = Affine::rotation(FRAC_PI_2, about).apply(p);
        assert!(is_near(turned, Point::new(1.0, 3.0)));
        let scaled = Affine::scale(2.0, 3.0, about).apply(p);
        assert!(is_near(scaled, Point::new(5.0, 1.0)));
        let mirrored = Affine::mirror(about, Point::new(5.0, 5.0)).apply(p);
        assert!(is_near(mirrored, Point::new(1.0, 3.0)));
    }

    #[test]
    fn one_after_the_other_is_one() {
        let a = Affine::rotation(0.3, Point::new(2.0, -1.0));
        let b = Affine::scale(0.5, -2.0, Point::new(7.0, 1.0));
        let p = Point::new(-4.0, 9.0);
        assert!(is_near(a.then(b).apply(p), b.apply(a.apply(p))));
    }
}
