//! Tests of the DXF reader, with helpers that build small drawings.

mod blocks;
mod cases;
mod real_files;
mod shapes;

use crate::common::read;
use guideway_layout::Layout;
use guideway_spline::{Point, uniform};

/// Reads a drawing in meters. Sections are given as lines of `code value`.
fn drawing(tables: &str, blocks: &str, entities: &str) -> Layout {
    read(&text(&format!(
        "0 SECTION\n2 HEADER\n9 $INSUNITS\n70 6\n0 ENDSEC\n\
         0 SECTION\n2 TABLES\n{tables}\n0 ENDSEC\n\
         0 SECTION\n2 BLOCKS\n{blocks}\n0 ENDSEC\n\
         0 SECTION\n2 ENTITIES\n{entities}\n0 ENDSEC\n0 EOF"
    )))
}

/// Splits lines of `code value` into a line per code and a line per value.
fn text(pairs: &str) -> String {
    let lines = pairs.lines().filter(|line| !line.is_empty());
    let pairs = lines.map(|line| line.split_once(' ').unwrap());
    pairs
        .map(|(code, value)| format!("{code}\n{value}\n"))
        .collect()
}

/// The end points of all segments of a path.
fn vertices(layout: &Layout, id: &str) -> Vec<Point<f64>> {
    let path = layout.paths.iter().find(|p| p.id() == id);
    let path = path.unwrap_or_else(|| panic!("no path {id}"));
    let segments: Vec<_> = path.runs().flat_map(|run| run.segments()).collect();
    let ends = segments.iter().map(uniform::end);
    [uniform::start(&segments[0])]
        .into_iter()
        .chain(ends)
        .collect()
}

fn assert_near(found: Point<f64>, x: f64, y: f64) {
    assert!(
        found.distance(Point::new(x, y)) < 1e-9,
        "{found:?} is not ({x}, {y})"
    );
}

/// A LINE with the handle A.
const LINE: &str = "0 LINE\n5 A\n8 0\n10 1\n20 0\n11 3\n21 1\n";
