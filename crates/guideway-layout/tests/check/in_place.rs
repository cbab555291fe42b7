//! Rotation edges are no finding; other paths without length are.

use guideway_layout::{Code, NewPath, Quantity, Value};

use crate::findings::{codes, found, only};
use crate::sketch::{Sketch, line_runs, p};

/// The clean layout with a path without length between two nodes at the same place.
fn dot(start: &str, end: &str) -> Sketch {
    let mut sketch = Sketch::clean();
    for id in ["c", "c turned"] {
        sketch.node(id, p(5.0, 5.0));
        sketch.path("", &line_runs(p(0.0, 0.0), p(5.0, 5.0)), "a", id);
    }
    sketch.path("turn", &line_runs(p(5.0, 5.0), p(5.0, 5.0)), start, end);
    sketch
}

/// Codes of the findings, without the two paths that lead to the same place.
fn codes_of(sketch: &Sketch) -> Vec<(Code, u64)> {
    let mut codes = codes(&found(sketch));
    codes.retain(|(code, _)| *code != Code::SameCurve);
    codes
}

#[test]
fn path_from_a_node_to_itself_is_no_finding() {
    assert_eq!(codes_of(&dot("c", "c")), []);
}

#[test]
fn path_that_states_rotation_or_actions_is_no_finding() {
    let plain = dot("c", "c turned");
    assert_eq!(codes_of(&plain), [(Code::ZeroLength, 1)]);
    for (name, value) in [
        ("rotationAllowed", Value::Bool(true)),
        ("orientationType", Value::Text("TANGENTIAL")),
        ("vehicleOrientation", Value::Float(1.57)),
        ("actions", Value::Json("[{\"actionType\": \"pick\"}]")),
    ] {
        let mut sketch = plain.layout.clone();
        let turn = sketch.paths.len() - 1;
        sketch.paths.attributes.set(turn, name, value);
        assert_eq!(codes_of(&Sketch { layout: sketch }), [], "{name}");
    }
    let mut other = plain;
    let turn = other.layout.paths.len() - 1;
    let attributes = &mut other.layout.paths.attributes;
    attributes.set(turn, "maxSpeed", Value::Float(1.0));
    assert_eq!(codes_of(&other), [(Code::ZeroLength, 1)]);
}

#[test]
fn change_of_orientation_between_two_nodes_is_no_finding() {
    let with_theta = |thetas: [f64; 2]| {
        let mut sketch = dot("c", "c turned");
        for (node, theta) in [2, 3].into_iter().zip(thetas) {
            let attributes = &mut sketch.layout.nodes.attributes;
            attributes.set_quantity(node, "theta", theta, Quantity::Angle);
        }
        codes_of(&sketch)
    };
    assert_eq!(with_theta([0.0, 1.57]), []);
    assert_eq!(with_theta([0.0, 0.0]), [(Code::ZeroLength, 1)]);
}

#[test]
fn several_rotations_at_one_place_are_no_pair() {
    let mut sketch = dot("c", "c turned");
    let turn = sketch.layout.paths.len() - 1;
    sketch.path(
        "back",
        &line_runs(p(5.0, 5.0), p(5.0, 5.0)),
        "c turned",
        "c",
    );
    for row in [turn, turn + 1] {
        let attributes = &mut sketch.layout.paths.attributes;
        attributes.set(row, "rotationAllowed", Value::Bool(true));
    }
    assert_eq!(codes(&found(&sketch)), [(Code::SameCurve, 1)]);
    // The same rotation twice is a duplicate.
    sketch.path(
        "again",
        &line_runs(p(5.0, 5.0), p(5.0, 5.0)),
        "c",
        "c turned",
    );
    let attributes = &mut sketch.layout.paths.attributes;
    attributes.set(turn + 2, "rotationAllowed", Value::Bool(true));
    let expected = [(Code::DuplicatePath, 1), (Code::SameCurve, 1)];
    assert_eq!(codes(&found(&sketch)), expected);
}

#[test]
fn advice_about_a_path_between_nodes_keeps_the_path() {
    let mut sketch = dot("c", "c turned");
    let remedy = |sketch: &Sketch| {
        let found = found(sketch);
        let finding = found.iter().find(|d| d.code == Code::ZeroLength).unwrap();
        finding.remedy.clone()
    };
    assert!(!remedy(&sketch).contains("Remove"));
    sketch = Sketch::clean();
    sketch.layout.paths.push(&NewPath {
        runs: &line_runs(p(1.0, 1.0), p(1.0, 1.0)),
        ..NewPath::default()
    });
    only(&found(&sketch), Code::ZeroLength);
    assert!(remedy(&sketch).contains("Remove"));
}

#[test]
fn advice_about_a_node_of_a_station_keeps_the_node() {
    let remedies = |has_station: bool| {
        let mut sketch = Sketch::clean();
        sketch.node("alone", p(5.0, 5.0));
        if has_station {
            sketch.layout.stations.push("dock", None, vec![2], None);
        }
        let found = found(&sketch);
        only(&found, Code::UnusedNode);
        found.iter().next().unwrap().remedy.clone()
    };
    assert!(remedies(false).contains("remove it"));
    assert!(!remedies(true).contains("remove it"));
}
