//! [`DrawingSources`]: the layers and notes of a drawing that options can name.

use std::collections::BTreeMap;

use guideway_layout::{Layout, NoteKind};

use super::NoteSource;
use super::drawn::text;

/// The layers and notes of a drawing, in the order of their names, each with its number of members.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct DrawingSources {
    /// Names of layers, and their paths.
    pub layers: Vec<(String, u64)>,
    /// Texts, blocks, points and circles by layer or name.
    pub notes: Vec<(NoteSource, u64)>,
}

impl DrawingSources {
    /// Lists the sources of a drawing. Paths without a layer count as those of the layer "".
    ///
    /// Cost: O(n log m) for n paths and notes of m layers.
    pub fn of(drawing: &Layout) -> Self {
        let mut layers: BTreeMap<&str, u64> = BTreeMap::new();
        let mut notes: BTreeMap<(NoteKind, &str), u64> = BTreeMap::new();
        for row in 0..drawing.paths.len() {
            let layer = text(drawing, row, "layer");
            *layers.entry(layer).or_default() += 1;
            if text(drawing, row, "entity") == "CIRCLE" {
                *notes.entry((NoteKind::Circle, layer)).or_default() += 1;
            }
        }
        for note in &drawing.notes {
            let name = NoteSource::name_of(note);
            *notes.entry((note.kind, name)).or_default() += 1;
        }
        let (layers, notes) = (layers.into_iter(), notes.into_iter());
        let named = notes.filter(|((_, name), _)| !name.is_empty());
        let notes = named.map(|((kind, name), count)| {
            let name = name.to_owned();
            (NoteSource { kind, name }, count)
        });
        Self {
            layers: layers.map(|(name, n)| (name.to_owned(), n)).collect(),
            notes: notes.collect(),
        }
    }
}
