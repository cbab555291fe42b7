//! Arcs lie on their circle within the stated bound, and begin and end exactly.

use guideway_spline::construct::{Arc, ConstructError};
use guideway_spline::{Point, Runs};
use proptest::prelude::*;

use crate::common::{P, point_within, scale};
use crate::{directions, p, samples};

const TOLERANCE: f64 = 1e-6;

/// Center of the circle through three points, by the two bisectors.
fn center(a: P, b: P, c: P) -> P {
    let (u, v) = (b - a, c - a);
    let twice = 2.0 * u.cross(v);
    let (uu, vv) = (u.dot(u), v.dot(v));
    a + Point::new(v.y * uu - u.y * vv, u.x * vv - v.x * uu) * (1.0 / twice)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(256))]

    #[test]
    fn arc_through_three_points_lies_on_their_circle(
        a in point_within(50.0), b in point_within(50.0), c in point_within(50.0),
        far in prop_oneof![Just(0.0), Just(1e5)],
    ) {
        let by = p(far, -far);
        let center = center(a, b, c);
        let radius = a.distance(center);
        // Thin triangles lose the digits of the center, by which the test measures.
        let distances = [a.distance(b), b.distance(c), a.distance(c)];
        prop_assume!(radius < 1e4 && distances.iter().all(|d| *d > 0.1));
        let arc = Arc::through([a + by, b + by, c + by]).unwrap();
        let rounding = 1e-11 * (radius + far);
        prop_assert!((arc.radius() - radius).abs() <= 1e-9 * radius * radius + rounding);
        let mut runs = Runs::default();
        let done = arc.push(TOLERANCE, &mut runs);
        prop_assert!(done.error_bound_m <= TOLERANCE);
        let samples = samples(&runs, 16);
        for at in &samples {
            let off = (at.distance(center + by) - radius).abs();
            prop_assert!(off <= done.error_bound_m + 1e3 * rounding, "{off}");
        }
        let reach = 1e-15 * scale(&samples) * 16.0;
        prop_assert!(runs.start().unwrap().distance(a + by) <= reach);
        prop_assert!(runs.end().unwrap().distance(c + by) <= reach);
        // The second point lies on this part of the circle, not on the other one.
        let to_b = samples
            .array_windows()
            .map(|[s, e]| crate::common::distance_to_line(b + by, *s, *e));
        let sagitta = crate::common::sagitta(&samples);
        prop_assert!(to_b.fold(f64::INFINITY, f64::min) <= sagitta + TOLERANCE + 1e3 * rounding);
        let length: f64 = samples.array_windows().map(|[s, e]| s.distance(*e)).sum();
        prop_assert!((length - arc.length()).abs() <= 1e-2 * length, "{length} {}", arc.length());
    }

    #[test]
    fn arc_from_a_tangent_begins_along_it(
        start in point_within(50.0),
        heading in -3.1..3.1_f64,
        turn in -3.0..3.0_f64,
        chord in 0.1..80.0,
    ) {
        let at = |angle: f64| p(angle.cos(), angle.sin());
        let end = start + at(heading + turn) * chord;
        let arc = Arc::from_tangent(start, at(heading) * 7.0, end).unwrap();
        prop_assert!((arc.sweep_rad() - 2.0 * turn).abs() < 1e-9);
        let mut runs = Runs::default();
        arc.push(TOLERANCE, &mut runs);
        let [first, last] = directions(&runs);
        prop_assert!(first.distance(at(heading)) < 1e-7, "{first:?}");
        prop_assert!(last.distance(at(heading + 2.0 * turn)) < 1e-7, "{last:?}");
        prop_assert!(runs.end().unwrap().distance(end) < 1e-11);
    }
}

#[test]
fn quarter_of_a_circle() {
    let arc = Arc::from_tangent(p(0.0, 0.0), p(1.0, 0.0), p(2.0, 2.0)).unwrap();
    assert!((arc.radius() - 2.0).abs() < 1e-12);
    assert!((arc.length() - std::f64::consts::PI).abs() < 1e-12);
    let mut runs = Runs::default();
    let done = arc.push(1e-9, &mut runs);
    assert!(!done.exact && done.error_bound_m <= 1e-9 && done.pieces > 1);
    for at in samples(&runs, 64) {
        assert!((at.distance(p(0.0, 2.0)) - 2.0).abs() <= 1.01e-9);
    }
}

#[test]
fn arc_without_a_turn_is_a_line() {
    for arc in [
        Arc::from_tangent(p(1.0, 1.0), p(3.0, 0.0), p(9.0, 1.0)),
        Arc::through([p(1.0, 1.0), p(2.0, 1.0), p(9.0, 1.0)]),
    ] {
        let arc = arc.unwrap();
        let mut runs = Runs::default();
        assert!(arc.push(TOLERANCE, &mut runs).exact);
        assert_eq!(runs, crate::line(p(1.0, 1.0), p(9.0, 1.0)));
        assert!(arc.radius().is_infinite() && arc.length() == 8.0);
    }
}

#[test]
fn nearly_straight_arc_keeps_its_height() {
    // The height of an arc is about a quarter of chord times turn: 5 mm over 200 m.
    let arc = Arc::through([p(0.0, 0.0), p(100.0, 0.005), p(200.0, 0.0)]).unwrap();
    let mut runs = Runs::default();
    arc.push(TOLERANCE, &mut runs);
    let highest = samples(&runs, 64).iter().map(|at| at.y).fold(0.0, f64::max);
    assert!((highest - 0.005).abs() < 1e-9, "{highest}");
}

#[test]
fn errors_name_the_points() {
    let (a, b) = (p(1.0, 1.0), p(5.0, 1.0));
    let same = ConstructError::EqualPoints { index: 1, at: a };
    assert_eq!(Arc::from_tangent(a, b, a), Err(same));
    assert_eq!(
        same.to_string(),
        "points 1 and 2 are the same, (1.000, 1.000)"
    );
    let zero = p(0.0, 0.0);
    assert_eq!(
        Arc::from_tangent(a, zero, b),
        Err(ConstructError::NoDirection)
    );
    let behind = Arc::from_tangent(a, p(-1.0, 0.0), b);
    assert_eq!(behind, Err(ConstructError::StraightBehind { end: b }));
    let beside = Arc::through([a, p(9.0, 1.0), b]);
    let through = p(9.0, 1.0);
    assert_eq!(beside, Err(ConstructError::NotBetween { through }));
    let nan = p(f64::NAN, 0.0);
    for bad in [Arc::through([a, nan, b]), Arc::from_tangent(a, nan, b)] {
        assert_eq!(bad, Err(ConstructError::NotFinite));
    }
    // A circle through its own start has no second place.
    assert!(matches!(
        Arc::through([a, b, a]),
        Err(ConstructError::EqualPoints { .. })
    ));
}

#[test]
fn arc_of_a_radius_turns_to_its_side_up_to_half_a_circle() {
    let (start, end) = (p(0.0, 0.0), p(2.0, 0.0));
    for radius in [1.0, 1.5, 100.0] {
        for side in [1.0, -1.0] {
            let arc = Arc::of_radius(start, end, side * radius).unwrap();
            assert!((arc.radius() - radius).abs() < 1e-9 * radius);
            assert!(arc.sweep_rad() * side > 0.0);
        }
    }
    let half = Arc::of_radius(start, end, 1.0).unwrap();
    assert!((half.length() - std::f64::consts::PI).abs() < 1e-9);
    let small = Arc::of_radius(start, end, 0.99).unwrap_err();
    assert!(matches!(small, ConstructError::TooSmall { smallest, .. } if smallest == 1.0));
    assert!(Arc::of_radius(start, end, 0.0).is_err());
    assert!(Arc::of_radius(start, end, f64::NAN).is_err());
    assert!(Arc::of_radius(start, start, 1.0).is_err());
}
