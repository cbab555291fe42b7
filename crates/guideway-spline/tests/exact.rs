//! Curves of degree 1 to 3 without weights convert to as few control points as they have.

mod common;

use common::{P, difference, segments, zigzag};
use guideway_spline::{Nurbs, Point, Runs, knots, nurbs_to_runs, uniform};

#[test]
fn clamped_curve_has_as_many_points_as_it_was_written_with() {
    for count in [5, 6, 7, 11, 100] {
        let points = zigzag(count);
        let curve = Nurbs::new(3, knots::uniform_clamped(3, count), points, None).unwrap();
        let mut runs = Runs::default();
        let done = nurbs_to_runs(&curve, 1e-3, &mut runs);
        assert_eq!((done.exact, done.pieces), (true, count - 3));
        assert_eq!((runs.len(), runs.points().len()), (1, count));
        assert!(difference(&curve, &runs) < 1e-10, "{count} points");
    }
}

#[test]
fn each_stretch_of_even_knots_is_a_run() {
    // Even, then half as wide, then a triple knot, then one span.
    let knots = [
        0.0, 0.0, 0.0, 0.0, 2.0, 4.0, 6.0, 7.0, 8.0, 9.0, 9.0, 9.0, 10.0, 10.0, 10.0, 10.0,
    ];
    let curve = Nurbs::new(3, knots.to_vec(), zigzag(12), None).unwrap();
    let mut runs = Runs::default();
    assert!(nurbs_to_runs(&curve, 1e-3, &mut runs).exact);
    let lengths: Vec<usize> = runs.iter().map(<[P]>::len).collect();
    assert_eq!(lengths, [6, 6, 4]);
    assert!(difference(&curve, &runs) < 1e-10);
}

/// Points of a line of degree 1 at shares of the way from (1, 2) to (5, 5), rounded to micrometers.
fn straight(shares: &[f64]) -> Nurbs {
    let micrometers = |v: f64| (v * 1e6).round() / 1e6;
    let points = shares.iter().map(|s| {
        let p = Point::new(1.0, 2.0).lerp(Point::new(5.0, 5.0), *s);
        Point::new(micrometers(p.x), micrometers(p.y))
    });
    let points: Vec<P> = points.collect();
    let knots = knots::uniform_clamped(1, points.len());
    Nurbs::new(1, knots, points, None).expect("a curve of degree 1")
}

#[test]
fn straight_points_are_one_run_that_passes_through_them() {
    for shares in [
        &[0.0, 0.5, 1.0][..],
        &[
            0.0, 0.101, 0.198, 0.3, 0.4003, 0.5, 0.61, 0.7, 0.81, 0.9, 1.0,
        ],
    ] {
        let curve = straight(shares);
        let mut runs = Runs::default();
        let done = nurbs_to_runs(&curve, 1e-3, &mut runs);
        assert!(done.error_bound_m < 5e-6, "{done:?}");
        assert_eq!((runs.len(), runs.points().len()), (1, shares.len() + 2));
        let segments = segments(&runs);
        for (segment, ends) in segments.iter().zip(curve.points().windows(2)) {
            assert!(uniform::start(segment).distance(ends[0]) < 1e-12);
            assert!(uniform::end(segment).distance(ends[1]) < 1e-12);
            let chord = (ends[1] - ends[0]) * (1.0 / ends[0].distance(ends[1]));
            let middle = uniform::point(segment, 0.5) - ends[0];
            assert!(middle.cross(chord).abs() <= done.error_bound_m.max(1e-12));
        }
    }
}

#[test]
fn lines_that_turn_or_are_uneven_stay_lines() {
    // Uneven: a smooth run through the points would turn back.
    for shares in [&[0.0, 0.01, 0.02, 1.0][..], &[0.0, 0.6, 0.4, 1.0]] {
        let curve = straight(shares);
        let mut runs = Runs::default();
        assert!(nurbs_to_runs(&curve, 1e-3, &mut runs).exact);
        assert!(runs.len() > 1 && difference(&curve, &runs) < 1e-12);
    }
}
