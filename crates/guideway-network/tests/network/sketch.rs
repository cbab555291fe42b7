//! Sketches of drawings, networks and cases.

use std::f64::consts::FRAC_PI_2;
use std::path::{Path, PathBuf};

use guideway_formats::{ReadOptions, read_file};
use guideway_layout::{Layout, NewPath, Note, NoteKind, Value};
use guideway_network::{BuildOptions, Network, build};
use guideway_spline::{Point, Runs, arc_to_runs};

/// A drawing of lines, named by their numbers, on one layer.
pub(crate) fn drawing(lines: &[[f64; 4]]) -> Layout {
    let mut layout = Layout::default();
    for line in lines {
        add_line(&mut layout, *line, "TRACK");
    }
    layout
}

pub(crate) fn add_line(layout: &mut Layout, [ax, ay, bx, by]: [f64; 4], layer: &str) {
    let mut runs = Runs::default();
    runs.push_line(Point::new(ax, ay), Point::new(bx, by));
    add_runs(layout, &runs, layer);
}

pub(crate) fn add_runs(layout: &mut Layout, runs: &Runs, layer: &str) {
    let id = format!("{}", layout.paths.len() + 1);
    let row = layout.paths.push(&NewPath {
        id: &id,
        runs,
        ..NewPath::default()
    });
    layout
        .paths
        .attributes
        .set(row, "layer", Value::Text(layer));
}

/// A quarter of a circle about the origin.
pub(crate) fn quarter(radius_m: f64) -> Runs {
    let mut runs = Runs::default();
    arc_to_runs(
        Point::new(0.0, 0.0),
        radius_m,
        0.0,
        FRAC_PI_2,
        1e-6,
        &mut runs,
    );
    runs
}

pub(crate) fn add_text(layout: &mut Layout, text: &str, x: f64, y: f64) {
    layout.notes.push(Note {
        kind: NoteKind::Text,
        text: text.into(),
        layer: "STATION".into(),
        position_m: Point::new(x, y),
        ..Note::default()
    });
}

/// Welds within 5 cm, cuts at junctions and crossings, and takes stations from texts.
pub(crate) fn split() -> BuildOptions {
    BuildOptions {
        weld_m: 0.05,
        split_junctions: true,
        split_crossings: true,
        stations: vec!["text:STATION".parse().unwrap()],
        ..BuildOptions::default()
    }
}

pub(crate) fn network(drawing: &Layout, options: &BuildOptions) -> Network {
    build(drawing, options).unwrap()
}

/// Start and end of each edge, by the positions of its nodes, in millimeters.
pub(crate) fn edges_mm(layout: &Layout) -> Vec<[i64; 4]> {
    let mm = |v: f64| (v * 1e3).round() as i64;
    let at = |node: Option<u32>| layout.nodes.position_m(node.unwrap());
    let edge = |path: guideway_layout::PathRef<'_>| {
        let (a, b) = (at(path.start_node()), at(path.end_node()));
        [mm(a.x), mm(a.y), mm(b.x), mm(b.y)]
    };
    let mut edges: Vec<_> = layout.paths.iter().map(edge).collect();
    edges.sort_unstable();
    edges
}

/// Asserts that each edge begins and ends at its nodes.
pub(crate) fn assert_ends_meet(layout: &Layout) {
    for path in layout.paths.iter() {
        let (start, end) = path.ends().unwrap();
        for (at, node) in [(start, path.start_node()), (end, path.end_node())] {
            let node_at = layout.nodes.position_m(node.unwrap());
            assert!(
                at.distance(node_at) < 1e-9,
                "{}: {at:?} {node_at:?}",
                path.id()
            );
        }
    }
}

/// A file of the folder `shared/cases/network` beside the repository, if it is there.
pub(crate) fn case(name: &str) -> Option<Layout> {
    let folder: PathBuf =
        Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/cases/network");
    let file = folder.join(name);
    if !file.exists() {
        eprintln!("SKIPPED: {} is not there", file.display());
        return None;
    }
    Some(read_file(&file, &ReadOptions::default()).unwrap())
}
