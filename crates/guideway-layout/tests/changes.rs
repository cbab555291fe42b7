//! Tests of [`guideway_layout::changes`]: each kind of change is listed once, with its element.

use guideway_growth::exponent_of_time;
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

/// A change with its values.
#[derive(Clone, Debug, PartialEq)]
enum Found {
    Of(Change),
    Renamed(String),
    Set(String, Option<String>, [Option<String>; 2]),
}

/// The changes after an edit, as kind, identifier and change.
fn after(edit: impl FnOnce(&mut Layout)) -> Vec<(ElementKind, String, Found)> {
    between(&sample(), edit)
}

fn between(old: &Layout, edit: impl FnOnce(&mut Layout)) -> Vec<(ElementKind, String, Found)> {
    let mut new = old.clone();
    edit(&mut new);
    let found = changes(old, &new, &CompareOptions::default());
    let with_values = found.elements.iter().map(|of| {
        let own = |text: &str| text.to_owned();
        let change = match (of.change, found.values(&of)) {
            (Change::Renamed, _) => Found::Renamed(found.new_id(&of).map(own).unwrap_or_default()),
            (_, Some(values)) => Found::Set(
                own(values.property),
                values.vehicle_type.map(own),
                [values.before, values.after],
            ),
            (change, None) => Found::Of(change),
        };
        (of.element, own(found.id(&of)), change)
    });
    with_values.collect()
}

fn set(property: &str, of: Option<&str>, before: Option<&str>, after: Option<&str>) -> Found {
    let values = [before, after].map(|value| value.map(Into::into));
    Found::Set(property.into(), of.map(Into::into), values)
}

#[test]
fn equal_layouts_have_no_changes() {
    let layout = sample();
    assert!(changes(&layout, &layout.clone(), &CompareOptions::default()).is_empty());
}

#[test]
fn lists_each_kind_of_change() {
    let path = |id: &str, change| vec![(ElementKind::Path, id.to_owned(), change)];
    let moved = Found::Of(Change::Moved { distance_m: 2.0 });
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
            set("direction", None, Some("one-way"), Some("two-way"))
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
    assert_eq!(
        after(|l| l.retain_paths(&[0])),
        path("e2", Found::Of(Change::Removed))
    );
}

#[test]
fn reshaped_paths_state_the_greatest_distance() {
    let found = after(|l| {
        let by = Affine::scale(1.0, 0.5, Point::default());
        l.paths.transform([1], by);
    });
    assert_eq!(found.len(), 1, "{found:?}");
    // A line moved sideways keeps its shape.
    assert_eq!(found[0].2, Found::Of(Change::Moved { distance_m: 2.5 }));
    let found = after(|l| {
        let by = Affine::rotation(0.3, Point::new(0.0, 5.0));
        l.paths.transform([1], by);
    });
    let Found::Of(Change::Reshaped { greatest_m }) = found[0].2 else {
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
    let expected =
        expected.map(|(kind, id, to)| (kind, id.to_owned(), Found::Renamed(to.to_owned())));
    assert_eq!(found, expected);
}

/// Nodes along a line, 10 m apart, with a path from each to the next one, and a station at each.
fn chain(count: usize) -> Layout {
    let mut layout = Layout::default();
    for i in 0..count {
        let at = Point::new(10.0 * i as f64, 0.0);
        let node = layout.nodes.push(&format!("n{i}"), at, None);
        let station = Some(Point::new(at.x, 3.0));
        layout
            .stations
            .push(&format!("s{i}"), station, vec![node], None);
        let Some(before) = node.checked_sub(1) else {
            continue;
        };
        let mut runs = Runs::default();
        runs.push_line(layout.nodes.position_m(before), at);
        layout.paths.push(&NewPath {
            id: &format!("p{i}"),
            runs: &runs,
            start_node: Some(before),
            end_node: Some(node),
            ..NewPath::default()
        });
    }
    layout
}

fn is_named(found: &[(ElementKind, String, Found)], id: &str, to: &str) -> bool {
    let renamed = Found::Renamed(to.to_owned());
    let has = |change: &dyn Fn(&Found) -> bool| {
        found.iter().any(|(_, of, found)| of == id && change(found))
    };
    has(&|found| *found == renamed) && has(&|found| matches!(found, Found::Of(_)))
}

#[test]
fn elements_that_were_renamed_and_moved_are_matched_by_what_is_around_them() {
    let old = chain(5);
    let far = Point::new(22.0, 40.0);
    let gone = |found: &[(ElementKind, String, Found)]| {
        let is_gone = |found: &Found| matches!(found, Found::Of(Change::Removed | Change::Added));
        found.iter().filter(|(.., found)| is_gone(found)).count()
    };
    // The paths keep their names.
    let found = between(&old, |l| {
        l.nodes.set_ids(&[(2, "middle")]);
        l.nodes.set_position_m(2, far);
    });
    assert!(
        is_named(&found, "n2", "middle") && gone(&found) == 0,
        "{found:?}"
    );
    // So do its neighbors only; then the paths between them follow, and the station of the node.
    let found = between(&old, |l| {
        l.nodes.set_ids(&[(2, "middle")]);
        l.nodes.set_position_m(2, far);
        l.paths.set_ids(&[(1, "in"), (2, "out")]);
        for path in [1, 2] {
            l.paths
                .transform([path], Affine::translation(Point::new(0.0, 5.0)));
        }
        l.stations.set_ids(&[(2, "gate")]);
        l.stations.set_position_m(2, Some(far));
    });
    for (id, to) in [
        ("n2", "middle"),
        ("p2", "in"),
        ("p3", "out"),
        ("s2", "gate"),
    ] {
        assert!(is_named(&found, id, to), "{id}: {found:?}");
    }
    assert_eq!(gone(&found), 0, "{found:?}");
    // A node at the end has one neighbor, which may have others: within a meter it is the same.
    for (x, count) in [(0.5, 0), (2.0, 2)] {
        let found = between(&old, |l| {
            l.nodes.set_ids(&[(0, "first")]);
            l.nodes.set_position_m(0, Point::new(x, 0.0));
            l.paths.set_nodes(0, None, Some(1));
        });
        assert_eq!(gone(&found), count, "{x} m: {found:?}");
    }
}

#[test]
fn lines_of_a_drawing_that_were_renamed_and_moved_are_matched_by_their_shape() {
    let line = |layout: &mut Layout, id: &str, from: [f64; 2], by: [f64; 2]| {
        let [from, by] = [from, by].map(|[x, y]| Point::new(x, y));
        let mut runs = Runs::default();
        runs.push_line(from, from + by);
        let path = NewPath {
            id,
            runs: &runs,
            ..NewPath::default()
        };
        layout.paths.push(&path);
    };
    let mut old = Layout::default();
    line(&mut old, "a", [0.0, 0.0], [10.0, 0.0]);
    line(&mut old, "b", [0.0, 5.0], [0.0, 7.0]);
    line(&mut old, "kept", [0.0, 50.0], [10.0, 0.0]);
    let changed = |moved: &[([f64; 2], [f64; 2])]| {
        let kinds = between(&old, |l| {
            l.retain_paths(&[2]);
            for (i, &(from, by)) in moved.iter().enumerate() {
                line(l, &format!("new {i}"), from, by);
            }
        });
        let gone = kinds
            .iter()
            .filter(|(.., found)| *found == Found::Of(Change::Removed));
        (gone.count(), kinds)
    };
    let (gone, found) = changed(&[([2.0, 3.0], [10.0, 0.0]), ([4.0, 5.0], [0.0, 7.0])]);
    assert_eq!(gone, 0, "{found:?}");
    for (id, to) in [("a", "new 0"), ("b", "new 1")] {
        assert!(is_named(&found, id, to), "{found:?}");
    }
    for (expected, moved) in [
        // Another shape, far away, and two that may be it.
        (2, vec![([2.0, 3.0], [10.0, 0.5])]),
        (2, vec![([20.0, 0.0], [10.0, 0.0])]),
        (
            2,
            vec![([1.0, 1.0], [10.0, 0.0]), ([0.0, 3.0], [10.0, 0.0])],
        ),
        (
            1,
            vec![([1.0, 1.0], [10.0, 0.0]), ([30.0, 0.0], [10.0, 0.0])],
        ),
    ] {
        let (gone, found) = changed(&moved);
        assert_eq!(gone, expected, "{moved:?}: {found:?}");
    }
}

#[test]
fn several_candidates_are_new_elements() {
    let mut old = Layout::default();
    old.nodes.push("a", Point::new(0.0, 0.0), None);
    let found = between(&old, |l| {
        *l = Layout::default();
        l.nodes.push("b", Point::new(0.3, 0.0), None);
        l.nodes.push("c", Point::new(0.0, 0.3), None);
    });
    let changes: Vec<_> = found.into_iter().map(|(.., change)| change).collect();
    let expected = [Change::Removed, Change::Added, Change::Added];
    assert_eq!(changes, expected.map(Found::Of));
}

#[test]
fn comparison_grows_almost_linearly() {
    let pair = |count: usize| {
        let (old, mut new) = (chain(count), chain(count));
        let names: Vec<String> = (0..count).map(|i| format!("x{i}")).collect();
        let renamed = names.iter().enumerate().skip(count / 2);
        let renamed: Vec<(u32, &str)> = renamed.map(|(i, id)| (i as u32, id.as_str())).collect();
        new.nodes.set_ids(&renamed);
        for row in 0..count as u32 {
            let at = new.nodes.position_m(row) + Point::new(0.2, 0.1);
            new.nodes.set_position_m(row, at);
        }
        for row in 0..count - 1 {
            let attributes = &mut new.paths.attributes;
            attributes.set_quantity(row, "maxSpeed", 1.5, Quantity::Speed);
        }
        (old, new)
    };
    let slope = exponent_of_time([2_000, 8_000, 32_000], pair, |(old, new)| {
        let found = changes(old, new, &CompareOptions::default());
        assert!(found.elements.len() > 2 * old.paths.len());
    });
    assert!(slope < 1.3, "exponent {slope:.2}");
}
