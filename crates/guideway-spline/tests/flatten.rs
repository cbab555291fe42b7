//! The Hausdorff distance between a run and its polyline is at most the tolerance.

mod common;

use common::{P, one_way, run, run_samples, sagitta, scale};
use guideway_spline::{MAX_LINES_PER_SEGMENT, Point, Real, flatten_run};
use proptest::prelude::*;

fn vertices<T: Real>(run: &[Point<T>], tolerance: T) -> Vec<Point<T>> {
    let mut vertices = Vec::new();
    flatten_run(run, tolerance, &mut |p| vertices.push(p));
    vertices
}

/// Dense points on the lines.
fn along(vertices: &[P]) -> Vec<P> {
    let on_line = |ends: &[P]| {
        let (a, b) = (ends[0], ends[1]);
        (0..=5).map(move |i| a.lerp(b, f64::from(i) / 5.0))
    };
    vertices.windows(2).flat_map(on_line).collect()
}

/// Hausdorff distance, less the error of sampling.
fn hausdorff(run: &[P], vertices: &[P]) -> f64 {
    let curve = run_samples(run, 48);
    let there = one_way(&curve, vertices);
    let back = one_way(&along(vertices), &curve) - sagitta(&curve);
    there.max(back) - 1e-14 * scale(run)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn stays_within_the_tolerance(
        run in run(),
        tolerance in prop_oneof![Just(2.0), Just(0.1), Just(2e-3)],
    ) {
        let vertices = vertices(&run, tolerance);
        let curve = run_samples(&run, 1);
        prop_assert_eq!(vertices[0], curve[0]);
        prop_assert_eq!(vertices.last(), curve.last());
        let distance = hausdorff(&run, &vertices);
        let count = vertices.len();
        prop_assert!(distance <= tolerance * (1.0 + 1e-9), "{} with {} vertices", distance, count);
    }

    #[test]
    fn stays_within_the_tolerance_in_f32(
        run in run(),
        tolerance in prop_oneof![Just(0.1), Just(2e-3)],
    ) {
        let narrow: Vec<_> = run.iter().map(|p| p.to_f32()).collect();
        let wide: Vec<P> = narrow.iter().map(|p| p.to_f64()).collect();
        let rounding = 8.0 * f64::from(f32::EPSILON) * scale(&wide);
        // No tolerance below the rounding error of the coordinates can be met.
        prop_assume!(rounding < 0.1 * tolerance);
        let vertices = vertices(&narrow, f32::of(tolerance));
        let vertices: Vec<P> = vertices.iter().map(|p| p.to_f64()).collect();
        prop_assert!(hausdorff(&wide, &vertices) <= tolerance + rounding);
    }
}

/// A run whose n + 3 control points follow a parametric curve.
fn trace(n: usize, at: impl Fn(f64) -> (f64, f64)) -> Vec<P> {
    let points = (0..n + 3).map(|i| at(i as f64 / n as f64));
    points.map(|(x, y)| Point::new(x, y)).collect()
}

#[test]
fn straight_run_yields_one_line() {
    for offset in [0.0, 1e7] {
        let run = trace(100, |t| (offset + 70.0 * t, offset - 30.0 * t));
        assert_eq!(vertices(&run, 1e-3).len(), 2);
    }
    let long = trace(100_000, |t| (1e5 * t, 0.0));
    assert_eq!(vertices(&long, 1e-3).len(), 2);
}

#[test]
fn line_count_is_near_the_optimum() {
    // The longest chord within `tolerance` of a circle, with its ends on the circle, spans
    // 2 acos(1 - tolerance / r). The test of the Bezier hull may need a few more lines.
    let (radius, tolerance) = (50.0, 0.01);
    let turn = std::f64::consts::TAU;
    let circle = trace(1000, |t| {
        (radius * (t * turn).cos(), radius * (t * turn).sin())
    });
    let fewest = turn / (2.0 * (1.0_f64 - tolerance / radius).acos());
    let lines = vertices(&circle, tolerance).len() - 1;
    assert!(
        lines as f64 <= 1.1 * fewest + 1.0,
        "{lines} lines, {fewest} at best"
    );

    // A bend between two straights takes lines for the bend only.
    let corner = trace(200, |t| if t < 0.5 { (t, 0.0) } else { (0.5, t - 0.5) });
    let lines = vertices(&corner, 1e-4).len() - 1;
    assert!(lines <= 8, "{lines} lines");
}

#[test]
fn divides_a_bent_segment_evenly() {
    let run = [(0.0, 0.0), (0.0, 60.0), (60.0, 60.0), (60.0, 0.0)].map(|(x, y)| Point::new(x, y));
    let bend = 60.0 * std::f64::consts::SQRT_2;
    for tolerance in [1.0, 1e-2, 1e-6] {
        let expected = (bend / (8.0 * tolerance)).sqrt().ceil();
        assert_eq!(vertices(&run, tolerance).len() as f64, expected + 1.0);
    }
    assert_eq!(
        vertices(&run, f64::MIN_POSITIVE).len(),
        MAX_LINES_PER_SEGMENT + 1
    );
}

#[test]
fn degenerate_run_yields_two_points() {
    let point = Point::new(3.0, -2.0);
    let vertices_of_point = vertices(&[point; 9], 1e-3);
    assert_eq!(vertices_of_point.len(), 2);
    assert!(vertices_of_point.iter().all(|v| v.distance(point) < 1e-12));
    assert!(vertices(&[point; 3], 1e-3).is_empty());
    assert!(vertices::<f64>(&[], 1e-3).is_empty());
}

#[test]
fn keeps_a_spike_between_equal_ends() {
    // Both ends are at the origin, so the line between them is far from the turn.
    let there_and_back = trace(40, |t| (20.0 * (0.5 - (t - 0.5).abs()), 0.0));
    let vertices = vertices(&there_and_back, 0.01);
    assert!(vertices.iter().any(|v| v.x > 9.6));
    assert!(hausdorff(&there_and_back, &vertices) <= 0.01);
}

#[test]
fn comparator_detects_wrong_lines() {
    let run = trace(20, |t| (10.0 * t, (6.0 * t).sin()));
    let good = vertices(&run, 0.01);
    assert!(hausdorff(&run, &good) <= 0.01);

    let mut moved = good.clone();
    moved[2].y += 0.05;
    assert!(hausdorff(&run, &moved) > 0.01);
    // A spur is far from the curve, though every point of the curve is near the lines.
    let mut spur = good.clone();
    spur.insert(2, Point::new(good[1].x, 5.0));
    spur.insert(2, good[1]);
    assert!(hausdorff(&run, &spur) > 1.0);
    assert!(hausdorff(&run, &good[1..]) > 0.01);
}
