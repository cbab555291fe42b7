//! Nodes, paths and stations that are created and deleted.

use guideway_document::{
    Document, Element, Elements, NewEdge, OperationError, PathSet, SelectMode,
};
use guideway_layout::{CheckOptions, Code, Member, NewPath};
use guideway_scene::Table;
use guideway_spline::Runs;

use crate::site::{document_of, ends, is_near, p, square};

#[test]
fn creates_nodes_paths_and_stations() {
    let mut document = document_of(square());
    let node = document.create_node(None, p(5.0, 5.0), Some(0)).unwrap();
    assert_eq!(document.layout().nodes.id(node), "node");
    let edge = NewEdge {
        start_node: 0,
        end_node: node,
        attributes_of: Some(0),
        vehicle_types: vec!["tug".into()],
        ..NewEdge::default()
    };
    let row = document.create_edge(&edge).unwrap();
    let (start, end) = ends(&document, row as usize);
    assert!(is_near(start, p(0.0, 0.0)) && is_near(end, p(5.0, 5.0)));
    let path = document.layout().paths.get(row as usize);
    assert_eq!((path.id(), path.level()), ("a--node", Some(0)));
    let station = document
        .create_station(Some("charger"), &[node], None, None)
        .unwrap();
    assert_eq!(document.station_position_m(station), Some(p(5.0, 5.0)));
    document.move_node(node, p(6.0, 5.0)).unwrap();
    assert!(is_near(ends(&document, row as usize).1, p(6.0, 5.0)));
    assert_eq!(document.station_position_m(station), Some(p(6.0, 5.0)));
    let taken = document
        .create_node(Some("a"), p(0.0, 0.0), None)
        .unwrap_err();
    assert!(taken.to_string().contains("another node is called `a`"));
    let same = NewEdge {
        start_node: 1,
        end_node: 1,
        ..NewEdge::default()
    };
    let error = document.create_edge(&same).unwrap_err();
    assert!(error.to_string().contains("from `b` to `b` has no length"));
    let unknown = document
        .create_station(None, &[99], None, None)
        .unwrap_err();
    assert!(unknown.to_string().contains("no node in row 99"));
    while document.undo().is_some() {}
    let layout = document.to_layout();
    let counts = (
        layout.nodes.len(),
        layout.paths.len(),
        layout.stations.len(),
    );
    assert_eq!(counts, (4, 4, 2));
}

fn counts(document: &Document) -> [usize; 3] {
    let layout = document.to_layout();
    [
        layout.paths.len(),
        layout.nodes.len(),
        layout.stations.len(),
    ]
}

#[test]
fn a_deleted_node_needs_its_paths_to_go_too() {
    let mut document = document_of(square());
    let b = Elements {
        nodes: PathSet::from_iter([1]),
        ..Elements::default()
    };
    let error = document.delete(&b, false).unwrap_err();
    let expected = OperationError::NodeInUse {
        node: "b".into(),
        path: "ab".into(),
        count: 2,
    };
    assert_eq!(error, expected);
    document.delete(&b, true).unwrap();
    assert_eq!(counts(&document), [2, 3, 2]);
    let layout = document.to_layout();
    assert_eq!(
        layout.stations.nodes(1),
        [1],
        "`rack` keeps `c`, whose row is 1 now"
    );
    assert_eq!(layout.blocks[0].members, [Member::Station(1)]);
    let path = layout.paths.get(0);
    assert_eq!(
        (path.id(), path.start_node(), path.end_node()),
        ("cd", Some(1), Some(2))
    );
    assert_eq!(document.node_near(p(10.0, 0.0), 1.0), None);
    assert!(!document.contains(Element::Node(1)) && document.contains(Element::Node(0)));
    document.undo().unwrap();
    assert_eq!(counts(&document), [4, 4, 2]);
    assert_eq!(document.node_near(p(10.0, 0.0), 1.0), Some(1));
}

#[test]
fn nodes_go_with_their_last_path_unless_a_station_needs_them() {
    let mut document = document_of(square());
    document.select((0..4).collect(), SelectMode::Replace);
    document.delete_selection().unwrap();
    assert_eq!(
        counts(&document),
        [0, 3, 2],
        "`dock` and `rack` have a, b and c"
    );
    document.undo().unwrap();
    let all = Elements {
        stations: PathSet::from_iter([0, 1]),
        ..Elements::of_paths(0..4)
    };
    document.delete(&all, false).unwrap();
    assert_eq!(counts(&document), [0, 0, 0]);
    assert!(document.existing(Table::Nodes).next().is_none());
}

#[test]
fn a_station_keeps_its_place_without_its_nodes() {
    let mut layout = square();
    layout.stations.push("park", None, vec![3], None);
    let mut document = document_of(layout);
    let d = Elements {
        nodes: PathSet::from_iter([3]),
        ..Elements::default()
    };
    document.delete(&d, true).unwrap();
    assert_eq!(document.station_position_m(2), Some(p(0.0, 10.0)));
    document.undo().unwrap();
    assert_eq!(document.to_layout().stations.position_m(2), None);
}

#[test]
fn findings_leave_out_removed_nodes_and_count_rows_of_the_document() {
    let mut layout = square();
    layout.nodes.push("", p(50.0, 50.0), None);
    let mut runs = Runs::default();
    runs.push_line(p(0.0, 0.0), p(10.0, 0.0));
    layout.paths.push(&NewPath {
        id: "spur",
        runs: &runs,
        ..NewPath::default()
    });
    let mut document = document_of(layout);
    let unused = |document: &Document| {
        let found = document.snapshot().findings(&CheckOptions::default());
        let unused = found
            .iter()
            .filter(|finding| finding.code == Code::UnusedNode);
        unused
            .map(|finding| finding.place.to_string())
            .collect::<Vec<_>>()
    };
    assert_eq!(unused(&document), ["node number 5"]);
    let b = Elements {
        nodes: PathSet::from_iter([1]),
        ..Elements::default()
    };
    document.delete(&b, true).unwrap();
    assert_eq!(unused(&document), ["node number 5"]);
    let last = Elements {
        nodes: PathSet::from_iter([4]),
        ..Elements::default()
    };
    document.delete(&last, false).unwrap();
    assert!(unused(&document).is_empty());
}
