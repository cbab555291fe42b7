//! Vectors and affine maps of space. A drawing is flat only in the end: blocks and arcs may lie on any plane.

use std::ops::{Add, Mul, Sub};

use guideway_spline::Point;

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Vector {
    pub(super) x: f64,
    pub(super) y: f64,
    pub(super) z: f64,
}

impl Vector {
    pub(super) const ZERO: Self = Self::new(0.0, 0.0, 0.0);

    pub(super) const fn new(x: f64, y: f64, z: f64) -> Self {
        Self { x, y, z }
    }

    /// As seen from above.
    pub(super) fn flat(self) -> Point<f64> {
        Point::new(self.x, self.y)
    }

    pub(super) fn cross(self, other: Self) -> Self {
        Self::new(
            self.y * other.z - self.z * other.y,
            self.z * other.x - self.x * other.z,
            self.x * other.y - self.y * other.x,
        )
    }

    pub(super) fn norm(self) -> f64 {
        self.x.hypot(self.y).hypot(self.z)
    }
}

impl Add for Vector {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self::new(self.x + other.x, self.y + other.y, self.z + other.z)
    }
}

impl Sub for Vector {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        Self::new(self.x - other.x, self.y - other.y, self.z - other.z)
    }
}

impl Mul<f64> for Vector {
    type Output = Self;

    fn mul(self, factor: f64) -> Self {
        Self::new(self.x * factor, self.y * factor, self.z * factor)
    }
}

/// An affine map: where the axes and the origin go.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Affine {
    pub(super) x: Vector,
    pub(super) y: Vector,
    pub(super) z: Vector,
    pub(super) origin: Vector,
}

impl Affine {
    pub(super) const fn scale(x: f64, y: f64, z: f64) -> Self {
        Self {
            x: Vector::new(x, 0.0, 0.0),
            y: Vector::new(0.0, y, 0.0),
            z: Vector::new(0.0, 0.0, z),
            origin: Vector::ZERO,
        }
    }

    pub(super) fn translation(origin: Vector) -> Self {
        Self {
            origin,
            ..Self::scale(1.0, 1.0, 1.0)
        }
    }

    /// Counter-clockwise about the z axis, in degrees.
    pub(super) fn rotation(degrees: f64) -> Self {
        let (sin, cos) = degrees.to_radians().sin_cos();
        Self {
            x: Vector::new(cos, sin, 0.0),
            y: Vector::new(-sin, cos, 0.0),
            ..Self::scale(1.0, 1.0, 1.0)
        }
    }

    /// The object coordinate system of an extrusion direction, by the arbitrary axis algorithm of the DXF
    /// reference. A direction of no length is that of the z axis.
    pub(super) fn of_extrusion(direction: Vector) -> Self {
        const NEAR: f64 = 1.0 / 64.0;
        let norm = direction.norm();
        if !(norm.is_finite() && norm > 0.0) {
            return Self::scale(1.0, 1.0, 1.0);
        }
        let z = direction * (1.0 / norm);
        let near_z = z.x.abs() < NEAR && z.y.abs() < NEAR;
        let helper = match near_z {
            true => Vector::new(0.0, 1.0, 0.0),
            false => Vector::new(0.0, 0.0, 1.0),
        };
        let x = helper.cross(z);
        let x = x * (1.0 / x.norm());
        Self {
            x,
            y: z.cross(x),
            z,
            origin: Vector::ZERO,
        }
    }

    pub(super) fn direction(&self, v: Vector) -> Vector {
        self.x * v.x + self.y * v.y + self.z * v.z
    }

    pub(super) fn point(&self, p: Vector) -> Vector {
        self.direction(p) + self.origin
    }

    /// The map that does `first` and then this one.
    pub(super) fn after(&self, first: &Self) -> Self {
        Self {
            x: self.direction(first.x),
            y: self.direction(first.y),
            z: self.direction(first.z),
            origin: self.point(first.origin),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_extrusion_downwards_mirrors_x() {
        let mirror = Affine::of_extrusion(Vector::new(0.0, 0.0, -2.0));
        let p = mirror.point(Vector::new(3.0, 4.0, 5.0));
        assert_eq!(p, Vector::new(-3.0, 4.0, -5.0));
    }

    #[test]
    fn an_extrusion_is_an_orthonormal_right_handed_frame() {
        for direction in [
            Vector::new(0.0, 0.0, 1.0),
            Vector::new(0.01, 0.01, 1.0),
            Vector::new(1.0, 0.0, 0.0),
            Vector::new(-3.0, 2.0, 0.5),
        ] {
            let frame = Affine::of_extrusion(direction);
            let apart = frame.x.cross(frame.y) - frame.z;
            assert!(apart.norm() < 1e-12, "{direction:?}");
            assert!((frame.x.norm() - 1.0).abs() < 1e-12);
            let along = frame.z * direction.norm() - direction;
            assert!(along.norm() < 1e-12);
        }
    }

    #[test]
    fn maps_chain_from_the_inside_out() {
        let turn = Affine::rotation(90.0);
        let shift = Affine::translation(Vector::new(10.0, 0.0, 0.0));
        let p = Vector::new(1.0, 0.0, 0.0);
        let chained = shift.after(&turn).point(p);
        assert!((chained - Vector::new(10.0, 1.0, 0.0)).norm() < 1e-12);
        let chained = turn.after(&shift).point(p);
        assert!((chained - Vector::new(0.0, 11.0, 0.0)).norm() < 1e-12);
    }
}
