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

    /// Euclidean length of the vector, with the same bits on every system: the `hypot` of each
    /// system's library rounds in its own way.
    pub fn norm(self) -> T {
        let square = self.dot(self);
        // Below this, the squares lose digits.
        let least = T::min_positive_value() / T::epsilon();
        match square >= least && square.is_finite() {
            true => square.sqrt(),
            false => self.scaled_norm(),
        }
    }

    /// The length of a vector whose squares leave the range of numbers.
    #[cold]
    fn scaled_norm(self) -> T {
        let largest = self.x.abs().max(self.y.abs());
        if self.x.is_zero() && self.y.is_zero() || largest.is_infinite() {
            return largest;
        }
        let scaled = Self::new(self.x / largest, self.y / largest);
        largest * scaled.dot(scaled).sqrt()
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn norm_is_the_nearest_length_or_its_neighbor() {
        for exponent in [-300, -160, -20, 0, 20, 160, 300] {
            let scale = 10_f64.powi(exponent);
            for (x, y) in [(3.0, 4.0), (-0.1, 0.7), (1.0, 1e-9), (0.0, -2.5)] {
                let (x, y) = (x * scale, y * scale);
                let expected = x.hypot(y);
                let error = (Point::new(x, y).norm() - expected).abs();
                assert!(error <= 2.0 * f64::EPSILON * expected, "({x}, {y})");
            }
        }
        assert_eq!(Point::new(3e30_f32, -4e30).norm(), 5e30);
        assert_eq!(
            Point::new(f64::from_bits(3), f64::from_bits(4)).norm(),
            f64::from_bits(5)
        );
    }

    #[test]
    fn norm_of_special_numbers_is_that_of_hypot() {
        let numbers = [
            0.0,
            -0.0,
            1.0,
            f64::MAX,
            f64::INFINITY,
            f64::NEG_INFINITY,
            f64::NAN,
        ];
        for x in numbers {
            for y in numbers {
                let (norm, expected) = (Point::new(x, y).norm(), x.hypot(y));
                assert!(
                    norm == expected || norm.is_nan() && expected.is_nan(),
                    "({x}, {y})"
                );
            }
        }
    }
}
