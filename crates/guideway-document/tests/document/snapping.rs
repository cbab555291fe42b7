//! Snapping to places of paths, by name, on the level that is shown.

use guideway_document::{Document, SnapOptions, SnapTarget};
use guideway_layout::{Layout, Level, NewPath};
use guideway_spline::{Point, Runs};

use crate::site::{document_of, is_near, p};

/// A line along x, one that crosses it at x = 2, and half a circle of radius 2 about (20, 0).
fn document() -> Document {
    let mut layout = Layout::default();
    let mut push = |id: &str, runs: &Runs, level| {
        layout.paths.push(&NewPath {
            id,
            runs,
            level,
            ..NewPath::default()
        });
    };
    for (id, from, to) in [
        ("along", p(0.0, 0.0), p(10.0, 0.0)),
        ("across", p(2.0, -3.0), p(2.0, 5.0)),
    ] {
        let mut line = Runs::default();
        line.push_line(from, to);
        push(id, &line, Some(0));
    }
    let arc = guideway_spline::construct::Arc::through([p(22.0, 0.0), p(20.0, 2.0), p(18.0, 0.0)]);
    let mut runs = Runs::default();
    arc.expect("three points on a circle").push(1e-9, &mut runs);
    push("arc", &runs, Some(0));
    let mut line = Runs::default();
    line.push_line(p(7.0, -4.0), p(7.0, 4.0));
    push("above", &line, Some(1));
    layout.nodes.push("here", p(0.0, 0.0), Some(0));
    layout.nodes.push("upstairs", p(0.05, 0.0), Some(1));
    let level = |id: &str| Level {
        id: id.into(),
        ..Level::default()
    };
    layout.levels = vec![level("hall"), level("upper")];
    document_of(layout)
}

#[test]
fn places_of_paths_are_found_by_name() {
    let document = document();
    let snap = SnapOptions {
        object_reach_m: Some(0.4),
        ..SnapOptions::default()
    };
    let from = Some(p(4.0, 6.0));
    for (at, from, to, place) in [
        (p(9.8, 0.1), from, SnapTarget::End, p(10.0, 0.0)),
        (p(5.2, -0.1), None, SnapTarget::Middle, p(5.0, 0.0)),
        (p(2.1, 0.2), from, SnapTarget::Crossing, p(2.0, 0.0)),
        (p(4.1, 0.2), from, SnapTarget::Perpendicular, p(4.0, 0.0)),
        // From (20, 4) a tangent touches at 60 degrees from the axis.
        (
            p(21.7, 1.0),
            Some(p(20.0, 4.0)),
            SnapTarget::Tangent,
            p(20.0 + 3f64.sqrt(), 1.0),
        ),
    ] {
        let found = document.snap(&snap, at, from);
        assert_eq!(found.to, Some(to), "{at:?}");
        assert!(
            found.at_m.distance(place) < 1e-4,
            "{to:?}: {:?}",
            found.at_m
        );
    }
    let nothing = document.snap(&snap, p(3.5, 0.6), None);
    assert_eq!((nothing.to, nothing.at_m), (None, p(3.5, 0.6)));
    // Paths of two levels do not cross.
    let apart = document.snap(&snap, p(7.0, 0.05), None);
    assert_ne!(apart.to, Some(SnapTarget::Crossing));
}

#[test]
fn only_the_shown_level_is_a_target() {
    let mut document = document();
    let at = p(0.06, 0.0);
    let snap = SnapOptions {
        node_reach_m: Some(0.5),
        object_reach_m: Some(0.4),
        ..SnapOptions::default()
    };
    let target = |document: &Document| document.snap(&snap, at, None).to;
    document.show_level(Some(0));
    assert_eq!(target(&document), Some(SnapTarget::Node(0)));
    document.show_level(Some(1));
    assert_eq!(target(&document), Some(SnapTarget::Node(1)));
    let end = document.snap(&snap, p(10.0, 0.1), None);
    assert_eq!(end.to, None, "the line is on the other level");
    document.show_level(None);
    assert!(matches!(target(&document), Some(SnapTarget::Node(_))));
    let grid = SnapOptions {
        grid_m: Some(0.25),
        ..snap
    };
    let found = document.snap(&grid, p(50.1, 50.4), None);
    assert_eq!(found.to.map(SnapTarget::name), Some("grid"));
    assert!(is_near(found.at_m, Point::new(50.0, 50.5)));
}
