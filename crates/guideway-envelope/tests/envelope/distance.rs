//! Compares the closest approach of sweeps with brute force.

use guideway_envelope::{ClosestApproach, ExemptZone, Heading, ProximityQuery, SweepTree};
use proptest::prelude::*;

use crate::brute::{Pose, apart, poses};
use crate::random::{Case, Curve, P, case, p};

const TOLERANCE_M: f64 = 0.02;
const STEP_M: f64 = 0.1;

fn nearest(
    a: &Case,
    b: &Case,
    threshold_m: f64,
    exempt_zones: &[ExemptZone],
) -> Option<ClosestApproach> {
    let (a, b) = (a.sweep(), b.sweep());
    let question = ProximityQuery {
        threshold_m,
        tolerance_m: TOLERANCE_M,
        exempt_zones,
        max_tests: u64::MAX,
    };
    let nearest = SweepTree::new(a).nearest(&mut SweepTree::new(b), &question, &mut 0);
    nearest.expect("there is no limit")
}

fn moved(case: &Case, by: P) -> Case {
    let curve = case.curve.0.iter().map(|b| b.map(|p| p + by)).collect();
    Case {
        curve: Curve(curve),
        ..case.clone()
    }
}

/// Smallest distance of two vehicles over the pairs of poses that `counts` accepts.
fn brute(a: &Case, b: &Case, counts: impl Fn(Pose, Pose) -> bool) -> f64 {
    let (pa, pb) = (poses(a, STEP_M), poses(b, STEP_M));
    let pairs = pa.iter().flat_map(|&p| pb.iter().map(move |&q| (p, q)));
    let counted = pairs.filter(|&(p, q)| counts(p, q));
    let each = counted.map(|(p, q)| apart((&a.body, p), (&b.body, q)));
    each.fold(f64::INFINITY, f64::min)
}

/// Returns `true` if an answer agrees with the distance by brute force, whose poses are `STEP_M`
/// apart.
fn agrees(answer: Option<ClosestApproach>, brute_m: f64, threshold_m: f64) -> bool {
    match answer {
        // Polygons contain the vehicles, so their distance is never larger.
        Some(ClosestApproach { distance_m, .. }) => {
            distance_m <= brute_m + 1e-6 && brute_m <= distance_m + TOLERANCE_M + 2.0 * STEP_M
        }
        None => brute_m >= threshold_m - 1e-6,
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(32))]

    #[test]
    fn closest_approach_matches_brute_force(
        a in case(),
        b in case(),
        x in 0.0..14.0,
        below in 0.0..4.0,
    ) {
        let b = moved(&b, p(x, 0.0));
        let brute_m = brute(&a, &b, |_, _| true);
        let answer = nearest(&a, &b, below, &[]);
        prop_assert!(agrees(answer, brute_m, below), "{:?} {}", answer, brute_m);
    }

    #[test]
    fn ignores_poses_in_an_exempt_zone(
        a in case(),
        b in case(),
        below in 0.0..2.0,
        radius in 0.5..4.0,
    ) {
        let start = |case: &Case| case.curve.0[0][0];
        let b = moved(&b, start(&a) - start(&b));
        let center = start(&a);
        let zone = ExemptZone { centers_m: [center; 2], radius_m: radius };
        let answer = nearest(&a, &b, below, &[zone]);
        let beyond = |radius: f64| {
            move |p: Pose, q: Pose| p.at.distance(center) > radius || q.at.distance(center) > radius
        };
        // Poses are exact to a step, and parts are cut to the tolerance.
        let (all, certain) = (
            brute(&a, &b, beyond(radius - TOLERANCE_M - STEP_M)),
            brute(&a, &b, beyond(radius + TOLERANCE_M)),
        );
        if let Some(found) = answer {
            let bound = found.distance_m + TOLERANCE_M + 2.0 * STEP_M;
            prop_assert!(all <= bound, "{:?} {}", found, all);
            prop_assert!(found.distance_m <= certain + 1e-6);
        } else {
            prop_assert!(certain >= below - 1e-6, "{}", certain);
        }
    }
}

fn straight(from: P, to: P) -> Case {
    let line = [from, from.lerp(to, 1.0 / 3.0), from.lerp(to, 2.0 / 3.0), to];
    Case {
        curve: Curve(vec![line]),
        body: guideway_envelope::Body::vehicle(2.0, 1.0, 1.0),
        heading: Heading::Tangential(0.0),
    }
}

#[test]
fn distance_of_parallel_paths_is_that_of_their_sides() {
    let (a, b) = (
        straight(p(0.0, 0.0), p(20.0, 0.0)),
        straight(p(30.0, 1.3), p(5.0, 1.3)),
    );
    let found = nearest(&a, &b, 0.5, &[]).expect("they are 0.3 m apart");
    assert!((found.distance_m - 0.3).abs() < 1e-9);
    assert_eq!(nearest(&a, &b, 0.29, &[]), None);
}

#[test]
fn reports_the_position_of_a_crossing() {
    let (a, b) = (
        straight(p(0.0, 0.0), p(40.0, 0.0)),
        straight(p(31.0, -30.0), p(31.0, 30.0)),
    );
    let found = nearest(&a, &b, 0.0, &[]).expect("they cross");
    assert_eq!(found.distance_m, 0.0);
    for place in found.positions {
        assert!(place.distance(p(31.0, 0.0)) < 4.0, "{place:?}");
    }
}

#[test]
fn kink_within_a_degree_of_180_is_a_cusp() {
    // After a cusp the vehicle comes back in reverse, so its front, 1 m ahead of the reference
    // point, is farther from the wall.
    let wall = straight(p(-4.0, -9.0), p(-4.0, 9.0));
    for (off_m, is_cusp) in [(0.08, true), (0.12, false)] {
        let there = straight(p(0.0, 0.0), p(6.0, 0.0));
        let back = straight(p(6.0, 0.0), p(0.0, off_m));
        let case = Case {
            curve: Curve(vec![there.curve.0[0], back.curve.0[0]]),
            body: guideway_envelope::Body::vehicle(1.0, 0.2, 0.0),
            ..there
        };
        let answer = nearest(&case, &wall, 4.0, &[]);
        let brute_m = brute(&case, &wall, |_, _| true);
        assert!(agrees(answer, brute_m, 4.0), "{answer:?} {brute_m}");
        assert_eq!(brute_m > 3.4, is_cusp, "{brute_m}");
    }
}

#[test]
fn agrees_rejects_wrong_answers() {
    let answer = |distance_m| {
        Some(ClosestApproach {
            distance_m,
            positions: [p(0.0, 0.0); 2],
        })
    };
    assert!(agrees(answer(0.3), 0.3, 0.5) && agrees(None, 0.6, 0.5));
    assert!(!agrees(answer(0.4), 0.3, 0.5), "too far");
    assert!(!agrees(answer(0.0), 0.3, 0.5), "too near");
    assert!(!agrees(None, 0.4, 0.5), "missed");
}
