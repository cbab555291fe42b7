//! Growth: edits of n rows cost O(n), and so does their undo. An exponent, never seconds.

use std::cell::RefCell;

use guideway_document::{Document, Elements, Neighbors, PropertyRef};
use guideway_growth::exponent_of_time;
use guideway_layout::{Layout, NewPath, Value};
use guideway_scene::Table;
use guideway_spline::{Affine, Runs};

use crate::site::{document_of, p};

/// Sizes of the documents.
const SIZES: [usize; 3] = [10_000, 30_000, 90_000];

/// A chain of paths, each with a vehicle type.
fn chain(count: usize) -> Document {
    let mut layout = Layout::default();
    let at = |row: usize| p(row as f64, 0.0);
    layout.nodes.push("n0", at(0), None);
    for row in 0..count {
        let end = layout
            .nodes
            .push(&format!("n{}", row + 1), at(row + 1), None);
        let mut runs = Runs::default();
        runs.push_line(at(row), at(row + 1));
        layout.paths.push(&NewPath {
            id: &format!("p{row}"),
            runs: &runs,
            start_node: Some(end - 1),
            end_node: Some(end),
            vehicle_types: &["tug"],
            ..NewPath::default()
        });
    }
    document_of(layout)
}

#[test]
fn edits_of_all_rows_and_their_undo_grow_linearly() {
    let speed = |vehicle_type| PropertyRef {
        of: Table::Paths,
        name: "maxSpeed",
        vehicle_type,
    };
    let all = |document: &Document| document.existing(Table::Paths).collect();
    type Edit<'a> = Box<dyn Fn(&mut Document) + Sync + 'a>;
    let edits: [(&str, Edit<'_>); 4] = [
        (
            "set for all types",
            Box::new(|document| {
                let value = Some(Value::Float(1.0));
                document
                    .set_property(speed(None), &all(document), value)
                    .unwrap();
            }),
        ),
        (
            "set for one type",
            Box::new(|document| {
                let value = Some(Value::Float(1.0));
                document
                    .set_property(speed(Some("tug")), &all(document), value)
                    .unwrap();
            }),
        ),
        (
            "set vehicle types",
            Box::new(|document| {
                let types = ["tug", "fork"];
                document
                    .set_vehicle_types(Table::Paths, &all(document), &types)
                    .unwrap();
            }),
        ),
        (
            "move",
            Box::new(|document| {
                let paths = Elements::of_paths(all(document));
                let by = Affine::translation(p(1.0, 2.0));
                document
                    .transform("move", &paths, by, Neighbors::Follow)
                    .unwrap();
            }),
        ),
    ];
    for (name, edit) in edits {
        let made = |size| RefCell::new(chain(size));
        let slope = exponent_of_time(SIZES, made, |document| {
            let document = &mut document.borrow_mut();
            edit(document);
            document.undo().unwrap();
        });
        assert!(slope < 1.3, "{name}: exponent {slope:.2}");
    }
}
