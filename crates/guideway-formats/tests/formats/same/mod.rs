//! Comparison of layouts, and arbitrary layouts, for tests of writers.

use guideway_formats::Losses;
use guideway_layout::{Direction, Layout, Level, NewPath, PathRef, Value};
use guideway_spline::{Point, Runs, nearest_on_run, polyline_to_runs, uniform};
use proptest::prelude::*;

/// Largest distance between a curve and its copy after a round trip, in meters.
pub(crate) const TOLERANCE_M: f64 = 1e-4;

/// Returns a layout with a path `E` of two lines with a gap of 4 m; the second line leads to `end`.
pub(crate) fn broken(end: Point<f64>, direction: Direction) -> Layout {
    let mut layout = Layout::default();
    let mut runs = Runs::default();
    runs.push_line(Point::new(0.0, 0.0), Point::new(1.0, 0.0));
    runs.push_line(Point::new(5.0, 0.0), end);
    layout.paths.push(&NewPath {
        id: "E",
        runs: &runs,
        direction,
        ..NewPath::default()
    });
    layout
}

/// Returns the distance of two curves: an upper bound for equal segments, else sampled.
pub(crate) fn apart_m(a: PathRef<'_>, b: PathRef<'_>) -> f64 {
    let beziers = |p: PathRef<'_>| -> Vec<[Point<f64>; 4]> {
        let segments = p.runs().flat_map(|run| run.segments());
        segments.map(|s| uniform::to_bezier(&s)).collect()
    };
    let (of_a, of_b) = (beziers(a), beziers(b));
    if of_a.len() == of_b.len() {
        // The distance of Bezier curves is at most that of their control points.
        let pairs = of_a.iter().flatten().zip(of_b.iter().flatten());
        let max = pairs.map(|(p, q)| p.distance(*q)).fold(0.0, f64::max);
        if max <= TOLERANCE_M {
            return max;
        }
    }
    farthest_m(a, b).max(farthest_m(b, a))
}

/// Returns the largest distance of sample points of one curve from another.
fn farthest_m(from: PathRef<'_>, to: PathRef<'_>) -> f64 {
    const STEPS: u32 = 16;
    let to: Vec<Vec<Point<f64>>> = to.runs().map(|run| run.iter().collect()).collect();
    let near = |p: Point<f64>| {
        let runs = to.iter().filter_map(|run| nearest_on_run(run, p, 1e-7));
        runs.map(|n| n.distance).fold(f64::INFINITY, f64::min)
    };
    let segments = from.runs().flat_map(|run| run.segments());
    let steps = |s| (0..=STEPS).map(move |i| uniform::point(&s, f64::from(i) / f64::from(STEPS)));
    segments.flat_map(steps).map(near).fold(0.0, f64::max)
}

/// Returns names and counts of losses.
pub(crate) fn lost(losses: &Losses) -> Vec<(&str, u64)> {
    let lost = losses.iter();
    lost.map(|loss| (loss.what.as_str(), loss.count)).collect()
}

/// Adds a path of straight lines.
pub(crate) fn push_lines(layout: &mut Layout, id: &str, points: &[(f64, f64)]) {
    let points: Vec<_> = points.iter().map(|&(x, y)| Point::new(x, y)).collect();
    let mut runs = Runs::default();
    polyline_to_runs(&points, &mut runs);
    layout.paths.push(&NewPath {
        id,
        runs: &runs,
        ..NewPath::default()
    });
}

pub(crate) fn assert_same_curves(a: &Layout, b: &Layout, what: &str) {
    assert_eq!(a.paths.len(), b.paths.len(), "{what}: number of paths");
    for (p, q) in a.paths.iter().zip(b.paths.iter()) {
        let apart = apart_m(p, q);
        assert!(
            apart <= TOLERANCE_M,
            "{what}: path {} is {apart} m off",
            p.id()
        );
    }
}

pub(crate) fn assert_same_ids(a: &Layout, b: &Layout, what: &str) {
    for (p, q) in a.paths.iter().zip(b.paths.iter()) {
        assert_eq!(p.id(), q.id(), "{what}");
    }
}

/// Asserts equal nodes, levels, and references of paths to them.
pub(crate) fn assert_same_network(a: &Layout, b: &Layout, what: &str) {
    let levels = |layout: &Layout| -> Vec<(String, Option<String>)> {
        let levels = layout.levels.iter();
        levels.map(|l| (l.id.clone(), l.name.clone())).collect()
    };
    assert_eq!(levels(a), levels(b), "{what}");
    let nodes = |layout: &Layout| -> Vec<(String, Option<u32>)> {
        let nodes = &layout.nodes;
        let all = 0..nodes.len() as u32;
        all.map(|n| (nodes.id(n).to_owned(), nodes.level(n)))
            .collect()
    };
    assert_eq!(nodes(a), nodes(b), "{what}");
    for node in 0..a.nodes.len() as u32 {
        let apart = a.nodes.position_m(node).distance(b.nodes.position_m(node));
        assert!(apart <= TOLERANCE_M, "{what}: node {node} is {apart} m off");
    }
    for (p, q) in a.paths.iter().zip(b.paths.iter()) {
        let refers = |p: PathRef<'_>| (p.start_node(), p.end_node(), p.level(), p.direction());
        assert_eq!(refers(p), refers(q), "{what}: path {}", p.id());
    }
}

/// Draft of a path: identifier, shape, indices of its end nodes, level.
type Draft = (String, Vec<Vec<Point<f64>>>, (usize, usize), usize);

fn point() -> impl Strategy<Value = Point<f64>> {
    (-2e3..2e3, -2e3..2e3).prop_map(|(x, y)| Point::new(x, y))
}

/// Strategy for curves, polylines, corners, gaps and points.
fn shape() -> impl Strategy<Value = Vec<Vec<Point<f64>>>> {
    let curve = prop::collection::vec(point(), 4..9).prop_map(|run| vec![run]);
    let runs_of = |runs: &Runs| runs.iter().map(<[_]>::to_vec).collect::<Vec<_>>();
    let lines = prop::collection::vec(point(), 2..6).prop_map(move |points| {
        let mut runs = Runs::default();
        polyline_to_runs(&points, &mut runs);
        runs_of(&runs)
    });
    let beziers = prop::collection::vec(point(), 7).prop_map(move |b| {
        let mut runs = Runs::default();
        runs.push_bezier(&[b[0], b[1], b[2], b[3]]);
        runs.push_bezier(&[b[3], b[4], b[5], b[6]]);
        runs_of(&runs)
    });
    let dot = point().prop_map(|p| vec![vec![p; 4]]);
    prop_oneof![4 => curve, 3 => lines, 3 => beziers, 1 => dot]
}

fn draft() -> impl Strategy<Value = Draft> {
    (
        "[ -~äé漢]{1,9}",
        shape(),
        (0..5_usize, 0..5_usize),
        0..2_usize,
    )
}

/// Strategy for a layout of two levels with nodes, vehicle types and columns, without gaps in
/// paths.
pub(crate) fn arbitrary_layout() -> impl Strategy<Value = Layout> {
    prop::collection::vec(draft(), 1..7).prop_map(|mut drafts| {
        // LIF and SVG group paths by level, in order on each.
        drafts.sort_by_key(|draft| draft.3);
        let mut layout = Layout::default();
        for (id, name) in [("ground", Some("Halle <1>")), ("upper", None)] {
            layout.levels.push(Level {
                id: id.to_owned(),
                name: name.map(str::to_owned),
                ..Level::default()
            });
        }
        // Five nodes on each level.
        for node in 0..10_u32 {
            let position = Point::new(f64::from(node) * 1.25, -0.1 * f64::from(node));
            layout
                .nodes
                .push(&format!("N {node}"), position, Some(node / 5));
        }
        for (id, shape, ends, level) in &drafts {
            let mut runs = Runs::default();
            shape.iter().for_each(|run| runs.push(run));
            let node = |i: usize| Some((level * 5 + i) as u32);
            let row = layout.paths.push(&NewPath {
                id,
                runs: &runs,
                start_node: node(ends.0),
                end_node: node(ends.1),
                direction: Direction::Forward,
                level: Some(*level as u32),
                vehicle_types: &["tugger", "Acme fork lift"],
            });
            let speed = Value::Float(ends.0 as f64 + 0.5);
            layout.paths.attributes.set(row, "maxSpeed", speed);
        }
        layout
    })
}
