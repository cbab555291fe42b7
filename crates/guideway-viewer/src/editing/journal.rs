//! Records the edits of one document in its journal file, and suspends that while a save runs.

use std::io;
use std::path::Path;

use guideway_document::{Document, ReplayProgress, SavedState};
use guideway_layout::shown_path;

use super::journal_file::{BaseCopy, JournalFile};
use super::notice::Notice;
use super::unsaved_work::{UnsavedSummary, UnsavedWork};
use crate::language::{say, t};

/// The journal of a document. It moves between threads with its document.
#[derive(Default)]
pub(crate) struct Journal {
    /// `None` before a document is loaded, and after the file could not be opened or written.
    file: Option<JournalFile>,
    /// A notice about the journal that was opened.
    notice: Option<Notice>,
    /// The saved state before the save in progress. While a save runs nothing is recorded: an entry
    /// would belong to neither the old nor the new file.
    saving: Option<SavedState>,
}

impl Journal {
    /// Opens the journal of a layout file that was just read.
    pub(crate) fn open(layout_file: &Path) -> Self {
        let mut journal = Self::default();
        match JournalFile::open(layout_file) {
            Ok(file) => {
                journal.notice = file.mismatched_copy().map(|kept| {
                    say!(
                        "{file} has changed since it was left with unsaved work. That work is \
                         kept in {copy}",
                        file = shown_path(layout_file),
                        copy = shown_path(kept)
                    )
                });
                journal.file = Some(file);
            }
            Err(error) => journal.notice = Some(unusable(layout_file, &error)),
        }
        journal
    }

    /// The notice about a journal that was opened: unsaved work that does not match the layout
    /// file, or a journal that cannot be used.
    pub(crate) fn take_notice(&mut self) -> Option<Notice> {
        self.notice.take()
    }

    /// Returns `true` if unsaved work of an earlier run awaits a decision.
    pub(crate) fn has_unsaved_work(&self) -> bool {
        self.unsaved_summary().is_some()
    }

    /// Unsaved work of an earlier run that awaits a decision.
    pub(crate) fn unsaved_summary(&self) -> Option<UnsavedSummary> {
        self.file.as_ref()?.unsaved_summary()
    }

    /// Unsaved work of an earlier run.
    pub(crate) fn unsaved_work(&self, layout_file: &Path) -> Option<UnsavedWork> {
        self.file.as_ref()?.unsaved_work(layout_file)
    }

    /// Checks that no unsaved work awaits a decision: new entries would mix with it.
    ///
    /// # Errors
    /// The notice for the user.
    pub(super) fn check_is_decided(&self) -> Result<(), Notice> {
        match self.has_unsaved_work() {
            false => Ok(()),
            true => Err(t("Recover or discard the unsaved work first").into()),
        }
    }

    /// Appends all edits since the last call.
    ///
    /// # Errors
    /// Once, when the journal cannot be written; later calls record nothing.
    pub(super) fn record(&mut self, document: &mut Document, file: &Path) -> Result<(), Notice> {
        match &mut self.file {
            Some(journal) if self.saving.is_none() => {
                let result = journal.record(document, file);
                self.close_on_error(result, file)
            }
            _ => Ok(()),
        }
    }

    /// Continues behind recovered work. Returns how much was recovered, as a notice.
    pub(crate) fn resume(&mut self, progress: ReplayProgress, file: &Path) -> Option<Notice> {
        let journal = self.file.as_mut()?;
        let steps = match progress.entries {
            1 => t("Recovered 1 step").to_owned(),
            entries => say!("Recovered {entries} steps", entries),
        };
        let result = journal.resume(progress, file).map(|is_all| match is_all {
            true => steps,
            false => say!("{steps}; the journal is damaged after them", steps),
        });
        Some(
            self.close_on_error(result, file)
                .unwrap_or_else(|notice| notice),
        )
    }

    /// Suspends recording while the layout is saved. Returns the copy to make of the file as read.
    ///
    /// # Errors
    /// When the journal cannot be written. The save may go on.
    pub(crate) fn begin_save(
        &mut self,
        before: SavedState,
        file: &Path,
    ) -> Result<Option<BaseCopy>, Notice> {
        self.saving = Some(before);
        let result = self.file.as_mut().map(|journal| journal.base_copy(file));
        self.close_on_error(result.transpose(), file)
    }

    /// Closes the journal if the file as read was not copied: its entries begin with that file.
    ///
    /// # Errors
    /// When it was not.
    pub(crate) fn end_copy(&mut self, copied: io::Result<()>, file: &Path) -> Result<(), Notice> {
        self.close_on_error(copied, file)
    }

    /// Resumes recording after a successful save to `file`.
    ///
    /// # Errors
    /// When the journal cannot be written.
    pub(crate) fn complete_save(&mut self, file: &Path) -> Result<(), Notice> {
        self.saving = None;
        match &mut self.file {
            Some(journal) => {
                let result = journal.mark_saved(file);
                self.close_on_error(result, file)
            }
            None => Ok(()),
        }
    }

    /// Resumes recording after a failed save. Returns the saved state to restore.
    pub(crate) fn abort_save(&mut self) -> Option<SavedState> {
        self.saving.take()
    }

    /// Deletes the journal: its work is saved or unwanted.
    pub(crate) fn discard(&mut self) {
        if let Some(journal) = &mut self.file {
            journal.delete();
        }
    }

    /// Closes the journal if it cannot be written.
    fn close_on_error<T>(&mut self, result: io::Result<T>, file: &Path) -> Result<T, Notice> {
        result.map_err(|error| {
            self.file = None;
            unusable(file, &error)
        })
    }
}

/// The notice about a journal that cannot be opened or written.
fn unusable(layout_file: &Path, error: &io::Error) -> Notice {
    let file = shown_path(layout_file);
    let reason = match error.kind() {
        io::ErrorKind::WouldBlock => t("the file is open in another window, which has the journal"),
        _ => &say!("cannot write the journal beside this file: {error}", error),
    };
    say!(
        "{file}: {reason}. Unsaved work would not survive a crash: save often",
        file,
        reason
    )
}
