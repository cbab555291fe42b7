//! Two paths on the same curve that differ are no duplicates: the finding names the differences.

use guideway_layout::{Code, Diagnostics, NewPath, Quantity, Severity, Value};

use crate::findings::{codes, found, only};
use crate::sketch::{Sketch, line_runs, p};

/// Two paths for two vehicle types between the same two nodes.
fn pair() -> Sketch {
    let mut sketch = Sketch::default();
    let start = sketch.layout.nodes.push("a", p(0.0, 0.0), None);
    let end = sketch.layout.nodes.push("b", p(10.0, 0.0), None);
    for id in ["first", "second"] {
        sketch.layout.paths.push(&NewPath {
            id,
            runs: &line_runs(p(0.0, 0.0), p(10.0, 0.0)),
            start_node: Some(start),
            end_node: Some(end),
            vehicle_types: &["tug", "fork"],
            ..NewPath::default()
        });
    }
    sketch
}

/// The message of the only finding, which must be information without the advice to remove a path.
fn difference(found: &Diagnostics) -> String {
    let (place, message) = only(found, Code::SameCurve);
    assert_eq!(place, "path \"second\"");
    let finding = found.iter().next().expect("a finding");
    assert_eq!(finding.severity, Severity::Info);
    assert!(!finding.remedy.contains("Remove"), "{}", finding.remedy);
    let (_, difference) = message
        .split_once("; they differ in ")
        .expect("a difference");
    difference.to_owned()
}

#[test]
fn paths_that_agree_in_everything_are_duplicates() {
    let mut sketch = pair();
    for row in 0..2 {
        let attributes = &mut sketch.layout.paths.attributes;
        attributes.set_quantity(row, "maxSpeed", 1.0, Quantity::Speed);
        attributes.set(row, "actions", Value::Json("[]"));
    }
    let entries = &mut sketch.layout.paths.vehicle_types_mut().attributes;
    for (entry, height) in [(0, 1.0), (1, 2.0), (2, 1.0), (3, 2.0)] {
        entries.set_quantity(entry, "maxHeight", height, Quantity::Length);
    }
    let found = found(&sketch);
    let (_, message) = only(&found, Code::DuplicatePath);
    let expected = "has the curve of path \"first\", from node \"a\" to node \"b\", and agrees in \
                    all properties";
    assert_eq!(message, expected);
    let remedy = &found.iter().next().expect("a finding").remedy;
    assert!(
        remedy.starts_with("Remove one of the two; if both are meant"),
        "{remedy}"
    );
}

#[test]
fn names_the_values_that_differ_with_their_unit() {
    let mut sketch = pair();
    let attributes = &mut sketch.layout.paths.attributes;
    attributes.set_quantity(0, "maxSpeed", 1.0, Quantity::Speed);
    attributes.set_quantity(1, "maxSpeed", 0.5, Quantity::Speed);
    assert_eq!(difference(&found(&sketch)), "maxSpeed: 1 and 0.5 m/s");
}

#[test]
fn load_restriction_of_one_path_is_a_difference() {
    let mut sketch = pair();
    let attributes = &mut sketch.layout.paths.attributes;
    attributes.set(1, "loadRestriction.loaded", Value::Bool(false));
    assert_eq!(
        difference(&found(&sketch)),
        "loadRestriction.loaded: none and false"
    );
}

#[test]
fn value_of_one_vehicle_type_is_a_difference() {
    let mut sketch = pair();
    let entries = &mut sketch.layout.paths.vehicle_types_mut().attributes;
    for (entry, height) in [(0, 1.0), (1, 2.0), (2, 1.0), (3, 2.5)] {
        entries.set_quantity(entry, "maxHeight", height, Quantity::Length);
    }
    assert_eq!(
        difference(&found(&sketch)),
        "maxHeight of fork: 2 and 2.5 m"
    );
}

#[test]
fn end_node_is_a_difference() {
    let mut sketch = pair();
    let other = sketch.layout.nodes.push("c", p(10.0, 0.0), None);
    let nodes = (Some(0), Some(other));
    sketch.layout.paths.push(&NewPath {
        id: "third",
        runs: &line_runs(p(0.0, 0.0), p(10.0, 0.0)),
        start_node: nodes.0,
        end_node: nodes.1,
        vehicle_types: &["tug", "fork"],
        ..NewPath::default()
    });
    let found = found(&sketch);
    assert_eq!(
        codes(&found),
        [(Code::DuplicatePath, 1), (Code::SameCurve, 1)]
    );
    let message = &found.iter().last().unwrap().message;
    let expected = "they differ in end node: node \"b\" and node \"c\"";
    assert!(message.ends_with(expected), "{message}");
}

#[test]
fn style_and_names_are_differences() {
    let mut sketch = pair();
    let paths = &mut sketch.layout.paths;
    paths.attributes.set(0, "name", Value::Text("north"));
    paths.attributes.set(1, "name", Value::Text("south"));
    paths.set_width_m(vec![0.5, 1.0]);
    let expected = "name: north and south; width: 0.5 and 1 m";
    assert_eq!(difference(&found(&sketch)), expected);
}

#[test]
fn long_texts_and_lists_of_differences_are_shortened() {
    let mut sketch = pair();
    for i in 0..6 {
        let (name, text) = (format!("note {i}"), "ä".repeat(100));
        let attributes = &mut sketch.layout.paths.attributes;
        attributes.set(1, &name, Value::Text(&text));
    }
    let message = difference(&found(&sketch));
    assert!(message.starts_with(&format!("note 0: none and {}...; note 1", "ä".repeat(30))));
    assert!(
        message.ends_with("...; and 2 other properties"),
        "{message}"
    );
}

#[test]
fn a_later_path_is_compared_with_all_earlier_ones() {
    let mut sketch = Sketch::default();
    let runs = line_runs(p(0.0, 0.0), p(10.0, 0.0));
    for i in 0..3_000 {
        sketch.free_path("", &runs);
        let speed = f64::from(i % 1_000);
        let attributes = &mut sketch.layout.paths.attributes;
        attributes.set_quantity(i as usize, "maxSpeed", 0.01 * speed, Quantity::Speed);
    }
    let found = found(&sketch);
    assert_eq!(
        codes(&found),
        [(Code::DuplicatePath, 2_000), (Code::SameCurve, 999)]
    );
    let duplicates = found.iter().filter(|d| d.code == Code::DuplicatePath);
    let last = duplicates.last().unwrap();
    assert!(
        last.message.contains("path number 1000,"),
        "{}",
        last.message
    );
}

#[test]
fn two_way_paths_against_each_other_differ_if_a_property_has_a_direction() {
    let of = |name: &str| {
        let mut sketch = Sketch::default();
        for (row, (from, to)) in [(0.0, 10.0), (10.0, 0.0)].into_iter().enumerate() {
            sketch.layout.paths.push(&NewPath {
                id: ["first", "second"][row],
                runs: &line_runs(p(from, 0.0), p(to, 0.0)),
                direction: guideway_layout::Direction::Both,
                ..NewPath::default()
            });
            let attributes = &mut sketch.layout.paths.attributes;
            attributes.set_quantity(row, name, 1.0, Quantity::Speed);
        }
        found(&sketch)
    };
    only(&of("maxSpeed"), Code::DuplicatePath);
    let message = difference(&of("maxReverseSpeed"));
    assert_eq!(
        message,
        "maxReverseSpeed (m/s), as the curves run in opposite directions"
    );
}
