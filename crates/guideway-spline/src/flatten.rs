use crate::{Point, Real, uniform};

/// The most lines that [`flatten_run`] draws for one segment.
///
/// It holds any tolerance above 1/(8 * 65536^2), or 3e-11, of the second derivative of the segment, which
/// is at most four times the reach of its control points.
pub const MAX_LINES_PER_SEGMENT: usize = 1 << 16;

/// How many segments the first line of a run is tried over.
const FIRST_REACH: usize = 8;

/// Draws a run as straight lines, as few as a greedy search finds, with no point of either farther than
/// `tolerance` (unit of the points) from the other: the Hausdorff distance.
///
/// `emit` gets the vertices in order: the start of the run, then the end of each line. A run that is a
/// single point gives that point twice; fewer than four control points give nothing. Nothing is
/// allocated, and n segments cost O(n log n).
///
/// A line may span many segments. It is taken if every Bezier point of the stretch from A to E lies
/// within the tolerance of the line segment AE, because then
///
/// - the curve is near the line: the set of points that near to AE (a capsule) is convex, so it holds
///   the hulls of the Bezier points, and these hold the curve;
/// - the line is near the curve: the nearest point on AE moves continuously along the curve, from A to
///   E, so every point of AE is the nearest one of some point of the curve, which is within the tolerance.
///
/// A segment that is too bent for one line is cut into n equal parts of its parameter, with
/// n = ceil(sqrt(max |C''| / (8 tolerance))): points of a chord and of the curve at equal parameters are
/// at most max |C''| / (8 n^2) apart, and C'' is linear, so its greatest length is at an end.
///
/// The proof is for exact arithmetic: rounding adds some units in the last place of the coordinates. A
/// `tolerance` that is not above zero (an error of the caller, found by a debug assertion) counts as the
/// smallest number, and [`MAX_LINES_PER_SEGMENT`] then ends the work. Points must be finite.
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
            cut(segment, tolerance, emit);
        }
        let done = count.max(1);
        from = uniform::end(uniform::segment(rest, done - 1));
        emit(from);
        rest = &rest[done..];
        reach = 2 * done;
    }
}

/// How many segments, from the first on, one line from `from` can stand for; 0 if not even one.
///
/// Whether a line is near enough is not monotone in its length, so this finds a good length, not
/// always the greatest. Trying lengths around `reach`, the double of the last one, keeps the cost of
/// all lines together to O(n log n).
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

/// Whether all Bezier points of the run are within the tolerance of the line from its start to its end.
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

/// Emits the inner vertices of one segment cut into equal parts.
fn cut<T: Real>(segment: &[Point<T>; 4], tolerance: T, emit: &mut impl FnMut(Point<T>)) {
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
