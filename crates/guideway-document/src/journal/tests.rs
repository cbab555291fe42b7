//! Round trips of entries, and damage to their bytes.

use guideway_layout::{Direction, Geometry, OwnStyle};
use guideway_scene::{Edit, Insertion, PathState};
use guideway_spline::{Affine, Point, Runs};

use super::decode::decode;
use super::encode::encode;
use super::entry::JournalEntry;
use crate::change::Change;

/// An entry with one change of every kind.
fn every_change() -> JournalEntry {
    let mut runs = Runs::default();
    runs.push_line(Point::new(0.0, 1.0), Point::new(2.0, 3.0));
    let mut curves = Geometry::default();
    curves.push(&runs);
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
    let edits = [
        Edit::Transform {
            paths: [1, 2].into(),
            by: Affine::rotation(0.3, Point::new(1.0, 2.0)),
        },
        Edit::Reshape {
            paths: [4].into(),
            curves: curves.into(),
        },
        Edit::Restyle([(1, style)].into()),
        Edit::SetStates([(1, PathState::Hidden), (2, PathState::Removed)].into()),
        Edit::Insert([insertion].into()),
    ];
    let mut changes: Vec<Change> = edits.into_iter().map(Change::Scene).collect();
    changes.push(Change::MoveNodes([(1, Point::new(5.0, 6.0))].into()));
    JournalEntry::Do(changes)
}

#[test]
fn decodes_what_it_encodes() {
    for entry in [every_change(), JournalEntry::Undo, JournalEntry::Redo] {
        let decoded = decode(&encode(&entry)).unwrap();
        assert_eq!(format!("{decoded:?}"), format!("{entry:?}"));
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
