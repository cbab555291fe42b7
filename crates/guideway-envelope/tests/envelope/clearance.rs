//! Checks clearance findings on small layouts and against brute force.

use std::collections::BTreeSet;

use guideway_envelope::{Body, ClearanceOptions, EnvelopeSource, Walls, check_clearance};
use guideway_layout::{Code, Diagnostics, Layout, NewPath};
use guideway_spline::{Point, Runs};
use proptest::prelude::*;

use crate::brute::{apart, poses};
use crate::random::{Case, Curve, P, case, p};

const VEHICLE: EnvelopeSource = EnvelopeSource::Vehicle(Body {
    front_m: 1.0,
    rear_m: 1.0,
    left_m: 0.5,
    right_m: 0.5,
});

/// A layout with paths named a, b, c, ...
fn layout(curves: &[Curve]) -> Layout {
    let mut layout = Layout::default();
    for (i, curve) in curves.iter().enumerate() {
        let mut runs = Runs::default();
        curve.0.iter().for_each(|bezier| runs.push_bezier(bezier));
        let name = char::from(b'a' + i as u8).to_string();
        layout.paths.push(&NewPath {
            id: &name,
            runs: &runs,
            ..NewPath::default()
        });
    }
    layout
}

fn polyline(points: &[P]) -> Curve {
    let line = |ends: &[P]| {
        let at = |t| ends[0].lerp(ends[1], t);
        [ends[0], at(1.0 / 3.0), at(2.0 / 3.0), ends[1]]
    };
    Curve(points.windows(2).map(line).collect())
}

fn options(clearance_m: f64) -> ClearanceOptions {
    ClearanceOptions {
        clearance_m,
        ..ClearanceOptions::default()
    }
}

/// The pairs of paths in findings, such as `ab`.
fn pairs(found: &Diagnostics) -> BTreeSet<String> {
    let letter = |text: &str| text.split('"').nth(1).expect("a name in quotes").to_owned();
    let of_pairs = found.iter().filter(|f| f.code == Code::Clearance);
    let pair = of_pairs.map(|f| letter(&f.place.element) + &letter(&f.message));
    pair.collect()
}

fn found(curves: &[Curve], options: &ClearanceOptions) -> BTreeSet<String> {
    pairs(&check_clearance(&layout(curves), VEHICLE, None, options).findings)
}

fn none() -> BTreeSet<String> {
    BTreeSet::new()
}

fn one(pair: &str) -> BTreeSet<String> {
    BTreeSet::from([pair.to_owned()])
}

#[test]
fn finds_close_lanes_and_crossings_without_a_node() {
    let lanes = [
        polyline(&[p(0.0, 0.0), p(30.0, 0.0)]),
        polyline(&[p(0.0, 1.2), p(30.0, 1.2)]),
    ];
    assert_eq!(found(&lanes, &options(0.3)), one("ab"));
    assert_eq!(found(&lanes, &options(0.1)), none());
    let crossing = [
        polyline(&[p(0.0, 0.0), p(30.0, 0.0)]),
        polyline(&[p(15.0, -10.0), p(15.0, 10.0)]),
    ];
    let all = check_clearance(&layout(&crossing), VEHICLE, None, &options(0.0));
    assert_eq!(pairs(&all.findings), one("ab"));
    let finding = all.findings.iter().next().unwrap();
    assert!(
        finding.message.starts_with("vehicles overlap with"),
        "{}",
        finding.message
    );
    assert_eq!((all.work.paths, all.work.candidates), (2, 1));
    assert!(all.work.tests > 0);
}

#[test]
fn ignores_paths_near_their_common_node() {
    let center = p(20.0, 0.0);
    let star = [p(0.0, 0.0), p(20.0, 20.0), p(40.0, 0.0), p(20.0, -20.0)];
    let star = star.map(|end| polyline(&[end, center]));
    assert_eq!(found(&star, &options(0.5)), none());
    // The same road in both directions, and twice.
    let road = [
        polyline(&[p(0.0, 0.0), p(30.0, 0.0)]),
        polyline(&[p(30.0, 0.0), p(0.0, 0.0)]),
        polyline(&[p(0.0, 0.0), p(30.0, 0.0)]),
    ];
    assert_eq!(found(&road, &options(0.5)), none());
    // A short path between two others.
    let chain = [
        polyline(&[p(0.0, 0.0), p(20.0, 0.0)]),
        polyline(&[p(20.0, 0.0), p(20.5, 0.0)]),
        polyline(&[p(20.5, 0.0), p(40.0, 0.0)]),
    ];
    assert_eq!(found(&chain, &options(0.5)), none());
    let gap = [chain[0].clone(), chain[2].clone()];
    assert_eq!(
        found(&gap, &options(0.5)),
        one("ab"),
        "no path connects them"
    );
}

#[test]
fn finds_paths_that_stay_close_beyond_their_node() {
    // Two lanes leave one node and continue side by side.
    let lanes = [
        polyline(&[p(0.0, 0.0), p(30.0, 0.0)]),
        polyline(&[p(0.0, 0.0), p(3.0, 1.2), p(30.0, 1.2)]),
    ];
    assert_eq!(found(&lanes, &options(0.3)), one("ab"));
    let far = ClearanceOptions {
        near_joint_m: Some(31.0),
        ..options(0.3)
    };
    assert_eq!(found(&lanes, &far), none());
    // Lanes connected by a short path are too close beyond it.
    let ladder = [
        polyline(&[p(0.0, 0.0), p(30.0, 0.0)]),
        polyline(&[p(0.0, 1.0), p(30.0, 1.0)]),
        polyline(&[p(0.0, 0.0), p(0.0, 1.0)]),
    ];
    assert_eq!(found(&ladder, &options(0.3)), one("ab"));
}

#[test]
fn ignores_paths_of_different_levels() {
    let lanes = [
        polyline(&[p(0.0, 0.0), p(30.0, 0.0)]),
        polyline(&[p(0.0, 0.5), p(30.0, 0.5)]),
    ];
    let mut layout = layout(&lanes);
    layout.paths.set_levels(vec![0, 1]);
    let found =
        |layout: &Layout| pairs(&check_clearance(layout, VEHICLE, None, &options(0.3)).findings);
    assert_eq!(found(&layout), none());
    layout.paths.set_levels(vec![1, 1]);
    assert_eq!(found(&layout), one("ab"));
}

#[test]
fn finds_and_names_close_walls() {
    let paths = layout(&[
        polyline(&[p(0.0, 0.0), p(30.0, 0.0)]),
        polyline(&[p(0.0, 9.0), p(30.0, 9.0)]),
    ]);
    let plan = layout(&[
        polyline(&[p(5.0, 0.7), p(25.0, 0.9)]),
        polyline(&[p(10.0, -0.6), p(10.0, -5.0)]),
        polyline(&[p(0.0, 20.0), p(30.0, 20.0)]),
    ]);
    let walls = Walls::new(&plan, |_| true);
    let all = check_clearance(&paths, VEHICLE, Some(&walls), &options(0.25));
    assert_eq!(all.findings.count(Code::WallClearance), 1);
    let finding = all.findings.iter().next().unwrap();
    assert_eq!(finding.place.element, "path \"a\"");
    let message = &finding.message;
    assert!(
        message.contains("within 0.10 m of path \"b\"") && message.contains("another line"),
        "{message}"
    );
    let near = |clearance_m| {
        let found = check_clearance(&paths, VEHICLE, Some(&walls), &options(clearance_m)).findings;
        found.count(Code::WallClearance)
    };
    assert_eq!((near(0.05), near(8.0), near(11.5)), (0, 2, 2));
    let some = Walls::new(&plan, |row| row == 2);
    let found = check_clearance(&paths, VEHICLE, Some(&some), &options(0.25)).findings;
    assert_eq!((some.len(), found.count(Code::WallClearance)), (1, 0));
}

/// Pairs of paths with poses closer than `below_m`; poses are `step_m` apart.
fn brute(cases: &[Case], threshold_m: f64, step_m: f64) -> BTreeSet<String> {
    let all: Vec<_> = cases.iter().map(|case| poses(case, step_m)).collect();
    let near = |i: usize, j: usize| {
        all[i].iter().any(|&a| {
            let mut others = all[j].iter();
            others.any(|&b| apart((&cases[i].body, a), (&cases[j].body, b)) < threshold_m)
        })
    };
    let name = |i: usize| char::from(b'a' + i as u8).to_string();
    let pairs = (0..cases.len()).flat_map(|i| (i + 1..cases.len()).map(move |j| (i, j)));
    let near = pairs.filter(|&(i, j)| near(i, j));
    near.map(|(i, j)| name(i) + &name(j)).collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(6))]

    #[test]
    fn findings_match_brute_force(
        cases in prop::collection::vec((case(), 0.0..25.0, 0.0..25.0), 6),
        clearance in 0.1..2.0,
    ) {
        let EnvelopeSource::Vehicle(body) = VEHICLE else { unreachable!() };
        let heading = guideway_envelope::Heading::Tangential(0.0);
        let moved = |(case, x, y): (Case, f64, f64)| {
            let curve = case.curve.0.iter().map(|b| b.map(|q| q + p(x, y))).collect();
            Case { curve: Curve(curve), body, heading }
        };
        let cases: Vec<Case> = cases.into_iter().map(moved).collect();
        let curves: Vec<Curve> = cases.iter().map(|case| case.curve.clone()).collect();
        let found = found(&curves, &options(clearance));
        let step = 0.3;
        // Brute force with a smaller and with a larger distance brackets the findings.
        let (certain, possible) = (
            brute(&cases, clearance - 1e-6, step),
            brute(&cases, clearance + ClearanceOptions::default().tolerance_m + 2.0 * step, step),
        );
        prop_assert!(certain.is_subset(&found), "{:?} of {:?}", found, certain);
        prop_assert!(found.is_subset(&possible), "{:?} within {:?}", found, possible);
    }
}

#[test]
fn brute_force_finds_a_close_pair() {
    let case = |curve| Case {
        curve,
        body: Body::vehicle(2.0, 1.0, 1.0),
        heading: guideway_envelope::Heading::Tangential(0.0),
    };
    let cases = [
        case(polyline(&[p(0.0, 0.0), p(10.0, 0.0)])),
        case(polyline(&[p(0.0, 1.4), p(10.0, 1.4)])),
    ];
    assert_eq!(brute(&cases, 0.5, 0.15), one("ab"));
    assert_eq!(brute(&cases, 0.3, 0.15), none());
    assert!(!one("ab").is_subset(&none()));
}

#[test]
fn reads_headings_and_corridors_from_the_file() {
    use guideway_layout::Value;
    let mut layout = layout(&[polyline(&[p(0.0, 0.0), p(10.0, 0.0)])]);
    let set = |layout: &mut Layout, name: &str, value| layout.paths.attributes.set(0, name, value);
    let top =
        |layout: &Layout, source: EnvelopeSource| source.sweep(layout, 0).map(|s| s.bounds().max.y);
    let long = EnvelopeSource::Vehicle(Body::vehicle(4.0, 1.0, 1.0));
    let is_near = |a: f64, b: f64| (a - b).abs() < 1e-9;
    assert!(is_near(top(&layout, long).unwrap(), 0.5));
    set(&mut layout, "orientationType", Value::Text("GLOBAL"));
    set(
        &mut layout,
        "vehicleOrientation",
        Value::Float(std::f64::consts::FRAC_PI_2),
    );
    assert!(is_near(top(&layout, long).unwrap(), 3.0));
    // Two alternative headings.
    layout.paths.attributes.remove("vehicleOrientation");
    set(
        &mut layout,
        "vehicleOrientations",
        Value::Json("[0, -1.5707963267948966]"),
    );
    assert!(is_near(top(&layout, long).unwrap(), 1.0));

    assert_eq!(
        top(&layout, EnvelopeSource::File),
        Err(guideway_envelope::NoEnvelope::NotInFile)
    );
    set(&mut layout, "corridor.leftWidth", Value::Float(0.75));
    set(&mut layout, "corridor.rightWidth", Value::Int(2));
    assert_eq!(
        top(&layout, EnvelopeSource::File),
        Err(guideway_envelope::NoEnvelope::CenterOnly)
    );
    set(
        &mut layout,
        "corridor.referencePoint",
        Value::Text("CONTOUR"),
    );
    let bounds = EnvelopeSource::File.sweep(&layout, 0).unwrap().bounds();
    assert!(
        bounds.min.distance(Point::new(0.0, -2.0)) < 1e-9,
        "{bounds:?}"
    );
    assert!(bounds.max.distance(Point::new(10.0, 0.75)) < 1e-9);
}
