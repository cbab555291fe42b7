//! Nodes and stations: how they move, and how paths follow them.

use guideway_document::{Document, Elements, Neighbors, PointRef};
use guideway_layout::{Layout, NewPath};
use guideway_scene::EditError;
use guideway_spline::{Affine, Point, Runs, uniform};

use crate::site::{document_of, ends, is_near, lanes, p, select, two_joined};

#[test]
fn path_ends_follow_a_moved_node_and_straight_stays_straight() {
    let mut document = two_joined();
    document.move_node(1, p(11.0, 2.0)).unwrap();
    assert!(is_near(document.node_position_m(1), p(11.0, 2.0)));
    let (start, end) = ends(&document, 0);
    assert!(is_near(start, p(0.0, 0.0)) && is_near(end, p(11.0, 2.0)));
    assert!((document.layout().paths.get(0).length_m() - 125f64.sqrt()).abs() < 1e-4);
    let (start, end) = ends(&document, 1);
    assert!(is_near(start, p(11.0, 2.0)) && is_near(end, p(20.0, 0.0)));
    assert_eq!(document.undo(), Some("move node"));
    assert_eq!(document.node_position_m(1), p(10.0, 0.0));
    assert_eq!(ends(&document, 0), ends(&two_joined(), 0));
    assert_eq!(
        document.move_node(9, p(0.0, 0.0)),
        Err(EditError::UnknownReference {
            what: "node",
            row: 9
        })
    );
}

#[test]
fn nodes_move_along_and_neighbors_stretch() {
    let mut document = two_joined();
    select(&mut document, [0]);
    let by = Affine::translation(p(0.0, 3.0));
    document.transform_selection("move", by).unwrap();
    for (node, x) in [(0, 0.0), (1, 10.0)] {
        assert_eq!(document.node_position_m(node), p(x, 3.0));
        assert_eq!(document.node_near(p(x, 3.1), 0.5), Some(node));
        assert_eq!(document.node_near(p(x, 0.0), 0.5), None);
    }
    let (start, end) = ends(&document, 1);
    assert!(is_near(start, p(10.0, 3.0)) && is_near(end, p(20.0, 0.0)));
}

#[test]
fn detached_paths_get_nodes_of_their_own() {
    let mut document = two_joined();
    let by = Affine::translation(p(0.0, 3.0));
    let first = Elements::of_paths([0]);
    document
        .transform("move", &first, by, Neighbors::Detach)
        .unwrap();
    let nodes = &document.layout().nodes;
    assert_eq!((nodes.len(), nodes.id(3)), (4, "b copy 1"));
    assert_eq!(nodes.position_m(0), p(0.0, 3.0), "only `ab` used it");
    assert_eq!(nodes.position_m(1), p(10.0, 0.0), "`bc` is still there");
    assert_eq!(nodes.position_m(3), p(10.0, 3.0));
    let path = document.layout().paths.get(0);
    assert_eq!((path.start_node(), path.end_node()), (Some(0), Some(3)));
    let at = |node| document.index().paths_at(node).collect::<Vec<u32>>();
    assert_eq!((at(1), at(3)), (vec![1], vec![0]));
    document.undo().unwrap();
    assert_eq!(document.to_layout().nodes.len(), 3);
    let at: Vec<u32> = document.index().paths_at(1).collect();
    assert_eq!(at.len(), 2, "both are back");
}

/// The Bezier points of the only segment of a path.
fn bezier(document: &Document, path: usize) -> [Point<f64>; 4] {
    let mut runs = document.layout().paths.get(path).runs();
    let segment = runs.next().and_then(|run| run.segments().next());
    uniform::to_bezier(&segment.expect("the path has a segment"))
}

#[test]
fn ends_without_nodes_and_where_runs_meet_are_moved() {
    let mut runs = Runs::default();
    runs.push_line(p(0.0, 0.0), p(6.0, 0.0));
    runs.push_line(p(6.0, 0.0), p(6.0, 6.0));
    let mut layout = Layout::default();
    layout.paths.push(&NewPath {
        runs: &runs,
        ..NewPath::default()
    });
    let mut document = document_of(layout);
    let corners = |document: &Document| -> Vec<Point<f64>> {
        let runs = document.layout().paths.get(0).runs();
        let beziers = runs.map(|run| uniform::to_bezier(&run.segments().next().unwrap()));
        let all: Vec<[Point<f64>; 4]> = beziers.collect();
        for [a, b, c, d] in &all {
            let thirds = [a.lerp(*d, 1.0 / 3.0), a.lerp(*d, 2.0 / 3.0)];
            assert!(is_near(*b, thirds[0]) && is_near(*c, thirds[1]), "straight");
        }
        all.iter().flat_map(|[a, _, _, d]| [*a, *d]).collect()
    };
    let near = |document: &Document, expected: [Point<f64>; 4]| {
        corners(document)
            .iter()
            .zip(expected)
            .all(|(&a, b)| is_near(a, b))
    };
    let at = |run, point| PointRef {
        path: 0,
        run,
        point,
    };
    let last = p(6.0, 6.0);
    for (point, to, start, corner) in [
        (at(0, 3), p(7.0, 1.0), p(0.0, 0.0), p(7.0, 1.0)),
        (at(1, 0), p(8.0, 2.0), p(0.0, 0.0), p(8.0, 2.0)),
        (at(0, 0), p(-1.0, 1.0), p(-1.0, 1.0), p(8.0, 2.0)),
    ] {
        document.move_point(point, to).unwrap();
        assert!(near(&document, [start, corner, corner, last]), "{point:?}");
    }
    document.move_point(at(1, 3), p(9.0, 9.0)).unwrap();
    let corner = p(8.0, 2.0);
    assert!(near(&document, [p(-1.0, 1.0), corner, corner, p(9.0, 9.0)]));
}

#[test]
fn control_points_take_nodes_along_or_leave_them() {
    let mut document = two_joined();
    let at = |point| PointRef {
        path: 1,
        run: 0,
        point,
    };
    let before = bezier(&document, 1);
    let by = p(0.0, 2.0);
    document.move_point(at(0), before[0] + by).unwrap();
    assert!(is_near(document.node_position_m(1), p(10.0, 2.0)));
    assert!(is_near(ends(&document, 0).1, p(10.0, 2.0)));
    assert!(is_near(ends(&document, 1).0, p(10.0, 2.0)));
    document.undo().unwrap();
    for point in [1, 2] {
        document.move_point(at(point), before[point] + by).unwrap();
        let (start, end) = ends(&document, 1);
        assert!(is_near(start, p(10.0, 0.0)) && is_near(end, p(20.0, 0.0)));
        let now = bezier(&document, 1);
        assert!(is_near(now[point], before[point] + by));
        assert!(is_near(now[3 - point], before[3 - point]));
        document.undo().unwrap();
    }
    document.insert_point(at(0)).unwrap();
    document.insert_point(at(1)).unwrap();
    document.move_point(at(2), p(13.0, 9.0)).unwrap();
    let (start, end) = ends(&document, 1);
    assert!(is_near(start, p(10.0, 0.0)) && is_near(end, p(20.0, 0.0)));
    document.remove_point(at(2)).unwrap();
    assert!(is_near(ends(&document, 1).0, p(10.0, 0.0)));
}

#[test]
fn a_station_moves_by_the_mean_of_the_moves_of_its_nodes() {
    let mut layout = lanes(3);
    let stations = &mut layout.stations;
    stations.push("rack", Some(p(-1.0, 0.5)), vec![0, 1], None);
    stations.push("charger", Some(p(-2.0, 2.0)), vec![2], None);
    stations.push("dock", None, vec![2, 0], None);
    stations.push("sign", Some(p(5.0, 5.0)), vec![], None);
    let mut document = document_of(layout);
    let stations = |document: &Document| {
        let saved = document.to_layout().stations;
        assert_eq!(saved.position_m(2), None, "it has no place of its own");
        for station in [0, 1, 3] {
            let at = document.station_position_m(station);
            assert_eq!(saved.position_m(station), at);
        }
        [0, 1, 2, 3].map(|station| document.station_position_m(station).unwrap())
    };
    let before = stations(&document);
    assert_eq!(before[2], p(0.0, 2.0));
    document.move_node(0, p(0.0, -3.0)).unwrap();
    assert_eq!(stations(&document)[0], p(-1.0, -1.0), "half as far");
    document.move_node(1, p(0.0, 0.0)).unwrap();
    document.move_node(2, p(4.0, 2.0)).unwrap();
    let after = [p(-1.0, -1.5), p(2.0, 2.0), p(4.0, 2.0), p(5.0, 5.0)];
    assert_eq!(stations(&document), after);
    for _ in 0..3 {
        document.undo().unwrap();
    }
    assert_eq!(stations(&document), before);
}

#[test]
fn added_paths_follow_their_nodes_and_removed_ones_do_not() {
    let mut document = two_joined();
    let points = [p(0.0, 0.0), p(5.0, 8.0), p(20.0, 0.0)];
    document.draw_path("new".into(), &points, 0.5).unwrap();
    select(&mut document, [0]);
    document.delete_selection().unwrap();
    document.move_node(0, p(-3.0, 1.0)).unwrap();
    assert!(is_near(ends(&document, 2).0, p(-3.0, 1.0)));
    assert!(is_near(ends(&document, 0).0, p(0.0, 0.0)), "it is removed");
    let mut at: Vec<u32> = document.index().paths_at(2).collect();
    at.sort_unstable();
    assert_eq!(at, [1, 2]);
}
