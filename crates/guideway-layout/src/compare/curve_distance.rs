//! Distance of two curves: an upper bound where it suffices, else by samples.

use guideway_spline::{Point, nearest_on_run, uniform};

use crate::PathRef;

/// Samples per segment.
const STEPS: u32 = 16;

/// Precision of a nearest point, in meters.
const PRECISION_M: f64 = 1e-9;

/// Returns `true` if no sampled point of either path is farther than `tolerance_m` from the other.
/// Paths without a curve are near each other only.
pub(super) fn are_near(a: PathRef<'_>, b: PathRef<'_>, tolerance_m: f64) -> bool {
    let (of_a, of_b) = (beziers(a), beziers(b));
    if of_a.len() == of_b.len() {
        // The distance of Bezier curves is at most that of their control points.
        let pairs = of_a.iter().flatten().zip(of_b.iter().flatten());
        if pairs
            .into_iter()
            .all(|(p, q)| p.distance(*q) <= tolerance_m)
        {
            return true;
        }
    }
    is_covered(a, b, tolerance_m) && is_covered(b, a, tolerance_m)
}

fn beziers(path: PathRef<'_>) -> Vec<[Point<f64>; 4]> {
    let segments = path.runs().flat_map(|run| run.segments());
    segments.map(|s| uniform::to_bezier(&s)).collect()
}

/// Returns `true` if all samples of a path are near another one.
fn is_covered(path: PathRef<'_>, by: PathRef<'_>, tolerance_m: f64) -> bool {
    let by: Vec<Vec<Point<f64>>> = by.runs().map(|run| run.iter().collect()).collect();
    let is_near = |p: Point<f64>| {
        let mut runs = by.iter();
        runs.any(|run| {
            nearest_on_run(run, p, PRECISION_M).is_some_and(|n| n.distance <= tolerance_m)
        })
    };
    let segments = path.runs().flat_map(|run| run.segments());
    let points = |s| (0..=STEPS).map(move |i| uniform::point(&s, f64::from(i) / f64::from(STEPS)));
    segments.flat_map(points).all(is_near)
}
