//! Boxes contain the curve and the tight ones touch it; arcs keep their bound; forms of a segment
//! agree.

mod common;

use common::{P, point_within, run, run_samples, scale};
use guideway_spline::{Bounds, Point, Runs, arc_to_runs, uniform};
use proptest::prelude::*;

proptest! {
    #[test]
    fn boxes_contain_the_curve(run in run()) {
        let rounding = 1e-14 * scale(&run);
        let samples = Bounds::of_points(run_samples(&run, 64)).unwrap();
        let tight = Bounds::of_run(&run).unwrap();
        let hull = Bounds::of_points(run.iter().copied()).unwrap();
        for count in 0..=run.len() {
            let points = &run[..count];
            prop_assert_eq!(
                Bounds::of_slice(points),
                Bounds::of_points(points.iter().copied())
            );
        }
        prop_assert_eq!(tight.inflated(rounding).union(samples), tight.inflated(rounding));
        prop_assert_eq!(hull.inflated(rounding).union(tight), hull.inflated(rounding));
        // Between samples, a coordinate exceeds theirs by at most h^2/8 |C''|, and
        // |C''| <= 4 * 20 * sqrt(2).
        let reach = 120.0 / (8.0 * 64.0 * 64.0) + rounding;
        prop_assert_eq!(samples.inflated(reach).union(tight), samples.inflated(reach));
    }

    #[test]
    fn forms_of_a_segment_agree(
        points in prop::array::uniform4(point_within(50.0)),
        t in 0.0..=1.0,
    ) {
        let near = |a: P, b: P| a.distance(b) < 1e-12 * 50.0;
        let bezier = uniform::to_bezier(&points);
        let back = uniform::from_bezier(&bezier);
        prop_assert!(points.iter().zip(back).all(|(a, b)| near(*a, b)));
        let mut d = bezier;
        for r in 1..4 {
            for i in 0..4 - r {
                d[i] = d[i].lerp(d[i + 1], t);
            }
        }
        prop_assert!(near(d[0], uniform::point(&points, t)));
        let [c0, c1, c2, c3] = uniform::polynomial(&points);
        prop_assert!(near(d[0], ((c3 * t + c2) * t + c1) * t + c0));
        let [left, right] = uniform::halves(&points);
        let half = if t < 0.5 {
            uniform::point(&left, 2.0 * t)
        } else {
            uniform::point(&right, 2.0 * t - 1.0)
        };
        prop_assert!(near(half, uniform::point(&points, t)));
    }

    #[test]
    fn arcs_stay_within_their_bound(
        center in point_within(100.0),
        radius in 0.01..100.0,
        start in -9.0..9.0,
        sweep in -6.3..6.3_f64,
        tolerance in prop_oneof![Just(0.1), Just(1e-3), Just(1e-6)],
    ) {
        let mut runs = Runs::default();
        let done = arc_to_runs(center, radius, start, sweep, tolerance, &mut runs);
        prop_assert!(done.error_bound_m <= tolerance);
        prop_assert!(done.pieces <= 120);
        let samples: Vec<P> = runs.iter().flat_map(|r| run_samples(r, 32)).collect();
        let worst = samples.iter().map(|p| p.distance(center) - radius);
        let worst = worst.fold(0.0, |a: f64, e| a.max(e.abs()));
        prop_assert!(worst <= done.error_bound_m + 1e-12, "{} with {:?}", worst, done);
        let on_circle = |angle: f64| center + Point::new(angle.cos(), angle.sin()) * radius;
        let end = on_circle(start + sweep.clamp(-std::f64::consts::TAU, std::f64::consts::TAU));
        prop_assert!(samples[0].distance(on_circle(start)) < 1e-11);
        prop_assert!(samples[samples.len() - 1].distance(end) < 1e-11);
    }
}

#[test]
fn error_bound_of_an_arc_is_tight() {
    let mut runs = Runs::default();
    let quarter = std::f64::consts::FRAC_PI_2;
    let done = arc_to_runs(Point::new(0.0, 0.0), 1.0, 0.0, quarter, 1e-3, &mut runs);
    let samples = run_samples(runs.iter().next().unwrap(), 1000);
    let worst = samples.iter().map(|p| p.norm() - 1.0).fold(0.0, f64::max);
    assert_eq!(done.pieces, 1);
    assert!(worst > 0.99 * done.error_bound_m, "{worst} with {done:?}");
}

#[test]
fn box_of_a_known_curve_is_tight() {
    // The top of the Bezier curve (0,0) (0,4) (8,4) (8,0) is at height 3.
    let corners = [(0.0, 0.0), (0.0, 4.0), (8.0, 4.0), (8.0, 0.0)];
    let segment = uniform::from_bezier(&corners.map(|(x, y)| Point::new(x, y)));
    let bounds = Bounds::of_segment(&segment);
    assert!(bounds.min.distance(Point::new(0.0, 0.0)) < 1e-12);
    assert!(bounds.max.distance(Point::new(8.0, 3.0)) < 1e-12);
    assert_eq!(Bounds::of_run(&segment[..3]), None);
}

#[test]
fn curvature_of_an_arc_is_its_inverse_radius() {
    let mut runs = Runs::default();
    let center = Point::new(3.0, 4.0);
    for (sweep, expected) in [(0.5, 0.2), (-0.5, -0.2)] {
        runs.clear();
        arc_to_runs(center, 5.0, 1.0, sweep, 1e-9, &mut runs);
        let segment = uniform::segment(runs.points(), 0);
        assert!((uniform::curvature(segment, 0.3) - expected).abs() < 1e-5);
    }
    let point = [center; 4];
    assert!(!uniform::curvature(&point, 0.5).is_finite());
}
