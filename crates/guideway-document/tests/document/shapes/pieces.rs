//! Splits and joins.

use std::sync::Arc;

use guideway_document::{Document, ShapeError};
use guideway_layout::{Direction, Value};
use guideway_scene::EditError;

use super::network::{check_step, members, network, node, path, path_ids};
use crate::site::{ends, is_near, p, select};

/// Splits the selected paths where they cross or end on each other.
fn split_crossings(document: &mut Document) -> Result<Vec<u32>, ShapeError> {
    let selected = document.selection().clone();
    document.split_at_crossings(&selected)
}

#[test]
fn split_keeps_the_properties_of_the_whole() {
    let mut document = network();
    let before = document.to_layout();
    let ab = path(&document, "ab");
    select(&mut document, [ab]);
    let nodes = document
        .split_at(&document.selection().clone(), p(2.5, 0.3), 0.5)
        .unwrap();
    check_step(&mut document, &before, "split");
    assert_eq!(nodes.len(), 1);
    let layout = document.to_layout();
    assert!(is_near(layout.nodes.position_m(nodes[0]), p(2.5, 0.0)));
    assert_eq!(layout.nodes.level(nodes[0]), Some(0));
    let pieces = ["ab.1", "ab.2"].map(|id| path(&document, id));
    let paths = &document.layout().paths;
    for (piece, share) in pieces.into_iter().zip([0.25, 0.75]) {
        let row = piece as usize;
        assert_eq!(paths.get(row).direction(), Direction::Both);
        assert!((paths.get(row).length_m() - 10.0 * share).abs() < 1e-6);
        assert_eq!(paths.value(row, "maxSpeed"), Some(Value::Float(1.5)));
        let types: Vec<&str> = paths.vehicle_types().of(row).collect();
        assert_eq!(types, ["tug", "fork"]);
        for (name, mass) in [("tug", 1.0), ("fork", 2.0)] {
            assert_eq!(paths.value_for(row, name, "mass"), Some(Value::Float(mass)));
        }
        // The file states 20 m for the whole, twice its curve.
        let Some(Value::Float(stated)) = paths.value(row, "length") else {
            panic!("no length");
        };
        assert!((stated - 20.0 * share).abs() < 1e-5, "{stated}");
    }
    assert_eq!(paths.get(pieces[0] as usize).end_node(), Some(nodes[0]));
    assert_eq!(paths.get(pieces[1] as usize).start_node(), Some(nodes[0]));
    assert_eq!(members(&document), ["ab.1", "ab.2", "cf", "near h"]);
    assert!(document.selection().iter().eq(pieces));
}

#[test]
fn a_reverse_pair_is_split_at_one_node() {
    let mut document = network();
    let before = document.to_layout();
    let rows = ["cf", "fc"].map(|id| path(&document, id));
    select(&mut document, rows);
    let nodes = document
        .split_at(&document.selection().clone(), p(20.2, -4.0), 0.5)
        .unwrap();
    check_step(&mut document, &before, "split");
    assert_eq!(nodes.len(), 1);
    let at = |id: &str| document.layout().paths.get(path(&document, id) as usize);
    assert_eq!(at("cf.1").end_node(), Some(nodes[0]));
    assert_eq!(at("fc.1").end_node(), Some(nodes[0]));
    assert_eq!(at("cf.2").start_node(), at("fc.2").start_node());
}

#[test]
fn bent_path_is_split_exactly() {
    let mut document = network();
    let bc = path(&document, "bc");
    let whole_m = document.layout().paths.get(bc as usize).length_m();
    select(&mut document, [bc]);
    document
        .split_at(&document.selection().clone(), p(13.0, 0.5), 0.5)
        .unwrap();
    let pieces = ["bc.1", "bc.2"].map(|id| path(&document, id) as usize);
    let sum_m: f64 = pieces
        .map(|row| document.layout().paths.get(row).length_m())
        .iter()
        .sum();
    assert!((sum_m - whole_m).abs() < 1e-5);
}

#[test]
fn crossings_and_ends_on_paths_become_nodes() {
    let mut document = network();
    document.select_all();
    let before = document.to_layout();
    let nodes = split_crossings(&mut document).unwrap();
    check_step(&mut document, &before, "split at crossings");
    // x crosses ab, and gh ends on hb, 2 cm from its start.
    assert_eq!(nodes.len(), 2);
    assert_eq!(nodes[0], node(&document, "h"));
    let ids = path_ids(&document);
    for id in ["ab.1", "ab.2", "x.1", "x.2", "hb.1", "hb.2"] {
        assert!(ids.iter().any(|own| own == id), "{ids:?}");
    }
    assert!(is_near(document.node_position_m(nodes[1]), p(4.0, 0.0)));
    assert_eq!(split_crossings(&mut document), Err(ShapeError::NoCrossing));
}

#[test]
fn end_on_the_middle_of_a_path_is_a_junction() {
    let mut document = network();
    document
        .draw_path("spur".into(), &[p(6.0, 0.0), p(6.0, -4.0)], 0.0)
        .unwrap();
    let rows = ["ab", "spur"].map(|id| path(&document, id));
    // A path without a level is on another level than one with.
    select(&mut document, rows);
    assert_eq!(split_crossings(&mut document), Err(ShapeError::NoCrossing));
    let x = path(&document, "x");
    select(&mut document, [x]);
    document
        .split_at(&document.selection().clone(), p(4.0, 0.0), 0.1)
        .expect("a place between the ends");
    let rows = ["ab", "x.1", "x.2"].map(|id| path(&document, id));
    select(&mut document, rows);
    let before = document.to_layout();
    let nodes = split_crossings(&mut document).unwrap();
    check_step(&mut document, &before, "split at crossings");
    let joint = document
        .layout()
        .paths
        .get(path(&document, "x.1") as usize)
        .end_node();
    assert_eq!(nodes, [joint.unwrap()], "the node of x is that of ab");
}

#[test]
fn end_beside_a_path_comes_to_the_node_of_the_cut() {
    let mut layout = guideway_layout::Layout::default();
    let curves = [
        super::network::line(p(0.0, 0.0), p(10.0, 0.0)),
        super::network::line(p(4.0, 0.0005), p(4.0, 5.0)),
    ];
    for (id, runs) in ["track", "spur"].into_iter().zip(&curves) {
        layout.paths.push(&guideway_layout::NewPath {
            id,
            runs,
            ..guideway_layout::NewPath::default()
        });
    }
    let mut document = crate::site::document_of(layout);
    document.select_all();
    let before = document.to_layout();
    let nodes = split_crossings(&mut document).unwrap();
    check_step(&mut document, &before, "split at crossings");
    assert_eq!((nodes.len(), document.to_layout().paths.len()), (1, 3));
    let spur = document
        .layout()
        .paths
        .get(path(&document, "spur") as usize);
    assert_eq!(spur.start_node(), Some(nodes[0]));
}

#[test]
fn split_that_cannot_be_is_named() {
    let mut document = network();
    let none = document.split_at(&document.selection().clone(), p(0.0, 0.0), 1.0);
    assert_eq!(none, Err(ShapeError::NoPath));
    let ab = path(&document, "ab");
    select(&mut document, [ab]);
    let (at, reach_m) = (p(5.0, 3.0), 1.0);
    let far = document
        .split_at(&document.selection().clone(), at, reach_m)
        .unwrap_err();
    assert_eq!(far, ShapeError::NothingNear { at, reach_m });
    assert_eq!(
        far.to_string(),
        "no path passes within 1 m of (5.000, 3.000) m"
    );
    let end = document.split_at(&document.selection().clone(), p(-3.0, 0.0), 5.0);
    assert_eq!(end, Err(ShapeError::AtEnd { path: "ab".into() }));
    assert!(!document.is_changed());
}

#[test]
fn join_undoes_a_split() {
    for id in ["ab", "bc", "cf"] {
        let mut document = network();
        let row = path(&document, id);
        let before = document.to_layout();
        let bounds = document.index().path_bounds(row).unwrap();
        select(&mut document, [row]);
        let nodes = document
            .split_at(&document.selection().clone(), bounds.center(), 5.0)
            .unwrap();
        let between = document.to_layout();
        assert_eq!(document.join_at(nodes[0]), Ok(row));
        super::network::assert_same(&document.to_layout(), &before);
        check_step(&mut document, &between, "join");
        assert_eq!(members(&document), ["ab", "cf", "near h"]);
    }
}

#[test]
fn join_turns_two_way_paths_around() {
    let mut document = network();
    let ab = path(&document, "ab");
    select(&mut document, [ab]);
    let nodes = document
        .split_at(&document.selection().clone(), p(5.0, 0.0), 1.0)
        .unwrap();
    // The second half is drawn from b to the new node.
    let half = path(&document, "ab.2");
    let turned = document.layout().paths.get(half as usize);
    let (start, end) = (turned.start_node(), turned.end_node());
    let mut runs = guideway_spline::Runs::default();
    turned.copy_runs(&mut runs);
    let mut geometry = guideway_layout::Geometry::default();
    geometry.push(&runs.reversed());
    let reshape = guideway_scene::Edit::Reshape {
        paths: [half].into(),
        curves: geometry.into(),
        written: Default::default(),
    };
    let ends_of = guideway_scene::TableEdit::SetEnds([(half, [end, start])].into());
    document
        .perform("turn", vec![reshape.into(), ends_of.into()])
        .unwrap();
    let speed = guideway_scene::TableEdit::SetValues {
        of: guideway_scene::Table::Paths,
        vehicle_type: None,
        column: "maxReverseSpeed".into(),
        quantity: None,
        rows: (0..document.scene().row_count() as u32).collect(),
        values: Arc::new([Some(Value::Float(0.3))].into_iter().collect()),
    };
    document.perform("slow back", vec![speed.into()]).unwrap();
    let one_sided = document.join_at(nodes[0]).unwrap_err().to_string();
    assert!(
        one_sided.ends_with("differ in maxReverseSpeed, which has a direction"),
        "{one_sided}"
    );
    document.undo();
    let before = document.to_layout();
    let joined = document.join_at(nodes[0]).unwrap();
    check_step(&mut document, &before, "join");
    let (start, end) = ends(&document, joined as usize);
    assert!(is_near(start, p(0.0, 0.0)) && is_near(end, p(10.0, 0.0)));
}

#[test]
fn join_that_cannot_be_is_named() {
    let mut document = network();
    let join = |document: &mut Document, id: &str| {
        let row = node(document, id);
        document.join_at(row).unwrap_err()
    };
    let differ = join(&mut document, "a");
    let expected = "paths \"ag\" and \"ab\" differ in direction, vehicle types";
    assert_eq!(differ.to_string(), expected);
    let count = join(&mut document, "b");
    assert_eq!(
        count.to_string(),
        "3 paths meet at node \"b\"; the edit needs two"
    );
    let station = join(&mut document, "g");
    assert_eq!(station.to_string(), "station \"rack\" is at node \"g\"");
    let of_pair = join(&mut document, "e");
    assert!(matches!(of_pair, ShapeError::TurnsBack { .. }), "{of_pair}");
    let one = join(&mut document, "upstairs");
    assert_eq!(
        one.to_string(),
        "1 paths meet at node \"upstairs\"; the edit needs two"
    );
    let (what, row) = ("node", 99);
    let unknown = document.join_at(row);
    assert_eq!(
        unknown,
        Err(EditError::UnknownReference { what, row }.into())
    );
    assert!(!document.is_changed());
}
