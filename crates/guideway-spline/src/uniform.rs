//! One segment of a uniform cubic B-spline (thesis eq. 3.2): evaluates, splits and converts it.
//!
//! A segment is four control points. Its parameter t runs from 0 at the start to 1 at the end.

use crate::{Point, Real};

/// Segment `i` of a run: its control points `i` to `i + 3`.
///
/// # Panics
/// When the run has fewer than `i + 4` points.
pub fn segment<T>(run: &[Point<T>], i: usize) -> &[Point<T>; 4] {
    run[i..]
        .first_chunk()
        .expect("a segment has four control points")
}

/// The point at parameter `t`.
pub fn point<T: Real>(p: &[Point<T>; 4], t: T) -> Point<T> {
    let one = T::one();
    let (three, four, sixth) = (T::of(3.0), T::of(4.0), T::of(1.0 / 6.0));
    let s = one - t;
    let b0 = s * s * s;
    let b1 = (three * t - T::of(6.0)) * t * t + four;
    let b2 = ((three - three * t) * t + three) * t + one;
    let b3 = t * t * t;
    (p[0] * b0 + p[1] * b1 + p[2] * b2 + p[3] * b3) * sixth
}

/// Coefficients of the segment as a polynomial in `t`, from `t^0` to `t^3`.
#[inline(always)]
pub fn polynomial<T: Real>(p: &[Point<T>; 4]) -> [Point<T>; 4] {
    let (half, sixth) = (T::of(0.5), T::of(1.0 / 6.0));
    let (d0, d1, d2) = (p[1] - p[0], p[2] - p[1], p[3] - p[2]);
    [
        start(p),
        (d0 + d1) * half,
        (d1 - d0) * half,
        (d2 - d1 - (d1 - d0)) * sixth,
    ]
}

/// The point at t = 0.
#[inline]
pub fn start<T: Real>(p: &[Point<T>; 4]) -> Point<T> {
    (p[0] + p[1] * T::of(4.0) + p[2]) * T::of(1.0 / 6.0)
}

/// The point at t = 1.
pub fn end<T: Real>(p: &[Point<T>; 4]) -> Point<T> {
    (p[1] + p[2] * T::of(4.0) + p[3]) * T::of(1.0 / 6.0)
}

/// The first derivative at `t`.
pub fn derivative<T: Real>(p: &[Point<T>; 4], t: T) -> Point<T> {
    let (half, s) = (T::of(0.5), T::one() - t);
    let (d0, d1, d2) = (p[1] - p[0], p[2] - p[1], p[3] - p[2]);
    let middle = T::one() + T::of(2.0) * t * s;
    (d0 * (s * s) + d1 * middle + d2 * (t * t)) * half
}

/// The second derivative at `t`, which is linear from `P0 - 2 P1 + P2` to `P1 - 2 P2 + P3`.
pub fn second_derivative<T: Real>(p: &[Point<T>; 4], t: T) -> Point<T> {
    let two = T::of(2.0);
    (p[0] - p[1] * two + p[2]).lerp(p[1] - p[2] * two + p[3], t)
}

/// The same curve as a cubic Bezier.
pub fn to_bezier<T: Real>(p: &[Point<T>; 4]) -> [Point<T>; 4] {
    let third = T::of(1.0 / 3.0);
    let two = T::of(2.0);
    [
        start(p),
        (p[1] * two + p[2]) * third,
        (p[1] + p[2] * two) * third,
        end(p),
    ]
}

/// The uniform cubic control points of a cubic Bezier: the exact inverse of [`to_bezier`].
pub fn from_bezier<T: Real>(b: &[Point<T>; 4]) -> [Point<T>; 4] {
    // Differences of points first: far from the origin, 6 b0 - 7 b1 + 2 b2 would lose digits.
    let (two, five) = (T::of(2.0), T::of(5.0));
    let (d0, d1, d2) = (b[1] - b[0], b[2] - b[1], b[3] - b[2]);
    [
        b[0] - d0 * five + d1 * two,
        b[1] - d1,
        b[2] + d1,
        b[3] + d2 * five - d1 * two,
    ]
}

/// Signed curvature at `t`, in 1/unit of length: positive where the curve turns left.
///
/// Infinite or NaN where the derivative vanishes. Formula: C' x C'' / |C'|^3.
pub fn curvature<T: Real>(p: &[Point<T>; 4], t: T) -> T {
    let velocity = derivative(p, t);
    let speed = velocity.norm();
    velocity.cross(second_derivative(p, t)) / (speed * speed * speed)
}

/// The two halves of a segment, split at t = 1/2, each as a segment.
pub fn halves<T: Real>(p: &[Point<T>; 4]) -> [[Point<T>; 4]; 2] {
    // Knot insertion at the middle of every span. Source: Lane & Riesenfeld 1980.
    let (half, eighth, six) = (T::of(0.5), T::of(0.125), T::of(6.0));
    let mid = |i: usize| (p[i] + p[i + 1]) * half;
    let vertex = |i: usize| (p[i - 1] + p[i] * six + p[i + 1]) * eighth;
    let (m0, v1, m1, v2, m2) = (mid(0), vertex(1), mid(1), vertex(2), mid(2));
    [[m0, v1, m1, v2], [v1, m1, v2, m2]]
}
