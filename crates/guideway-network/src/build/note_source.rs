//! [`NoteSource`]: which notes of a drawing are meant, such as `text:STATION`.

use std::fmt;
use std::str::FromStr;

use guideway_layout::{Note, NoteKind};
use serde::{Deserialize, Serialize};

/// Notes of one kind on one layer, or the placements of one block; `*` at the end of the name
/// stands for any rest.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub struct NoteSource {
    /// Kind of the notes.
    pub kind: NoteKind,
    /// Layer of texts, points and circles; name of blocks.
    pub name: String,
}

impl NoteSource {
    /// Returns `true` if a note is meant.
    pub(super) fn has(&self, note: &Note) -> bool {
        self.kind == note.kind && self.is_of(Self::name_of(note))
    }

    /// The name by which a source means a note: that of its block, else of its layer.
    pub(super) fn name_of(note: &Note) -> &str {
        match note.kind {
            NoteKind::Block => &note.block,
            _ => &note.layer,
        }
    }

    /// Returns `true` if the source has notes of this layer, or of this block.
    pub(super) fn is_of(&self, name: &str) -> bool {
        fits(&self.name, name)
    }
}

const KINDS: [(&str, NoteKind); 4] = [
    ("text", NoteKind::Text),
    ("block", NoteKind::Block),
    ("point", NoteKind::Point),
    ("circle", NoteKind::Circle),
];

impl FromStr for NoteSource {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let parts = text.split_once(':').and_then(|(kind, name)| {
            let (_, kind) = KINDS.iter().find(|(known, _)| *known == kind.trim())?;
            (!name.trim().is_empty()).then(|| Self {
                kind: *kind,
                name: name.trim().to_owned(),
            })
        });
        parts.ok_or_else(|| {
            format!(
                "\"{text}\" names no notes; write text:LAYER, point:LAYER, circle:LAYER or \
                 block:NAME, such as text:STATION or block:DOCK*"
            )
        })
    }
}

impl TryFrom<String> for NoteSource {
    type Error = String;

    fn try_from(text: String) -> Result<Self, String> {
        text.parse()
    }
}

impl From<NoteSource> for String {
    fn from(source: NoteSource) -> Self {
        source.to_string()
    }
}

impl fmt::Display for NoteSource {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let kind = KINDS.iter().find(|(_, kind)| *kind == self.kind);
        let kind = kind.map_or("text", |(name, _)| name);
        write!(f, "{kind}:{}", self.name)
    }
}

/// Returns `true` if a name is the pattern, whatever its case; a `*` at the end of the pattern
/// stands for any rest.
pub(super) fn fits(pattern: &str, name: &str) -> bool {
    match pattern.strip_suffix('*') {
        Some(start) => name.to_lowercase().starts_with(&start.to_lowercase()),
        None => pattern.to_lowercase() == name.to_lowercase(),
    }
}
