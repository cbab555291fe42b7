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
//! cut.

use std::fs::{self, File, OpenOptions};
use std::io::{self, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use guideway_document::{Document, JournalEntry, ReplayProgress};

use super::journal_header::{HEADER_BYTES, header, read_header};
use super::unsaved_work::UnsavedWork;

/// A journal file. It is created with the first entry.
pub(crate) struct JournalFile {
    pub(super) journal: PathBuf,
    base: PathBuf,
    /// Open for appending; `None` until the first entry.
    file: Option<File>,
    /// True if unsaved work of an earlier run awaits a decision.
    has_unsaved_work: bool,
    /// Destination of unsaved work that does not match the layout file.
    mismatched_copy: Option<PathBuf>,
}

impl JournalFile {
    /// Opens the journal of a layout file that was just read. Unsaved work of another state of that
    /// file is moved aside.
    pub(crate) fn open(layout_file: &Path) -> Self {
        let journal = sibling(layout_file, "journal");
        let unsaved = find_unsaved(&journal, layout_file).unwrap_or_default();
        let mut opened = Self {
            has_unsaved_work: unsaved == Some(Match::Same),
            base: sibling(layout_file, "base"),
            journal,
            file: None,
            mismatched_copy: None,
        };
        if unsaved == Some(Match::Other) {
            opened.move_aside();
        }
        if !opened.has_unsaved_work {
            // A journal without unsaved entries is of no use.
            opened.delete();
        }
        opened
    }

    /// Renames journal and base, and replaces older copies of that name.
    fn move_aside(&mut self) {
        let [journal, base] = [&self.journal, &self.base].map(|file| {
            let mut copy = file.clone().into_os_string();
            copy.push("-old");
            let copy = PathBuf::from(copy);
            // There may be no base.
            fs::rename(file, &copy).ok().map(|()| copy)
        });
        self.mismatched_copy = journal.or(base);
    }

    /// Destination of unsaved work that does not match the layout file.
    pub(super) fn mismatched_copy(&self) -> Option<&Path> {
        self.mismatched_copy.as_deref()
    }

    /// Returns `true` if unsaved work of an earlier run awaits a decision.
    pub(crate) fn has_unsaved_work(&self) -> bool {
        self.has_unsaved_work
    }

    /// Unsaved work of an earlier run. It stays on disk until it is recovered or discarded.
    pub(crate) fn unsaved_work(&self, layout_file: &Path) -> Option<UnsavedWork> {
        let base = match self.base.exists() {
            true => &self.base,
            false => layout_file,
        };
        self.has_unsaved_work.then(|| UnsavedWork {
            journal: self.journal.clone(),
            base: base.to_owned(),
        })
    }

    /// Continues behind recovered entries and truncates the rest. Returns whether nothing was
    /// truncated.
    ///
    /// # Errors
    /// When the journal cannot be written.
    pub(super) fn resume(&mut self, done: ReplayProgress, layout_file: &Path) -> io::Result<bool> {
        let end = (HEADER_BYTES + done.bytes) as u64;
        let mut options = OpenOptions::new();
        let mut file = options.read(true).write(true).open(&self.journal)?;
        let is_all = file.metadata()?.len() <= end;
        if read_header(&mut file)?.1 > done.bytes as u64 {
            // The saved state lies behind the damage: nothing counts as saved.
            file.rewind()?;
            file.write_all(&header(layout_file, 0)?)?;
        }
        file.set_len(end)?;
        file.seek(SeekFrom::End(0))?;
        self.file = Some(file);
        self.has_unsaved_work = false;
        Ok(is_all)
    }

    /// Appends the document's new entries.
    ///
    /// # Errors
    /// When the journal cannot be written.
    pub(crate) fn record(&mut self, document: &mut Document, layout_file: &Path) -> io::Result<()> {
        if self.has_unsaved_work {
            return Ok(());
        }
        let entries = document.take_journal_entries();
        if entries.is_empty() {
            return Ok(());
        }
        let file = match &mut self.file {
            Some(file) => file,
            none => none.insert(create(&self.journal, layout_file)?),
        };
        let records: Vec<u8> = entries.iter().flat_map(JournalEntry::to_record).collect();
        file.write_all(&records)
    }

    /// Copies the file as read, before its first save.
    ///
    /// # Errors
    /// When the copy cannot be written.
    pub(super) fn copy_base(&self, layout_file: &Path) -> io::Result<()> {
        if self.base.exists() {
            return Ok(());
        }
        // Saves replace files and never write into them, so a hard link is a copy.
        let is_linked = fs::hard_link(layout_file, &self.base).is_ok();
        if !is_linked {
            fs::copy(layout_file, &self.base)?;
        }
        Ok(())
    }

    /// Marks all entries as saved, in `layout_file`, which may have another name than before.
    ///
    /// # Errors
    /// When the journal cannot be written.
    pub(super) fn mark_saved(&mut self, layout_file: &Path) -> io::Result<()> {
        let (journal, base) = (
            sibling(layout_file, "journal"),
            sibling(layout_file, "base"),
        );
        if journal != self.journal {
            fs::copy(&self.base, &base)?;
            if let Some(file) = &mut self.file {
                file.flush()?;
                fs::copy(&self.journal, &journal)?;
                *file = OpenOptions::new().write(true).open(&journal)?;
                fs::remove_file(&self.journal)?;
            }
            fs::remove_file(&self.base)?;
            (self.journal, self.base) = (journal, base);
        }
        let Some(file) = &mut self.file else {
            return Ok(());
        };
        let end = file.seek(SeekFrom::End(0))?;
        file.rewind()?;
        file.write_all(&header(layout_file, end - HEADER_BYTES as u64)?)?;
        file.seek(SeekFrom::End(0)).map(drop)
    }

    /// Deletes journal and base.
    pub(super) fn delete(&mut self) {
        self.has_unsaved_work = false;
        self.file = None;
        for path in [&self.journal, &self.base] {
            // Either may be absent.
            let _ = fs::remove_file(path);
        }
    }
}

/// All entries of a journal and the file that they begin with; `None` without a journal.
#[cfg(test)]
pub(crate) fn read_entries(layout_file: &Path) -> Option<(Vec<u8>, PathBuf)> {
    let mut journal = fs::read(sibling(layout_file, "journal")).ok()?;
    let entries = journal.split_off(HEADER_BYTES);
    let base = sibling(layout_file, "base");
    let base = match base.exists() {
        true => base,
        false => layout_file.to_owned(),
    };
    Some((entries, base))
}

fn create(journal: &Path, layout_file: &Path) -> io::Result<File> {
    let header = header(layout_file, 0)?;
    let mut file = File::create(journal)?;
    file.write_all(&header)?;
    Ok(file)
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
fn find_unsaved(journal: &Path, layout_file: &Path) -> io::Result<Option<Match>> {
    let mut file = File::open(journal)?;
    let (found, saved_bytes) = read_header(&mut file)?;
    let entry_bytes = file.metadata()?.len() - HEADER_BYTES as u64;
    let is_same = match found == header(layout_file, saved_bytes)? {
        true => Match::Same,
        false => Match::Other,
    };
    Ok((entry_bytes > saved_bytes).then_some(is_same))
}

/// `.site.lif.json.guideway-journal` beside `site.lif.json`.
fn sibling(layout_file: &Path, kind: &str) -> PathBuf {
    let name = layout_file.file_name().unwrap_or_default();
    let name = name.to_string_lossy();
    layout_file.with_file_name(format!(".{name}.guideway-{kind}"))
}

#[cfg(test)]
mod tests;
