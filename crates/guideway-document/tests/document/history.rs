//! Undo, redo and saving; rejected edits; the index and the layout under edits.

use std::sync::Arc;

use guideway_document::{Change, CopiesOf, Elements, Index, JournalEntry, PointRef, replay};
use guideway_layout::{Layout, Value};
use guideway_scene::{Edit, EditError, LayoutCopy};
use guideway_spline::{Affine, Bounds};

use crate::site::{document, ends, is_near, p, select};

#[test]
fn deleted_paths_are_not_saved_and_return_on_undo() {
    let mut document = document(4);
    select(&mut document, [1, 2]);
    document.delete_selection().unwrap();
    assert!(document.selection().is_empty());
    let saved = document.to_layout();
    let ids: Vec<&str> = saved.paths.iter().map(|path| path.id()).collect();
    assert_eq!(ids, ["path-0", "path-3"]);
    let attributes = &saved.paths.attributes;
    assert_eq!(
        attributes.get("speed").unwrap().values.get(1),
        Some(Value::Float(1.5))
    );
    assert_eq!(attributes.get("zone").unwrap().values.get(1), None);
    assert!(document.is_changed());
    document.mark_saved();
    assert!(!document.is_changed());
    assert_eq!(document.undo(), Some("delete"));
    assert!(document.is_changed());
    assert_eq!(document.selection().len(), 2, "selected as before");
    assert_eq!(document.to_layout().paths.len(), 4);
    assert_eq!(document.redo(), Some("delete"));
    assert!(!document.is_changed(), "just as it was saved");
}

#[test]
fn a_rejected_edit_changes_nothing() {
    let mut document = document(3);
    document.select_all();
    let far = Affine::translation(p(1e12, 0.0));
    assert!(document.transform_selection("move", far).is_err());
    let changes = vec![
        Change::Scene(Edit::Transform {
            paths: [0].into(),
            by: Affine::translation(p(1.0, 0.0)),
        }),
        Change::MoveNodes([(99, p(0.0, 0.0))].into()),
    ];
    assert!(document.perform("both", changes).is_err());
    assert!(is_near(ends(&document, 0).0, p(0.0, 0.0)));
    assert!(!document.is_changed());
    assert_eq!(document.undo_redo_names(), (None, None));
}

#[test]
fn undo_memory_grows_with_the_changes_not_the_layout() {
    let bytes_after = |paths: usize, moved: u32, steps: usize| {
        let mut document = document(paths);
        document.select_all();
        let all_selected = document.history_bytes();
        for step in 0..steps {
            let point = PointRef {
                path: step as u32 % moved,
                run: 0,
                point: 1,
            };
            document.move_point(point, p(step as f64, 0.0)).unwrap();
        }
        assert_eq!(all_selected, 0);
        document.history_bytes()
    };
    let small = bytes_after(100, 1, 1_000);
    // Every step has the same selection of all paths and nodes, stored once.
    let large = bytes_after(20_000, 1, 1_000);
    assert!(large < small + 20_000, "{small} and {large} bytes");
    let twice = bytes_after(100, 1, 2_000);
    assert!((1.9..2.1).contains(&(twice as f64 / small as f64)));
    let mut document = document(5_000);
    select(&mut document, 0..1);
    let by = Affine::translation(p(1.0, 0.0));
    document.transform_selection("move", by).unwrap();
    let one = document.history_bytes();
    document.select_all();
    document.transform_selection("move", by).unwrap();
    let all = document.history_bytes() - one;
    assert!(
        all > 1_000 * one / 2,
        "{one} for one, {all} for 5,000: it counts"
    );
    document.undo();
    assert!(document.history_bytes() > all / 2, "it can be done again");
}

#[test]
fn index_stays_consistent_under_edits() {
    let mut document = document(40);
    select(&mut document, 0..3);
    let up = Affine::translation(p(0.0, 1000.0));
    document.transform_selection("move", up).unwrap();
    document.copy_selection(1, p(0.0, 1000.0)).unwrap();
    select(&mut document, 20..40);
    document.transform_selection("move", up).unwrap();
    document.undo();
    let everywhere = Bounds {
        min: p(-1e6, -1e6),
        max: p(1e6, 1e6),
    };
    let fresh = Index::new(document.layout());
    for y in [0.0, 10.0, 30.0, 1001.0, 2001.0, 1030.0] {
        let bounds = Bounds {
            min: p(0.0, y),
            max: p(1.0, y + 3.0),
        };
        let found = |index: &Index, bounds| {
            let mut rows: Vec<u32> = index.paths_in(bounds).collect();
            rows.sort_unstable();
            rows
        };
        assert_eq!(
            found(document.index(), bounds),
            found(&fresh, bounds),
            "{y}"
        );
        assert_eq!(found(document.index(), everywhere).len(), 43);
    }
}

#[test]
fn adopts_only_a_copy_of_its_present_layout() {
    let mut document = document(3);
    let renderer = document.scene().clone();
    assert!(document.scene().is_layout_shared());
    document.adopt_copy(LayoutCopy::new(document.scene().shared_layout()));
    assert!(!document.scene().is_layout_shared());
    let held: *const Layout = document.layout();
    let stale = LayoutCopy::new(document.scene().shared_layout());
    document.adopt_copy(LayoutCopy::new(renderer.shared_layout()));
    assert!(std::ptr::eq(held, document.layout()), "that of another");
    document.select_all();
    let by = Affine::translation(p(0.0, 5.0));
    document.transform_selection("move", by).unwrap();
    document.adopt_copy(stale);
    let start = |layout: &Layout| layout.paths.get(0).ends().map(|(start, _)| start);
    assert_eq!(start(document.layout()), Some(p(0.0, 5.0)));
    assert_eq!(start(renderer.layout()), Some(p(0.0, 0.0)));
}

/// The journal of many copies names what was copied, not what came of it.
#[test]
fn the_journal_of_copies_is_a_command() {
    let bytes_of = |count: u32| {
        let mut document = document(100);
        document.select_all();
        document.copy_selection(count, p(0.0, 200.0)).unwrap();
        document.undo();
        document.redo();
        let entries = document.take_journal_entries();
        let journal: Vec<u8> = entries.iter().flat_map(JournalEntry::to_record).collect();
        let mut recovered = crate::site::document(100);
        replay(&journal, &mut recovered, |_| true);
        let (saved, again) = (document.to_layout(), recovered.to_layout());
        assert_eq!(saved.paths.len(), 100 * (count as usize + 1));
        let found = guideway_layout::differences(&saved, &again, &Default::default());
        assert_eq!(found, []);
        journal.len()
    };
    let (few, many) = (bytes_of(1), bytes_of(50));
    assert_eq!(few, many, "bytes of 1 and of 50 copies");
    assert!(few < 2_000, "{few} bytes for 100 paths with their nodes");
}

/// A few bytes of a journal ask for any number of copies, and for copies of copies.
#[test]
fn copies_keep_limits_in_journals_too() {
    let elements = Elements::of_paths(0..100);
    let copies = |elements: &Elements, count: u32| {
        vec![Change::Copy(CopiesOf {
            elements: Arc::new(elements.clone()),
            count,
            step_m: p(0.0, 1.0),
        })]
    };
    let mut document = document(100);
    for count in [CopiesOf::MAX_COUNT + 1, u32::MAX] {
        let refused = document.copy(&elements, count, p(0.0, 1.0)).unwrap_err();
        let is_count = matches!(refused, EditError::TooManyCopies { what: "copies", .. });
        assert!(is_count, "{refused}");
        assert!(document.perform("copy", copies(&elements, count)).is_err());
    }
    let four = document.copy(&elements, 30, p(0.0, 200.0)).unwrap();
    let refused = document.perform("copy", copies(&four, CopiesOf::MAX_COUNT));
    let refused = refused.unwrap_err().to_string();
    assert!(
        refused.contains("exceed the limit of 134217728"),
        "{refused}"
    );
    let again = [copies(&elements, 2), copies(&elements, u32::MAX)].map(JournalEntry::Do);
    let journal: Vec<u8> = again.iter().flat_map(JournalEntry::to_record).collect();
    assert_eq!(replay(&journal, &mut document, |_| true).entries, 1);
    assert_eq!(document.to_layout().paths.len(), 100 + 3_000 + 200);
}
