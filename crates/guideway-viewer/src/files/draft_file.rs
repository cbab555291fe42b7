//! The draft of a layout that has no file yet: its first state, in the state folder. The journal
//! lies beside it, so that a new layout survives a crash as an opened one does.
//!
//! ```text
//! drafts/4711-0/untitled.lif.json.arrow                      the layout as it began
//! drafts/4711-0/.untitled.lif.json.arrow.guideway-journal    its edits
//! ```

use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Duration;

use guideway_layout::Layout;

use crate::editing::JournalFile;
use crate::services::AppServices;

/// Suggested extension where a layout has no file, the format of the file has no writer, or saving
/// would lose content.
pub(crate) const DEFAULT_EXTENSION: &str = "lif.json";

const FOLDER: &str = "drafts";
/// Ending of a draft: a format that keeps all of a layout and its rows.
const EXTENSION: &str = ".arrow";
/// Age of a draft without unsaved work from which it is taken as left by a crash.
const MAX_AGE: Duration = Duration::from_secs(7 * 24 * 3600);

/// A draft and its folder, which belong to one open layout.
pub(crate) struct DraftFile {
    path: PathBuf,
}

impl DraftFile {
    /// The place of a new draft, for a layout that would be saved as `name`. `None` if the folder
    /// cannot be created.
    pub(super) fn create(state_folder: &Path, name: &Path) -> Option<Self> {
        static COUNT: AtomicU64 = AtomicU64::new(0);
        let drafts = state_folder.join(FOLDER);
        fs::create_dir_all(&drafts).ok()?;
        let process = std::process::id();
        let mut names = std::iter::repeat_with(|| COUNT.fetch_add(1, Ordering::Relaxed));
        let folder = names.find_map(|number| {
            let folder = drafts.join(format!("{process}-{number}"));
            match fs::create_dir(&folder) {
                // Another run had the same process number.
                Err(error) if error.kind() == io::ErrorKind::AlreadyExists => None,
                created => Some(created.map(|()| folder)),
            }
        });
        let mut file = name.file_name()?.to_owned();
        file.push(EXTENSION);
        Some(Self {
            path: folder?.ok()?.join(file),
        })
    }

    /// Drafts with unsaved work that earlier runs left, the oldest first.
    pub(super) fn left(state_folder: &Path) -> Vec<Self> {
        let files = |folder: &Path| {
            let entries = fs::read_dir(folder).into_iter().flatten().flatten();
            entries.map(|entry| entry.path()).collect::<Vec<_>>()
        };
        let folders = files(&state_folder.join(FOLDER)).into_iter();
        let drafts = folders.flat_map(|folder| files(&folder));
        let drafts = drafts.filter(|file| file.to_string_lossy().ends_with(EXTENSION));
        let drafts = drafts.map(|path| Self { path });
        let (mut left, others): (Vec<_>, Vec<_>) = drafts.partition(|d| has_unsaved_work(&d.path));
        let is_old = |draft: &Self| draft.age().is_some_and(|age| age > MAX_AGE);
        others.into_iter().filter(is_old).for_each(|d| d.delete());
        left.sort_by_cached_key(|draft| std::cmp::Reverse(draft.age()));
        left
    }

    fn age(&self) -> Option<Duration> {
        let modified = fs::metadata(&self.path).and_then(|m| m.modified()).ok()?;
        modified.elapsed().ok()
    }

    pub(crate) fn path(&self) -> &Path {
        &self.path
    }

    /// The name under which its layout would be saved, up to the extension.
    pub(super) fn suggested_stem(&self) -> String {
        let name = self.path.file_name().unwrap_or_default().to_string_lossy();
        let extension = format!(".{DEFAULT_EXTENSION}{EXTENSION}");
        name.strip_suffix(&extension).unwrap_or(&name).to_owned()
    }

    /// Deletes the draft. Its journal must be discarded or moved away before.
    pub(super) fn delete(&self) {
        // It may not have been written.
        let _ = fs::remove_file(&self.path);
        if let Some(folder) = self.path.parent() {
            let _ = fs::remove_dir(folder);
        }
    }
}

/// Writes the first state of a layout as its draft. Without one, the journal says that it cannot be
/// written.
pub(super) fn write_draft(services: &dyn AppServices, layout: &Layout, path: &Path) {
    let _ = services.save_layout(layout, path, &|_| true);
}

/// Returns `true` if a draft has a journal with edits, and no other window has it.
fn has_unsaved_work(draft: &Path) -> bool {
    let journal = JournalFile::open(draft);
    journal.is_ok_and(|journal| journal.unsaved_summary().is_some())
}

#[cfg(test)]
pub(super) mod tests {
    use guideway_document::Document;

    use super::*;
    use crate::tests::services::lanes;

    /// A draft with unsaved work, as a crash leaves it.
    pub(in crate::files) fn left_behind(state: &Path, name: &Path) -> DraftFile {
        let draft = DraftFile::create(state, name).unwrap();
        let mut document = Document::new(lanes(2).into(), &Default::default()).unwrap();
        fs::write(draft.path(), "").unwrap();
        document.select_all();
        document.delete_selection().unwrap();
        let mut journal = JournalFile::open(draft.path()).unwrap();
        journal.record(&mut document, draft.path()).unwrap();
        let is_draft = |left: &DraftFile| left.path() == draft.path();
        assert!(
            !DraftFile::left(state).iter().any(is_draft),
            "its window has it"
        );
        draft
    }

    #[test]
    fn drafts_without_edits_are_not_work() {
        let state = tempfile::tempdir().unwrap();
        let name = Path::new("untitled.lif.json");
        let idle = DraftFile::create(state.path(), name).unwrap();
        fs::write(idle.path(), "").unwrap();
        let edited = left_behind(state.path(), name);
        assert_ne!(idle.path(), edited.path());
        let left = DraftFile::left(state.path());
        let paths: Vec<&Path> = left.iter().map(DraftFile::path).collect();
        assert_eq!(paths, [edited.path()]);
        assert_eq!(left[0].suggested_stem(), "untitled");
    }
}
