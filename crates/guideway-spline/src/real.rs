//! [`Real`]: the floating-point types of coordinates, and minima of two compiled to one
//! instruction.

use std::fmt::Debug;

/// A floating-point number: `f32` or `f64`.
pub trait Real: num_traits::Float + Debug + Default + Send + Sync + 'static {
    /// The nearest number to `value`.
    fn of(value: f64) -> Self;
    /// The same number in `f64`.
    fn to_f64(self) -> f64;
}

impl Real for f64 {
    fn of(value: f64) -> Self {
        value
    }
    fn to_f64(self) -> f64 {
        self
    }
}

impl Real for f32 {
    #[allow(
        clippy::cast_possible_truncation,
        reason = "the function exists to round to f32"
    )]
    fn of(value: f64) -> Self {
        value as Self
    }
    fn to_f64(self) -> f64 {
        f64::from(self)
    }
}

/// Minimum of two numbers, in one instruction: `f64::min` handles NaN too. `b` if one is NaN.
#[inline(always)]
pub fn lesser<T: PartialOrd>(a: T, b: T) -> T {
    if a < b { a } else { b }
}

/// Maximum of two numbers, in one instruction. `b` if one is NaN.
#[inline(always)]
pub fn greater<T: PartialOrd>(a: T, b: T) -> T {
    if a > b { a } else { b }
}
