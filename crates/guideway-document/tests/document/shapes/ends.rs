//! Welds and straight lines.

use guideway_document::{ShapeError, Welded};
use guideway_layout::{Layout, Value};

use super::network::{assert_same, check, check_step, line, members, network, node, path};
use crate::site::{document_of, ends, is_near, p, select};

#[test]
fn weld_brings_paths_stations_and_blocks_to_one_node() {
    let mut document = network();
    let rows = ["gh", "hb"].map(|id| path(&document, id));
    select(&mut document, rows);
    let before = document.to_layout();
    let welded = document.weld(&document.selection().clone(), 0.05).unwrap();
    let expected = Welded {
        nodes: 1,
        ..Welded::default()
    };
    assert_eq!(welded, expected);
    check_step(&mut document, &before, "weld");
    let h = node(&document, "h");
    let hb = path(&document, "hb");
    assert_eq!(
        document.layout().paths.get(hb as usize).start_node(),
        Some(h)
    );
    assert!(is_near(ends(&document, hb as usize).0, p(10.0, 10.0)));
    assert_eq!(document.to_layout().nodes.len(), before.nodes.len() - 1);
    assert_eq!(members(&document), ["ab", "cf", "h"]);
}

#[test]
fn weld_lists_the_values_that_go() {
    let mut layout = Layout::default();
    for (row, x) in [0.0, 10.0, 10.01, 20.0].into_iter().enumerate() {
        let at = p(x, 0.0);
        let types: &[&str] = if row == 2 { &["tug"] } else { &[] };
        layout
            .nodes
            .push_for_types(&format!("n{row}"), at, None, types);
    }
    for (start, end) in [(0, 1), (2, 3)] {
        let runs = line(layout.nodes.position_m(start), layout.nodes.position_m(end));
        layout.paths.push(&guideway_layout::NewPath {
            runs: &runs,
            start_node: Some(start),
            end_node: Some(end),
            ..guideway_layout::NewPath::default()
        });
    }
    let nodes = &mut layout.nodes;
    for (row, name, value) in [
        (1, "zone", "A"),
        (2, "zone", "A"),
        (1, "use", "in"),
        (2, "use", "out"),
    ] {
        nodes.attributes.set(row, name, Value::Text(value));
    }
    let of_types = &mut nodes.vehicle_types_mut().attributes;
    of_types.set(0, "theta", Value::Float(1.0));
    let mut document = document_of(layout);
    document.select_all();
    let welded = document.weld(&document.selection().clone(), 0.02).unwrap();
    // Both are of zone A.
    let values = welded
        .values
        .iter()
        .map(|(name, count)| (name.as_str(), *count));
    assert_eq!(values.collect::<Vec<_>>(), [("theta", 1), ("use", 1)]);
}

#[test]
fn stations_keep_their_welded_node() {
    let mut layout = Layout::default();
    for (row, x) in [0.0, 10.0, 10.01, 20.0].into_iter().enumerate() {
        layout.nodes.push(&format!("n{row}"), p(x, 0.0), None);
    }
    for (start, end) in [(0, 1), (2, 3), (1, 2)] {
        let at = |node| layout.nodes.position_m(node);
        let runs = line(at(start), at(end));
        layout.paths.push(&guideway_layout::NewPath {
            id: &format!("{start}-{end}"),
            runs: &runs,
            start_node: Some(start),
            end_node: Some(end),
            ..guideway_layout::NewPath::default()
        });
    }
    layout.stations.push("dock", None, vec![2, 1], None);
    let mut document = document_of(layout);
    document.select_all();
    let before = document.to_layout();
    let welded = document.weld(&document.selection().clone(), 0.02).unwrap();
    let expected = Welded {
        nodes: 1,
        paths: 1,
        ..Welded::default()
    };
    assert_eq!(
        welded, expected,
        "the path between the two has no length left"
    );
    check_step(&mut document, &before, "weld");
    assert_eq!(document.layout().stations.nodes(0), [1]);
}

#[test]
fn free_ends_get_a_common_node() {
    let mut document = network();
    let drawn = [
        ("p", p(40.0, 0.0), p(50.0, 0.0)),
        ("q", p(50.01, 0.0), p(60.0, 0.0)),
    ];
    for (id, from, to) in drawn {
        document.draw_path(id.into(), &[from, to], 0.0).unwrap();
    }
    let rows = ["p", "q"].map(|id| path(&document, id));
    select(&mut document, rows);
    let before = document.to_layout();
    assert_eq!(
        document
            .weld(&document.selection().clone(), 0.05)
            .unwrap()
            .ends,
        2
    );
    check_step(&mut document, &before, "weld");
    let at = |row: u32| document.layout().paths.get(row as usize);
    assert_eq!(at(rows[0]).end_node(), at(rows[1]).start_node());
    assert!(at(rows[0]).end_node().is_some() && at(rows[0]).start_node().is_none());
}

#[test]
fn weld_never_joins_levels() {
    let mut document = network();
    let rows = ["gh", "up"].map(|id| path(&document, id));
    select(&mut document, rows);
    let error = document
        .weld(&document.selection().clone(), 0.05)
        .unwrap_err();
    assert_eq!(
        error.to_string(),
        "\"h\" and \"upstairs\" are on different levels"
    );
    for value in [0.0, -1.0, f64::INFINITY] {
        let name = "tolerance";
        assert_eq!(
            document.weld(&document.selection().clone(), value),
            Err(ShapeError::Length { name, value })
        );
    }
    assert!(!document.is_changed());
}

#[test]
fn nothing_near_is_welded_to_nothing() {
    let mut document = network();
    document.select_all();
    assert_eq!(
        document.weld(&document.selection().clone(), 1e-4),
        Ok(Welded::default())
    );
    assert!(!document.is_changed());
    assert_same(&document.to_layout(), &network().to_layout());
}

#[test]
fn straight_line_between_the_same_nodes() {
    let mut document = network();
    let bc = path(&document, "bc");
    select(&mut document, [bc]);
    let before = document.to_layout();
    document.straighten(&document.selection().clone()).unwrap();
    check_step(&mut document, &before, "straighten");
    let straight = document.layout().paths.get(bc as usize);
    assert!((straight.length_m() - 10.0).abs() < 1e-9);
    let up = path(&document, "up");
    select(&mut document, [up]);
    let path = "up".into();
    assert_eq!(
        document.straighten(&document.selection().clone()),
        Err(ShapeError::Loop { path })
    );
    check(&document).unwrap();
}
