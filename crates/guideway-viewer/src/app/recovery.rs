use std::fs::{self, File, OpenOptions};
use std::io::{self, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::time::UNIX_EPOCH;

use guideway_document::{Act, Document};

/// Begins every journal file; the digit is the version of what follows.
const MAGIC: &[u8; 8] = b"GWJRNAL2";
/// Magic; size and time of the layout file; bytes of the journal that are saved in that.
const HEADER_BYTES: usize = 8 + 8 + 16 + 8;

/// The journal of one open file: what was done since it was read, so that a crash loses none of it.
///
/// Acts name rows as they were read, and saving numbers them anew. So the file as it was read is kept beside the
/// journal from the first time that it is saved over, until it is closed: both together give back the work.
///
/// It is written as the work is done, and not forced to the disk each time: it survives a crash of this program,
/// not one of the computer.
pub(super) struct Recovery {
    journal: PathBuf,
    /// The file as it was read; only there once it was saved over.
    base: PathBuf,
    /// Made with the first act.
    file: Option<File>,
    /// What an earlier run left behind and nobody has decided about.
    found: Option<Vec<u8>>,
}

impl Recovery {
    /// The journal of a layout file that was just read.
    pub(super) fn of(layout_file: &Path) -> Self {
        let journal = beside(layout_file, "journal");
        let mut recovery = Self {
            found: fs::read(&journal)
                .ok()
                .and_then(|bytes| unsaved(bytes, layout_file)),
            base: beside(layout_file, "base"),
            journal,
            file: None,
        };
        if recovery.found.is_none() {
            // One of another state of the file, or of work that was saved, is of no use.
            recovery.clear();
        }
        recovery
    }

    /// Whether an earlier run left something behind.
    pub(super) fn has_found(&self) -> bool {
        self.found.is_some()
    }

    /// What an earlier run left behind: acts for [`guideway_document::replay`], and the file to do them with.
    pub(super) fn take_found(&mut self, layout_file: &Path) -> (Vec<u8>, PathBuf) {
        let file = if self.base.exists() {
            &self.base
        } else {
            layout_file
        };
        (self.found.take().unwrap_or_default(), file.to_owned())
    }

    /// Writes down what was done.
    ///
    /// # Errors
    /// When the journal cannot be written.
    pub(super) fn record(&mut self, document: &mut Document, layout_file: &Path) -> io::Result<()> {
        let acts = document.take_acts();
        if acts.is_empty() || self.found.is_some() {
            return Ok(());
        }
        let file = match &mut self.file {
            Some(file) => file,
            none => none.insert(begin(&self.journal, layout_file)?),
        };
        let records: Vec<u8> = acts.iter().flat_map(Act::to_record).collect();
        file.write_all(&records)
    }

    /// Keeps the file as it was read, right before it is saved over.
    ///
    /// # Errors
    /// When it cannot be kept.
    pub(super) fn keep_base(&self, layout_file: &Path) -> io::Result<()> {
        if self.file.is_none() || self.base.exists() {
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
    pub(super) fn set_saved(&mut self, layout_file: &Path) -> io::Result<()> {
        let (journal, base) = (beside(layout_file, "journal"), beside(layout_file, "base"));
        let Some(file) = &mut self.file else {
            (self.journal, self.base) = (journal, base);
            return Ok(());
        };
        if journal != self.journal {
            file.flush()?;
            fs::copy(&self.journal, &journal)?;
            fs::copy(&self.base, &base)?;
            fs::remove_file(&self.journal)?;
            fs::remove_file(&self.base)?;
            (self.journal, self.base) = (journal, base);
            *file = OpenOptions::new().write(true).open(&self.journal)?;
        }
        let end = file.seek(SeekFrom::End(0))?;
        file.rewind()?;
        file.write_all(&header(layout_file, end - HEADER_BYTES as u64)?)?;
        file.seek(SeekFrom::End(0)).map(drop)
    }

    /// Takes all of it away: what is in it is saved, or is not wanted.
    pub(super) fn clear(&mut self) {
        self.found = None;
        self.file = None;
        for path in [&self.journal, &self.base] {
            // There may be none.
            let _ = fs::remove_file(path);
        }
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

/// The acts of a journal, if it is one of this state of the file and not all of it is saved there.
fn unsaved(mut bytes: Vec<u8>, layout_file: &Path) -> Option<Vec<u8>> {
    let (head, acts) = bytes.split_first_chunk::<HEADER_BYTES>()?;
    let (state, saved) = head.split_last_chunk()?;
    let saved = u64::from_le_bytes(*saved);
    let is_of_this = header(layout_file, saved).is_ok_and(|now| now.starts_with(state));
    let is_unsaved = is_of_this && acts.len() as u64 > saved;
    is_unsaved.then(|| bytes.split_off(HEADER_BYTES))
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
mod tests {
    use guideway_document::replay;
    use guideway_spline::Point;

    use super::*;
    use crate::tests::table::lanes;

    fn document() -> Document {
        Document::new(lanes(4).into(), &Default::default()).unwrap()
    }

    /// A file, and a document of it in which something was done and written down.
    fn edited() -> (tempfile::TempDir, PathBuf, Document, Recovery) {
        let folder = tempfile::tempdir().unwrap();
        let site = folder.path().join("site.arrow");
        fs::write(&site, "as it was read").unwrap();
        let mut recovery = Recovery::of(&site);
        assert!(!recovery.has_found());
        let mut edited = document();
        edited.select_all();
        edited.delete_selection().unwrap();
        recovery.record(&mut edited, &site).unwrap();
        edited.undo();
        edited.move_node(0, Point::new(1.0, 1.0)).unwrap();
        recovery.record(&mut edited, &site).unwrap();
        (folder, site, edited, recovery)
    }

    fn files(folder: &tempfile::TempDir) -> usize {
        fs::read_dir(folder.path()).unwrap().count()
    }

    #[test]
    fn work_is_found_after_a_crash_and_only_with_the_same_file() {
        let (_folder, site, edited, recovery) = edited();
        drop(recovery);
        let mut found = Recovery::of(&site);
        assert!(found.has_found());
        let (acts, file) = found.take_found(&site);
        assert_eq!(file, site);
        let mut recovered = document();
        assert_eq!(replay(&acts, &mut recovered).acts, 3);
        assert_eq!(recovered.scene().draw_order().len(), 4);
        assert_eq!(recovered.node_position_m(0), edited.node_position_m(0));
        // It crashes once more, right after that was written down anew.
        found.record(&mut recovered, &site).unwrap();
        drop(found);
        assert!(Recovery::of(&site).has_found());
        fs::write(&site, "another layout").unwrap();
        assert!(!Recovery::of(&site).has_found());
    }

    #[test]
    fn work_after_saving_is_found_with_the_file_as_it_was_read() {
        for name in ["site.arrow", "other.arrow"] {
            let (folder, site, mut edited, mut recovery) = edited();
            let target = folder.path().join(name);
            recovery.keep_base(&site).unwrap();
            let new = folder.path().join("new");
            fs::write(&new, "as it is saved").unwrap();
            fs::rename(&new, &target).unwrap();
            recovery.set_saved(&target).unwrap();
            edited.move_node(1, Point::new(2.0, 2.0)).unwrap();
            recovery.record(&mut edited, &target).unwrap();
            drop(recovery);
            let mut found = Recovery::of(&target);
            let (acts, base) = found.take_found(&target);
            assert_eq!(fs::read_to_string(base).unwrap(), "as it was read");
            let mut recovered = document();
            assert_eq!(replay(&acts, &mut recovered).acts, 4);
            assert_eq!(recovered.node_position_m(1), Point::new(2.0, 2.0));
        }
    }

    #[test]
    fn what_is_saved_or_not_wanted_leaves_nothing_behind() {
        let (folder, site, _, mut recovery) = edited();
        recovery.keep_base(&site).unwrap();
        recovery.set_saved(&site).unwrap();
        assert_eq!(files(&folder), 3);
        drop(recovery);
        // A crash with nothing unsaved.
        assert!(!Recovery::of(&site).has_found());
        assert_eq!(files(&folder), 1);
        let (folder, _, _, mut recovery) = edited();
        recovery.clear();
        assert_eq!(files(&folder), 1);
    }
}
