//! Curves through points are smooth to the second derivative; curves of anchors follow handles.

use guideway_spline::construct::{Anchor, ConstructError, Spacing, curve_of_anchors, interpolate};
use guideway_spline::uniform;
use proptest::prelude::*;

use crate::common::point_within;
use crate::{directions, line, p, samples};

const FREE: [Option<guideway_spline::Point<f64>>; 2] = [None, None];

proptest! {
    #![proptest_config(ProptestConfig::with_cases(256))]

    #[test]
    fn curve_goes_through_all_points_without_kinks(
        points in prop::collection::vec(point_within(50.0), 2..20),
        centripetal in any::<bool>(),
        headings in [prop::option::of(-3.0..3.0_f64), prop::option::of(-3.0..3.0_f64)],
    ) {
        prop_assume!(points.windows(2).all(|w| w[0].distance(w[1]) > 0.1));
        let spacing = if centripetal { Spacing::Centripetal } else { Spacing::ChordLength };
        let given = headings.map(|heading| heading.map(|a| p(a.cos(), a.sin())));
        let runs = interpolate(&points, spacing, given).unwrap();
        let segments: Vec<_> = runs.segments().collect();
        prop_assert_eq!(segments.len(), points.len() - 1);
        let range = |i: usize| {
            let chord = points[i].distance(points[i + 1]);
            if centripetal { chord.sqrt() } else { chord }
        };
        let size = samples(&runs, 4).iter().map(|at| at.norm()).fold(1.0, f64::max);
        for (i, segment) in segments.iter().enumerate() {
            prop_assert!(uniform::start(segment).distance(points[i]) < 1e-11 * size);
            prop_assert!(uniform::end(segment).distance(points[i + 1]) < 1e-11 * size);
            let Some(next) = segments.get(i + 1) else { continue };
            // Derivatives by the common parameter.
            let (h, k) = (range(i), range(i + 1));
            let ends = uniform::derivative(segment, 1.0) * (1.0 / h);
            let begins = uniform::derivative(next, 0.0) * (1.0 / k);
            prop_assert!(ends.distance(begins) < 1e-9 * size / h.min(k), "{ends:?} {begins:?}");
            let ends = uniform::second_derivative(segment, 1.0) * (1.0 / (h * h));
            let begins = uniform::second_derivative(next, 0.0) * (1.0 / (k * k));
            prop_assert!(ends.distance(begins) < 1e-8 * size / (h * k).min(h * h).min(k * k));
        }
        let found = directions(&runs);
        let bends = [(segments[0], 0.0), (segments[segments.len() - 1], 1.0)];
        for ((given, found), (segment, t)) in given.iter().zip(found).zip(bends) {
            match given {
                Some(given) => prop_assert!(given.distance(found) < 1e-6, "{found:?}"),
                None => prop_assert!(uniform::second_derivative(segment, t).norm() < 1e-9 * size),
            }
        }
    }
}

#[test]
fn two_points_give_a_line() {
    let ends = [p(1.0, 2.0), p(7.0, -3.0)];
    let runs = interpolate(&ends, Spacing::default(), FREE).unwrap();
    let straight = samples(&line(ends[0], ends[1]), 8);
    let found = samples(&runs, 8);
    assert!(
        found
            .iter()
            .zip(&straight)
            .all(|(a, b)| a.distance(*b) < 1e-12)
    );
}

#[test]
fn points_of_a_circle_give_nearly_a_circle() {
    let at = |i: usize| {
        let angle = i as f64 * std::f64::consts::PI / 8.0;
        p(10.0 * angle.cos(), 10.0 * angle.sin())
    };
    let points: Vec<_> = (0..=8).map(at).collect();
    let given = [Some(p(0.0, 1.0)), Some(p(0.0, -1.0))];
    let runs = interpolate(&points, Spacing::ChordLength, given).unwrap();
    for at in samples(&runs, 32) {
        assert!((at.norm() - 10.0).abs() < 1e-2, "{at:?}");
    }
}

#[test]
fn anchors_give_their_beziers() {
    let anchors = [
        Anchor::smooth(p(0.0, 0.0), p(1.0, 0.0)),
        Anchor::smooth(p(4.0, 4.0), p(0.0, 2.0)),
        Anchor {
            at: p(0.0, 8.0),
            before: p(1.0, 8.0),
            after: p(9.0, 9.0),
        },
    ];
    let runs = curve_of_anchors(&anchors).unwrap();
    let beziers: Vec<_> = runs.segments().map(uniform::to_bezier).collect();
    let expected = [
        [p(0.0, 0.0), p(1.0, 0.0), p(4.0, 2.0), p(4.0, 4.0)],
        [p(4.0, 4.0), p(4.0, 6.0), p(1.0, 8.0), p(0.0, 8.0)],
    ];
    assert_eq!(beziers.len(), 2);
    for (found, expected) in beziers.iter().flatten().zip(expected.iter().flatten()) {
        assert!(found.distance(*expected) < 1e-12);
    }
}

#[test]
fn errors_name_what_is_missing() {
    let (a, b) = (p(0.0, 0.0), p(1.0, 0.0));
    let of = |points: &[_], ends| interpolate(points, Spacing::default(), ends).unwrap_err();
    assert_eq!(of(&[a], FREE), ConstructError::TooFewPoints { actual: 1 });
    assert_eq!(
        of(&[a, b, b], FREE),
        ConstructError::EqualPoints { index: 2, at: b }
    );
    assert_eq!(of(&[a, b], [Some(a), None]), ConstructError::NoDirection);
    assert_eq!(
        of(&[a, p(f64::INFINITY, 0.0)], FREE),
        ConstructError::NotFinite
    );
    assert_eq!(
        of(&[a, b], [None, Some(p(f64::NAN, 0.0))]),
        ConstructError::NotFinite
    );
    let anchor = Anchor::smooth(a, b);
    let twice = curve_of_anchors(&[anchor, anchor]);
    assert_eq!(twice, Err(ConstructError::EqualPoints { index: 1, at: a }));
    let lost = Anchor::smooth(b, p(f64::NAN, 0.0));
    assert_eq!(
        curve_of_anchors(&[anchor, lost]),
        Err(ConstructError::NotFinite)
    );
}
