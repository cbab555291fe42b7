use std::fs::{self, File, OpenOptions};
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::time::UNIX_EPOCH;

use guideway_document::{Document, JournalEntry, ReplayProgress, replay};

use crate::services::{Job, WINDOW_ERROR};
use guideway_layout::UserError;

/// Begins every journal file; the digit is the version of what follows.
const MAGIC: &[u8; 8] = b"GWJRNAL2";
/// Magic; size and time of the layout file; bytes of the journal that are saved in that.
const HEADER_BYTES: usize = 8 + 8 + 16 + 8;

/// The journal of one open file: what was done since it was read, so that a crash loses none of it.
///
/// Acts name rows as they were read, and saving numbers them anew. So the file as it was read is kept beside the
/// journal from the first time that it is saved, until it is closed: both together give back the work. Even where
/// nothing was done before, for a file that was written need not have the rows of the one that was read.
///
/// It is written as the work is done, and not forced to the disk each time: it survives a crash of this program,
/// not one of the computer.
pub(crate) struct Recovery {
    journal: PathBuf,
    /// The file as it was read; only there once it was saved.
    base: PathBuf,
    /// Made with the first act.
    file: Option<File>,
    /// Whether an earlier run left something behind that nobody has decided about.
    has_found: bool,
    /// Where work was put that an earlier run left behind, and that is of another state of the file.
    aside: Option<PathBuf>,
}

/// What an earlier run left behind.
pub(crate) struct Found {
    journal: PathBuf,
    /// The file that it begins with.
    pub(crate) file: PathBuf,
}

impl Recovery {
    /// The journal of a layout file that was just read.
    pub(crate) fn of(layout_file: &Path) -> Self {
        let journal = beside(layout_file, "journal");
        let unsaved = unsaved(&journal, layout_file).unwrap_or_default();
        let mut recovery = Self {
            has_found: unsaved == Some(IsOf::File),
            base: beside(layout_file, "base"),
            journal,
            file: None,
            aside: None,
        };
        if unsaved == Some(IsOf::Another) {
            recovery.put_aside();
        }
        if !recovery.has_found {
            // One of work that was saved is of no use.
            recovery.clear();
        }
        recovery
    }

    /// Keeps the journal, and the file that it begins with, under other names, in place of any that are there.
    fn put_aside(&mut self) {
        let [journal, base] = [&self.journal, &self.base].map(|file| {
            let mut aside = file.clone().into_os_string();
            aside.push("-old");
            // There may be no base.
            let aside = PathBuf::from(aside);
            fs::rename(file, &aside).ok().map(|()| aside)
        });
        self.aside = journal.or(base);
    }

    /// Where work was put that an earlier run left behind, and that is of another state of the file.
    pub(crate) fn aside(&self) -> Option<&Path> {
        self.aside.as_deref()
    }

    /// Whether an earlier run left something behind.
    pub(crate) fn has_found(&self) -> bool {
        self.has_found
    }

    /// What an earlier run left behind. It stays where it is until it is done again, or dropped.
    pub(crate) fn found(&self, layout_file: &Path) -> Option<Found> {
        let file = if self.base.exists() {
            &self.base
        } else {
            layout_file
        };
        self.has_found.then(|| Found {
            journal: self.journal.clone(),
            file: file.to_owned(),
        })
    }

    /// What was found is done again: the journal goes on behind that. Returns whether that was all of it.
    ///
    /// # Errors
    /// When the journal cannot be written.
    pub(crate) fn go_on(&mut self, done: ReplayProgress, layout_file: &Path) -> io::Result<bool> {
        let end = (HEADER_BYTES + done.bytes) as u64;
        let mut file = OpenOptions::new()
            .read(true)
            .write(true)
            .open(&self.journal)?;
        let is_all = file.metadata()?.len() <= end;
        if read_header(&mut file)?.1 > done.bytes as u64 {
            // The state that was saved is not reached any more.
            file.rewind()?;
            file.write_all(&header(layout_file, 0)?)?;
        }
        file.set_len(end)?;
        file.seek(SeekFrom::End(0))?;
        self.file = Some(file);
        self.has_found = false;
        Ok(is_all)
    }

    /// Writes down what was done.
    ///
    /// # Errors
    /// When the journal cannot be written.
    pub(crate) fn record(&mut self, document: &mut Document, layout_file: &Path) -> io::Result<()> {
        if self.has_found {
            return Ok(());
        }
        let acts = document.take_journal_entries();
        if acts.is_empty() {
            return Ok(());
        }
        let file = match &mut self.file {
            Some(file) => file,
            none => none.insert(begin(&self.journal, layout_file)?),
        };
        let records: Vec<u8> = acts.iter().flat_map(JournalEntry::to_record).collect();
        file.write_all(&records)
    }

    /// Keeps the file as it was read, right before it is saved.
    ///
    /// # Errors
    /// When it cannot be kept.
    pub(crate) fn keep_base(&self, layout_file: &Path) -> io::Result<()> {
        if self.base.exists() {
            return Ok(());
        }
        // Files are replaced and not written into, so a second name keeps what is there.
        let is_linked = fs::hard_link(layout_file, &self.base).is_ok();
        if !is_linked {
            fs::copy(layout_file, &self.base)?;
        }
        Ok(())
    }

    /// All that was recorded is saved, perhaps as another file.
    ///
    /// # Errors
    /// When the journal cannot be written.
    pub(crate) fn set_saved(&mut self, layout_file: &Path) -> io::Result<()> {
        let (journal, base) = (beside(layout_file, "journal"), beside(layout_file, "base"));
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

    /// Takes all of it away: what is in it is saved, or is not wanted.
    pub(crate) fn clear(&mut self) {
        self.has_found = false;
        self.file = None;
        for path in [&self.journal, &self.base] {
            // There may be none.
            let _ = fs::remove_file(path);
        }
    }
}

impl Found {
    /// Does all of it again, with a document of [`Self::file`].
    ///
    /// # Errors
    /// When the journal cannot be read, or the job was cancelled.
    pub(crate) fn do_again(
        &self,
        document: &mut Document,
        job: &Job,
    ) -> Result<ReplayProgress, UserError> {
        let (saved, acts) = self.acts().map_err(|problem| UserError {
            code: WINDOW_ERROR,
            message: format!("{} cannot be read: {problem}", self.journal.display()),
            remedy: "Make it readable and try again, or forget the work in it".into(),
        })?;
        let follow = |document: &mut Document, from: ReplayProgress, end: usize| {
            let done = replay(&acts[from.bytes..end], document, |done| {
                job.advance((from.bytes + done.bytes) as u64, acts.len() as u64);
                !job.is_cancelled()
            });
            ReplayProgress {
                entries: from.entries + done.entries,
                bytes: from.bytes + done.bytes,
            }
        };
        let mut done = follow(
            document,
            ReplayProgress {
                entries: 0,
                bytes: 0,
            },
            saved,
        );
        if done.bytes == saved {
            document.mark_saved();
            done = follow(document, done, acts.len());
        }
        // They are in the journal.
        document.take_journal_entries();
        if job.is_cancelled() {
            return Err(UserError {
                code: WINDOW_ERROR,
                message: "the work of last time was not done again: that was cancelled".into(),
                remedy: "It is kept; choose once more what is to become of it".into(),
            });
        }
        Ok(done)
    }

    /// What was done, and how many bytes of it were saved.
    fn acts(&self) -> io::Result<(usize, Vec<u8>)> {
        let mut journal = File::open(&self.journal)?;
        let (_, saved) = read_header(&mut journal)?;
        let mut acts = Vec::new();
        journal.read_to_end(&mut acts)?;
        Ok((acts.len().min(saved as usize), acts))
    }
}

/// All that a journal holds, and the file that it began with; none if there is no journal.
#[cfg(test)]
pub(crate) fn written(layout_file: &Path) -> Option<(Vec<u8>, PathBuf)> {
    let mut journal = fs::read(beside(layout_file, "journal")).ok()?;
    let acts = journal.split_off(HEADER_BYTES);
    let base = beside(layout_file, "base");
    let file = if base.exists() {
        base
    } else {
        layout_file.to_owned()
    };
    Some((acts, file))
}

fn begin(journal: &Path, layout_file: &Path) -> io::Result<File> {
    let header = header(layout_file, 0)?;
    let mut file = File::create(journal)?;
    file.write_all(&header)?;
    Ok(file)
}

/// What work that was not saved is of.
#[derive(Clone, Copy, PartialEq, Eq)]
enum IsOf {
    /// The file as it is now.
    File,
    /// The file as it was once.
    Another,
}

/// What a journal is of, if not all in it is saved.
fn unsaved(journal: &Path, layout_file: &Path) -> io::Result<Option<IsOf>> {
    let mut file = File::open(journal)?;
    let (is, saved) = read_header(&mut file)?;
    let acts_bytes = file.metadata()?.len() - HEADER_BYTES as u64;
    let is_of = match is == header(layout_file, saved)? {
        true => IsOf::File,
        false => IsOf::Another,
    };
    Ok((acts_bytes > saved).then_some(is_of))
}

/// The header of a journal, and the bytes behind it that are saved.
fn read_header(journal: &mut File) -> io::Result<([u8; HEADER_BYTES], u64)> {
    let mut header = [0; HEADER_BYTES];
    journal.read_exact(&mut header)?;
    let saved = header.last_chunk().map_or(0, |n| u64::from_le_bytes(*n));
    Ok((header, saved))
}

/// What tells the journal of one state of a file from that of another.
fn header(layout_file: &Path, saved_bytes: u64) -> io::Result<[u8; HEADER_BYTES]> {
    let metadata = fs::metadata(layout_file)?;
    let since = metadata.modified()?.duration_since(UNIX_EPOCH);
    let mut header = [0; HEADER_BYTES];
    header[..8].copy_from_slice(MAGIC);
    header[8..16].copy_from_slice(&metadata.len().to_le_bytes());
    // A file from before 1970 is as old as that.
    header[16..32].copy_from_slice(&since.map_or(0, |since| since.as_nanos()).to_le_bytes());
    header[32..].copy_from_slice(&saved_bytes.to_le_bytes());
    Ok(header)
}

/// `.site.lif.json.guideway-journal` beside `site.lif.json`.
fn beside(layout_file: &Path, what: &str) -> PathBuf {
    let name = layout_file
        .file_name()
        .unwrap_or_default()
        .to_string_lossy();
    layout_file.with_file_name(format!(".{name}.guideway-{what}"))
}

#[cfg(test)]
mod tests;
