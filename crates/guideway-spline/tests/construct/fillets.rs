//! Fillets touch both curves, and an error names the largest radius that fits.

use guideway_spline::construct::{ConstructError, Fillet, fillet};
use guideway_spline::{Runs, run_length};
use proptest::prelude::*;

use crate::common::{P, distance_to_polyline};
use crate::{directions, line, p, samples};

fn length(runs: &Runs) -> f64 {
    runs.iter().map(|run| run_length(run, 1e-9)).sum()
}

fn unit(angle: f64) -> P {
    p(angle.cos(), angle.sin())
}

/// Two curves that meet in the origin, where they turn by an angle; each one bends in its middle.
fn bent(turn: f64, sizes: [f64; 2], bends: [f64; 2]) -> [Runs; 2] {
    let arm = |direction: P, size: f64, bend: f64| {
        let side = p(-direction.y, direction.x);
        let at = |along: f64, aside: f64| direction * (along * size) + side * (aside * size);
        let mut runs = Runs::default();
        runs.push_bezier(&[at(0.0, 0.0), at(0.3, 0.0), at(0.6, bend), at(1.0, bend)]);
        runs
    };
    let first = arm(unit(std::f64::consts::PI), sizes[0], bends[0]);
    [first.reversed(), arm(unit(turn), sizes[1], bends[1])]
}

/// Checks that the parts follow each other smoothly and lie on the curves.
fn check(found: &Fillet, curves: &[Runs; 2], radius: f64) -> Result<(), TestCaseError> {
    let mut arc = Runs::default();
    found.arc.push(1e-9, &mut arc);
    prop_assert!(
        (found.arc.radius() - radius).abs() < 1e-6 * radius,
        "{}",
        found.arc.radius()
    );
    for (rest, end, begin) in [(&found.before, 1, 0), (&found.after, 0, 1)] {
        if rest.is_empty() {
            continue;
        }
        let meeting = [rest.end(), rest.start()][begin].expect("a rest");
        let arc_end = [arc.start(), arc.end()][begin].expect("an arc");
        prop_assert!(meeting.distance(arc_end) < 1e-9);
        let (of_rest, of_arc) = (directions(rest)[end], directions(&arc)[begin]);
        prop_assert!(of_rest.distance(of_arc) < 1e-6, "{of_rest:?} {of_arc:?}");
    }
    for (rest, whole) in [(&found.before, &curves[0]), (&found.after, &curves[1])] {
        let whole = samples(whole, 2048);
        for at in samples(rest, 8) {
            prop_assert!(distance_to_polyline(at, &whole) < 1e-4);
        }
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(128))]

    #[test]
    fn lines_are_cut_at_the_tangent_length(
        turn in 0.02..3.0_f64,
        left in any::<bool>(),
        radius in 0.05..5.0,
        far in prop_oneof![Just(0.0), Just(1e5)],
    ) {
        let turn = if left { turn } else { -turn };
        let corner = p(far, far);
        let tangent = radius * (0.5 * turn.abs()).tan();
        let size = tangent * 1.5 + 1.0;
        let [before, after] = [corner - p(size, 0.0), corner + unit(turn) * size];
        let curves = [line(before, corner), line(corner, after)];
        let found = fillet(&curves[0], &curves[1], radius).unwrap();
        prop_assert!((length(&found.before) - (size - tangent)).abs() < 1e-7);
        prop_assert!((length(&found.after) - (size - tangent)).abs() < 1e-7);
        prop_assert!((found.arc.sweep_rad() - turn).abs() < 1e-6);
        if far == 0.0 {
            check(&found, &curves, radius)?;
        }
    }

    #[test]
    fn largest_radius_of_lines_fits_and_hardly_more(
        turn in 0.1..3.0_f64, sizes in [0.5..9.0_f64, 0.5..9.0],
    ) {
        let corner = p(0.0, 0.0);
        let curves = [line(p(-sizes[0], 0.0), corner), line(corner, unit(turn) * sizes[1])];
        let expected = sizes[0].min(sizes[1]) / (0.5 * turn).tan();
        let large = fillet(&curves[0], &curves[1], 1.5 * expected);
        let Err(ConstructError::TooLarge { largest, .. }) = large else {
            return Err(TestCaseError::fail("it fits"));
        };
        prop_assert!((largest - expected).abs() <= 1e-5 * expected, "{largest} {expected}");
        let found = fillet(&curves[0], &curves[1], largest);
        prop_assert!(found.is_ok());
    }

    #[test]
    fn arc_touches_bent_curves(
        turn in 0.3..2.5_f64,
        sizes in [4.0..9.0, 4.0..9.0],
        bends in [-0.3..0.3, -0.3..0.3],
        radius in 0.05..20.0,
    ) {
        let curves = bent(turn, sizes, bends);
        match fillet(&curves[0], &curves[1], radius) {
            Ok(found) => check(&found, &curves, radius)?,
            Err(ConstructError::TooLarge { largest, .. }) => {
                prop_assert!(largest > 0.05 && largest < radius, "{largest}");
                check(&fillet(&curves[0], &curves[1], largest).unwrap(), &curves, largest)?;
            }
            Err(other) => return Err(TestCaseError::fail(other.to_string())),
        }
    }
}

#[test]
fn right_angle_of_radius_two() {
    let (first, second) = (
        line(p(0.0, 0.0), p(5.0, 0.0)),
        line(p(5.0, 0.0), p(5.0, 4.0)),
    );
    let found = fillet(&first, &second, 2.0).unwrap();
    assert!(found.before.end().unwrap().distance(p(3.0, 0.0)) < 1e-12);
    assert!(found.after.start().unwrap().distance(p(5.0, 2.0)) < 1e-12);
    assert!((found.arc.length() - std::f64::consts::PI).abs() < 1e-11);
    // The arc may use up a curve.
    let whole = fillet(&first, &second, 4.0).unwrap();
    assert!(whole.after.is_empty() && !whole.before.is_empty());
    let error = fillet(&first, &second, 6.0).unwrap_err().to_string();
    let expected = "a radius of 6 does not fit; the largest one that does is 3.999";
    assert!(
        error == expected || error == expected.replace("3.999", "4.000"),
        "{error}"
    );
}

#[test]
fn corners_without_a_fillet_are_named() {
    let first = line(p(0.0, 0.0), p(5.0, 0.0));
    let on = line(p(5.0, 0.0), p(9.0, 0.0));
    assert_eq!(fillet(&first, &on, 1.0), Err(ConstructError::NoCorner));
    assert_eq!(
        fillet(&first, &first.reversed(), 1.0),
        Err(ConstructError::TurnsBack)
    );
    let up = line(p(5.0, 0.0), p(5.0, 9.0));
    for radius in [0.0, -1.0] {
        assert_eq!(
            fillet(&first, &up, radius),
            Err(ConstructError::Radius { radius })
        );
    }
    assert_eq!(
        fillet(&first, &up, f64::NAN),
        Err(ConstructError::NotFinite)
    );
    let none = fillet(&Runs::default(), &up, 1.0);
    assert_eq!(none, Err(ConstructError::TooFewPoints { actual: 0 }));
    let dot = line(p(5.0, 0.0), p(5.0, 0.0));
    assert_eq!(fillet(&first, &dot, 1.0), Err(ConstructError::NoDirection));
}
