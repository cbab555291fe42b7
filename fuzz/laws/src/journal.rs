//! Law of journals: replaying any bytes leaves a valid document whose edits can be undone.

use std::sync::{Arc, mpsc};

use guideway_document::{Document, SceneChange, replay};
use guideway_layout::{CheckOptions, Direction, Layout, NewPath, Value, check};
use guideway_scene::SceneOptions;
use guideway_spline::{Point, Runs};

use crate::read::assert_finite;

/// Replays a journal on a small document, and sends its edits to a copy of the scene.
///
/// # Panics
/// When the document or the copy becomes invalid, they differ, or undo does not restore all paths.
pub fn journal(bytes: &[u8]) {
    let mut document = document();
    let untouched = document.to_layout().paths.len();
    let mut replica = document.scene().clone();
    let (tell, told) = mpsc::channel();
    document.on_edit(move |change| {
        let change = match change {
            SceneChange::Edit(edit) => Ok(edit.clone()),
            SceneChange::Replaced(scene) => Err(scene.clone()),
        };
        tell.send(change).expect("it is heard below");
    });
    let journal = with_checksums(bytes);
    let done = replay(&journal, &mut document, |_| true);
    assert!(done.bytes <= journal.len());
    for change in told.try_iter() {
        match change {
            Ok(edit) => assert!(replica.edit(&edit).is_ok(), "{edit:?}"),
            Err(scene) => replica = scene,
        }
    }
    assert_eq!(replica.draw_order(), document.scene().draw_order());
    let layout = document.to_layout();
    assert_finite(&layout);
    check(&layout, &CheckOptions::default());
    while document.undo().is_some() {}
    assert_eq!(document.to_layout().paths.len(), untouched);
}

/// The document of the seed journals: eight parallel paths with nodes, vehicle types and an
/// attribute.
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

/// The journal with corrected lengths and checksums, so that mutants reach the decoder of records.
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

/// FNV-1a hash of 32 bits (Fowler, Noll, Vo), the checksum of a record.
fn fnv_1a(bytes: &[u8]) -> u32 {
    let step = |hash: u32, &byte: &u8| (hash ^ u32::from(byte)).wrapping_mul(0x0100_0193);
    bytes.iter().fold(0x811c_9dc5, step)
}
