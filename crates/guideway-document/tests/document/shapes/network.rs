//! A network with two-way paths, reverse pairs, stations, blocks and properties per vehicle type;
//! the rules that must hold in any network.

use std::collections::HashSet;

use guideway_document::Document;
use guideway_layout::{
    Block, CompareOptions, Direction, Layout, Level, Member, NewPath, Quantity, Value, differences,
};
use guideway_spline::{Point, Runs};

use crate::site::{document_of, p};

pub(crate) fn line(from: Point<f64>, to: Point<f64>) -> Runs {
    let mut runs = Runs::default();
    runs.push_line(from, to);
    runs
}

/// Rows of the nodes that a layout has by these names.
pub(crate) fn node(document: &Document, id: &str) -> u32 {
    let nodes = &document.layout().nodes;
    let rows = 0..nodes.len() as u32;
    let exists = |row: &u32| document.scene().exists(guideway_scene::Table::Nodes, *row);
    rows.filter(exists)
        .find(|row| nodes.id(*row) == id)
        .unwrap_or_else(|| panic!("no node {id}"))
}

/// The row of the existing path of a name.
pub(crate) fn path(document: &Document, id: &str) -> u32 {
    let paths = &document.layout().paths;
    let rows = 0..paths.len() as u32;
    let exists = |row: &u32| document.scene().exists(guideway_scene::Table::Paths, *row);
    rows.filter(exists)
        .find(|row| paths.id(*row as usize) == id)
        .unwrap_or_else(|| panic!("no path {id}"))
}

/// Names of the existing paths.
pub(crate) fn path_ids(document: &Document) -> Vec<String> {
    let layout = document.to_layout();
    layout
        .paths
        .iter()
        .map(|path| path.id().to_owned())
        .collect()
}

/// ```text
///   g ----gh---- h          gh, hi: two-way; station "rack" at g
///   |            |          cf, fc: reverse pair, a corner at f
///   |            |          x: no nodes, crosses ab
///   a --ab-- b --bc-- c     bc: bent
///                     || cf, fc
///           e ==ef/fe= f
/// ```
pub(crate) fn network() -> Document {
    let mut layout = Layout::default();
    layout.levels.push(Level {
        id: "ground".into(),
        ..Level::default()
    });
    layout.levels.push(Level {
        id: "first".into(),
        ..Level::default()
    });
    let places = [
        ("a", 0.0, 0.0),
        ("b", 10.0, 0.0),
        ("c", 20.0, 0.0),
        ("f", 20.0, -10.0),
        ("e", 10.0, -10.0),
        ("g", 0.0, 10.0),
        ("h", 10.0, 10.0),
        ("near h", 10.0, 10.02),
        ("upstairs", 10.0, 10.01),
    ];
    for (id, x, y) in places {
        let level = u32::from(id == "upstairs");
        layout.nodes.push(id, p(x, y), Some(level));
    }
    let at = |layout: &Layout, id: &str| -> (u32, Point<f64>) {
        let row = places
            .iter()
            .position(|place| place.0 == id)
            .expect("a place") as u32;
        (row, layout.nodes.position_m(row))
    };
    let paths: [(&str, &str, &str, Direction); 10] = [
        ("ab", "a", "b", Direction::Both),
        ("bc", "b", "c", Direction::Both),
        ("cf", "c", "f", Direction::Forward),
        ("fc", "f", "c", Direction::Forward),
        ("fe", "f", "e", Direction::Forward),
        ("ef", "e", "f", Direction::Forward),
        ("ag", "a", "g", Direction::Forward),
        ("gh", "g", "h", Direction::Forward),
        ("hb", "near h", "b", Direction::Forward),
        ("up", "upstairs", "upstairs", Direction::Forward),
    ];
    for (id, start, end, direction) in paths {
        let ((start, from), (end, to)) = (at(&layout, start), at(&layout, end));
        let mut runs = line(from, to);
        if id == "bc" {
            runs.clear();
            runs.push_bezier(&[from, from + p(3.0, 2.0), to - p(3.0, 2.0), to]);
        }
        if id == "up" {
            runs.clear();
            runs.push_bezier(&[from, from + p(5.0, 2.0), to + p(-5.0, 2.0), to]);
        }
        let row = layout.paths.push(&NewPath {
            id,
            runs: &runs,
            start_node: Some(start),
            end_node: Some(end),
            direction,
            level: Some(u32::from(id == "up")),
            vehicle_types: if id == "ab" { &["tug", "fork"] } else { &[] },
        });
        let speed = if id == "bc" { 0.5 } else { 1.5 };
        let columns = &mut layout.paths.attributes;
        columns.set_quantity(row, "maxSpeed", speed, Quantity::Speed);
        if id == "ab" {
            columns.set_quantity(row, "length", 20.0, Quantity::Length);
        }
    }
    let entries = layout.paths.vehicle_types_mut();
    let (first, second) = (entries.entries(0).start, entries.entries(0).start + 1);
    entries.attributes.set(first, "mass", Value::Float(1.0));
    entries.attributes.set(second, "mass", Value::Float(2.0));
    layout.paths.push(&NewPath {
        id: "x",
        runs: &line(p(4.0, -3.0), p(4.0, 5.0)),
        level: Some(0),
        ..NewPath::default()
    });
    let rack = at(&layout, "g").0;
    layout
        .stations
        .push("rack", Some(p(-1.0, 10.0)), vec![rack], Some(0));
    layout.blocks.push(Block {
        id: "crossing".into(),
        members: vec![Member::Path(0), Member::Path(2), Member::Node(7)],
        ..Block::default()
    });
    document_of(layout)
}

/// Checks that paths end on their nodes, references exist, and names of paths are unique.
pub(crate) fn check(document: &Document) -> Result<(), String> {
    let layout = document.to_layout();
    let mut ids = HashSet::new();
    for path in layout.paths.iter() {
        let Some((start, end)) = path.ends() else {
            return Err(format!("{} has no curve", path.id()));
        };
        for (at_m, node) in [(start, path.start_node()), (end, path.end_node())] {
            let Some(node) = node else { continue };
            let off_m = layout.nodes.position_m(node).distance(at_m);
            if off_m.is_nan() || off_m > 1e-6 {
                return Err(format!("{} is {off_m} m off its node", path.id()));
            }
        }
        if !ids.insert(path.id()) {
            return Err(format!("{} is there twice", path.id()));
        }
    }
    for station in 0..layout.stations.len() as u32 {
        if layout.stations.nodes(station).is_empty() {
            return Err(format!("{} has lost its node", layout.stations.id(station)));
        }
    }
    Ok(())
}

/// Checks the network, and that an edit of one step is undone and done again.
pub(crate) fn check_step(document: &mut Document, before: &Layout, name: &str) {
    check(document).expect("a whole network");
    let after = document.to_layout();
    assert_eq!(document.undo(), Some(name));
    assert_same(&document.to_layout(), before);
    assert_eq!(document.redo(), Some(name));
    assert_same(&document.to_layout(), &after);
}

pub(crate) fn assert_same(found: &Layout, expected: &Layout) {
    let found = differences(expected, found, &CompareOptions::default());
    assert!(found.is_empty(), "{found:?}");
}

/// The members of the block of [`network`], by name.
pub(crate) fn members(document: &Document) -> Vec<String> {
    let layout = document.to_layout();
    let name = |member: &Member| match *member {
        Member::Path(row) => layout.paths.id(row as usize).to_owned(),
        Member::Node(row) => layout.nodes.id(row).to_owned(),
        Member::Station(row) => layout.stations.id(row).to_owned(),
    };
    layout.blocks[0].members.iter().map(name).collect()
}
