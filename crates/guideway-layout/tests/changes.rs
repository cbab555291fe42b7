//! Tests of [`guideway_layout::changes`]: each kind of change is listed once, with its element.

use guideway_layout::{
    Change, CompareOptions, Direction, ElementKind, Layout, Level, NewPath, Quantity, Value,
    changes,
};
use guideway_spline::{Affine, Point, Runs};

/// Two nodes, two paths for vehicle types, and a station.
fn sample() -> Layout {
    let mut layout = Layout::default();
    layout.levels.push(Level {
        id: "ground".into(),
        ..Level::default()
    });
    let ends = [Point::new(0.0, 0.0), Point::new(10.0, 0.0)];
    let [a, b] =
        [("A", ends[0]), ("B", ends[1])].map(|(id, at)| layout.nodes.push(id, at, Some(0)));
    for (id, types, y) in [("e1", &["tug", "fork"][..], 0.0), ("e2", &[], 5.0)] {
        let mut runs = Runs::default();
        runs.push_line(Point::new(0.0, y), Point::new(10.0, y));
        layout.paths.push(&NewPath {
            id,
            runs: &runs,
            start_node: Some(a),
            end_node: Some(b),
            level: Some(0),
            vehicle_types: types,
            ..NewPath::default()
        });
    }
    let speeds = &mut layout.paths.vehicle_types_mut().attributes;
    speeds.set_quantity(0, "maxSpeed", 1.0, Quantity::Speed);
    layout
        .stations
        .push("dock", Some(ends[0]), vec![a], Some(0));
    layout
}

/// The changes after an edit, as kind, identifier and change.
fn after(edit: impl FnOnce(&mut Layout)) -> Vec<(ElementKind, String, Change)> {
    let old = sample();
    let mut new = old.clone();
    edit(&mut new);
    let found = changes(&old, &new, &CompareOptions::default());
    let elements = found.elements.into_iter();
    elements.map(|of| (of.element, of.id, of.change)).collect()
}

fn set(property: &str, of: Option<&str>, before: Option<&str>, after: Option<&str>) -> Change {
    Change::Set {
        property: property.into(),
        vehicle_type: of.map(Into::into),
        before: before.map(Into::into),
        after: after.map(Into::into),
    }
}

#[test]
fn equal_layouts_have_no_changes() {
    let layout = sample();
    assert!(changes(&layout, &layout.clone(), &CompareOptions::default()).is_empty());
}

#[test]
fn lists_each_kind_of_change() {
    let path = |id: &str, change| vec![(ElementKind::Path, id.to_owned(), change)];
    let moved = Change::Moved { distance_m: 2.0 };
    assert_eq!(
        after(|l| l
            .paths
            .transform([1], Affine::translation(Point::new(0.0, 2.0)))),
        path("e2", moved.clone())
    );
    assert_eq!(
        after(|l| l.nodes.set_position_m(1, Point::new(10.0, 2.0))),
        [(ElementKind::Node, "B".to_owned(), moved)]
    );
    assert_eq!(
        after(|l| l.paths.set_direction(0, Direction::Both)),
        path(
            "e1",
            set("direction", None, Some("one way"), Some("two ways"))
        )
    );
    assert_eq!(
        after(|l| {
            let speeds = &mut l.paths.vehicle_types_mut().attributes;
            speeds.set_quantity(0, "maxSpeed", 1.5, Quantity::Speed);
        }),
        path(
            "e1",
            set("maxSpeed", Some("tug"), Some("1 m/s"), Some("1.5 m/s"))
        )
    );
    assert_eq!(
        after(|l| l.nodes.attributes.set(0, "name", Value::Text("north"))),
        [(
            ElementKind::Node,
            "A".to_owned(),
            set("name", None, None, Some("north"))
        )]
    );
    assert_eq!(
        after(|l| l.paths.set_level(1, None)),
        path("e2", set("level", None, Some("ground"), None))
    );
    assert_eq!(
        after(|l| l.paths.set_nodes(1, Some(0), None)),
        path("e2", set("end node", None, Some("B"), None))
    );
    assert_eq!(
        after(|l| l.paths.vehicle_types_mut().set(1, &["tug"])),
        path("e2", set("vehicle types", None, Some("all"), Some("tug")))
    );
    assert_eq!(after(|l| l.retain_paths(&[0])), path("e2", Change::Removed));
}

#[test]
fn reshaped_paths_state_the_greatest_distance() {
    let found = after(|l| {
        let by = Affine::scale(1.0, 0.5, Point::default());
        l.paths.transform([1], by);
    });
    assert_eq!(found.len(), 1, "{found:?}");
    // A line moved sideways keeps its shape.
    assert_eq!(found[0].2, Change::Moved { distance_m: 2.5 });
    let found = after(|l| {
        let by = Affine::rotation(0.3, Point::new(0.0, 5.0));
        l.paths.transform([1], by);
    });
    let Change::Reshaped { greatest_m } = found[0].2 else {
        panic!("{found:?}");
    };
    assert!(
        (greatest_m - 10.0 * 0.3_f64.sin()).abs() < 1e-6,
        "{greatest_m}"
    );
}

#[test]
fn renamed_elements_are_matched_by_place() {
    let found = after(|l| {
        l.nodes.set_ids(&[(0, "north")]);
        l.paths.set_ids(&[(1, "lane")]);
        l.stations.set_ids(&[(0, "gate")]);
    });
    let expected = [
        (ElementKind::Node, "A", "north"),
        (ElementKind::Path, "e2", "lane"),
        (ElementKind::Station, "dock", "gate"),
    ];
    let expected = expected.map(|(kind, id, to)| {
        let change = Change::Renamed { to: to.to_owned() };
        (kind, id.to_owned(), change)
    });
    assert_eq!(found, expected);
}
