//! The journal file of one open layout file: appends edits and finds unsaved work of earlier runs.
//!
//! ```text
//! .site.lif.json.guideway-journal   magic 8 | file size 8 | file time 16 | saved bytes 8 | entries
//! .site.lif.json.guideway-base      the layout file as read; exists from the first save on
//! ```
//!
//! Entries name rows of the file as read, and a save renumbers the rows. So the first save copies
//! the file as read, and base plus journal restore the work, even where nothing was edited before.
//! The journal is not flushed to disk per entry: it survives a crash of the program, not a power
//! cut. Entries that the disk has no room for wait in memory.
//!
//! The window that has locked the journal owns both files. Another window on the same layout file
//! reads, writes and deletes neither.

use std::ffi::OsString;
use std::fs::{self, File};
use std::io::{self, ErrorKind, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use guideway_compose::lock_regular_file;
use guideway_document::{Document, JournalEntry, ReplayProgress};

use super::journal_header::{HEADER_BYTES, header, read_header};
use super::journal_writes::{append, copy, create, or_remove, rewrite, with_suffix};
use super::unsaved_work::{UnsavedSummary, UnsavedWork, read_entries};

/// A journal file. It is created with the first entry, or before the first save.
pub(crate) struct JournalFile {
    pub(super) journal: PathBuf,
    base: PathBuf,
    /// The layout file that it belongs to.
    layout_file: PathBuf,
    /// Open and locked; `None` until it is created.
    file: Option<File>,
    /// Entries that could not be written yet.
    pending: Vec<u8>,
    /// Bytes of entries that are in the saved layout file, until the header says so.
    saved_to_mark: Option<u64>,
    /// Unsaved work of an earlier run that awaits a decision.
    unsaved: Option<UnsavedSummary>,
    /// Destination of unsaved work that does not match the layout file.
    mismatched_copy: Option<PathBuf>,
}

impl JournalFile {
    /// Opens the journal of a layout file that was just read. Unsaved work of another state of that
    /// file is moved aside.
    ///
    /// # Errors
    /// When another window has the journal, or it cannot be opened.
    pub(crate) fn open(layout_file: &Path) -> io::Result<Self> {
        let mut opened = Self::absent(layout_file);
        let mut file = match lock_regular_file(&opened.journal, false) {
            Ok(file) => file,
            Err(error) if error.kind() == ErrorKind::NotFound => return Ok(opened),
            Err(error) => return Err(error),
        };
        let unsaved = find_unsaved(&mut file, layout_file).unwrap_or_default();
        if unsaved == Some(Match::Same) {
            opened.unsaved = Some(UnsavedSummary::of(&mut file)?);
        }
        opened.file = Some(file);
        if unsaved == Some(Match::Other) {
            opened.move_aside();
        }
        if opened.unsaved.is_none() {
            // A journal without unsaved entries is of no use.
            opened.delete();
        }
        Ok(opened)
    }

    fn absent(layout_file: &Path) -> Self {
        Self {
            journal: sibling(layout_file, "journal"),
            base: sibling(layout_file, "base"),
            layout_file: layout_file.to_owned(),
            file: None,
            pending: Vec::new(),
            saved_to_mark: None,
            unsaved: None,
            mismatched_copy: None,
        }
    }

    /// Renames journal and base, and replaces older copies of that name.
    fn move_aside(&mut self) {
        let [journal, base] = [&self.journal, &self.base].map(|file| {
            let copy = with_suffix(file, "-old");
            // There may be no base.
            fs::rename(file, &copy).ok().map(|()| copy)
        });
        self.mismatched_copy = journal.or(base);
    }

    /// Destination of unsaved work that does not match the layout file.
    pub(super) fn mismatched_copy(&self) -> Option<&Path> {
        self.mismatched_copy.as_deref()
    }

    /// Unsaved work of an earlier run that awaits a decision.
    pub(crate) fn unsaved_summary(&self) -> Option<UnsavedSummary> {
        self.unsaved
    }

    /// Unsaved work of an earlier run. It stays on disk until it is recovered or discarded.
    pub(crate) fn unsaved_work(&self, layout_file: &Path) -> Option<UnsavedWork> {
        let file = self.file.as_ref().filter(|_| self.unsaved.is_some())?;
        let base = match self.base.exists() {
            true => &self.base,
            false => layout_file,
        };
        Some(UnsavedWork {
            journal: self.journal.clone(),
            entries: read_entries(file),
            base: base.to_owned(),
        })
    }

    /// Continues behind recovered entries and truncates the rest. Returns whether nothing was
    /// truncated.
    ///
    /// # Errors
    /// When the journal cannot be written.
    pub(super) fn resume(&mut self, done: ReplayProgress, layout_file: &Path) -> io::Result<bool> {
        let Some(file) = &mut self.file else {
            return Ok(true);
        };
        let end = (HEADER_BYTES + done.bytes) as u64;
        let is_all = file.metadata()?.len() <= end;
        file.rewind()?;
        if read_header(file)?.1 > done.bytes as u64 {
            // The saved state lies behind the damage: nothing counts as saved.
            file.rewind()?;
            file.write_all(&header(layout_file, 0)?)?;
        }
        file.set_len(end)?;
        file.seek(SeekFrom::End(0))?;
        self.unsaved = None;
        Ok(is_all)
    }

    /// Takes the document's new entries, to be written.
    pub(super) fn take(&mut self, document: &mut Document) {
        if self.unsaved.is_none() {
            let entries = document.take_journal_entries();
            let records = entries.iter().flat_map(JournalEntry::to_record);
            self.pending.extend(records);
        }
    }

    /// Takes the document's new entries and appends them.
    #[cfg(test)]
    pub(crate) fn record(&mut self, document: &mut Document, layout_file: &Path) -> io::Result<()> {
        self.take(document);
        self.write_pending(layout_file)
    }

    /// Appends the entries that were taken. Those that cannot be written come with the next ones.
    ///
    /// # Errors
    /// When the journal cannot be written, or another window has it.
    pub(super) fn write_pending(&mut self, layout_file: &Path) -> io::Result<()> {
        if !self.pending.is_empty() {
            let pending = std::mem::take(&mut self.pending);
            let written = self.created(layout_file);
            let written = written.and_then(|file| append(file, &pending));
            if written.is_err() {
                self.pending = pending;
            }
            written?;
        }
        if let (Some(saved), Some(file)) = (self.saved_to_mark, &mut self.file) {
            file.rewind()?;
            file.write_all(&header(layout_file, saved)?)?;
            self.saved_to_mark = None;
        }
        Ok(())
    }

    /// The journal, which is created where there is none. One that vanished is written again.
    fn created(&mut self, layout_file: &Path) -> io::Result<&mut File> {
        let is_gone = || fs::symlink_metadata(&self.journal).is_err();
        if let Some(vanished) = self.file.as_mut().filter(|_| is_gone()) {
            let written = rewrite(vanished, &self.journal)?;
            self.file = Some(written);
        }
        match &mut self.file {
            Some(file) => Ok(file),
            none => {
                let file = create(&self.journal, layout_file)?;
                // That of a journal which is gone.
                let _ = fs::remove_file(&self.base);
                Ok(none.insert(file))
            }
        }
    }

    /// The copy of the file as read that is to be made before its first save, on any thread.
    ///
    /// # Errors
    /// When the journal cannot be written, or another window has it.
    pub(super) fn base_copy(&mut self, layout_file: &Path) -> io::Result<BaseCopy> {
        self.created(layout_file)?;
        Ok(BaseCopy {
            from: layout_file.to_owned(),
            to: self.base.clone(),
        })
    }

    /// Returns `true` if it is the journal of this layout file.
    pub(super) fn is_of(&self, layout_file: &Path) -> bool {
        sibling(layout_file, "journal") == self.journal
    }

    /// Marks all entries as saved, in `layout_file`, which may have another name than before.
    ///
    /// # Errors
    /// When the journal cannot be written, or another window has that of the other name.
    pub(super) fn mark_saved(&mut self, layout_file: &Path) -> io::Result<()> {
        if !self.is_of(layout_file) {
            self.move_to(layout_file)?;
        }
        let on_disk = match &self.file {
            Some(file) => file.metadata()?.len() - HEADER_BYTES as u64,
            None => 0,
        };
        self.saved_to_mark = Some(on_disk + self.pending.len() as u64);
        self.write_pending(layout_file)
    }

    /// Moves journal and base beside another layout file. Unsaved work that is there already is
    /// moved aside.
    fn move_to(&mut self, layout_file: &Path) -> io::Result<()> {
        let mut moved = Self::absent(layout_file);
        if self.file.is_some() || !self.pending.is_empty() {
            let mut target = lock_regular_file(&moved.journal, true)?;
            if target.metadata()?.len() > HEADER_BYTES as u64 {
                moved.move_aside();
                target = lock_regular_file(&moved.journal, true)?;
            }
            target.set_len(0)?;
            let written = match &mut self.file {
                Some(file) => file
                    .rewind()
                    .and_then(|()| io::copy(file, &mut target))
                    .map(drop),
                None => header(layout_file, 0).and_then(|header| target.write_all(&header)),
            };
            or_remove(written, &moved.journal)?;
            moved.pending.clone_from(&self.pending);
            moved.file = Some(target);
        }
        let _ = fs::remove_file(&moved.base);
        if moved.file.is_some() {
            // Without room for the copy, the file as read is still the base.
            let base = match self.base.exists() {
                true => &self.base,
                false => &self.layout_file,
            };
            or_remove(copy(base, &moved.base), &moved.journal)?;
        }
        self.delete();
        *self = moved;
        Ok(())
    }

    /// Deletes journal and base, which this window owns.
    pub(super) fn delete(&mut self) {
        self.unsaved = None;
        self.pending.clear();
        self.saved_to_mark = None;
        if let Some(_locked) = self.file.take() {
            for path in [&self.base, &self.journal] {
                // Either may be absent.
                let _ = fs::remove_file(path);
            }
        }
    }
}

/// A copy of a layout file as it was read, unless there is one.
#[derive(Clone, Debug)]
pub(crate) struct BaseCopy {
    from: PathBuf,
    to: PathBuf,
}

impl BaseCopy {
    /// Makes the copy, which takes time for a large file.
    ///
    /// # Errors
    /// When the file cannot be read or the copy cannot be written.
    pub(crate) fn run(&self) -> io::Result<()> {
        match self.to.exists() {
            true => Ok(()),
            false => copy(&self.from, &self.to),
        }
    }
}

/// All entries of a journal and the file that they begin with; `None` without a journal.
#[cfg(test)]
pub(crate) fn entries_on_disk(layout_file: &Path) -> Option<(Vec<u8>, PathBuf)> {
    let mut journal = fs::read(sibling(layout_file, "journal")).ok()?;
    let entries = journal.split_off(HEADER_BYTES);
    let base = sibling(layout_file, "base");
    let base = match base.exists() {
        true => base,
        false => layout_file.to_owned(),
    };
    Some((entries, base))
}

/// The state of the layout file that unsaved work belongs to.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Match {
    /// The present one.
    Same,
    /// An earlier one.
    Other,
}

/// Compares a journal that has unsaved entries with its layout file; `None` without such entries.
fn find_unsaved(journal: &mut File, layout_file: &Path) -> io::Result<Option<Match>> {
    let (found, saved_bytes) = read_header(journal)?;
    let entry_bytes = journal.metadata()?.len() - HEADER_BYTES as u64;
    let is_same = match found == header(layout_file, saved_bytes)? {
        true => Match::Same,
        false => Match::Other,
    };
    Ok((entry_bytes > saved_bytes).then_some(is_same))
}

/// `.site.lif.json.guideway-journal` beside `site.lif.json`.
fn sibling(layout_file: &Path, kind: &str) -> PathBuf {
    let mut name = OsString::from(".");
    name.push(layout_file.file_name().unwrap_or_default());
    name.push(format!(".guideway-{kind}"));
    layout_file.with_file_name(name)
}

#[cfg(test)]
mod tests;
