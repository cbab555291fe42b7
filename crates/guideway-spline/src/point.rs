//! [`Point`]: a point or vector in the plane, with its arithmetic.

use std::ops::{Add, Mul, Neg, Sub};

use bytemuck::{Pod, Zeroable};

use crate::Real;

/// A point or vector in the plane. In layouts: meters, y up.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(C)]
pub struct Point<T> {
    /// Coordinate to the right.
    pub x: T,
    /// Coordinate upward.
    pub y: T,
}

#[allow(
    unsafe_code,
    reason = "no derive does this for a type with a parameter; see SAFETY"
)]
// SAFETY: all bytes zero are two numbers of value zero.
unsafe impl<T: Zeroable> Zeroable for Point<T> {}

#[allow(
    unsafe_code,
    reason = "no derive does this for a type with a parameter; see SAFETY"
)]
// SAFETY: `repr(C)` puts the two numbers of one type next to each other without padding, and any
// bits of a `Pod` are a number.
unsafe impl<T: Pod> Pod for Point<T> {}

impl<T: Real> Point<T> {
    /// The point (x, y).
    pub const fn new(x: T, y: T) -> Self {
        Self { x, y }
    }

    /// Returns `true` if both coordinates are finite.
    pub fn is_finite(self) -> bool {
        self.x.is_finite() && self.y.is_finite()
    }

    /// Scalar product.
    pub fn dot(self, other: Self) -> T {
        self.x * other.x + self.y * other.y
    }

    /// z component of the cross product: positive if `other` is to the left.
    pub fn cross(self, other: Self) -> T {
        self.x * other.y - self.y * other.x
    }

    /// Euclidean length of the vector.
    pub fn norm(self) -> T {
        self.x.hypot(self.y)
    }

    /// Distance to another point.
    pub fn distance(self, other: Self) -> T {
        (self - other).norm()
    }

    /// Linear interpolation: this point at t = 0, `other` at t = 1.
    pub fn lerp(self, other: Self, t: T) -> Self {
        self * (T::one() - t) + other * t
    }

    /// The same point in `f64`.
    pub fn to_f64(self) -> Point<f64> {
        Point {
            x: self.x.to_f64(),
            y: self.y.to_f64(),
        }
    }
}

impl Point<f64> {
    /// The nearest point in `f32`.
    pub fn to_f32(self) -> Point<f32> {
        Point {
            x: f32::of(self.x),
            y: f32::of(self.y),
        }
    }
}

impl<T: Real> Add for Point<T> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self {
            x: self.x + other.x,
            y: self.y + other.y,
        }
    }
}

impl<T: Real> Sub for Point<T> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self {
            x: self.x - other.x,
            y: self.y - other.y,
        }
    }
}

impl<T: Real> Mul<T> for Point<T> {
    type Output = Self;
    fn mul(self, factor: T) -> Self {
        Self {
            x: self.x * factor,
            y: self.y * factor,
        }
    }
}

impl<T: Real> Neg for Point<T> {
    type Output = Self;
    fn neg(self) -> Self {
        Self {
            x: -self.x,
            y: -self.y,
        }
    }
}
