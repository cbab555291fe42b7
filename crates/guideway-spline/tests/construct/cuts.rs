//! Cuts and joins keep the curve; crossings lie on both curves.

use guideway_spline::construct::{
    ConstructError, Parameter, crossings, cut, join, nearest_parameter, parameter_at_length,
    point_at,
};
use guideway_spline::{Overlap, Runs, run_length, segment_length, uniform};
use proptest::prelude::*;

use crate::common::{P, point_within, run, scale};
use crate::{line, p, samples};

/// Curves of one to three runs that meet.
fn runs() -> impl Strategy<Value = Runs> {
    prop::collection::vec(run(), 1..4).prop_map(|all| {
        let mut runs = Runs::default();
        for run in &all {
            let start = uniform::start(uniform::segment(run, 0));
            let by = runs.end().unwrap_or(start) - start;
            let moved: Vec<P> = run.iter().map(|point| *point + by).collect();
            runs.push(&moved);
        }
        runs
    })
}

/// The parameter at a share of all segments.
fn at_share(runs: &Runs, share: f64) -> Parameter {
    let numbers = |(run, points): (usize, &[P])| (0..points.len() - 3).map(move |s| (run, s));
    let all: Vec<_> = runs.iter().enumerate().flat_map(numbers).collect();
    let at = share * all.len() as f64;
    let index = (at as usize).min(all.len() - 1);
    let (run, segment) = all[index];
    let t = at - index as f64;
    Parameter { run, segment, t }
}

fn length(runs: &Runs) -> f64 {
    runs.iter().map(|run| run_length(run, 1e-9)).sum()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(256))]

    #[test]
    fn parts_are_the_curve(runs in runs(), share in 0.0..=1.0) {
        let at = at_share(&runs, share);
        let place = point_at(&runs, at).unwrap();
        let slack = 1e-14 * scale(runs.points()) + 2e-6;
        let Some([before, after]) = cut(&runs, at) else {
            let lengths: Vec<f64> = runs.segments().map(|s| segment_length(s, 1e-9)).collect();
            let index = (share * lengths.len() as f64) as usize;
            let before: f64 = lengths[..index.min(lengths.len())].iter().sum();
            let after: f64 = lengths.iter().skip(index + 1).sum();
            prop_assert!(before.min(after) <= 1e-5, "{before} {after}");
            return Ok(());
        };
        prop_assert!(before.end().unwrap().distance(place) <= slack);
        prop_assert!(after.start().unwrap().distance(place) <= slack);
        prop_assert!(before.start().unwrap().distance(runs.start().unwrap()) <= slack);
        let end = runs.end().unwrap();
        prop_assert!(after.end().unwrap().distance(end) <= slack);
        let (whole, parts) = (length(&runs), length(&before) + length(&after));
        prop_assert!((whole - parts).abs() <= 1e-4 + 1e-12 * whole, "{whole} {parts}");
        for at in samples(&before, 3).into_iter().chain(samples(&after, 3)) {
            let (_, nearest) = nearest_parameter(&runs, at, 1e-9).unwrap();
            prop_assert!(nearest.distance <= slack);
        }
    }

    #[test]
    fn joined_parts_are_the_curve_again(
        run in prop::collection::vec(point_within(20.0), 4..12),
        share in 0.0..1.0,
    ) {
        let mut runs = Runs::default();
        runs.push(&run);
        let Some([before, after]) = cut(&runs, at_share(&runs, share)) else { return Ok(()) };
        let joined = join(&before, &after, 1e-6).unwrap();
        prop_assert_eq!(joined.segments().count(), runs.segments().count());
        for (found, expected) in joined.segments().zip(runs.segments()) {
            for t in [0.0, 0.3, 1.0] {
                let [found, expected] = [found, expected].map(|s| uniform::point(s, t));
                prop_assert!(found.distance(expected) <= 2e-6, "{found:?} {expected:?}");
            }
        }
    }

    #[test]
    fn reversed_curve_has_the_same_points(runs in runs()) {
        let back = runs.reversed();
        prop_assert_eq!(&back.reversed(), &runs);
        prop_assert_eq!(back.len(), runs.len());
        let reach = 1e-14 * scale(runs.points());
        prop_assert!(back.start().unwrap().distance(runs.end().unwrap()) <= reach);
        prop_assert!(back.end().unwrap().distance(runs.start().unwrap()) <= reach);
        prop_assert!((length(&back) - length(&runs)).abs() < 1e-6);
    }

    #[test]
    fn crossings_lie_on_both_curves(
        first in prop::collection::vec(point_within(20.0), 4..9),
        second in prop::collection::vec(point_within(20.0), 4..9),
    ) {
        let of = |points: &[P]| { let mut runs = Runs::default(); runs.push(points); runs };
        let (first, second) = (of(&first), of(&second));
        let found = crossings(&first, &second).unwrap();
        for crossing in &found {
            let [a, b] = [(&first, 0), (&second, 1)]
                .map(|(runs, i)| point_at(runs, crossing.at[i]).unwrap());
            prop_assert!(a.distance(crossing.position) < 1e-12, "{a:?}");
            prop_assert!(b.distance(a) < 2e-5, "{a:?} {b:?}");
        }
        // Polylines with small steps cross at least about as often.
        let (a, b) = (samples(&first, 200), samples(&second, 200));
        let crosses = |[p, q]: &[P; 2], [r, s]: &[P; 2]| {
            let side = |a: P, b: P, c: P| (b - a).cross(c - a);
            side(*p, *q, *r) * side(*p, *q, *s) < 0.0 && side(*r, *s, *p) * side(*r, *s, *q) < 0.0
        };
        for one in a.array_windows() {
            for two in b.array_windows() {
                if crosses(one, two) {
                    let is_known = found.iter().any(|c| c.position.distance(one[0]) < 0.5);
                    prop_assert!(is_known, "{one:?} {found:?}");
                }
            }
        }
    }
}

#[test]
fn half_of_the_length() {
    let mut runs = line(p(0.0, 0.0), p(10.0, 0.0));
    runs.push_line(p(10.0, 0.0), p(10.0, 2.0));
    let at = |length| point_at(&runs, parameter_at_length(&runs, length, 1e-9).unwrap()).unwrap();
    assert!(at(6.0).distance(p(6.0, 0.0)) < 1e-8);
    assert!(at(11.5).distance(p(10.0, 1.5)) < 1e-8);
    assert!(at(99.0).distance(p(10.0, 2.0)) < 1e-8);
    assert_eq!(parameter_at_length(&Runs::default(), 1.0, 1e-9), None);
    let mut bend = Runs::default();
    bend.push_bezier(&[p(0.0, 0.0), p(8.0, 0.0), p(8.0, 0.5), p(8.0, 6.0)]);
    let half = parameter_at_length(&bend, 0.5 * length(&bend), 1e-9).unwrap();
    let [before, after] = cut(&bend, half).unwrap();
    assert!((length(&before) - length(&after)).abs() < 1e-6);
}

#[test]
fn ends_are_no_place_to_cut() {
    let straight = line(p(0.0, 0.0), p(4.0, 0.0));
    for (segment, t) in [(0, 0.0), (0, 1.0), (0, 1e-9), (1, 0.5)] {
        let at = Parameter { run: 0, segment, t };
        assert_eq!(cut(&straight, at), None);
    }
    let nowhere = Parameter {
        run: 3,
        segment: 0,
        t: 0.5,
    };
    assert_eq!(
        (cut(&straight, nowhere), point_at(&straight, nowhere)),
        (None, None)
    );
}

#[test]
fn join_closes_small_gaps_and_refuses_wide_ones() {
    let first = line(p(0.0, 0.0), p(4.0, 0.0));
    let second = line(p(4.002, 0.0), p(4.0, 5.0));
    let joined = join(&first, &second, 0.01).unwrap();
    assert_eq!(joined.segments().count(), 2);
    let parts: Vec<_> = joined.iter().collect();
    assert!(uniform::start(parts[1].first_chunk().unwrap()).distance(p(4.0, 0.0)) < 1e-12);
    assert!(joined.end().unwrap().distance(p(4.0, 5.0)) < 1e-12);
    let error = join(&first, &second, 0.001).unwrap_err();
    assert_eq!(
        error.to_string(),
        "the curves are 0.0020 apart; at most 0.001 is allowed"
    );
    let none = join(&first, &Runs::default(), 1.0);
    assert_eq!(none, Err(ConstructError::TooFewPoints { actual: 0 }));
    let straight = join(&first, &line(p(4.0, 0.0), p(9.0, 0.0)), 0.0).unwrap();
    assert_eq!(straight, line(p(0.0, 0.0), p(9.0, 0.0)));
}

#[test]
fn curves_on_each_other_have_no_crossings() {
    let mut bend = Runs::default();
    bend.push_bezier(&[p(0.0, 0.0), p(8.0, 0.0), p(8.0, 0.5), p(8.0, 6.0)]);
    let half = parameter_at_length(&bend, 5.0, 1e-9).unwrap();
    let [part, _] = cut(&bend, half).unwrap();
    assert_eq!(crossings(&bend, &part), Err(Overlap));
}
