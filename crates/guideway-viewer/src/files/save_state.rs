//! The save and reload state of one open file, and the steps of a save.

use std::io;
use std::path::{Path, PathBuf};

use guideway_document::Snapshot;
use guideway_layout::shown_path;

use super::watcher::Stamp;
use crate::editing::{BaseCopy, DocumentSlot, EditTask, Journal};
use crate::language::say;
use crate::services::LostPart;

/// True if a file is being saved or reloaded, and its state on disk after the last save.
#[derive(Default)]
pub(crate) struct SaveState {
    is_saving: bool,
    is_reloading: bool,
    /// True if the document that is being loaded replaces unsaved changes.
    drops_changes: bool,
    /// True if this window saved the file since it was read.
    is_written: bool,
    /// State of the file that the document stands for: as it was read or saved here.
    known: Stamp,
    /// Losses that the user has accepted, and for which file.
    accepted: Option<(PathBuf, Vec<LostPart>)>,
}

/// The start of a save: the parts of its write, which another thread performs.
pub(crate) struct BegunSave {
    pub(crate) snapshot: Snapshot,
    /// Made before the file is written.
    pub(crate) base: Option<BaseCopy>,
    /// For the user.
    pub(crate) notices: Vec<String>,
}

/// A file that a save has written.
pub(crate) struct SavedFile {
    pub(crate) path: PathBuf,
    /// Its state after that.
    pub(crate) state: Stamp,
    /// The result of [`BegunSave::base`].
    pub(crate) copied: io::Result<()>,
}

impl SaveState {
    pub(crate) fn is_saving(&self) -> bool {
        self.is_saving
    }

    /// Returns `true` if this window saved the file since it was read.
    pub(crate) fn is_written(&self) -> bool {
        self.is_written
    }

    /// Accepts that the file at `path` lacks these parts, in later saves too.
    pub(crate) fn accept_losses(&mut self, path: PathBuf, losses: Vec<LostPart>) {
        self.accepted = Some((path, losses));
    }

    /// The kinds of losses that the user has accepted for the file at `path`.
    pub(crate) fn accepted_losses(&self, path: &Path) -> Vec<LostPart> {
        let accepted = self.accepted.as_ref().filter(|(of, _)| of == path);
        accepted.map_or_else(Vec::new, |(_, losses)| losses.clone())
    }

    pub(super) fn drops_changes(&self) -> bool {
        self.drops_changes
    }

    /// Returns `true` if another program has changed the file, now in this state, since it was read
    /// or saved here. A file that is gone holds nothing to lose.
    pub(crate) fn is_changed_by_others(&self, state: Stamp) -> bool {
        is_unknown(state, self.known)
    }

    /// State of the file that the document stands for; `None` without one.
    pub(crate) fn known(&self) -> Stamp {
        self.known
    }

    /// The document is that of the file, which had this state before it was read.
    pub(super) fn complete_load(&mut self, state: Stamp) {
        self.known = state;
    }

    pub(super) fn begin_reload(&mut self, drops_changes: bool) {
        self.drops_changes = drops_changes;
        (self.is_reloading, self.is_written) = (true, false);
    }

    pub(super) fn keep_changes(&mut self) {
        self.drops_changes = false;
    }

    pub(super) fn end_reload(&mut self) {
        self.is_reloading = false;
    }

    /// Begins a save. `None` while the file is reloaded, an edit has the document, or unsaved work
    /// awaits a decision: the content to save is not certain then.
    pub(super) fn begin(&mut self, slot: &mut DocumentSlot, file: &Path) -> Option<BegunSave> {
        if slot.journal().has_unsaved_work() || self.is_reloading {
            return None;
        }
        let document = slot.document_mut()?;
        document.end_preview();
        let snapshot = document.snapshot();
        let before = document.mark_saved();
        self.is_saving = true;
        let recorded = slot.record(file).err();
        let mut notices: Vec<String> = recorded.into_iter().collect();
        let base = slot.journal_mut().begin_save(before, file);
        let base = base.unwrap_or_else(|notice| {
            notices.push(notice);
            None
        });
        Some(BegunSave {
            snapshot,
            base,
            notices,
        })
    }

    /// Ends a save; with a file, the layout was written there, and with `opens_journal` has a file
    /// from now on. Returns the edit that completes it in the document and its journal.
    pub(super) fn end(&mut self, saved: Option<SavedFile>, opens_journal: bool) -> EditTask {
        self.is_saving = false;
        match saved {
            Some(SavedFile {
                path,
                state,
                copied,
            }) => {
                (self.is_written, self.known) = (true, state);
                EditTask::with_journal(move |_, journal| {
                    if !opens_journal {
                        return journal.complete_save(&path, copied);
                    }
                    *journal = Journal::open(&path);
                    journal.take_notice().map_or(Ok(()), Err)
                })
            }
            None => EditTask::with_journal(|document, journal| {
                if let Some(before) = journal.abort_save() {
                    document.restore_saved(before);
                }
                Ok(())
            }),
        }
    }
}

/// Returns `true` if a file in this state is not the one in the known state.
pub(crate) fn is_unknown(state: Stamp, known: Stamp) -> bool {
    state.is_some() && state != known
}

/// The notice about a file that both another program and the user changed.
pub(super) fn changed_on_disk(name: &str) -> String {
    say!(
        "{name} has changed on disk. File > Reload reads it and discards your changes",
        name
    )
}

/// The notice about a file that is no longer there.
pub(super) fn gone_from_disk(file: &Path) -> String {
    say!(
        "{file} is gone. What is open here stays; Save writes the file again, and Save as writes \
         another one",
        file = shown_path(file)
    )
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;
    use std::time::Duration;

    use guideway_document::Document;

    use super::*;
    use crate::background::RepaintHandle;
    use crate::tests::services::lanes;

    #[test]
    fn failed_save_leaves_the_document_changed() {
        let mut slot = DocumentSlot::default();
        let mut document = Document::new(lanes(2).into(), &Default::default()).unwrap();
        document.select_all();
        document.delete_selection().unwrap();
        slot.replace(document);
        let (mut save, file) = (SaveState::default(), Path::new("site.arrow"));
        assert!(save.begin(&mut slot, file).is_some() && save.is_saving());
        assert!(!slot.document().unwrap().is_changed());
        let repaint: RepaintHandle = Arc::new(|| {});
        slot.run(
            save.end(None, false),
            Duration::from_secs(60),
            file,
            &repaint,
        );
        assert!(slot.document().unwrap().is_changed() && !save.is_written());
    }

    #[test]
    fn refuses_to_save_while_the_file_is_reloaded() {
        let mut slot = DocumentSlot::default();
        let document = Document::new(lanes(2).into(), &Default::default()).unwrap();
        slot.replace(document);
        let mut save = SaveState::default();
        save.begin_reload(false);
        assert!(save.begin(&mut slot, Path::new("site.arrow")).is_none());
        save.end_reload();
        assert!(save.begin(&mut slot, Path::new("site.arrow")).is_some());
    }
}
