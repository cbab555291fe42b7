//! Records the edits of one document in its journal file, and suspends that while a save runs.

use std::io;
use std::io::ErrorKind::{QuotaExceeded, ResourceBusy, StorageFull, WouldBlock};
use std::path::Path;
use std::time::{Duration, Instant};

use guideway_document::{Document, ReplayProgress, SavedState};
use guideway_layout::shown_path;

use super::journal_file::{BaseCopy, JournalFile};
use super::notice::Notice;
use super::unsaved_work::{UnsavedSummary, UnsavedWork};
use crate::language::{say, t};

/// Time after which a journal that could not be written is tried again.
const RETRY: Duration = Duration::from_secs(1);

/// The journal of a document. It moves between threads with its document.
#[derive(Default)]
pub(crate) struct Journal {
    /// `None` before a document is loaded, and where the file cannot be used.
    file: Option<JournalFile>,
    /// Time of the last attempt, while the file cannot be written.
    failed_at: Option<Instant>,
    /// Why there is no copy of the file as read, which the save in progress may replace.
    lacks_base: Option<io::ErrorKind>,
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
    /// file, or a journal that cannot be used. Also that a journal is written again.
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
    /// Once, when the journal cannot be written; later calls try again.
    pub(super) fn record(&mut self, document: &mut Document, file: &Path) -> Result<(), Notice> {
        let is_waiting = self.failed_at.is_some_and(|at| at.elapsed() < RETRY);
        match &mut self.file {
            Some(journal) if self.saving.is_none() => {
                // Also while it waits: a save marks all entries that were taken.
                journal.take(document);
                if is_waiting {
                    return Ok(());
                }
                let result = journal.write_pending(file);
                self.follow(result, file)
            }
            _ => Ok(()),
        }
    }

    /// The time until the journal is tried again; `None` unless it waits.
    pub(crate) fn retry_after(&self) -> Option<Duration> {
        self.file.as_ref()?;
        let failed_at = self.failed_at?;
        Some(RETRY.saturating_sub(failed_at.elapsed()))
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
        let error = result.as_ref().and_then(|copy| copy.as_ref().err());
        self.lacks_base = error.map(io::Error::kind);
        match result {
            Some(Ok(copy)) => Ok(Some(copy)),
            Some(Err(error)) => self.follow(Err(error), file).map(|()| None),
            None => Ok(None),
        }
    }

    /// Resumes recording after a successful save to `file`, before which the file as read was
    /// copied or not.
    ///
    /// # Errors
    /// When the journal cannot be written. It ends where that file is gone with which its entries
    /// begin.
    pub(crate) fn complete_save(
        &mut self,
        file: &Path,
        copied: io::Result<()>,
    ) -> Result<(), Notice> {
        self.saving = None;
        let lacks_base = self.lacks_base.take();
        let Some(journal) = &mut self.file else {
            return Ok(());
        };
        if !journal.is_of(file) {
            let moved = journal.mark_saved(file);
            if moved.is_err() {
                // All of it is in the saved file.
                journal.delete();
            }
            self.failed_at = None;
            return self.close_on_error(moved, file);
        }
        let copied = lacks_base.map_or(copied, |kind| Err(kind.into()));
        if copied.is_err() {
            journal.delete();
            return self.close_on_error(copied, file);
        }
        let marked = journal.mark_saved(file);
        self.follow(marked, file)
    }

    /// Resumes recording after a failed save. Returns the saved state to restore.
    pub(crate) fn abort_save(&mut self) -> Option<SavedState> {
        self.lacks_base = None;
        self.saving.take()
    }

    /// Deletes the journal: its work is saved or unwanted.
    pub(crate) fn discard(&mut self) {
        self.failed_at = None;
        if let Some(journal) = &mut self.file {
            journal.delete();
        }
    }

    /// Tells that the journal cannot be written, once, and that it is written again. One that
    /// another window has is closed.
    fn follow(&mut self, result: io::Result<()>, file: &Path) -> Result<(), Notice> {
        let Err(error) = result else {
            if self.failed_at.take().is_some() {
                let file = shown_path(file);
                self.notice = Some(say!("{file}: unsaved work is recorded again", file));
            }
            return Ok(());
        };
        if matches!(error.kind(), WouldBlock | ResourceBusy) {
            return self.close_on_error(Err(error), file);
        }
        let is_told = self.failed_at.replace(Instant::now()).is_some();
        match is_told {
            true => Ok(()),
            false => Err(unwritten(file, &error)),
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

/// The notice about a journal that cannot be written for now.
fn unwritten(layout_file: &Path, error: &io::Error) -> Notice {
    let (file, reason) = (shown_path(layout_file), reason(error));
    say!(
        "{file}: {reason}. Meanwhile unsaved work would not survive a crash: save often, or \
         elsewhere",
        file,
        reason
    )
}

fn reason(error: &io::Error) -> String {
    match error.kind() {
        WouldBlock => t("the file is open in another window, which has the journal").to_owned(),
        StorageFull | QuotaExceeded => {
            t("the disk is full, so the journal beside this file cannot be written").to_owned()
        }
        _ => say!("cannot write the journal beside this file: {error}", error),
    }
}

/// The notice about a journal that cannot be opened or written.
fn unusable(layout_file: &Path, error: &io::Error) -> Notice {
    let (file, reason) = (shown_path(layout_file), reason(error));
    say!(
        "{file}: {reason}. Unsaved work would not survive a crash: save often",
        file,
        reason
    )
}
