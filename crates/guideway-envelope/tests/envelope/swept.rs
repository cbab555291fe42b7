//! Checks that swept polygons contain the vehicle and stay within their tolerance.

use std::f64::consts::{FRAC_PI_2, PI};

use guideway_envelope::{Body, ConvexPolygon, Heading};
use proptest::prelude::*;

use crate::brute::{body_point, distance_from, poses};
use crate::random::{Case, Curve, P, case, p};

fn polygons(case: &Case, tolerance_m: f64) -> Vec<ConvexPolygon> {
    let mut polygons = Vec::new();
    let sweep = case.sweep();
    sweep.polygons(tolerance_m, None, &mut |polygon| {
        polygons.push(polygon.clone());
    });
    polygons
}

/// Rounding errors, and the parts that the brute force omits at the ends of curves: a few 1e-7 of
/// their length.
const ROUNDING_M: f64 = 1e-5;

/// A point of the vehicle at some pose that no polygon contains.
fn outside(case: &Case, polygons: &[ConvexPolygon]) -> Option<P> {
    let grown = |polygon: &ConvexPolygon, q: P| {
        let around = |i: i32| p(f64::from(i % 3 - 1), f64::from(i / 3 - 1)) * ROUNDING_M;
        (0..9).any(|i| polygon.contains(q + around(i)))
    };
    let marks = [-1.0, 0.1, 1.0];
    let places = marks.iter().flat_map(|&x| marks.map(|y| (x, y)));
    let points = poses(case, 0.1).into_iter().flat_map(|pose| {
        let point = move |(x, y)| body_point(&case.body, pose, x, y);
        places.clone().map(point)
    });
    points
        .into_iter()
        .find(|&q| !polygons.iter().any(|polygon| grown(polygon, q)))
}

/// Largest distance of a point of the polygons from the vehicle at its closest pose. Poses are
/// `step` apart, so the real distance may be smaller by `step`.
fn farthest_m(case: &Case, polygons: &[ConvexPolygon], step: f64) -> f64 {
    let poses = poses(case, step);
    let from_all = |q: P| {
        let each = poses.iter().map(|&pose| distance_from(&case.body, pose, q));
        each.fold(f64::INFINITY, f64::min)
    };
    let of_polygon = |polygon: &ConvexPolygon| {
        let corners = polygon.points();
        let share = 1.0 / corners.len() as f64;
        let center = corners.iter().fold(p(0.0, 0.0), |sum, &c| sum + c * share);
        let edges = corners.iter().zip(corners.iter().cycle().skip(1));
        let middles = edges.map(|(a, b)| a.lerp(*b, 0.5));
        let points = corners.iter().copied().chain(middles).chain([center]);
        points.map(from_all).fold(0.0, f64::max)
    };
    polygons.iter().map(of_polygon).fold(0.0, f64::max)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(32))]

    #[test]
    fn polygons_contain_the_vehicle(
        case in case(),
        tolerance in prop_oneof![Just(0.5), Just(0.05)],
    ) {
        let polygons = polygons(&case, tolerance);
        prop_assert_eq!(outside(&case, &polygons), None);
    }

    #[test]
    fn polygons_stay_within_the_tolerance_of_the_vehicle(
        case in case(),
        tolerance in prop_oneof![Just(0.5), Just(0.08)],
    ) {
        let (polygons, step) = (polygons(&case, tolerance), 0.02);
        let farthest = farthest_m(&case, &polygons, step);
        prop_assert!(farthest <= tolerance + step + ROUNDING_M, "{}", farthest);
    }

    #[test]
    fn visits_exactly_the_polygons_that_intersect_the_box(
        case in case(),
        x in -3.0..3.0,
        y in -3.0..3.0,
    ) {
        let within = guideway_spline::Bounds { min: p(x, y), max: p(x + 1.0, y + 1.0) };
        let mut some = Vec::new();
        case.sweep().polygons(0.05, Some(within), &mut |polygon| some.push(polygon.clone()));
        let all = polygons(&case, 0.05);
        let seen = all.iter().filter(|polygon| polygon.bounds().intersects(within));
        prop_assert_eq!(seen.cloned().collect::<Vec<_>>(), some);
    }
}

fn line(from: P, to: P) -> [P; 4] {
    [from, from.lerp(to, 1.0 / 3.0), from.lerp(to, 2.0 / 3.0), to]
}

fn case_of(curve: Vec<[P; 4]>, heading: Heading) -> Case {
    Case {
        curve: Curve(curve),
        body: Body::vehicle(2.0, 1.0, 0.5),
        heading,
    }
}

fn covers(polygons: &[ConvexPolygon], x: f64, y: f64) -> bool {
    polygons.iter().any(|polygon| polygon.contains(p(x, y)))
}

#[test]
fn straight_path_is_one_polygon_with_the_vehicle_at_both_ends() {
    let path = vec![line(p(0.0, 0.0), p(10.0, 0.0))];
    for (heading, low, high) in [
        (Heading::Tangential(0.0), p(-0.5, -0.5), p(11.5, 0.5)),
        (Heading::Tangential(PI), p(-1.5, -0.5), p(10.5, 0.5)),
        (Heading::Tangential(FRAC_PI_2), p(-0.5, -0.5), p(10.5, 1.5)),
        (Heading::Fixed(FRAC_PI_2), p(-0.5, -0.5), p(10.5, 1.5)),
    ] {
        let polygons = polygons(&case_of(path.clone(), heading), 0.01);
        assert_eq!(polygons.len(), 1, "{heading:?}");
        let bounds = polygons[0].bounds();
        assert!(bounds.min.distance(low) < 1e-9, "{heading:?} {bounds:?}");
        assert!(bounds.max.distance(high) < 1e-9, "{heading:?} {bounds:?}");
    }
}

#[test]
fn vehicle_pivots_at_a_kink_and_reverses_at_a_cusp() {
    let corner = vec![
        line(p(0.0, 0.0), p(5.0, 0.0)),
        line(p(5.0, 0.0), p(5.0, 5.0)),
    ];
    let turned = polygons(&case_of(corner.clone(), Heading::Tangential(0.0)), 0.01);
    // The front right corner reaches the farthest, at 1.5 and 0.5 from the reference point.
    let (reach, half) = (1.5_f64.hypot(0.5), (0.5_f64).atan2(1.5));
    for direction in [-half + 0.05, 0.3, FRAC_PI_2 - half] {
        let at = p(5.0 + reach * direction.cos(), reach * direction.sin()) - p(1e-3, 1e-3);
        assert!(covers(&turned, at.x, at.y), "{direction}");
    }
    assert!(!covers(&turned, 5.0 + reach + 0.02, 0.0));
    let fixed = polygons(&case_of(corner, Heading::Fixed(0.0)), 0.01);
    assert!(!covers(&fixed, 5.0, -0.52) && covers(&fixed, 6.4, 4.0));

    let back = vec![
        line(p(0.0, 0.0), p(5.0, 0.0)),
        line(p(5.0, 0.0), p(-3.0, 0.0)),
    ];
    let reversed = polygons(&case_of(back, Heading::Tangential(0.0)), 0.01);
    // In reverse, the rear still points to the left.
    assert!(covers(&reversed, -3.45, 0.0) && !covers(&reversed, -3.55, 0.0));
    assert!(!covers(&reversed, 5.0, 0.55), "no pivot");
}

#[test]
fn path_without_a_direction_needs_a_fixed_heading() {
    let mut runs = guideway_spline::Runs::default();
    runs.push_bezier(&[p(1.0, 1.0); 4]);
    let mut layout = guideway_layout::Layout::default();
    layout.paths.push(&guideway_layout::NewPath {
        runs: &runs,
        ..guideway_layout::NewPath::default()
    });
    let body = Body::vehicle(2.0, 1.0, 0.5);
    let sweep = |heading| guideway_envelope::Sweep::new(layout.paths.get(0), body, &[heading]);
    assert!(sweep(Heading::Tangential(0.0)).is_none());
    let there = sweep(Heading::Fixed(0.0)).unwrap().bounds();
    assert!(there.max.distance(p(2.5, 1.5)) < 1e-9);
}

#[test]
fn skips_curves_that_are_not_finite() {
    for bad in [f64::NAN, f64::INFINITY] {
        let mut runs = guideway_spline::Runs::default();
        runs.push_line(p(0.0, 0.0), p(bad, 0.0));
        runs.push_line(p(5.0, 0.0), p(6.0, 0.0));
        let mut layout = guideway_layout::Layout::default();
        layout.paths.push(&guideway_layout::NewPath {
            runs: &runs,
            ..guideway_layout::NewPath::default()
        });
        let body = Body::vehicle(2.0, 1.0, 1.0);
        for heading in [Heading::Tangential(0.0), Heading::Fixed(0.0)] {
            let sweep = guideway_envelope::Sweep::new(layout.paths.get(0), body, &[heading]);
            let bounds = sweep.expect("the second curve is finite").bounds();
            assert!(bounds.min.distance(p(4.0, -0.5)) < 1e-9, "{bounds:?}");
        }
    }
}

#[test]
fn brute_force_rejects_wrong_polygons() {
    let bend = vec![[p(0.0, 0.0), p(3.0, 0.0), p(4.0, 1.0), p(4.0, 4.0)]];
    let case = case_of(bend, Heading::Tangential(0.0));
    let good = polygons(&case, 0.05);
    assert_eq!(outside(&case, &good), None);
    assert!(farthest_m(&case, &good, 0.02) <= 0.07);

    let mut gone = good.clone();
    gone.remove(good.len() / 2);
    let hidden = gone.len() == good.len();
    let thin: Vec<ConvexPolygon> = good.iter().map(|polygon| shrunk(polygon, 0.9)).collect();
    assert!(!hidden && outside(&case, &thin).is_some());
    assert!(outside(&case, &good[..good.len() - 1]).is_some());
    let thick: Vec<ConvexPolygon> = good.iter().map(|polygon| shrunk(polygon, 1.2)).collect();
    assert!(farthest_m(&case, &thick, 0.02) > 0.07);

    let mirrored = Case {
        heading: Heading::Tangential(PI),
        ..case.clone()
    };
    assert!(outside(&mirrored, &good).is_some(), "the rear is shorter");
    assert!(farthest_m(&mirrored, &good, 0.02) > 0.07);
}

fn shrunk(polygon: &ConvexPolygon, by: f64) -> ConvexPolygon {
    let center = polygon.bounds().center();
    let points = polygon.points().iter();
    ConvexPolygon::hull(points.map(|&p| center + (p - center) * by)).expect("corners")
}

/// Regression test: brute force starts to turn this vehicle 2 micrometers before the kink.
#[test]
fn kink_matches_brute_force() {
    let (kink, body) = (p(2.683_207, 1.539_235), Body::vehicle(0.2, 1.276_964, 0.0));
    let curve = vec![
        line(p(-3.852_558, -0.768_282), kink),
        line(kink, p(1.343_644, 2.207_579)),
    ];
    let case = Case {
        body,
        ..case_of(curve, Heading::Tangential(-1.545_424_985))
    };
    assert_eq!(outside(&case, &polygons(&case, 0.05)), None);
}
