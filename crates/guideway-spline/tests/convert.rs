//! Converted runs draw the same curve as Cox-de Boor evaluation.

mod common;

use common::{
    P, difference, nurbs, one_way, run_samples, sagitta, scale, segments, span_samples, spans,
    zigzag,
};
use guideway_spline::{
    Conversion, Nurbs, NurbsError, Point, Runs, basis, bezier_to_runs, knots, nurbs_to_runs,
    polyline_to_runs, uniform,
};
use proptest::prelude::*;

/// Hausdorff distance between the samples of both curves, less the error of sampling.
fn distance(curve: &Nurbs, runs: &Runs) -> f64 {
    let samples: Vec<_> = spans(curve)
        .into_iter()
        .map(|s| span_samples(curve, s, 400))
        .collect();
    let drawn: Vec<_> = segments(runs).iter().map(|s| run_samples(s, 12)).collect();
    let slack = samples.iter().chain(&drawn).map(|s| sagitta(s));
    let slack = slack.fold(1e-11 * scale(curve.points()), f64::max);
    let nearest = |from: &[P], to: &[Vec<P>]| {
        let each = from.iter().step_by(3).map(|p| {
            let ways = to.iter().map(|line| one_way(&[*p], line));
            ways.fold(f64::INFINITY, f64::min)
        });
        each.fold(0.0, f64::max)
    };
    let there = samples.iter().map(|s| nearest(s, &drawn));
    let back = drawn.iter().map(|d| nearest(d, &samples));
    there.chain(back).fold(0.0, f64::max) - slack
}

proptest! {
    #[test]
    fn converts_low_degrees_exactly(curve in nurbs(1..=3, Just(false))) {
        let mut runs = Runs::default();
        let done = nurbs_to_runs(&curve, 1e-3, &mut runs);
        prop_assert!(done.exact && done.error_bound_m == 0.0);
        prop_assert_eq!(done.pieces, spans(&curve).len());
        prop_assert!(difference(&curve, &runs) <= 1e-9 * scale(curve.points()));
    }

    #[test]
    fn basis_sums_to_one(curve in nurbs(1..=25, Just(false)), at in 0.0..=1.0) {
        let (first, last) = curve.domain();
        let u = first + (last - first) * at;
        let values = (0..curve.points().len())
            .map(|i| basis::basis(i, curve.degree(), curve.knots(), u));
        let values: Vec<f64> = values.collect();
        prop_assert!(values.iter().all(|&v| v >= 0.0));
        prop_assert!((values.iter().sum::<f64>() - 1.0).abs() < 1e-12);
    }

    #[test]
    fn basis_matches_the_recurrence(curve in nurbs(1..=5, Just(false)), at in 0.0..1.0_f64) {
        let (first, last) = curve.domain();
        let u = (first + (last - first) * at).min(last.next_down());
        for i in 0..curve.points().len() {
            let expected = recurrence(i, curve.degree(), curve.knots(), u);
            let actual = basis::basis(i, curve.degree(), curve.knots(), u);
            let is_near = (actual - expected).abs() < 1e-12;
            prop_assert!(is_near, "N_{} is {}, not {}", i, actual, expected);
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn approximation_stays_within_its_bound(
        curve in prop_oneof![nurbs(1..=5, Just(true)), nurbs(4..=7, Just(false))],
        tolerance in prop_oneof![Just(1e-1), Just(1e-3)],
    ) {
        let mut runs = Runs::default();
        let done = nurbs_to_runs(&curve, tolerance, &mut runs);
        prop_assert!(!done.exact);
        prop_assert!(done.error_bound_m <= tolerance, "{:?}", done);
        prop_assert_eq!(done.pieces, segments(&runs).len());
        let actual = distance(&curve, &runs);
        prop_assert!(actual <= done.error_bound_m, "{} with {:?}", actual, done);
    }
}

/// The recurrence of thesis eq. 3.1, literally.
fn recurrence(i: usize, p: usize, knots: &[f64], u: f64) -> f64 {
    if p == 0 {
        return if knots[i] <= u && u < knots[i + 1] {
            1.0
        } else {
            0.0
        };
    }
    let part = |above: f64, below: f64, n: f64| if below == 0.0 { 0.0 } else { above / below * n };
    part(
        u - knots[i],
        knots[i + p] - knots[i],
        recurrence(i, p - 1, knots, u),
    ) + part(
        knots[i + p + 1] - u,
        knots[i + p + 1] - knots[i + 1],
        recurrence(i + 1, p - 1, knots, u),
    )
}

#[test]
fn comparator_detects_wrong_curves() {
    let points = zigzag(7);
    let weights = vec![1.0, 2.0, 1.0, 0.5, 1.0, 3.0, 1.0];
    let knots = knots::uniform_clamped(3, 7);
    let curve = Nurbs::new(3, knots.clone(), points.clone(), Some(weights.clone())).unwrap();
    let mut runs = Runs::default();
    nurbs_to_runs(&curve, 1e-4, &mut runs);
    assert!(distance(&curve, &runs) <= 1e-4);

    let mut moved = points.clone();
    moved[3].y += 0.01;
    let moved = Nurbs::new(3, knots.clone(), moved, Some(weights)).unwrap();
    assert!(distance(&moved, &runs) > 1e-3);

    let unweighted = Nurbs::new(3, knots, points.clone(), None).unwrap();
    assert!(distance(&unweighted, &runs) > 0.1);

    // A missing part raises the distance in one direction only.
    let mut part = Runs::default();
    runs.iter().skip(1).for_each(|run| part.push(run));
    assert!(distance(&curve, &part) > 0.1);

    let open = Nurbs::new(3, knots::uniform_open(3, 7), points.clone(), None).unwrap();
    runs.clear();
    runs.push(&zigzag(7));
    assert!(difference(&open, &runs) < 1e-12);
    let shifted: Vec<P> = points.iter().map(|p| *p + Point::new(0.0, 1e-6)).collect();
    runs.clear();
    runs.push(&shifted);
    assert!(difference(&open, &runs) > 1e-7);
}

#[test]
fn uniform_cubics_keep_their_control_points() {
    let points = zigzag(9);
    for start in [0.0, 0.1, -1e4] {
        let knots = (0..13).map(|i| start + 0.1 * f64::from(i)).collect();
        let curve = Nurbs::new(3, knots, points.clone(), Some(vec![2.0; 9])).unwrap();
        let mut runs = Runs::default();
        let done = nurbs_to_runs(&curve, 1e-3, &mut runs);
        assert!(done.exact);
        assert_eq!(runs.iter().collect::<Vec<_>>(), [&points[..]]);
    }
    let closed = Nurbs::closed(3, &points).unwrap();
    let mut runs = Runs::default();
    nurbs_to_runs(&closed, 1e-3, &mut runs);
    let run = runs.iter().next().unwrap();
    assert_eq!((runs.len(), run.len()), (1, 12));
    let ends = (
        uniform::start(uniform::segment(run, 0)),
        uniform::end(uniform::segment(run, 8)),
    );
    assert_eq!(ends.0, ends.1);
}

#[test]
fn inner_knot_of_full_multiplicity_breaks_the_curve() {
    let knots = vec![0.0, 0.0, 1.0, 1.0, 2.0, 2.0];
    let corners = [(0.0, 0.0), (1.0, 0.0), (5.0, 5.0), (6.0, 5.0)];
    let points = corners.map(|(x, y)| Point::new(x, y));
    let curve = Nurbs::new(1, knots, points.to_vec(), None).unwrap();
    let mut runs = Runs::default();
    nurbs_to_runs(&curve, 1e-3, &mut runs);
    let expected = [points[0], points[1], points[2], points[3]];
    let ends: Vec<P> = segments(&runs)
        .iter()
        .flat_map(|s| [uniform::start(s), uniform::end(s)])
        .collect();
    assert!(
        ends.iter()
            .zip(expected)
            .all(|(a, b)| a.distance(b) < 1e-12)
    );
    assert_eq!((curve.point(1.0), curve.point(2.0)), (points[2], points[3]));
}

#[test]
fn piece_limit_yields_best_effort_with_its_error_bound() {
    // One dominant weight concentrates the bend in a sliver of the parameter range.
    let points = zigzag(4);
    let weights = vec![1.0, 1e15, 1e-3, 1.0];
    let curve = Nurbs::new(3, knots::uniform_clamped(3, 4), points, Some(weights)).unwrap();
    let mut runs = Runs::default();
    let done = nurbs_to_runs(&curve, 1e-9, &mut runs);
    assert!(done.error_bound_m > 1e-9 && done.pieces <= 1024, "{done:?}");
    assert!(runs.points().iter().all(|p| p.is_finite()));

    // A tolerance of zero ends at the rounding error, before the limit.
    let quartic = zigzag(5);
    let done = bezier_to_runs(&quartic, 0.0, &mut runs).unwrap();
    assert!(done.error_bound_m < 1e-10, "{done:?}");

    let huge = [Point::new(1e308, 0.0), Point::new(-1e308, 1e308)].repeat(3);
    let done = bezier_to_runs(&huge, 1e-3, &mut runs).unwrap();
    assert!(done.error_bound_m > 1e-3);
}

#[test]
fn converts_bezier_curves_of_any_degree() {
    for degree in 1..=25 {
        let points = zigzag(degree + 1);
        let knots = knots::uniform_clamped(degree, degree + 1);
        let curve = Nurbs::new(degree, knots, points.clone(), None).unwrap();
        let mut runs = Runs::default();
        let done = bezier_to_runs(&points, 1e-4, &mut runs).unwrap();
        assert_eq!(done.exact, degree <= 3);
        assert!(done.error_bound_m <= 1e-4, "degree {degree}: {done:?}");
        assert!(distance(&curve, &runs) <= done.error_bound_m);
    }
    let too_many = bezier_to_runs(&zigzag(27), 1e-4, &mut Runs::default());
    assert_eq!(too_many, Err(NurbsError::Degree { actual: 26 }));
    assert!(bezier_to_runs(&[], 1e-4, &mut Runs::default()).is_err());
}

#[test]
fn converts_polylines_exactly() {
    let corners = zigzag(5);
    let mut runs = Runs::default();
    let done = polyline_to_runs(&corners, &mut runs);
    assert_eq!(
        done,
        Conversion {
            exact: true,
            error_bound_m: 0.0,
            pieces: 4
        }
    );
    for (segment, ends) in segments(&runs).iter().zip(corners.windows(2)) {
        for i in 0..=4 {
            let t = f64::from(i) / 4.0;
            assert!(uniform::point(segment, t).distance(ends[0].lerp(ends[1], t)) < 1e-12);
        }
    }
    assert_eq!(polyline_to_runs(&corners[..1], &mut runs).pieces, 0);
}

#[test]
fn errors_state_expected_and_actual_values() {
    let p = zigzag(4);
    let new = |degree, knots: &[f64], weights: Option<&[f64]>| {
        Nurbs::new(
            degree,
            knots.to_vec(),
            p.clone(),
            weights.map(<[f64]>::to_vec),
        )
        .unwrap_err()
        .to_string()
    };
    let k = [0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0];
    assert_eq!(new(0, &k, None), "degree 0 is outside of 1 to 25");
    assert_eq!(
        new(4, &k, None),
        "expected at least 5 control points, found 4"
    );
    assert_eq!(new(3, &k[1..], None), "expected 8 knots, found 7");
    assert_eq!(new(3, &k, Some(&[1.0])), "expected 4 weights, found 1");
    assert_eq!(
        new(3, &k, Some(&[1.0, -1.0, 1.0, 1.0])),
        "weight 1 is -1, expected a finite number from 0 on"
    );
    assert_eq!(
        new(3, &k, Some(&[0.0; 4])),
        "all weights that count from parameter 0 to 1 are 0"
    );
    let mut wrong = k;
    wrong[7] = 0.5;
    assert_eq!(new(3, &wrong, None), "knot 7 is 0.5, expected at least 1");
    wrong[7] = f64::INFINITY;
    assert_eq!(
        new(3, &wrong, None),
        "knot 7 is inf, expected a finite number"
    );
    assert_eq!(
        new(3, &[2.0; 8], None),
        "the domain is [2, 2], expected a positive finite width"
    );
    let infinite = Nurbs::new(3, k.to_vec(), vec![Point::new(f64::NAN, 0.0); 4], None);
    assert_eq!(
        infinite.unwrap_err().to_string(),
        "control point 0 is not finite"
    );
}

/// Ends and middle of the runs of a curve, and those of its evaluation, which are the same.
#[allow(clippy::unwrap_used, reason = "a test may fail by a panic")]
fn ends_and_middle(degree: usize, knots: Vec<f64>, points: &[P], weights: &[f64]) -> [P; 3] {
    let curve = Nurbs::new(degree, knots, points.to_vec(), Some(weights.to_vec())).unwrap();
    let mut runs = Runs::default();
    let done = nurbs_to_runs(&curve, 1e-6, &mut runs);
    assert!(done.error_bound_m <= 1e-6, "{done:?}");
    assert!(distance(&curve, &runs) <= 1e-5);
    let (first, last) = curve.domain();
    let at = [first, (first + last) / 2.0, last].map(|u| curve.point(u));
    let ends = [runs.start().unwrap(), runs.end().unwrap()];
    assert!(ends[0].distance(at[0]) < 1e-9 && ends[1].distance(at[2]) < 1e-9);
    at
}

#[test]
fn end_weights_of_zero_leave_the_limit() {
    let p = zigzag(7);
    let near = |actual: [P; 3], expected: [P; 3]| {
        let pairs = actual.iter().zip(&expected);
        assert!(
            pairs.into_iter().all(|(a, b)| a.distance(*b) < 1e-9),
            "{actual:?}, not {expected:?}"
        );
    };
    // One Bezier curve: u (1 - u) cancels, and a line between the inner points is left.
    let bezier = knots::uniform_clamped(3, 4);
    let line = ends_and_middle(3, bezier.clone(), &p[..4], &[0.0, 1.0, 1.0, 0.0]);
    near(line, [p[1], p[1].lerp(p[2], 0.5), p[2]]);
    // Weights 3 and 1: the middle is nearer to the first.
    let line = ends_and_middle(3, bezier.clone(), &p[..4], &[0.0, 3.0, 1.0, 0.0]);
    near(line, [p[1], p[1].lerp(p[2], 0.25), p[2]]);
    // u^2 cancels, and the last two points are left; then one point.
    let line = ends_and_middle(3, bezier.clone(), &p[..4], &[0.0, 0.0, 1.0, 3.0]);
    near(line, [p[2], p[2].lerp(p[3], 0.5), p[3]]);
    near(
        ends_and_middle(3, bezier, &p[..4], &[0.0, 1.0, 0.0, 0.0]),
        [p[1]; 3],
    );
    // A parabola: u cancels, and 2 (1 - u) P1 + 2 u P2 is left.
    let parabola = knots::uniform_clamped(2, 3);
    let line = ends_and_middle(2, parabola, &p[..3], &[0.0, 1.0, 2.0]);
    near(line, [p[1], p[1].lerp(p[2], 0.5), p[2]]);
    // Several spans, and knots that are not clamped.
    let weights = [0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 0.0];
    let [start, _, end] = ends_and_middle(3, knots::uniform_open(3, 7), &p, &weights);
    assert!(start.distance(p[3]) < 1e-9 && end.distance((p[4] * 1.0 + p[5] * 4.0) * 0.2) < 1e-9);
}

#[test]
fn inner_weights_of_zero_break_the_curve() {
    let p = zigzag(8);
    let weights = [1.0, 1.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0];
    let knots = knots::uniform_clamped(3, 8);
    let (middle, points) = (knots[5], p.clone());
    let curve = Nurbs::new(3, knots, points, Some(weights.to_vec())).unwrap();
    let mut runs = Runs::default();
    nurbs_to_runs(&curve, 1e-6, &mut runs);
    // At the third knot only the three points without a weight count.
    assert!(curve.point(middle).distance(p[5]) < 1e-9);
    assert!(curve.point(middle.next_down()).distance(p[1]) < 1e-9);
    assert!(distance(&curve, &runs) < 1e-5);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn any_weights_of_zero_stay_within_the_bound(
        curve in nurbs(1..=5, Just(true)),
        is_zero in prop::collection::vec(any::<bool>(), 20),
    ) {
        let weights = curve.weights().unwrap_or_default().iter().zip(&is_zero);
        let weights: Vec<f64> = weights.map(|(w, zero)| if *zero { 0.0 } else { *w }).collect();
        let (knots, points) = (curve.knots().to_vec(), curve.points().to_vec());
        let Ok(curve) = Nurbs::new(curve.degree(), knots, points, Some(weights)) else {
            return Ok(());
        };
        let mut runs = Runs::default();
        let done = nurbs_to_runs(&curve, 1e-2, &mut runs);
        prop_assert!(done.error_bound_m.is_finite(), "{:?}", done);
        let actual = distance(&curve, &runs);
        prop_assert!(actual <= done.error_bound_m, "{} with {:?}", actual, done);
    }
}

#[test]
fn weights_of_zero_are_within_the_tolerance() {
    let points = zigzag(7);
    let knots = knots::uniform_clamped(3, 7);
    for weights in [
        [1.0, 0.0, 1.0, 1.0, 0.0, 0.0, 1.0],
        [0.5, 0.0, 0.0, 2.0, 0.0, 0.0, 1.0],
    ] {
        let weights = Some(weights.to_vec());
        let curve = Nurbs::new(3, knots.clone(), points.clone(), weights).unwrap();
        let mut runs = Runs::default();
        let done = nurbs_to_runs(&curve, 1e-4, &mut runs);
        assert!(done.error_bound_m <= 1e-4, "{done:?}");
        assert!(distance(&curve, &runs) < 2e-4);
    }
}
