//! Walls and doors are no part of a network, and ways to other levels may lead on.

use guideway_layout::{Code, Direction, Layout, NewPath, Severity, Value};
use guideway_network::{AnalyzeOptions, RouteOptions, Router, analyze};
use guideway_spline::{Point, Runs};

/// A loop of three one-way edges, and an edge to a fourth node.
fn layout(element: &str) -> Layout {
    let mut layout = Layout::default();
    for (id, x, y) in [
        ("a", 0.0, 0.0),
        ("b", 9.0, 0.0),
        ("c", 9.0, 9.0),
        ("d", 30.0, 9.0),
    ] {
        layout.nodes.push(id, Point::new(x, y), None);
    }
    for (row, (from, to)) in [(0, 1), (1, 2), (2, 0), (2, 3)].into_iter().enumerate() {
        let mut runs = Runs::default();
        runs.push_line(layout.nodes.position_m(from), layout.nodes.position_m(to));
        layout.paths.push(&NewPath {
            id: &row.to_string(),
            runs: &runs,
            start_node: Some(from),
            end_node: Some(to),
            direction: Direction::Forward,
            ..NewPath::default()
        });
        let kind = if to == 3 { element } else { "lane" };
        layout
            .paths
            .attributes
            .set(row, "element", Value::Text(kind));
    }
    layout
}

#[test]
fn walls_and_doors_are_no_ways() {
    let traps = |element: &str| analyze(&layout(element), &AnalyzeOptions::default());
    assert_eq!(traps("lane").count(Code::DeadEnd), 1);
    for element in ["wall", "door", "human lane"] {
        assert!(traps(element).is_empty(), "{element}");
        let layout = layout(element);
        let router = Router::new(&layout, None, &RouteOptions::default()).expect("a router");
        let [from, to] = ["a", "d"].map(|name| router.place(name).expect("a node"));
        let error = router.route(&from, &to).unwrap_err().to_string();
        assert!(error.contains("no path of vehicles is at \"d\""), "{error}");
    }
}

#[test]
fn dead_ends_are_information_where_ways_to_other_levels_are_refused() {
    let mut layout = layout("lane");
    layout
        .refused
        .push("lift", Code::CrossLevel, "it leads to another level");
    let found = analyze(&layout, &AnalyzeOptions::default());
    assert_eq!(found.count(Code::DeadEnd), 1);
    assert_eq!(found.count_at_least(Severity::Warning), 0);
}

#[test]
fn unknown_places_suggest_near_names() {
    let layout = layout("lane");
    let router = Router::new(&layout, None, &RouteOptions::default()).expect("a router");
    let mut named = layout.clone();
    named.nodes.set_ids(&[(0, "DOCK-01"), (1, "RACK-01")]);
    let near = Router::new(&named, None, &RouteOptions::default()).expect("a router");
    let error = near.place("dock01").expect_err("no such node").to_string();
    assert!(error.contains("near names are DOCK-01"), "{error}");
    let error = router.place("quite-another").expect_err("no such node");
    assert!(
        error.to_string().contains("known are a, b, c, d"),
        "{error}"
    );
}
