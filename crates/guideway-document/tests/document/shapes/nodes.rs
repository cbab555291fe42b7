//! Nodes on lines, rounded corners, and new paths between nodes.

use guideway_document::{AlignTo, Document, NewEdge, Shape, ShapeError};
use guideway_layout::{Direction, Value};
use guideway_scene::EditError;
use guideway_spline::construct::ConstructError;
use guideway_spline::{bezier, uniform};

use super::network::{check, check_step, members, network, node, path};
use crate::site::{is_near, p};

fn rows(document: &Document, ids: &[&str]) -> Vec<u32> {
    ids.iter().map(|id| node(document, id)).collect()
}

#[test]
fn aligned_nodes_take_their_paths_and_stations_along() {
    let mut document = network();
    let nodes = rows(&document, &["a", "g", "f"]);
    let before = document.to_layout();
    document.align_nodes(&nodes, AlignTo::Y).unwrap();
    check_step(&mut document, &before, "align");
    let y = |id: &str| document.node_position_m(node(&document, id)).y;
    assert!(["a", "g", "f"].iter().all(|id| y(id).abs() < 1e-9));
    // The station keeps its place beside its node.
    assert!(is_near(
        document.station_position_m(0).unwrap(),
        p(-1.0, 0.0)
    ));
    document.align_nodes(&nodes, AlignTo::X).unwrap();
    let x = |id: &str| document.node_position_m(node(&document, id)).x;
    assert!(
        ["a", "g", "f"]
            .iter()
            .all(|id| (x(id) - 20.0 / 3.0).abs() < 1e-9)
    );
}

#[test]
fn best_line_keeps_nodes_of_a_line() {
    let mut document = network();
    let nodes = rows(&document, &["g", "b", "f"]);
    let before = document.to_layout();
    // The three lie on one line already.
    document.align_nodes(&nodes, AlignTo::Line).unwrap();
    super::network::assert_same(&document.to_layout(), &before);
    let bent = rows(&document, &["a", "h", "c"]);
    document.align_nodes(&bent, AlignTo::Line).unwrap();
    check(&document).unwrap();
    let [a, h, c] = [0, 1, 2].map(|i| document.node_position_m(bent[i]));
    assert!((h - a).cross(c - a).abs() < 1e-9);
    assert!(
        (a.y - 10.0 / 3.0).abs() < 1e-9,
        "the sum of distances is least: {a:?}"
    );
}

#[test]
fn distributed_nodes_have_even_distances() {
    let mut document = network();
    document
        .move_node(node(&document, "b"), p(3.0, 0.5))
        .unwrap();
    let nodes = rows(&document, &["a", "b", "c"]);
    let before = document.to_layout();
    document.distribute_nodes(&nodes, None).unwrap();
    check_step(&mut document, &before, "distribute");
    let at = |id: &str| document.node_position_m(node(&document, id));
    let gaps = [at("b") - at("a"), at("c") - at("b")];
    let direction = (at("c") - at("a")) * (1.0 / at("c").distance(at("a")));
    assert!((gaps[0] - gaps[1]).dot(direction).abs() < 0.1, "{gaps:?}");
    assert!(is_near(at("a"), p(0.0, 0.0)) && is_near(at("c"), p(20.0, 0.0)));
    // A spacing moves all but the one nearest to the first node.
    let back = rows(&document, &["c", "a"]);
    document.distribute_nodes(&back, Some(5.0)).unwrap();
    let at = |id: &str| document.node_position_m(node(&document, id));
    assert!(is_near(at("c"), p(20.0, 0.0)) && is_near(at("a"), p(15.0, 0.0)));
    check(&document).unwrap();
}

#[test]
fn lines_without_a_direction_are_named() {
    let mut document = network();
    let one = rows(&document, &["a", "a"]);
    let few = document.align_nodes(&one, AlignTo::X);
    assert_eq!(
        few,
        Err(ShapeError::TooFewNodes {
            actual: 1,
            least: 2
        })
    );
    let two = rows(&document, &["a", "b"]);
    let few = document.distribute_nodes(&two, None);
    assert_eq!(
        few,
        Err(ShapeError::TooFewNodes {
            actual: 2,
            least: 3
        })
    );
    let (name, value) = ("spacing", -1.0);
    let negative = document.distribute_nodes(&two, Some(value));
    assert_eq!(negative, Err(ShapeError::Length { name, value }));
    let (what, row) = ("node", 77);
    let unknown = document.align_nodes(&[0, row], AlignTo::X);
    assert_eq!(
        unknown,
        Err(EditError::UnknownReference { what, row }.into())
    );
    assert!(!document.is_changed());
}

/// Turn from the end of one path to the start of another one, in radians.
fn kink_rad(document: &Document, from: u32, to: u32) -> f64 {
    let segments = |row: u32| -> Vec<_> {
        let path = document.layout().paths.get(row as usize);
        path.runs().flat_map(|run| run.segments()).collect()
    };
    let from = bezier::end_direction(&uniform::to_bezier(segments(from).last().expect("a curve")))
        .expect("a curve with a length");
    let to = bezier::start_direction(&uniform::to_bezier(&segments(to)[0]))
        .expect("a curve with a length");
    bezier::angle_rad(from, to)
}

#[test]
fn corner_of_a_reverse_pair_gets_an_arc_per_way() {
    let mut document = network();
    let f = node(&document, "f");
    let before = document.to_layout();
    let arcs = document.fillet_at(f, 2.0).unwrap();
    check_step(&mut document, &before, "fillet");
    assert_eq!(arcs.len(), 2);
    let paths = &document.layout().paths;
    let [cf, fc, fe, ef] = ["cf", "fc", "fe", "ef"].map(|id| path(&document, id));
    for (before, after) in [(cf, fe), (ef, fc)] {
        let way = |&row: &u32| {
            let arc = paths.get(row as usize);
            let starts = paths.get(before as usize).end_node() == arc.start_node();
            starts && paths.get(after as usize).start_node() == arc.end_node()
        };
        let arc = arcs
            .iter()
            .copied()
            .find(way)
            .expect("an arc between the two");
        assert_eq!(paths.get(arc as usize).direction(), Direction::Forward);
        assert!(kink_rad(&document, before, arc) < 1e-6);
        assert!(kink_rad(&document, arc, after) < 1e-6);
        assert_eq!(
            paths.value(arc as usize, "maxSpeed"),
            Some(Value::Float(1.5))
        );
    }
    assert_eq!(members(&document).len(), 4, "the arc of cf is in its block");
    let places = [f, document.layout().nodes.len() as u32 - 1];
    let mut places = places.map(|node| document.node_position_m(node));
    places.sort_by(|a, b| a.x.total_cmp(&b.x));
    assert!(is_near(places[0], p(18.0, -10.0)) && is_near(places[1], p(20.0, -8.0)));
}

#[test]
fn fillet_that_cannot_be_is_named() {
    let mut document = network();
    let fillet = |document: &mut Document, id: &str, radius_m: f64| {
        let row = node(document, id);
        document.fillet_at(row, radius_m).unwrap_err()
    };
    let large = fillet(&mut document, "f", 40.0).to_string();
    assert!(
        large.ends_with("does not fit; the largest one that does is 9.990"),
        "{large}"
    );
    // A path that the arc would use up needs a length.
    let whole = fillet(&mut document, "f", 10.0).to_string();
    assert!(whole.ends_with("does is 9.990"), "{whole}");
    let station = fillet(&mut document, "g", 1.0);
    assert!(matches!(station, ShapeError::Station { .. }), "{station}");
    let branches = fillet(&mut document, "b", 1.0);
    assert!(
        matches!(branches, ShapeError::NotTwo { count: 3, .. }),
        "{branches}"
    );
    let dead_end = fillet(&mut document, "e", 1.0);
    assert!(
        matches!(dead_end, ShapeError::NotTwo { count: 1, .. }),
        "{dead_end}"
    );
    let negative = fillet(&mut document, "f", -1.0);
    let radius = -1.0;
    let reason = ConstructError::Radius { radius };
    assert!(matches!(negative, ShapeError::Curve { reason: r, .. } if r == reason));
    assert!(!document.is_changed());
}

/// Creates a two-way path with the properties of bc.
fn create(document: &mut Document, nodes: [&str; 2], shape: &Shape) -> Result<u32, ShapeError> {
    let [start_node, end_node] = nodes.map(|id| node(document, id));
    let edge = NewEdge {
        start_node,
        end_node,
        curve: Some(document.curve_between([start_node, end_node], shape)?),
        direction: Direction::Both,
        attributes_of: Some(path(document, "bc")),
        ..NewEdge::default()
    };
    Ok(document.create_edge(&edge).expect("nodes and a free name"))
}

#[test]
fn new_curves_continue_adjacent_paths() {
    for case in 0..3 {
        let mut document = network();
        let (gh, bc) = (path(&document, "gh"), path(&document, "bc"));
        let shape = match case {
            0 => Shape::Arc { along: gh },
            1 => Shape::ArcThrough(p(18.0, 8.0)),
            _ => Shape::Spline {
                through: vec![p(16.0, 12.0)],
                along: [Some(gh), Some(bc)],
            },
        };
        let before = document.to_layout();
        let row = create(&mut document, ["h", "c"], &shape).unwrap();
        check_step(&mut document, &before, "create edge");
        let paths = &document.layout().paths;
        assert_eq!(paths.get(row as usize).level(), Some(0));
        assert_eq!(
            paths.value(row as usize, "maxSpeed"),
            Some(Value::Float(0.5))
        );
        if case != 1 {
            assert!(kink_rad(&document, gh, row) < 1e-6);
        }
        if case == 2 {
            // bc ends at c too: the new path meets it head on.
            let against = std::f64::consts::PI - end_turn_rad(&document, row, bc);
            assert!(against.abs() < 1e-6, "{against}");
        }
    }
}

/// Angle between the directions in which two paths end, in radians.
fn end_turn_rad(document: &Document, a: u32, b: u32) -> f64 {
    let direction = |row: u32| {
        let path = document.layout().paths.get(row as usize);
        let last = path.runs().flat_map(|run| run.segments()).last();
        let bezier = uniform::to_bezier(&last.expect("a curve"));
        bezier::end_direction(&bezier).expect("a curve with a length")
    };
    bezier::angle_rad(direction(a), direction(b))
}

#[test]
fn new_curve_that_cannot_be_is_named() {
    let mut document = network();
    let ab = path(&document, "ab");
    let mut error = |nodes: [&str; 2], shape: &Shape| {
        create(&mut document, nodes, shape).unwrap_err().to_string()
    };
    let apart = error(["h", "c"], &Shape::Arc { along: ab });
    assert_eq!(apart, "path \"ab\" neither begins nor ends at node \"h\"");
    let behind = error(["b", "a"], &Shape::Arc { along: ab });
    assert!(
        behind.contains("\"b--a\": no arc begins in this direction"),
        "{behind}"
    );
    let dot = error(["a", "a"], &Shape::ArcThrough(p(1.0, 1.0)));
    assert!(dot.contains("are the same"), "{dot}");
    let unknown = error(["a", "c"], &Shape::Arc { along: 99 });
    assert!(unknown.contains("no path in row 99"), "{unknown}");
    assert!(!document.is_changed());
}
