//! Flattening: turns a run into a polyline within a proven Hausdorff distance.

use crate::{Point, Real, uniform};

/// Most lines per segment that [`flatten_run`] emits.
///
/// Derived: enough for any tolerance above 1/(8 * 65536^2), or 3e-11, of the second derivative of
/// the segment, which is at most four times the extent of its control points.
pub const MAX_LINES_PER_SEGMENT: usize = 1 << 16;

/// Segments that the search tries to cover with the first line of a run.
const FIRST_REACH: usize = 8;

/// Flattens a run to a polyline with as few lines as a greedy search finds. The Hausdorff distance
/// of curve and polyline is at most `tolerance` (in the unit of the points).
///
/// `emit` gets the vertices in order: the start of the run, then the end of each line. A run whose
/// points are all equal yields that point twice; fewer than four control points yield nothing. The
/// function allocates no memory and takes O(n log n) for n segments.
///
/// ```text
///     b1 . . . b2          b: Bezier points of the segments from A to E
///    .            .        AE: the line that replaces them
///   A ------------- E
/// ```
///
/// A line may replace many segments. The search accepts it if every Bezier point of the curve from
/// A to E lies within the tolerance of the line segment AE, because then
///
/// - the curve is near the line: the set of points that near to AE (a capsule) is convex, so it
///   contains the hulls of the Bezier points, and these contain the curve;
/// - the line is near the curve: the point of AE nearest to C(t) moves continuously from A to E, so
///   every point of AE is the nearest one to some point of the curve, which is within the
///   tolerance.
///
/// A segment too bent for one line is divided into n equal parts of its parameter, with
/// n = ceil(sqrt(max |C''| / (8 tolerance))): points of chord and curve at equal parameters are at
/// most max |C''| / (8 n^2) apart, and C'' is linear, so |C''| is greatest at an end.
///
/// The proof assumes exact arithmetic: rounding adds some units in the last place of the
/// coordinates. A `tolerance` of zero or less (an error of the caller, which a debug assertion
/// reports) counts as the smallest positive number; [`MAX_LINES_PER_SEGMENT`] then bounds the work.
/// Points must be finite.
pub fn flatten_run<T: Real>(points: &[Point<T>], tolerance: T, emit: &mut impl FnMut(Point<T>)) {
    debug_assert!(tolerance > T::zero(), "a tolerance of {tolerance:?}");
    let Some(first) = points.first_chunk() else {
        return;
    };
    let tolerance = tolerance.max(T::min_positive_value());
    let mut from = uniform::start(first);
    emit(from);
    let mut rest = points;
    let mut reach = FIRST_REACH;
    while let Some(segment) = rest.first_chunk() {
        let count = longest_line(rest, from, reach, tolerance);
        if count == 0 {
            subdivide(segment, tolerance, emit);
        }
        let done = count.max(1);
        from = uniform::end(uniform::segment(rest, done - 1));
        emit(from);
        rest = &rest[done..];
        reach = 2 * done;
    }
}

/// Number of leading segments of `rest` that one line from `from` can replace; 0 if not even one.
///
/// Nearness is not monotone in the length of the line, so the result is a good length, not always
/// the greatest. The search starts at `reach`, twice the length of the last line, which bounds the
/// cost of all lines together by O(n log n).
fn longest_line<T: Real>(rest: &[Point<T>], from: Point<T>, reach: usize, tolerance: T) -> usize {
    let most = rest.len() - 3;
    let (mut good, mut bad) = (0, most + 1);
    let mut count = reach.min(most);
    while good + 1 < bad {
        if is_near_line(&rest[..count + 3], from, tolerance) {
            good = count;
        } else {
            bad = count;
        }
        count = if bad > most {
            (2 * good).min(most)
        } else {
            (good + bad) / 2
        };
    }
    good
}

/// Returns `true` if all Bezier points of the run lie within the tolerance of the line from `from`
/// to its end.
fn is_near_line<T: Real>(run: &[Point<T>], from: Point<T>, tolerance: T) -> bool {
    let third = T::of(1.0 / 3.0);
    let two = T::of(2.0);
    let line = uniform::end(uniform::segment(run, run.len() - 4)) - from;
    let length_squared = line.dot(line);
    let tolerance_squared = tolerance * tolerance;
    let is_near = |p: Point<T>| {
        let v = p - from;
        let along = v.dot(line);
        if along <= T::zero() {
            v.dot(v) <= tolerance_squared
        } else if along >= length_squared {
            let v = v - line;
            v.dot(v) <= tolerance_squared
        } else {
            let across = v.cross(line);
            across * across <= tolerance_squared * length_squared
        }
    };
    run.array_windows().all(|p: &[Point<T>; 4]| {
        is_near((p[1] * two + p[2]) * third)
            && is_near((p[1] + p[2] * two) * third)
            && is_near(uniform::end(p))
    })
}

/// Emits the inner vertices of one segment, divided into equal parts of its parameter.
fn subdivide<T: Real>(segment: &[Point<T>; 4], tolerance: T, emit: &mut impl FnMut(Point<T>)) {
    let at = |t: T| uniform::second_derivative(segment, t).norm();
    let bend = at(T::zero()).max(at(T::one()));
    let parts = (bend / (T::of(8.0) * tolerance)).sqrt().ceil();
    let parts = parts.min(T::of(MAX_LINES_PER_SEGMENT as f64));
    let step = parts.recip();
    let mut i = T::one();
    while i < parts {
        emit(uniform::point(segment, i * step));
        i = i + T::one();
    }
}
