//! Findings depend on what a path is: a way of vehicles, a line of a drawing, a wall.

use guideway_layout::{Code, LineIndex, Severity, TextPosition, Value};

use crate::findings::{codes, found};
use crate::sketch::{Sketch, line_runs, p};
use guideway_spline::Runs;

/// A line with a right angle.
fn corner(from: (f64, f64)) -> Runs {
    let (x, y) = from;
    let mut runs = line_runs(p(x, y), p(x, y + 5.0));
    runs.push_line(p(x, y + 5.0), p(x + 10.0, y));
    runs
}

#[test]
fn kinks_are_warnings_where_vehicles_drive() {
    let mut sketch = Sketch::clean();
    sketch.path("way", &corner((0.0, 0.0)), "a", "b");
    let way = found(&sketch);
    assert_eq!(codes(&way), [(Code::Kink, 1)]);
    assert_eq!(way.count_at_least(Severity::Warning), 1);

    let mut sketch = Sketch::clean();
    sketch.free_path("line", &corner((0.0, 60.0)));
    let line = found(&sketch);
    assert_eq!(codes(&line), [(Code::Kink, 1)]);
    assert_eq!(line.count_at_least(Severity::Warning), 0);

    for (element, expected) in [("lane", 1), ("wall", 0), ("door", 0), ("human lane", 0)] {
        let mut sketch = Sketch::clean();
        sketch.path("way", &corner((0.0, 0.0)), "a", "b");
        let row = sketch.layout.paths.len() - 1;
        let attributes = &mut sketch.layout.paths.attributes;
        attributes.set(row, "element", Value::Text(element));
        assert_eq!(found(&sketch).count(Code::Kink), expected, "{element}");
    }
}

#[test]
fn gaps_of_shapes_are_information() {
    let mut gap = line_runs(p(0.0, 60.0), p(4.0, 60.0));
    gap.push_line(p(6.0, 60.0), p(9.0, 60.0));
    for (format, warnings) in [("SVG", 0), ("DXF", 0), ("LIF", 1)] {
        let mut sketch = Sketch::clean();
        sketch.free_path("shape", &gap);
        sketch.layout.provenance.format = format.to_owned();
        let found = found(&sketch);
        assert_eq!(codes(&found), [(Code::BrokenPath, 1)]);
        assert_eq!(
            found.count_at_least(Severity::Warning),
            warnings,
            "{format}"
        );
    }
}

#[test]
fn ways_and_lanelets_have_identifiers_of_their_own() {
    for (format, elements, count) in [
        ("Lanelet2", ["way", "lanelet"], 0),
        ("Lanelet2", ["way", "way"], 1),
        ("GeoJSON", ["way", "lanelet"], 1),
    ] {
        let mut sketch = Sketch::clean();
        for (i, element) in elements.into_iter().enumerate() {
            let y = 60.0 + 5.0 * i as f64;
            sketch.free_path("7", &line_runs(p(0.0, y), p(9.0, y)));
            let row = sketch.layout.paths.len() - 1;
            let attributes = &mut sketch.layout.paths.attributes;
            attributes.set(row, "element", Value::Text(element));
        }
        sketch.layout.provenance.format = format.to_owned();
        assert_eq!(
            found(&sketch).count(Code::DuplicateId),
            count,
            "{format} {elements:?}"
        );
    }
}

#[test]
fn findings_have_the_place_of_their_element() {
    let mut sketch = Sketch::clean();
    sketch.path("way", &corner((0.0, 0.0)), "a", "b");
    let row = sketch.layout.paths.len() - 1;
    let place = |sketch: &Sketch| {
        let found = found(sketch);
        let place = &found.iter().next().expect("a kink").place;
        (place.line, place.column, place.row)
    };
    assert_eq!(place(&sketch), (None, None, None));
    let layout = &mut sketch.layout;
    layout
        .paths
        .source
        .set_position(row, TextPosition { line: 7, column: 3 });
    assert_eq!(place(&sketch), (Some(7), Some(3), None));
    // Of a kept text, the line follows from the first byte.
    let text = "{\n  {\"way\"}\n}";
    let mut kept = Sketch::clean();
    kept.path("way", &corner((0.0, 0.0)), "a", "b");
    kept.layout
        .paths
        .source
        .set(row, text.find("{\"way").expect("it is there"));
    kept.layout.provenance.text = Some(text.into());
    assert_eq!(place(&kept), (Some(2), Some(3), None));
    assert_eq!(
        LineIndex::new(text).position(0),
        TextPosition { line: 1, column: 1 }
    );
    let mut table = Sketch::clean();
    table.path("way", &corner((0.0, 0.0)), "a", "b");
    table.layout.provenance.format = "Arrow".to_owned();
    assert_eq!(place(&table), (None, None, Some(row as u32 + 1)));
}
