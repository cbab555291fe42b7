//! Unsaved work of an earlier run: replays its journal on the file that it begins with.

use std::fs::File;
use std::io::{self, Read, Seek};
use std::path::PathBuf;
use std::time::SystemTime;

use guideway_document::{Document, ReplayProgress, count_records, replay};
use guideway_layout::{UserError, shown_path};

use super::journal_header::read_header;
use crate::language::{say, t};
use crate::services::{Job, WINDOW_ERROR};

/// The size and age of unsaved work.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct UnsavedSummary {
    /// Entries behind those that are saved.
    pub(crate) steps: u64,
    /// Time of the last entry.
    pub(crate) last_written: SystemTime,
}

impl UnsavedSummary {
    /// The summary of a journal, from its start.
    ///
    /// # Errors
    /// When the journal cannot be read.
    pub(super) fn of(journal: &mut File) -> io::Result<Self> {
        journal.rewind()?;
        let (_, saved_bytes) = read_header(journal)?;
        journal.seek_relative(saved_bytes.cast_signed())?;
        Ok(Self {
            steps: count_records(journal)?,
            last_written: journal.metadata()?.modified()?,
        })
    }
}

/// A journal that an earlier run left, and its base file.
pub(crate) struct UnsavedWork {
    pub(super) journal: PathBuf,
    /// All entries, and how many of their bytes are in the saved file.
    pub(super) entries: io::Result<(usize, Vec<u8>)>,
    /// The layout file that the journal begins with.
    pub(crate) base: PathBuf,
}

impl UnsavedWork {
    /// Replays the journal on a document of [`Self::base`].
    ///
    /// # Errors
    /// When the journal cannot be read, or the job was cancelled.
    pub(crate) fn replay(
        &self,
        document: &mut Document,
        job: &Job,
    ) -> Result<ReplayProgress, UserError> {
        let entries = self.entries.as_ref();
        let &(saved_bytes, ref entries) = entries.map_err(|error| {
            UserError::new(
                WINDOW_ERROR,
                say!(
                    "{file}: cannot read the journal: {error}",
                    file = shown_path(&self.journal),
                    error
                ),
                t("Make the file readable and recover again, or discard the unsaved work"),
            )
        })?;
        let replay_to = |document: &mut Document, from: ReplayProgress, end: usize| {
            let done = replay(&entries[from.bytes..end], document, |done| {
                job.advance((from.bytes + done.bytes) as u64, entries.len() as u64);
                !job.is_cancelled()
            });
            ReplayProgress {
                entries: from.entries + done.entries,
                bytes: from.bytes + done.bytes,
            }
        };
        let start = ReplayProgress {
            entries: 0,
            bytes: 0,
        };
        let mut done = replay_to(document, start, saved_bytes);
        if done.bytes == saved_bytes {
            document.mark_saved();
            done = replay_to(document, done, entries.len());
        }
        // The journal has these entries already.
        document.take_journal_entries();
        if job.is_cancelled() {
            return Err(UserError::new(
                WINDOW_ERROR,
                t("the recovery of unsaved work was cancelled"),
                t("The work is kept: choose again whether to recover or discard it"),
            ));
        }
        Ok(done)
    }
}

/// Reads all entries of a journal, and how many of their bytes are in the saved file.
pub(super) fn read_entries(mut journal: &File) -> io::Result<(usize, Vec<u8>)> {
    journal.rewind()?;
    let (_, saved_bytes) = read_header(&mut journal)?;
    let mut entries = Vec::new();
    journal.read_to_end(&mut entries)?;
    Ok((entries.len().min(saved_bytes as usize), entries))
}
