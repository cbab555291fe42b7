//! Checks the areas that a file gives as polygons.

use std::f64::consts::TAU;

use guideway_envelope::{
    ClearanceOptions, ConvexPolygon, EnvelopeSource, NoEnvelope, check_clearance,
};
use guideway_layout::{Layout, NewPath, Value};
use guideway_spline::Runs;
use proptest::prelude::*;

use crate::random::{P, p};

/// A chain of paths of 20 m, each with the text of its area.
fn layout(areas: &[&str]) -> Layout {
    let mut layout = Layout::default();
    for (i, area) in (0..).zip(areas) {
        let mut runs = Runs::default();
        let start = p(20.0 * f64::from(i), 0.0);
        runs.push_line(start, start + p(20.0, 0.0));
        let row = layout.paths.push(&NewPath {
            id: &format!("path-{i}"),
            runs: &runs,
            ..NewPath::default()
        });
        let area = Value::Text(area);
        layout
            .paths
            .attributes
            .set(row, "vehicleEnvelope.area", area);
    }
    layout
}

fn parts(area: &str) -> Result<Vec<ConvexPolygon>, NoEnvelope> {
    let sweep = EnvelopeSource::File.sweep(&layout(&[area]), 0)?;
    let mut parts = Vec::new();
    sweep.polygons(0.01, None, &mut |part| parts.push(part.clone()));
    Ok(parts)
}

fn contains(parts: &[ConvexPolygon], point: P) -> bool {
    parts.iter().any(|part| part.contains(point))
}

#[test]
fn one_path_with_an_envelope_suffices() {
    assert_eq!(EnvelopeSource::File.require_any(&Layout::default()), Ok(()));
    let both = layout(&["none", "[[[[0,0],[4,0],[4,4],[0,4],[0,0]]]]"]);
    assert_eq!(EnvelopeSource::File.require_any(&both), Ok(()));
    let alone = EnvelopeSource::File.require_any(&layout(&["none"]));
    assert_eq!(alone, Err(NoEnvelope::Unreadable));
}

#[test]
fn keeps_convex_areas_whole_and_cuts_holes_and_notches() {
    let square = "[[[0,0],[4,0],[4,4],[0,4],[0,0]]]";
    assert_eq!(parts(&format!("[{square}]")).unwrap().len(), 1);
    let notched = "[[[10,0],[14,0],[14,4],[12,1],[10,4],[10,0]]]";
    let ring = "[[[20,0],[24,0],[24,4],[20,4],[20,0]],[[21,1],[23,1],[23,3],[21,3],[21,1]]]";
    let parts = parts(&format!("[{square}, {notched}, {ring}]")).unwrap();
    for inside in [
        p(2.0, 2.0),
        p(10.5, 2.0),
        p(12.0, 0.5),
        p(20.5, 2.0),
        p(23.5, 3.9),
    ] {
        assert!(contains(&parts, inside), "{inside:?}");
    }
    for outside in [p(5.0, 2.0), p(12.0, 2.0), p(22.0, 2.0), p(12.0, -0.1)] {
        assert!(!contains(&parts, outside), "{outside:?}");
    }
}

#[test]
fn self_intersecting_polygon_covers_its_hull() {
    let bow = parts("[[[[0,0],[4,4],[4,0],[0,4],[0,0]]]]").unwrap();
    assert!(contains(&bow, p(2.0, 3.9)) && contains(&bow, p(3.9, 2.0)));
}

#[test]
fn distinguishes_malformed_areas_from_missing_ones() {
    let of = |text: &str| EnvelopeSource::File.sweep(&layout(&[text]), 0).map(|_| ());
    for text in [
        "POLYGON",
        "",
        "[]",
        "[[]]",
        "[[[]]]",
        "[[[[1]]]]",
        "[[[[1e999,0],[0,1],[1,1]]]]",
    ] {
        assert_eq!(of(text), Err(NoEnvelope::Unreadable), "{text}");
    }
    let mut layout = layout(&["x"]);
    layout.paths.attributes = Default::default();
    assert_eq!(
        EnvelopeSource::File.sweep(&layout, 0).map(|_| ()),
        Err(NoEnvelope::NotInFile)
    );
}

fn is_too_near(areas: &[&str], clearance_m: f64) -> bool {
    let options = ClearanceOptions {
        clearance_m,
        near_joint_m: Some(3.0),
        ..ClearanceOptions::default()
    };
    let work = check_clearance(&layout(areas), EnvelopeSource::File, None, &options);
    work.findings.iter().next().is_some()
}

#[test]
fn ignores_areas_that_touch_only_at_a_joint() {
    let first = "[[[[0,-1],[21,-1],[21,1],[0,1],[0,-1]]]]";
    let second = "[[[[19,-1],[40,-1],[40,1],[19,1],[19,-1]]]]";
    assert!(!is_too_near(&[first, second], 0.5));
    // The last of four areas in a row comes back within 0.5 m of the first one, far from any joint.
    let armed = "[[[[59,-1],[80,-1],[80,2],[5,2],[5,1.5],[78,1.5],[78,1],[59,1],[59,-1]]]]";
    let all = [first, "[]", "[]", armed];
    assert!(!is_too_near(&all, 0.4));
    assert!(is_too_near(&all, 0.6));
}

/// A star-shaped polygon around the origin.
fn star() -> impl Strategy<Value = Vec<P>> {
    prop::collection::vec(0.5..4.0_f64, 3..12).prop_map(|radii| {
        let turn = |i: usize| TAU * i as f64 / radii.len() as f64;
        let corner = |(i, r): (usize, &f64)| p(turn(i).cos(), turn(i).sin()) * *r;
        radii.iter().enumerate().map(corner).collect()
    })
}

proptest! {
    #[test]
    fn parts_contain_exactly_the_points_inside(
        star in star(),
        x in -4.0..4.0_f64,
        y in -4.0..4.0_f64,
    ) {
        let point = p(x, y);
        let corners: Vec<String> = star.iter().map(|p| format!("[{:?},{:?}]", p.x, p.y)).collect();
        let parts = parts(&format!("[[[{}]]]", corners.join(","))).unwrap();
        let edges = || star.iter().zip(star.iter().cycle().skip(1));
        // Crossings of a ray to the right.
        let crosses = |(a, b): (&P, &P)| {
            (a.y > y) != (b.y > y) && x < a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x)
        };
        let is_inside = edges().filter(|&edge| crosses(edge)).count() % 2 == 1;
        let from_edge = edges().map(|(a, b)| {
            let t = ((point - *a).dot(*b - *a) / (*b - *a).dot(*b - *a)).clamp(0.0, 1.0);
            point.distance(a.lerp(*b, t))
        });
        prop_assume!(from_edge.fold(f64::INFINITY, f64::min) > 1e-6);
        prop_assert_eq!(contains(&parts, point), is_inside);
    }
}
