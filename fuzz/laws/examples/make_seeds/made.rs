//! Makes the binary seeds: journals and Arrow files.

use std::collections::BTreeMap;
use std::error::Error;
use std::sync::Arc;

use guideway_document::{Document, JournalEntry, PointRef, SelectMode};
use guideway_formats::arrow::{self, Precision, WriteOptions};
use guideway_laws::document;
use guideway_spline::{Affine, Point};

use super::Files;

/// An editing session.
type Session = fn(&mut Document) -> Result<(), Box<dyn Error>>;

const JOURNALS: [(&str, Session); 5] = [
    ("move", |document| {
        document.select([1, 2].into_iter().collect(), SelectMode::Replace);
        let by = Affine::translation(Point::new(1.0, 2.0));
        document.transform_selection("move", by)?;
        document.undo();
        document.redo();
        Ok(())
    }),
    ("copy-and-delete", |document| {
        document.select([3].into_iter().collect(), SelectMode::Replace);
        document.copy_selection(2, Point::new(0.0, 9.0))?;
        document.delete_selection()?;
        Ok(())
    }),
    ("draw", |document| {
        let points = [(0.0, 0.0), (3.0, 1.0), (5.0, 4.0)].map(|(x, y)| Point::new(x, y));
        document.draw_path("drawn".into(), &points, 0.5)?;
        Ok(())
    }),
    ("nodes-and-points", |document| {
        document.move_node(0, Point::new(-1.0, 0.5))?;
        let point = PointRef {
            path: 4,
            run: 0,
            point: 1,
        };
        document.insert_point(point)?;
        document.move_point(point, Point::new(2.0, 7.0))?;
        document.undo();
        Ok(())
    }),
    ("refine", |document| {
        document.select([5, 6].into_iter().collect(), SelectMode::Replace);
        document.refine_selection()?;
        Ok(())
    }),
];

/// Journals of editing sessions, and the edited layout as Arrow, by target and name.
pub(crate) fn files() -> Result<BTreeMap<&'static str, Files>, Box<dyn Error>> {
    let (mut journals, mut arrows) = (Files::new(), Files::new());
    let mut last = document();
    for (name, session) in JOURNALS {
        let mut document = document();
        session(&mut document)?;
        let records = document
            .take_journal_entries()
            .iter()
            .flat_map(JournalEntry::to_record)
            .collect::<Vec<u8>>();
        journals.insert(name.to_owned(), records);
        last = document;
    }
    let layout = Arc::new(last.to_layout());
    for (name, precision) in [("f32.arrow", Precision::F32), ("f64.arrow", Precision::F64)] {
        let options = WriteOptions {
            precision: Some(precision),
        };
        let mut bytes = Vec::new();
        arrow::write_layout(&layout, &mut bytes, &options)?;
        arrows.insert(name.to_owned(), bytes);
    }
    Ok([("journal", journals), ("arrow", arrows)].into())
}
