//! Copies inside a document, and from one document into another.

use guideway_document::{Document, Elements, PropertyRef};
use guideway_layout::{
    CompareOptions, Layout, Level, NewPath, Quantity, Value, WrittenCurve, differences,
};
use guideway_scene::{SceneOptions, Table};
use guideway_spline::{Affine, Runs};

use crate::site::{document, document_of, ends, is_near, p, square};

#[test]
fn copies_bring_their_nodes_and_stations() {
    let mut document = document_of(square());
    let tug = PropertyRef {
        of: Table::Paths,
        name: "maxSpeed",
        vehicle_type: Some("tug"),
    };
    let first = [0].into_iter().collect();
    document
        .set_property(tug, &first, Some(Value::Float(0.5)))
        .unwrap();
    let copied = document
        .copy(&Elements::of_paths([0, 1]), 2, p(100.0, 0.0))
        .unwrap();
    assert_eq!(
        [
            copied.paths.len(),
            copied.nodes.len(),
            copied.stations.len()
        ],
        [4, 6, 4]
    );
    assert_eq!(*document.selection(), copied.paths);
    let layout = document.to_layout();
    let path = layout.paths.get(6);
    assert_eq!(path.id(), "ab copy 2");
    let nodes = [path.start_node(), path.end_node()].map(|node| layout.nodes.id(node.unwrap()));
    assert_eq!(nodes, ["a copy 2", "b copy 2"]);
    let (start, end) = ends(&document, 6);
    assert!(is_near(start, p(200.0, 0.0)) && is_near(end, p(210.0, 0.0)));
    assert_eq!(
        layout.paths.value_for(6, "tug", "maxSpeed"),
        Some(Value::Float(0.5))
    );
    let rack = layout.stations.nodes(5);
    let ids: Vec<&str> = rack.iter().map(|&node| layout.nodes.id(node)).collect();
    assert_eq!(
        (layout.stations.id(5), ids),
        ("rack copy 2", vec!["b copy 2", "c copy 2"])
    );
    assert_eq!(layout.stations.position_m(5), Some(p(211.0, 5.0)));
    // A second copy of the same paths has other names.
    document
        .copy(&Elements::of_paths([0]), 1, p(0.0, 50.0))
        .unwrap();
    assert_eq!(document.layout().paths.id(8), "ab copy 1 2");
    document.undo().unwrap();
    document.undo().unwrap();
    assert_eq!(document.to_layout().nodes.len(), 4);
    assert!(
        document
            .copy(&Elements::of_paths([99]), 1, p(0.0, 0.0))
            .is_err()
    );
}

#[test]
fn pastes_into_an_empty_document_what_was_copied() {
    let mut source = document_of(square());
    let types = PropertyRef {
        of: Table::Paths,
        name: "maxSpeed",
        vehicle_type: Some("stacker"),
    };
    let first = [0].into_iter().collect();
    source
        .set_property(types, &first, Some(Value::Float(0.25)))
        .unwrap();
    let clip = source.clip(&Elements::of_paths(0..4)).unwrap();
    let empty = Layout {
        levels: square().levels,
        ..Layout::default()
    };
    let mut target = Document::new(empty.into(), &SceneOptions::default()).unwrap();
    target.paste(&clip, Affine::IDENTITY, None).unwrap();
    let mut expected = source.to_layout();
    expected.blocks.clear();
    let found = differences(&expected, &target.to_layout(), &CompareOptions::default());
    assert!(found.is_empty(), "{found:?}");
    let pasted = target
        .paste(&clip, Affine::translation(p(0.0, 30.0)), Some(1))
        .unwrap();
    let layout = target.to_layout();
    assert_eq!(layout.paths.id(4), "ab 2");
    assert_eq!(layout.nodes.level(pasted.nodes.min().unwrap()), Some(1));
    assert_eq!(
        layout.paths.value_for(4, "stacker", "maxSpeed"),
        Some(Value::Float(0.25))
    );
    assert_eq!(layout.nodes.id(layout.stations.nodes(2)[0]), "a 2");
    while target.undo().is_some() {}
    assert_eq!(target.to_layout().paths.len(), 0);
}

#[test]
fn paste_names_the_level_or_column_that_does_not_fit() {
    let source = document_of(square());
    let clip = source.clip(&Elements::of_paths([0])).unwrap();
    let mut other = square();
    other.levels = vec![Level {
        id: "roof".into(),
        ..Level::default()
    }];
    let mut target = document_of(other);
    let error = target.paste(&clip, Affine::IDENTITY, None).unwrap_err();
    assert!(error.to_string().contains("no level `ground`"), "{error}");
    assert!(target.paste(&clip, Affine::IDENTITY, Some(0)).is_ok());
    let mut other = square();
    let attributes = &mut other.paths.attributes;
    attributes.set_quantity(0, "maxSpeed", 1.0, Quantity::Length);
    let mut target = document_of(other);
    let error = target
        .paste(&clip, Affine::IDENTITY, None)
        .unwrap_err()
        .to_string();
    assert!(
        error.contains("numbers in m/s") && error.contains("numbers in m in"),
        "{error}"
    );
    assert!(!target.is_changed());
}

#[test]
fn copies_of_numbered_elements_go_on_with_the_numbers() {
    let mut layout = Layout::default();
    for (id, x) in [("dock-08", 0.0), ("dock-09", 10.0), ("dock-11", 20.0)] {
        layout.nodes.push(id, p(x, 0.0), None);
    }
    let mut runs = Runs::default();
    runs.push_line(p(0.0, 0.0), p(10.0, 0.0));
    for (id, end) in [("dock-08--dock-09", Some(1)), ("aisle 7", None)] {
        layout.paths.push(&NewPath {
            id,
            runs: &runs,
            start_node: Some(0),
            end_node: end,
            ..NewPath::default()
        });
    }
    let mut document = document_of(layout);
    document
        .copy(&Elements::of_paths([0]), 2, p(0.0, 5.0))
        .unwrap();
    let layout = document.layout();
    let nodes: Vec<&str> = (3..7).map(|node| layout.nodes.id(node)).collect();
    assert_eq!(nodes, ["dock-10", "dock-12", "dock-13", "dock-14"]);
    let paths = [2, 3].map(|row| layout.paths.id(row));
    assert_eq!(paths, ["dock-10--dock-12", "dock-13--dock-14"]);
    document
        .copy(&Elements::of_paths([1]), 1, p(0.0, 5.0))
        .unwrap();
    assert_eq!(document.layout().paths.id(4), "aisle 8");
}

#[test]
fn a_paste_keeps_draw_ranks_and_written_curves_in_one_insertion() {
    let mut layout = square();
    layout.paths.set_rank(vec![3, 0, -1, 0]);
    let curve = WrittenCurve {
        degree: 1,
        knots: vec![0.0, 0.0, 1.0, 1.0],
        points_m: vec![p(0.0, 0.0), p(10.0, 0.0)],
        weights: None,
    };
    layout.paths.set_written_curve(0, curve);
    let source = document_of(layout);
    let clip = source.clip(&Elements::of_paths([0, 2])).unwrap();
    let mut other = square();
    other.paths.set_rank(vec![1; 4]);
    for target in [Layout::default(), other] {
        let mut target = document_of(target);
        let by = Affine::translation(p(0.0, 50.0));
        let pasted = target.paste(&clip, by, None).unwrap();
        let rows: Vec<usize> = pasted.paths.iter().map(|row| row as usize).collect();
        let paths = &target.layout().paths;
        let ranks = paths.rank().unwrap();
        assert_eq!([ranks[rows[0]], ranks[rows[1]]], [3, -1]);
        let written = paths.written_curve(rows[0]).unwrap();
        assert_eq!(written.points_m, [p(0.0, 50.0), p(10.0, 50.0)]);
        let entries = target.take_journal_entries();
        let journal: Vec<u8> = entries.iter().flat_map(|e| e.to_record()).collect();
        assert!(!journal.is_empty());
        let end = target.to_layout();
        target.undo();
        target.redo();
        let exact = CompareOptions::default();
        assert_eq!(differences(&end, &target.to_layout(), &exact), []);
    }
}

#[test]
fn undo_of_many_copies_gives_their_memory_back() {
    let mut document = document(200);
    let rows = |document: &Document| Table::ALL.map(|of| of.row_count(document.layout()));
    let (bytes, before) = (document.layout().heap_bytes(), rows(&document));
    let exact = CompareOptions::default();
    for _ in 0..2 {
        document
            .copy(&Elements::of_paths(0..200), 20, p(0.0, 300.0))
            .unwrap();
        assert!(document.layout().heap_bytes() > 10 * bytes);
        let copied = document.to_layout();
        document.undo().unwrap();
        assert!(document.layout().heap_bytes() <= bytes);
        assert_eq!(rows(&document), before);
        // As states of rows, the undo step had 8 bytes for each of 8,000.
        assert!(document.history_bytes() < 20_000);
        document.redo().unwrap();
        assert_eq!(differences(&copied, &document.to_layout(), &exact), []);
        document.undo().unwrap();
    }
    // The journal has the rows of the originals.
    let entries = document.take_journal_entries();
    let journal: usize = entries.iter().map(|entry| entry.to_record().len()).sum();
    assert!(journal < 2_000, "{journal} bytes");
    // Steps behind the copies find their rows again, although these stay.
    document
        .copy(&Elements::of_paths(0..200), 2, p(0.0, 300.0))
        .unwrap();
    document
        .draw_path("drawn".into(), &[p(0.0, 0.0), p(5.0, 5.0)], 0.5)
        .unwrap();
    let end = document.to_layout();
    while document.undo().is_some() {}
    assert_eq!(document.to_layout().paths.len(), 200);
    assert_eq!(document.layout().paths.len(), 601);
    while document.redo().is_some() {}
    assert_eq!(differences(&end, &document.to_layout(), &exact), []);
}

/// The memory of the process around the copy of a million paths, as its user sees it.
#[cfg(target_os = "linux")]
#[test]
#[ignore = "takes a gigabyte and a minute"]
fn undo_of_a_million_copies_gives_resident_memory_back() {
    const PAGE_MB: f64 = 4096.0 / 1e6;
    let resident_mb = || {
        let pages = std::fs::read_to_string("/proc/self/statm").unwrap();
        PAGE_MB * pages.split(' ').nth(1).unwrap().parse::<f64>().unwrap()
    };
    let mut document = document(1_000_000);
    let before_mb = resident_mb();
    let step = p(0.0, 300.0);
    let all = Elements::of_paths(0..1_000_000);
    document.copy(&all, 1, step).unwrap();
    let copied_mb = resident_mb();
    document.undo().unwrap();
    let after_mb = resident_mb();
    let entries = document.take_journal_entries();
    let journal: usize = entries.iter().map(|entry| entry.to_record().len()).sum();
    println!(
        "{before_mb:.0} MB, {copied_mb:.0} MB after the copy, {after_mb:.0} MB after undo; journal \
         of {journal} bytes"
    );
    // The layout and its copies, then the layout and what the allocator keeps.
    assert!(copied_mb > 2.0 * before_mb && after_mb < 1.6 * before_mb);
    // The rows of the originals, not 128 bytes of points for each copy.
    assert!(journal < 5_000_000);
}
