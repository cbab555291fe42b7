//! Lengths and nearest points agree with dense polylines.

mod common;

use common::{P, distance_to_polyline, point_within, run, run_samples, sagitta, scale};
use guideway_spline::{
    Point, Runs, arc_to_runs, nearest_on_run, run_length, segment_length, uniform,
};
use proptest::prelude::*;

fn polyline_length(vertices: &[P]) -> f64 {
    vertices.windows(2).map(|l| l[0].distance(l[1])).sum()
}

/// Length of the Bezier control polygons of a segment after `halvings`: an upper bound of its
/// length.
fn control_polygon_length(segment: &[P; 4], halvings: u32) -> f64 {
    if halvings == 0 {
        return polyline_length(&uniform::to_bezier(segment));
    }
    let halves = uniform::halves(segment);
    let lengths = halves
        .iter()
        .map(|h| control_polygon_length(h, halvings - 1));
    lengths.sum()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(128))]

    #[test]
    fn length_lies_between_chords_and_control_polygons(run in run()) {
        let least = polyline_length(&run_samples(&run, 256));
        let most: f64 = run.array_windows().map(|s| control_polygon_length(s, 8)).sum();
        let length = run_length(&run, 1e-6);
        let slack = 1e-6 + 1e-15 * scale(&run) * 256.0 * run.len() as f64;
        prop_assert!(least - slack <= length, "{} < {}", length, least);
        prop_assert!(length <= most + slack, "{} > {}", length, most);
        prop_assert!(most - least <= 0.001 * most + slack, "{} {} are too far apart", least, most);
        let parts: f64 = run.array_windows().map(|s| segment_length(s, 1e-8)).sum();
        prop_assert!((parts - length).abs() <= 2e-6);
    }

    #[test]
    fn nearest_matches_brute_force(
        run in run(),
        away in point_within(30.0),
        tolerance in prop_oneof![Just(0.1), Just(1e-6)],
    ) {
        let query = run[0] + away;
        let samples = run_samples(&run, 128);
        let expected = distance_to_polyline(query, &samples);
        let found = nearest_on_run(&run, query, tolerance).unwrap();
        let rounding = 1e-14 * scale(&run);
        let slack = sagitta(&samples) + rounding;
        prop_assert!(found.distance <= expected + tolerance + slack, "{:?} {}", found, expected);
        prop_assert!(found.distance >= expected - slack, "{:?} {}", found, expected);
        let point = uniform::point(uniform::segment(&run, found.segment), found.t);
        prop_assert!(point.distance(found.point) <= rounding + 1e-12);
        prop_assert!((found.point.distance(query) - found.distance).abs() <= rounding + 1e-12);
    }

    #[test]
    fn point_of_the_run_is_its_own_nearest(run in run(), at in 0.0..1.0, t in 0.0..=1.0) {
        let index = ((run.len() - 3) as f64 * at) as usize;
        let query = uniform::point(uniform::segment(&run, index), t);
        let found = nearest_on_run(&run, query, 1e-9).unwrap();
        prop_assert!(found.distance <= 1e-9 + 1e-14 * scale(&run), "{:?}", found);
    }
}

#[test]
fn lengths_of_known_curves() {
    let mut runs = Runs::default();
    let length = |runs: &Runs| -> f64 { runs.iter().map(|r| run_length(r, 1e-9)).sum() };
    runs.push_line(Point::new(1.0, 1.0), Point::new(4.0, 5.0));
    assert!((length(&runs) - 5.0).abs() < 1e-12);

    runs.clear();
    arc_to_runs(Point::new(0.0, 0.0), 2.0, 0.0, 3.0, 1e-12, &mut runs);
    assert!((length(&runs) - 6.0).abs() < 1e-10);

    // The parabola y = x^2 from 0 to 1: (2 sqrt(5) + asinh(2)) / 4.
    runs.clear();
    runs.push_quadratic(&[(0.0, 0.0), (0.5, 0.0), (1.0, 1.0)].map(|(x, y)| Point::new(x, y)));
    let expected = (2.0 * 5.0_f64.sqrt() + 2.0_f64.asinh()) / 4.0;
    assert!((length(&runs) - expected).abs() < 1e-12);

    // Out and back along a line, with a cusp at the turn: x = 3 t (1 - t) reaches 3/4.
    runs.clear();
    runs.push_bezier(&[0.0, 1.0, 1.0, 0.0].map(|x| Point::new(x, 0.0)));
    assert!((length(&runs) - 1.5).abs() < 1e-9);

    // Collinear with a sharp turn, where quadrature over the whole and over its halves agree by
    // chance.
    let along = [
        -7.932_900_435_681_415,
        5.713_928_133_972_491,
        -7.777_752_419_538_123,
        0.0,
    ];
    let fold = along.map(|x| Point::new(0.6 * x, -0.8 * x));
    let most = control_polygon_length(&fold, 12);
    assert!((run_length(&fold, 1e-9) - most).abs() < 1e-6);

    assert_eq!(run_length::<f64>(&[], 1e-3), 0.0);
    assert_eq!(run_length(&[Point::new(3.0, 1.0); 5], 0.0), 0.0);
}

#[test]
fn nearest_to_the_center_of_a_circle_is_at_its_radius() {
    let center = Point::new(1e5, -1e5);
    let mut runs = Runs::default();
    arc_to_runs(center, 4.0, 0.0, 7.0, 1e-9, &mut runs);
    for run in runs.iter() {
        let found = nearest_on_run(run, center, 1e-6).unwrap();
        assert!((found.distance - 4.0).abs() < 1.1e-6);
    }
    assert_eq!(nearest_on_run::<f64>(&[], center, 1e-3), None);
}

#[test]
fn finds_a_run_of_equal_points() {
    let found = nearest_on_run(&[Point::new(3.0_f32, 4.0); 6], Point::new(0.0, 0.0), 0.0).unwrap();
    assert!((found.distance - 5.0).abs() < 1e-12);
}
