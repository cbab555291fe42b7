//! Distance of two curves: an upper bound where it suffices, else by samples.

use std::cell::OnceCell;

use guideway_spline::{Point, bezier, nearest_on_run, uniform};

use crate::PathRef;

/// Samples per segment.
const STEPS: u32 = 16;

/// Samples of a segment, with both ends.
const SAMPLES: usize = STEPS as usize + 1;

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
    is_covered([a, b], [&of_a, &of_b], tolerance_m)
        && is_covered([b, a], [&of_b, &of_a], tolerance_m)
}

/// Returns the greatest distance of a sampled point of either path from the other, in meters;
/// `None` if one of them has no curve.
pub(super) fn greatest_distance_m(a: PathRef<'_>, b: PathRef<'_>) -> Option<f64> {
    let from = |path: PathRef<'_>, to: PathRef<'_>| {
        let to = run_points(to);
        let distance = |p| {
            let runs = to
                .iter()
                .filter_map(|run| nearest_on_run(run, p, PRECISION_M));
            runs.map(|near| near.distance).reduce(f64::min)
        };
        samples(path).filter_map(distance).reduce(f64::max)
    };
    Some(from(a, b)?.max(from(b, a)?))
}

fn beziers(path: PathRef<'_>) -> Vec<[Point<f64>; 4]> {
    let segments = path.runs().flat_map(|run| run.segments());
    segments.map(|s| uniform::to_bezier(&s)).collect()
}

/// Returns `true` if all samples of the first path are near the second one. Where the paths have
/// equally many segments, the same place of the other path is tried before the nearest one.
fn is_covered(
    [of, by]: [PathRef<'_>; 2],
    [own, others]: [&[[Point<f64>; 4]]; 2],
    tolerance_m: f64,
) -> bool {
    let runs: OnceCell<Vec<Vec<Point<f64>>>> = OnceCell::new();
    let is_near_at_all = |p: Point<f64>| {
        let mut runs = runs.get_or_init(|| run_points(by)).iter();
        runs.any(|run| {
            nearest_on_run(run, p, PRECISION_M).is_some_and(|n| n.distance <= tolerance_m)
        })
    };
    let has_same_segments = own.len() == others.len();
    samples(of).enumerate().all(|(sample, p)| {
        let (segment, step) = (sample / SAMPLES, sample % SAMPLES);
        let same_place = has_same_segments
            .then(|| bezier::point(&others[segment], step as f64 / f64::from(STEPS)));
        same_place.is_some_and(|q| p.distance(q) <= tolerance_m) || is_near_at_all(p)
    })
}

fn run_points(path: PathRef<'_>) -> Vec<Vec<Point<f64>>> {
    path.runs().map(|run| run.iter().collect()).collect()
}

fn samples(path: PathRef<'_>) -> impl Iterator<Item = Point<f64>> {
    let segments = path.runs().flat_map(|run| run.segments());
    let points = |s| (0..=STEPS).map(move |i| uniform::point(&s, f64::from(i) / f64::from(STEPS)));
    segments.flat_map(points)
}
