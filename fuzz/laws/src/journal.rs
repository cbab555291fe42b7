use std::sync::{Arc, mpsc};

use guideway_document::{Document, replay};
use guideway_layout::{CheckOptions, Direction, Layout, NewPath, Value, check};
use guideway_scene::SceneOptions;
use guideway_spline::{Point, Runs};

use crate::read::assert_finite;

/// Does what a journal says with a small layout. Whatever it says, the document stays one that can be drawn, saved
/// and taken back, and a renderer that only hears of the edits has the same paths.
pub fn journal(bytes: &[u8]) {
    let mut document = document();
    let untouched = document.to_layout().paths.len();
    let mut replica = document.scene().clone();
    let (tell, told) = mpsc::channel();
    document.on_edit(move |edit| tell.send(edit.clone()).expect("it is heard below"));
    let journal = with_checksums(bytes);
    let done = replay(&journal, &mut document, |_| true);
    assert!(done.bytes <= journal.len());
    for edit in told.try_iter() {
        let followed = replica.edit(&edit);
        assert!(followed.is_ok(), "{followed:?}");
    }
    assert_eq!(replica.draw_order(), document.scene().draw_order());
    let layout = document.to_layout();
    assert_finite(&layout);
    check(&layout, &CheckOptions::default());
    while document.undo().is_some() {}
    assert_eq!(document.to_layout().paths.len(), untouched);
}

/// The document that the journals of the seeds belong to: eight parallel paths with nodes, types and a column.
pub fn document() -> Document {
    Document::new(Arc::new(site()), &SceneOptions::default())
        .expect("no level or column is asked for")
}

fn site() -> Layout {
    let mut layout = Layout::default();
    for row in 0..8 {
        let (start, end) = (
            Point::new(0.0, f64::from(row)),
            Point::new(10.0, f64::from(row)),
        );
        let mut runs = Runs::default();
        runs.push_line(start, end);
        let node = layout.nodes.push(&format!("node-{row}"), start, None);
        let row = layout.paths.push(&NewPath {
            id: &format!("path-{row}"),
            runs: &runs,
            start_node: Some(node),
            direction: match row % 3 {
                0 => Direction::Both,
                _ => Direction::Forward,
            },
            vehicle_types: &["tug"],
            ..NewPath::default()
        });
        let speed = Value::Float(0.5 * row as f64);
        layout.paths.attributes.set(row, "speed", speed);
    }
    layout
}

/// The journal with the length and the checksum of each record made right, so that mutants reach what is within.
fn with_checksums(bytes: &[u8]) -> Vec<u8> {
    let mut journal = Vec::with_capacity(bytes.len());
    let mut rest = bytes;
    while let Some((&len, behind)) = rest.split_first_chunk::<4>()
        && let Some((_, behind)) = behind.split_first_chunk::<4>()
    {
        let len = behind.len().min(u32::from_le_bytes(len) as usize);
        let (payload, behind) = behind.split_at(len);
        journal.extend((len as u32).to_le_bytes());
        journal.extend(fnv_1a(payload).to_le_bytes());
        journal.extend(payload);
        rest = behind;
    }
    journal
}

/// Fowler, Noll and Vo's hash of 32 bits, which is the checksum of a record.
fn fnv_1a(bytes: &[u8]) -> u32 {
    let step = |hash: u32, &byte: &u8| (hash ^ u32::from(byte)).wrapping_mul(0x0100_0193);
    bytes.iter().fold(0x811c_9dc5, step)
}
