//! Vectors and affine maps in 3D: blocks, arcs and polylines may lie in any plane before the
//! projection to x and y.

use std::ops::{Add, Mul, Sub};

use guideway_spline::Point;

/// A vector or a point in 3D.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Vector3 {
    pub(super) x: f64,
    pub(super) y: f64,
    pub(super) z: f64,
}

impl Vector3 {
    pub(super) const ZERO: Self = Self::new(0.0, 0.0, 0.0);

    pub(super) const fn new(x: f64, y: f64, z: f64) -> Self {
        Self { x, y, z }
    }

    /// The projection along z.
    pub(super) fn xy(self) -> Point<f64> {
        Point::new(self.x, self.y)
    }

    pub(super) fn cross(self, other: Self) -> Self {
        Self::new(
            self.y * other.z - self.z * other.y,
            self.z * other.x - self.x * other.z,
            self.x * other.y - self.y * other.x,
        )
    }

    pub(super) fn dot(self, other: Self) -> f64 {
        self.x * other.x + self.y * other.y + self.z * other.z
    }

    pub(super) fn norm(self) -> f64 {
        self.x.hypot(self.y).hypot(self.z)
    }
}

impl Add for Vector3 {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self::new(self.x + other.x, self.y + other.y, self.z + other.z)
    }
}

impl Sub for Vector3 {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        Self::new(self.x - other.x, self.y - other.y, self.z - other.z)
    }
}

impl Mul<f64> for Vector3 {
    type Output = Self;

    fn mul(self, factor: f64) -> Self {
        Self::new(self.x * factor, self.y * factor, self.z * factor)
    }
}

/// An affine map, given by the images of the axes and of the origin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Affine3 {
    pub(super) x: Vector3,
    pub(super) y: Vector3,
    pub(super) z: Vector3,
    pub(super) origin: Vector3,
}

impl Affine3 {
    pub(super) const fn scale(x: f64, y: f64, z: f64) -> Self {
        Self {
            x: Vector3::new(x, 0.0, 0.0),
            y: Vector3::new(0.0, y, 0.0),
            z: Vector3::new(0.0, 0.0, z),
            origin: Vector3::ZERO,
        }
    }

    pub(super) fn translation(origin: Vector3) -> Self {
        Self {
            origin,
            ..Self::scale(1.0, 1.0, 1.0)
        }
    }

    /// A counter-clockwise rotation about the z axis, in degrees.
    pub(super) fn rotation(degrees: f64) -> Self {
        let (sin, cos) = degrees.to_radians().sin_cos();
        Self {
            x: Vector3::new(cos, sin, 0.0),
            y: Vector3::new(-sin, cos, 0.0),
            ..Self::scale(1.0, 1.0, 1.0)
        }
    }

    /// The object coordinate system (OCS) of an extrusion direction. A zero direction means the z
    /// axis.
    ///
    /// Source: DXF reference, "Arbitrary Axis Algorithm", which also gives the threshold 1/64.
    pub(super) fn of_extrusion(direction: Vector3) -> Self {
        const NEAR: f64 = 1.0 / 64.0;
        let norm = direction.norm();
        if !(norm.is_finite() && norm > 0.0) {
            return Self::scale(1.0, 1.0, 1.0);
        }
        let z = direction * (1.0 / norm);
        let near_z = z.x.abs() < NEAR && z.y.abs() < NEAR;
        let helper = match near_z {
            true => Vector3::new(0.0, 1.0, 0.0),
            false => Vector3::new(0.0, 0.0, 1.0),
        };
        let x = helper.cross(z);
        let x = x * (1.0 / x.norm());
        Self {
            x,
            y: z.cross(x),
            z,
            origin: Vector3::ZERO,
        }
    }

    /// Maps a direction: no translation.
    pub(super) fn direction(&self, v: Vector3) -> Vector3 {
        self.x * v.x + self.y * v.y + self.z * v.z
    }

    /// Maps a point.
    pub(super) fn point(&self, p: Vector3) -> Vector3 {
        self.direction(p) + self.origin
    }

    /// The map back; `None` if there is none, because a volume becomes flat or is not finite.
    pub(super) fn inverse(&self) -> Option<Self> {
        let normals = [
            self.y.cross(self.z),
            self.z.cross(self.x),
            self.x.cross(self.y),
        ];
        let volume = self.x.dot(normals[0]);
        if !(volume.is_finite() && volume != 0.0) {
            return None;
        }
        let [a, b, c] = normals.map(|normal| normal * (1.0 / volume));
        let back = Self {
            x: Vector3::new(a.x, b.x, c.x),
            y: Vector3::new(a.y, b.y, c.y),
            z: Vector3::new(a.z, b.z, c.z),
            origin: Vector3::ZERO,
        };
        Some(back.after(&Self::translation(self.origin * -1.0)))
    }

    /// The map that applies `first` and then `self`.
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
    fn downward_extrusion_mirrors_x() {
        let mirror = Affine3::of_extrusion(Vector3::new(0.0, 0.0, -2.0));
        let p = mirror.point(Vector3::new(3.0, 4.0, 5.0));
        assert_eq!(p, Vector3::new(-3.0, 4.0, -5.0));
    }

    #[test]
    fn extrusion_frame_is_orthonormal_and_right_handed() {
        for direction in [
            Vector3::new(0.0, 0.0, 1.0),
            Vector3::new(0.01, 0.01, 1.0),
            Vector3::new(1.0, 0.0, 0.0),
            Vector3::new(-3.0, 2.0, 0.5),
        ] {
            let frame = Affine3::of_extrusion(direction);
            let error = frame.x.cross(frame.y) - frame.z;
            assert!(error.norm() < 1e-12, "{direction:?}");
            assert!((frame.x.norm() - 1.0).abs() < 1e-12);
            let along = frame.z * direction.norm() - direction;
            assert!(along.norm() < 1e-12);
        }
    }

    #[test]
    fn inverse_maps_back() {
        let shift = Affine3::translation(Vector3::new(3.0, -4.0, 5.0));
        let map = Affine3::of_extrusion(Vector3::new(0.3, 0.2, -1.0))
            .after(&Affine3::scale(2.0, -3.0, 0.5))
            .after(&shift);
        let p = Vector3::new(1.0, 2.0, 3.0);
        let back = map.inverse().unwrap().point(map.point(p));
        assert!((back - p).norm() < 1e-12, "{back:?}");
        assert_eq!(Affine3::scale(1.0, 0.0, 1.0).inverse(), None);
        assert_eq!(Affine3::scale(1.0, f64::NAN, 1.0).inverse(), None);
    }

    #[test]
    fn after_applies_its_argument_first() {
        let turn = Affine3::rotation(90.0);
        let shift = Affine3::translation(Vector3::new(10.0, 0.0, 0.0));
        let p = Vector3::new(1.0, 0.0, 0.0);
        let chained = shift.after(&turn).point(p);
        assert!((chained - Vector3::new(10.0, 1.0, 0.0)).norm() < 1e-12);
        let chained = turn.after(&shift).point(p);
        assert!((chained - Vector3::new(0.0, 11.0, 0.0)).norm() < 1e-12);
    }
}
