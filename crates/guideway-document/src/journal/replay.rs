//! Replays a journal on the document from which it started.

use guideway_scene::EditError;

use super::decode;
use super::entry::JournalEntry;
use super::record::next_payload;
use crate::document::Document;

/// The part of a journal that was replayed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ReplayProgress {
    /// Number of entries replayed.
    pub entries: usize,
    /// Size of their records, in bytes. Bytes after them are damaged or not replayed yet.
    pub bytes: usize,
}

/// Replays a journal up to its first damaged record. `document` must be in the state in which the
/// journal started. `continues` receives the progress before each entry; false stops the replay.
pub fn replay(
    journal: &[u8],
    document: &mut Document,
    mut continues: impl FnMut(ReplayProgress) -> bool,
) -> ReplayProgress {
    let mut progress = ReplayProgress {
        entries: 0,
        bytes: 0,
    };
    let mut bytes = journal;
    while let Some((payload, rest)) = next_payload(bytes).filter(|_| continues(progress)) {
        let entry = decode::decode(payload);
        if entry.is_none_or(|entry| perform(entry, document).is_err()) {
            break;
        }
        bytes = rest;
        progress.entries += 1;
        progress.bytes = journal.len() - bytes.len();
    }
    progress
}

fn perform(entry: JournalEntry, document: &mut Document) -> Result<(), EditError> {
    match entry {
        JournalEntry::Do(changes) => document.perform("recovered edit", changes)?,
        // Rejected again, and leaves the same rows.
        JournalEntry::Try(changes) => drop(document.perform("rejected edit", changes)),
        JournalEntry::Undo => drop(document.undo()),
        JournalEntry::Redo => drop(document.redo()),
    }
    Ok(())
}
