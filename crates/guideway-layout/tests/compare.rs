//! Differences of layouts: each kind is found, and equal layouts have none.

use guideway_layout::{
    Block, CompareOptions, Direction, Layout, Level, Member, NewPath, Value, VehicleType,
    WrittenCurve, Zone, differences,
};
use guideway_spline::{Affine, Point, Runs};

fn line(from: (f64, f64), to: (f64, f64)) -> Runs {
    let mut runs = Runs::default();
    runs.push_line(Point::new(from.0, from.1), Point::new(to.0, to.1));
    runs
}

fn sample() -> Layout {
    let mut layout = Layout::default();
    for id in ["ground", "first"] {
        layout.levels.push(Level {
            id: id.into(),
            ..Level::default()
        });
    }
    for (id, x) in [("n1", 0.0), ("n2", 10.0), ("n3", 20.0)] {
        layout.nodes.push(id, Point::new(x, 0.0), Some(0));
    }
    for (id, nodes) in [("e1", [0, 1]), ("e2", [1, 2])] {
        let ends = nodes.map(|n: u32| (f64::from(n) * 10.0, 0.0));
        layout.paths.push(&NewPath {
            id,
            runs: &line(ends[0], ends[1]),
            start_node: Some(nodes[0]),
            end_node: Some(nodes[1]),
            level: Some(0),
            vehicle_types: &["fork", "tug"],
            ..NewPath::default()
        });
    }
    let entries = &mut layout.paths.vehicle_types_mut().attributes;
    (0..4).for_each(|entry| entries.set(entry, "maxSpeed", Value::Float(entry as f64)));
    layout
        .stations
        .push("dock", Some(Point::new(0.0, 2.0)), vec![0], Some(0));
    layout.vehicle_types.push(VehicleType {
        id: "tug".into(),
        ..VehicleType::default()
    });
    layout.blocks.push(Block {
        id: "crossing".into(),
        members: vec![Member::Path(0), Member::Node(1)],
        ..Block::default()
    });
    layout.zones.push(Zone {
        id: "wet".into(),
        outline_m: vec![
            Point::new(0.0, 0.0),
            Point::new(1.0, 0.0),
            Point::new(0.0, 1.0),
        ],
        ..Zone::default()
    });
    layout
}

fn kinds(a: &Layout, b: &Layout) -> Vec<(String, u64)> {
    let found = differences(a, b, &CompareOptions::default());
    found.into_iter().map(|d| (d.what, d.count)).collect()
}

#[test]
fn equal_layouts_have_no_difference() {
    let layout = sample();
    assert_eq!(kinds(&layout, &layout.clone()), []);
    assert_eq!(kinds(&Layout::default(), &Layout::default()), []);
}

#[test]
fn finds_each_kind_of_change() {
    type Change = fn(&mut Layout);
    let changes: [(&str, Change); 18] = [
        ("paths", |l| l.retain_paths(&[0])),
        ("curves", |l| {
            l.paths
                .transform([1], Affine::translation(Point::new(0.0, 1e-3)));
        }),
        ("new curves", |l| {
            l.paths.set_written_curve(
                0,
                WrittenCurve {
                    degree: 1,
                    knots: Vec::new(),
                    points_m: Vec::new(),
                    weights: None,
                },
            );
        }),
        ("ends", |l| l.paths.set_nodes(0, Some(0), Some(2))),
        ("ends", |l| l.stations.set_nodes(0, vec![1])),
        ("directions", |l| l.paths.set_direction(1, Direction::Both)),
        ("levels", |l| l.paths.set_level(1, Some(1))),
        ("levels", |l| l.levels[1].elevation_m = Some(4.0)),
        ("vehicle types", |l| {
            l.paths.vehicle_types_mut().set(1, &["tug"]);
        }),
        ("new vehicle types", |l| {
            l.vehicle_types[0].id = "truck".into();
        }),
        ("column maxSpeed", |l| {
            l.paths
                .vehicle_types_mut()
                .attributes
                .set(3, "maxSpeed", Value::Float(0.5));
        }),
        ("new column name", |l| {
            l.nodes.attributes.set(2, "name", Value::Text("N3"));
        }),
        ("positions", |l| {
            l.nodes.set_position_m(1, Point::new(10.0, 1.0));
        }),
        ("positions", |l| l.stations.set_position_m(0, None)),
        ("blocks", |l| l.blocks[0].members.truncate(1)),
        ("zones", |l| l.zones[0].outline_m.truncate(2)),
        ("new layout properties", |l| {
            l.attributes.set(0, "project", Value::Text("Hall"));
        }),
        ("new widths", |l| l.paths.set_width_m(vec![f32::NAN, 0.5])),
    ];
    let before = sample();
    for (kind, change) in changes {
        let mut after = before.clone();
        change(&mut after);
        let found = kinds(&before, &after);
        assert!(
            found.iter().any(|(what, _)| what == kind),
            "{kind}: {found:?}"
        );
        assert!(found.len() <= 2, "{kind}: {found:?}");
    }
}

#[test]
fn matches_renamed_rows_by_order_if_no_identifier_is_kept() {
    let before = sample();
    let mut after = before.clone();
    after.paths.set_ids(&[(0, "1"), (1, "2")]);
    assert_eq!(kinds(&before, &after), [("identifiers".to_owned(), 2)]);
    after.paths.set_ids(&[(1, "e2")]);
    let one_of_each = [("paths".to_owned(), 1), ("new paths".to_owned(), 1)];
    assert_eq!(kinds(&before, &after)[..2], one_of_each);
}

#[test]
fn renamed_rows_elsewhere_are_other_elements() {
    let mut before = Layout::default();
    let mut after = Layout::default();
    for (layout, ids, x) in [
        (&mut before, ["a", "b"], 0.0),
        (&mut after, ["1", "2"], 50.0),
    ] {
        for (i, id) in ids.into_iter().enumerate() {
            let at = Point::new(x + 10.0 * i as f64, 0.0);
            layout.nodes.push(id, at, None);
            layout.stations.push(id, Some(at), Vec::new(), None);
            layout.paths.push(&NewPath {
                id,
                runs: &line((at.x, 0.0), (at.x + 5.0, 0.0)),
                ..NewPath::default()
            });
        }
    }
    let tables = ["paths", "nodes", "stations"];
    let expected = tables.map(|of| [(of.to_owned(), 2), (format!("new {of}"), 2)]);
    assert_eq!(kinds(&before, &after), expected.concat());
}
