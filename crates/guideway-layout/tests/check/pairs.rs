//! Paths on the same curve are found, however the curve is divided into runs and segments.

use std::collections::BTreeSet;

use guideway_layout::{CheckOptions, Code, Direction, Layout, NewPath, check};
use guideway_spline::{Point, Runs, uniform};
use proptest::prelude::*;

use crate::findings::{codes, found, only};
use crate::sketch::{Sketch, line_runs, p, runs_of};

fn pair(first: &Runs, second: &Runs) -> Sketch {
    let mut sketch = Sketch::default();
    sketch.free_path("first", first);
    sketch.free_path("second", second);
    sketch
}

/// The same curve with every segment split in two.
fn halved(runs: &Runs) -> Runs {
    let mut halved = Runs::default();
    for segment in runs.iter().flat_map(|run| run.windows(4)) {
        let segment: &[Point<f64>; 4] = segment.try_into().expect("windows of four");
        uniform::halves(segment)
            .iter()
            .for_each(|half| halved.push(half));
    }
    halved
}

#[test]
fn line_of_two_runs_duplicates_a_line_of_one() {
    let whole = line_runs(p(0.0, 0.0), p(10.0, 4.0));
    let mut parts = line_runs(p(0.0, 0.0), p(2.5, 1.0));
    parts.push_line(p(2.5, 1.0), p(10.0, 4.0));
    let (place, message) = only(&found(&pair(&whole, &parts)), Code::DuplicatePath);
    assert_eq!(place, "path \"second\"");
    assert_eq!(
        message,
        "has the curve of path \"first\", and agrees in all properties"
    );
    let (_, message) = only(&found(&pair(&whole, &parts.reversed())), Code::ReversePair);
    assert_eq!(
        message,
        "has the curve of path \"first\" in the opposite direction"
    );
}

#[test]
fn line_with_uneven_speed_is_a_duplicate() {
    let mut eased = Runs::default();
    let (a, b) = (p(0.0, 0.0), p(10.0, 4.0));
    eased.push_bezier(&[a, a, b, b]);
    only(&found(&pair(&line_runs(a, b), &eased)), Code::DuplicatePath);
}

#[test]
fn different_curves_between_the_same_ends_are_no_pair() {
    let mut bow = Runs::default();
    bow.push_bezier(&[p(0.0, 0.0), p(3.0, 0.01), p(7.0, 0.01), p(10.0, 0.0)]);
    assert!(found(&pair(&line_runs(p(0.0, 0.0), p(10.0, 0.0)), &bow)).is_empty());
}

#[test]
fn curves_on_two_levels_are_no_pair() {
    let mut sketch = Sketch::default();
    let runs = line_runs(p(0.0, 0.0), p(10.0, 0.0));
    for level in [0, 1] {
        let level = Some(level);
        sketch.layout.paths.push(&NewPath {
            runs: &runs,
            level,
            ..NewPath::default()
        });
    }
    assert!(found(&sketch).is_empty());
}

#[test]
fn paths_without_common_vehicle_type_are_no_pair() {
    let runs = line_runs(p(0.0, 0.0), p(10.0, 0.0));
    let of = |types: &[&[&str]]| {
        let mut sketch = Sketch::default();
        for &vehicle_types in types {
            let path = NewPath {
                runs: &runs,
                vehicle_types,
                ..NewPath::default()
            };
            sketch.layout.paths.push(&path);
        }
        codes(&found(&sketch))
    };
    assert_eq!(of(&[&["tug"], &["lift"]]), []);
    assert_eq!(of(&[&["tug"], &["lift", "tug"]]), [(Code::SameCurve, 1)]);
    assert_eq!(of(&[&["tug"], &[], &["lift"]]), [(Code::SameCurve, 2)]);
    assert_eq!(
        of(&[&["tug", "lift"], &["lift", "tug"]]),
        [(Code::DuplicatePath, 1)]
    );
}

#[test]
fn reports_each_later_path_of_a_group_once() {
    let there = line_runs(p(0.0, 0.0), p(10.0, 0.0));
    let back = there.reversed();
    let mut sketch = Sketch::default();
    for i in 0..3_000 {
        sketch.free_path("", if i % 3 == 2 { &back } else { &there });
    }
    let found = found(&sketch);
    // One reverse pair for the group: further paths duplicate one of its two.
    assert_eq!(
        codes(&found),
        [(Code::DuplicatePath, 2_998), (Code::ReversePair, 1)]
    );
    let others: BTreeSet<_> = found.iter().map(|d| d.message.clone()).collect();
    assert_eq!(others.len(), 3, "{others:?}");
}

#[test]
fn cost_stays_linear_for_many_curves_between_the_same_ends() {
    let mut sketch = Sketch::default();
    for i in 0..20_000 {
        let mut runs = Runs::default();
        let y = 1.0 + f64::from(i);
        runs.push_bezier(&[p(0.0, 0.0), p(3.0, y), p(7.0, y), p(10.0, 0.0)]);
        sketch.free_path("", &runs);
    }
    assert_eq!(found(&sketch).count(Code::DuplicatePath), 0);
}

#[test]
fn two_way_path_shares_its_curve_in_both_directions() {
    let (there, back) = (
        line_runs(p(0.0, 20.0), p(9.0, 20.0)),
        line_runs(p(9.0, 20.0), p(0.0, 20.0)),
    );
    let of = |direction, runs: &Runs| {
        let mut sketch = Sketch::clean();
        let two_way = NewPath {
            id: "1",
            runs: &there,
            direction: Direction::Both,
            ..NewPath::default()
        };
        sketch.layout.paths.push(&two_way);
        sketch.layout.paths.push(&NewPath {
            id: "2",
            runs,
            direction,
            ..NewPath::default()
        });
        let found = found(&sketch);
        let finding = found.iter().next().unwrap();
        (finding.code, finding.message.clone())
    };
    let differs = "has the curve of path \"1\"; they differ in direction: two-way and one-way";
    for runs in [&back, &there] {
        assert_eq!(
            of(Direction::Forward, runs),
            (Code::SameCurve, differs.to_owned())
        );
        assert_eq!(of(Direction::Both, runs).0, Code::DuplicatePath);
    }
}

fn points() -> impl Strategy<Value = Vec<Point<f64>>> {
    let point = (-500.0..500.0, -500.0..500.0).prop_map(|(x, y)| p(x, y));
    prop::collection::vec(point, 4..12)
}

/// Distinct curves, each with a reversed copy if its flag is set.
fn layout(curves: &[(Vec<Point<f64>>, bool)]) -> Vec<(String, Runs)> {
    let mut paths = Vec::new();
    for (i, (points, has_reverse)) in curves.iter().enumerate() {
        let runs = runs_of(points);
        if *has_reverse {
            paths.push((format!("{i} back"), halved(&runs).reversed()));
        }
        paths.push((i.to_string(), runs));
    }
    paths
}

/// Identifiers of the paths of each reverse pair, independent of their order.
fn groups(paths: &[(String, Runs)]) -> BTreeSet<BTreeSet<String>> {
    let mut layout = Layout::default();
    for (id, runs) in paths {
        layout.paths.push(&NewPath {
            id,
            runs,
            ..NewPath::default()
        });
    }
    let found = check(&layout, &CheckOptions::default());
    let pairs = found.iter().filter(|d| d.code == Code::ReversePair);
    let names = pairs.map(|d| {
        let text = format!("{} {}", d.place, d.message);
        text.split('"')
            .skip(1)
            .step_by(2)
            .map(str::to_owned)
            .collect()
    });
    names.collect()
}

proptest! {
    #[test]
    fn finds_a_curve_divided_differently_and_slightly_moved(
        points in points(),
        back: bool,
        offset_m in -5e-4..5e-4,
        far_m in prop_oneof![Just(0.0), Just(5e6)],
    ) {
        let place = p(far_m, far_m);
        let first = runs_of(&points.iter().map(|&at| at + place).collect::<Vec<_>>());
        let place = place + p(offset_m, 0.0);
        let second = runs_of(&points.iter().map(|&at| at + place).collect::<Vec<_>>());
        let second = halved(&if back { second.reversed() } else { second });
        let found = found(&pair(&first, &second));
        prop_assert_eq!(found.count(Code::ReversePair), u64::from(back));
        prop_assert_eq!(found.count(Code::DuplicatePath), u64::from(!back));
    }

    #[test]
    fn groups_are_independent_of_the_order_of_paths(
        (paths, shuffled) in prop::collection::vec((points(), any::<bool>()), 1..12)
            .prop_map(|curves| layout(&curves))
            .prop_flat_map(|paths| (Just(paths.clone()), Just(paths).prop_shuffle())),
    ) {
        let groups_found = groups(&paths);
        let reversed = paths.iter().filter(|(id, _)| id.ends_with("back")).count();
        prop_assert_eq!(groups_found.len(), reversed);
        prop_assert_eq!(groups_found, groups(&shuffled));
    }
}
