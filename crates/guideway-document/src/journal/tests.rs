//! Round trips of entries, and damage to their bytes.

use std::io::Cursor;
use std::mem::discriminant;
use std::sync::Arc;

use guideway_layout::{
    Attribute, Attributes, Direction, Geometry, Level, Member, OwnStyle, Quantity, TypeEntries,
    Value, VehicleType, WrittenCurve, WrittenCurves,
};
use guideway_scene::{Edit, Insertion, NewNode, NewStation, PathState, Table, TableEdit};
use guideway_spline::{Affine, Point, Runs};

use super::decode::decode;
use super::encode::encode;
use super::entry::JournalEntry;
use super::record::count_records;
use crate::change::{Change, CopiesOf};
use crate::elements::Elements;

/// An entry with one change of every kind.
fn every_change() -> JournalEntry {
    let mut runs = Runs::default();
    runs.push_line(Point::new(0.0, 1.0), Point::new(2.0, 3.0));
    let mut curves = Geometry::default();
    curves.push(&runs);
    let mut written = WrittenCurves::default();
    let curve = WrittenCurve {
        degree: 1,
        knots: vec![0.0, 0.0, 1.0, 1.0],
        points_m: vec![Point::new(0.0, 1.0), Point::new(2.0, 3.0)],
        weights: Some(vec![1.0, 2.0]),
    };
    written.set(0, Some(curve.into()));
    let style = OwnStyle {
        width_m: Some(0.5),
        color_rgba: None,
    };
    let insertion = Insertion {
        id: "é".into(),
        runs,
        start_node: Some(3),
        direction: Direction::Both,
        vehicle_types: vec!["a".into(), "b".into()],
        style,
        attributes_of: Some(7),
        ..Insertion::default()
    };
    let ranked = Insertion {
        rank: Some(-2),
        written: written.shared(0),
        ..insertion.clone()
    };
    let edits = [
        Edit::Transform {
            paths: [1, 2].into(),
            by: Affine::rotation(0.3, Point::new(1.0, 2.0)),
        },
        Edit::Reshape {
            paths: [4].into(),
            curves: curves.clone().into(),
            written: Arc::default(),
        },
        Edit::Reshape {
            paths: [4].into(),
            curves: curves.into(),
            written: written.into(),
        },
        Edit::Restyle([(1, style)].into()),
        Edit::SetStates([(1, PathState::Hidden), (2, PathState::Removed)].into()),
        Edit::Insert([insertion].into()),
        Edit::Insert([ranked].into()),
    ];
    let mut changes: Vec<Change> = edits.into_iter().map(Change::Scene).collect();
    changes.push(Change::MoveNodes([(1, Point::new(5.0, 6.0))].into()));
    changes.push(Change::Copy(CopiesOf {
        elements: Arc::new(Elements::of_paths([2, 7])),
        count: 3,
        step_m: Point::new(0.5, -1.0),
    }));
    changes.extend(every_table_edit().into_iter().map(Change::from));
    JournalEntry::Do(changes)
}

/// An edit of tables of every kind, with values of every type.
fn every_table_edit() -> Vec<TableEdit> {
    let column = |name: &str, value: Value<'_>| Attribute {
        quantity: Some(Quantity::Speed),
        source_type: Some("f32".into()),
        ..Attribute::new(name, [None, Some(value)].into_iter().collect())
    };
    let set = |value: Value<'_>| TableEdit::SetValues {
        of: Table::Paths,
        vehicle_type: Some("tug".into()),
        column: "maxSpeed".into(),
        quantity: Some(Quantity::Speed),
        rows: [3, 9].into(),
        values: Arc::new([Some(value), None].into_iter().collect()),
    };
    let values = [
        Value::Bool(true),
        Value::Int(-3),
        Value::Float(0.5),
        Value::Text("é"),
        Value::Json("[1]"),
    ];
    let mut entries = TypeEntries::default();
    entries.push(&["tug", "fork"]);
    entries.push(&[]);
    entries
        .attributes
        .insert(column("maxSpeed", Value::Float(1.0)));
    let set_column = |column| TableEdit::SetColumn {
        of: Table::Nodes,
        per_type: true,
        name: "zone".into(),
        column,
    };
    let at_m = Point::new(1.0, 2.0);
    let (of, members) = (
        Table::Stations,
        [Member::Path(1), Member::Node(2), Member::Station(3)],
    );
    let mut attributes = Attributes::default();
    attributes.insert(column("maxSpeed", Value::Float(1.0)));
    let level = Level {
        id: "upper".into(),
        name: Some("Mezzanine".into()),
        elevation_m: Some(4.5),
        attributes: attributes.clone(),
        source: Some(1),
    };
    let tug = VehicleType {
        id: "tug".into(),
        attributes,
    };
    let mut edits = vec![
        TableEdit::SetIds {
            of,
            ids: [(2, "dock".into())].into(),
        },
        set_column(None),
        set_column(Some(Arc::new(column("zone", Value::Text("A"))))),
        TableEdit::SetEntries {
            of: Table::Nodes,
            rows: [1, 0].into(),
            entries: entries.into(),
        },
        TableEdit::SetEnds([(1, [None, Some(4)])].into()),
        TableEdit::SetDirections([(0, Direction::Both), (1, Direction::Forward)].into()),
        TableEdit::SetLevels {
            of,
            levels: [(0, None), (1, Some(2))].into(),
        },
        TableEdit::SetStationNodes([(1, [2, 3].into())].into()),
        TableEdit::SetMembers([(0, members.into())].into()),
        TableEdit::MoveNodes([(1, at_m)].into()),
        TableEdit::MoveStations([(0, None), (1, Some(at_m))].into()),
        TableEdit::InsertNodes(
            [NewNode {
                id: "n".into(),
                position_m: at_m,
                level: Some(1),
                vehicle_types: vec!["tug".into()],
                attributes_of: Some(3),
            }]
            .into(),
        ),
        TableEdit::InsertStations(
            [NewStation {
                id: "s".into(),
                position_m: Some(at_m),
                nodes: vec![4],
                ..NewStation::default()
            }]
            .into(),
        ),
        TableEdit::SetExists {
            of,
            rows: [(1, false), (2, true)].into(),
        },
        TableEdit::SetZoneLevels([(0, None), (1, Some(2))].into()),
        TableEdit::InsertLevel {
            row: 1,
            level: level.clone().into(),
            elements: Arc::new([vec![1, 2], Vec::new(), vec![3]]),
        },
        TableEdit::RemoveLevel(2),
        TableEdit::SetLevel {
            row: 0,
            level: level.into(),
        },
        TableEdit::SetVehicleTypes([VehicleType::default(), tug].into()),
    ];
    edits.extend(values.map(set));
    edits
}

#[test]
fn decodes_what_it_encodes() {
    let JournalEntry::Do(tried) = every_change() else {
        panic!("changes that are done");
    };
    for entry in [
        every_change(),
        JournalEntry::Try(tried),
        JournalEntry::Undo,
        JournalEntry::Redo,
    ] {
        let bytes = encode(&entry);
        let decoded = decode(&bytes).unwrap();
        assert_eq!(discriminant(&decoded), discriminant(&entry));
        // The types of entries are in a hash map, whose order the bytes do not depend on.
        assert_eq!(encode(&decoded), bytes);
    }
}

#[test]
fn rejects_truncated_entries_and_survives_damaged_ones() {
    let bytes = encode(&every_change());
    for len in 0..bytes.len() {
        assert!(decode(&bytes[..len]).is_none(), "cut at {len}");
    }
    for at in 0..bytes.len() {
        for flip in [1, 0x80, 0xff] {
            let mut damaged = bytes.clone();
            damaged[at] ^= flip;
            // Any result is fine; a panic or an endless loop is not.
            let _ = decode(&damaged);
        }
    }
}

#[test]
fn decodes_entries_of_earlier_versions() {
    // Do, of one change: moves node 1 to (5, 6).
    let mut bytes = vec![1, 1, 0, 0, 0, 16, 1, 0, 0, 0, 1, 0, 0, 0];
    bytes.extend(5f64.to_le_bytes());
    bytes.extend(6f64.to_le_bytes());
    let JournalEntry::Do(changes) = decode(&bytes).unwrap() else {
        panic!("changes that are done");
    };
    let [Change::MoveNodes(to)] = changes.as_slice() else {
        panic!("one move: {changes:?}");
    };
    assert_eq!(**to, [(1, Point::new(5.0, 6.0))]);
}

#[test]
fn counts_whole_records() {
    let mut journal: Vec<u8> = Vec::new();
    for entry in [every_change(), JournalEntry::Undo, JournalEntry::Redo] {
        journal.extend(entry.to_record());
    }
    let count = |bytes: &[u8]| count_records(&mut Cursor::new(bytes)).unwrap();
    assert_eq!(count(&journal), 3);
    assert_eq!(
        count(&journal[..journal.len() - 1]),
        2,
        "the last one is cut off"
    );
    assert_eq!(count(&[]), 0);
}
