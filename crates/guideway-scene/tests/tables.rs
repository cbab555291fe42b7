//! Edits of tables: their effect, their inverses and their errors.

use std::sync::Arc;

use guideway_layout::{
    Attribute, Block, CompareOptions, Direction, Layout, Level, Member, NewPath, Quantity,
    TypeEntries, Value, Values, differences,
};
use guideway_scene::{
    Edit, EditError, Insertion, NewNode, NewStation, Scene, SceneOptions, Table, TableEdit,
};
use guideway_spline::{Point, Runs};

fn p(x: f64, y: f64) -> Point<f64> {
    Point::new(x, y)
}

fn line() -> Runs {
    let mut runs = Runs::default();
    runs.push_line(p(0.0, 0.0), p(10.0, 0.0));
    runs
}

/// Two nodes, two paths between them, a station and a block.
fn layout() -> Layout {
    let mut layout = Layout::default();
    layout.levels.push(Level {
        id: "hall".into(),
        ..Level::default()
    });
    let a = layout
        .nodes
        .push_for_types("a", p(0.0, 0.0), None, &["tug"]);
    let b = layout.nodes.push("b", p(10.0, 0.0), None);
    for (id, types) in [("ab", &["tug", "fork"][..]), ("ba", &[])] {
        layout.paths.push(&NewPath {
            id,
            runs: &line(),
            start_node: Some(a),
            end_node: Some(b),
            vehicle_types: types,
            ..NewPath::default()
        });
    }
    let paths = &mut layout.paths;
    paths.attributes.set(0, "lanes", Value::Int(2));
    let own = &mut paths.vehicle_types_mut().attributes;
    own.set_quantity(1, "maxSpeed", 1.5, Quantity::Speed);
    layout.nodes.attributes.set(0, "zone", Value::Text("A"));
    layout
        .stations
        .push("dock", Some(p(0.0, 1.0)), vec![a], None);
    layout.blocks.push(Block {
        id: "crossing".into(),
        members: vec![Member::Path(0), Member::Node(1)],
        ..Block::default()
    });
    layout
}

fn scene() -> Scene {
    Scene::new(Arc::new(layout()), &SceneOptions::default()).expect("options that fit any layout")
}

fn are_equal(a: &Layout, b: &Layout) -> bool {
    let exact = CompareOptions {
        tolerance_m: 0.0,
        relative_tolerance: 0.0,
    };
    differences(a, b, &exact).is_empty() && differences(b, a, &exact).is_empty()
}

fn values(values: &[Option<Value<'_>>]) -> Arc<Values> {
    Arc::new(values.iter().copied().collect())
}

fn set_values(
    vehicle_type: Option<&str>,
    column: &str,
    rows: &[u32],
    of_rows: &[Option<Value<'_>>],
) -> TableEdit {
    TableEdit::SetValues {
        of: Table::Paths,
        vehicle_type: vehicle_type.map(Arc::from),
        column: column.into(),
        quantity: None,
        rows: rows.into(),
        values: values(of_rows),
    }
}

fn entries() -> Arc<TypeEntries> {
    let mut entries = TypeEntries::default();
    entries.push(&[]);
    entries.push(&["crane", "tug"]);
    entries.attributes.set(1, "maxSpeed", Value::Float(9.0));
    Arc::new(entries)
}

/// Edits that change rows, columns and references of every table.
fn edits() -> Vec<TableEdit> {
    let [paths, nodes] = [Table::Paths, Table::Nodes];
    let float = |v| Some(Value::Float(v));
    vec![
        TableEdit::SetIds {
            of: paths,
            ids: [(1, "new".into()), (0, "first".into())].into(),
        },
        set_values(None, "lanes", &[0, 1], &[Some(Value::Int(3))]),
        set_values(None, "lanes", &[1, 0], &[Some(Value::Int(3)), None]),
        set_values(None, "lanes", &[1], &[float(0.5)]),
        set_values(None, "speed", &[1], &[float(0.5)]),
        set_values(Some("fork"), "maxSpeed", &[0], &[float(0.25)]),
        set_values(Some("tug"), "maxSpeed", &[0], &[float(0.25)]),
        set_values(Some("tug"), "name", &[0], &[Some(Value::Text("x"))]),
        TableEdit::SetEntries {
            of: paths,
            rows: [0, 1].into(),
            entries: entries(),
        },
        TableEdit::SetEnds([(0, [Some(1), Some(0)]), (1, [None, Some(1)])].into()),
        TableEdit::SetDirections([(1, Direction::Both)].into()),
        TableEdit::SetLevels {
            of: nodes,
            levels: [(1, Some(0))].into(),
        },
        TableEdit::SetStationNodes([(0, [1, 0].into())].into()),
        TableEdit::SetMembers([(0, [Member::Station(0)].into())].into()),
        TableEdit::MoveNodes([(1, p(3.0, 4.0))].into()),
        TableEdit::MoveStations([(0, None)].into()),
    ]
}

#[test]
fn inverse_restores_the_tables_after_every_edit() {
    for edit in edits() {
        let mut scene = scene();
        let before = layout();
        let edit = Edit::Tables(edit);
        let undo = scene.edit_with_undo(&edit, |_| {}).unwrap();
        let after = scene.layout().clone();
        assert!(!are_equal(&before, &after), "{edit:?}");
        let redo = scene.edit_with_undo(&undo, |_| {}).unwrap();
        assert!(are_equal(&before, scene.layout()), "{edit:?}");
        let columns = |layout: &Layout| {
            let paths = &layout.paths;
            let own = paths.attributes.iter().cloned();
            let all: Vec<_> = own
                .chain(paths.vehicle_types().attributes.iter().cloned())
                .collect();
            all.into_iter()
                .map(|c| (c.name, c.quantity))
                .collect::<Vec<_>>()
        };
        assert_eq!(columns(scene.layout()), columns(&before), "{edit:?}");
        scene.edit(&redo).unwrap();
        assert!(are_equal(&after, scene.layout()), "{edit:?}");
    }
}

#[test]
fn inserted_places_keep_their_rows_when_removed() {
    let mut scene = scene();
    let nodes = [NewNode {
        id: "copy".into(),
        position_m: p(5.0, 5.0),
        level: Some(0),
        vehicle_types: vec!["tug".into()],
        attributes_of: Some(0),
    }];
    let stations = [NewStation {
        id: "rack".into(),
        nodes: vec![2],
        ..NewStation::default()
    }];
    let insert_nodes = Edit::Tables(TableEdit::InsertNodes(nodes.into()));
    let undo_nodes = scene.edit_with_undo(&insert_nodes, |_| {}).unwrap();
    let insert_stations = Edit::Tables(TableEdit::InsertStations(stations.into()));
    let undo_stations = scene.edit_with_undo(&insert_stations, |_| {}).unwrap();
    let layout = scene.layout();
    assert_eq!(
        layout.nodes.attributes.value(2, "zone"),
        Some(Value::Text("A"))
    );
    assert_eq!(layout.stations.nodes(1), [2]);
    assert!(scene.exists(Table::Nodes, 2) && scene.exists(Table::Stations, 1));
    assert!(!scene.exists(Table::Nodes, 3));
    scene.edit(&undo_stations).unwrap();
    let redo_nodes = scene.edit_with_undo(&undo_nodes, |_| {}).unwrap();
    assert!(!scene.exists(Table::Nodes, 2) && scene.exists(Table::Nodes, 1));
    assert_eq!(scene.removed(Table::Nodes).collect::<Vec<_>>(), [2]);
    assert_eq!(scene.removed(Table::Stations).collect::<Vec<_>>(), [1]);
    scene.edit(&redo_nodes).unwrap();
    assert!(scene.exists(Table::Nodes, 2));
}

#[test]
fn a_copied_path_keeps_its_values_per_vehicle_type() {
    let mut scene = scene();
    let copy = Insertion {
        runs: line(),
        vehicle_types: vec!["fork".into()],
        attributes_of: Some(0),
        ..Insertion::default()
    };
    scene.edit(&Edit::Insert([copy].into())).unwrap();
    let paths = &scene.layout().paths;
    assert_eq!(
        paths.value_for(2, "fork", "maxSpeed"),
        Some(Value::Float(1.5))
    );
    assert_eq!(paths.value_for(2, "fork", "lanes"), Some(Value::Int(2)));
}

#[test]
fn rejected_edits_change_nothing_and_say_why() {
    let unknown = |what, row| EditError::UnknownReference { what, row };
    let two = [Some(Value::Int(1)), Some(Value::Int(2))];
    let far = EditError::FarPosition { what: "node" };
    let text_entries = {
        let mut entries = TypeEntries::default();
        entries.push(&["tug"]);
        entries.attributes.set(0, "maxSpeed", Value::Text("fast"));
        Arc::new(entries)
    };
    let set_column = |values: Vec<f64>| {
        let values = values.into_iter().map(|v| Some(Value::Float(v)));
        TableEdit::SetColumn {
            of: Table::Paths,
            per_type: false,
            name: "speed".into(),
            column: Some(Attribute::new("speed", values.collect()).into()),
        }
    };
    let wrong = [
        (
            TableEdit::SetEnds([(2, [None; 2])].into()),
            unknown("path", 2),
        ),
        (
            TableEdit::SetEnds([(0, [None, Some(2)])].into()),
            unknown("node", 2),
        ),
        (
            TableEdit::SetMembers([(1, [].into())].into()),
            unknown("block", 1),
        ),
        (
            TableEdit::SetMembers([(0, [Member::Station(4)].into())].into()),
            unknown("station", 4),
        ),
        (
            TableEdit::SetLevels {
                of: Table::Stations,
                levels: [(0, Some(1))].into(),
            },
            unknown("level", 1),
        ),
        (
            set_values(None, "lanes", &[0, 1, 0], &two),
            EditError::ValueCountMismatch,
        ),
        (
            set_values(None, "speed", &[0], &[Some(Value::Float(f64::NAN))]),
            EditError::NotFinite {
                column: "speed".into(),
            },
        ),
        (
            set_values(Some("fork"), "speed", &[1], &[Some(Value::Float(1.0))]),
            EditError::NoEntry {
                what: "path",
                row: 1,
                vehicle_type: "fork".into(),
            },
        ),
        (
            set_column(vec![1.0, 2.0, 3.0]),
            EditError::ValueCountMismatch,
        ),
        (
            set_column(vec![f64::INFINITY]),
            EditError::NotFinite {
                column: "speed".into(),
            },
        ),
        (
            TableEdit::SetEntries {
                of: Table::Stations,
                rows: [].into(),
                entries: Arc::default(),
            },
            EditError::NoVehicleTypes,
        ),
        (
            TableEdit::SetEntries {
                of: Table::Paths,
                rows: [0].into(),
                entries: text_entries,
            },
            EditError::ColumnType {
                column: "maxSpeed".into(),
            },
        ),
        (
            TableEdit::MoveNodes([(0, p(f64::NAN, 0.0))].into()),
            far.clone(),
        ),
        (TableEdit::MoveNodes([(0, p(2e9, 0.0))].into()), far),
        (
            TableEdit::SetExists {
                of: Table::Paths,
                rows: [(0, false)].into(),
            },
            EditError::PathState,
        ),
    ];
    for (edit, error) in wrong {
        let mut scene = scene();
        let edit = Edit::Tables(edit);
        assert_eq!(scene.edit(&edit), Err(error), "{edit:?}");
        assert!(are_equal(scene.layout(), &layout()), "{edit:?}");
    }
}
