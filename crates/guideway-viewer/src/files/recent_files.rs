//! The list of recent files, stored in the state folder as one path per line.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use crate::preferences::write_state;

/// Length of the list: one digit key per file.
const MAX_FILES: usize = 10;
const FILE_NAME: &str = "recent-files";

/// Recent files, the newest first.
pub(crate) struct RecentFiles {
    /// The state folder; `None` keeps the list in memory only.
    folder: Option<PathBuf>,
    files: Vec<PathBuf>,
}

impl RecentFiles {
    /// Reads the list; a missing or unreadable file is an empty list.
    pub(crate) fn load(folder: Option<PathBuf>) -> Self {
        let text = folder
            .as_ref()
            .and_then(|folder| fs::read_to_string(folder.join(FILE_NAME)).ok());
        let text = text.unwrap_or_default();
        let lines = text.lines().filter(|line| !line.is_empty());
        Self {
            files: lines.take(MAX_FILES).map(PathBuf::from).collect(),
            folder,
        }
    }

    /// The files, and whether each still exists.
    pub(crate) fn files(&self) -> Vec<(PathBuf, bool)> {
        let state = |file: &PathBuf| (file.clone(), file.is_file());
        self.files.iter().map(state).collect()
    }

    /// Puts a file at the front of the list.
    ///
    /// # Errors
    /// When the list cannot be written.
    pub(crate) fn add(&mut self, file: &Path) -> io::Result<()> {
        let file = std::path::absolute(file)?;
        // The list has one line per file: it omits names that are not UTF-8 or have line breaks.
        if file.to_str().is_none_or(|name| name.contains(['\n', '\r'])) {
            return Ok(());
        }
        let Some(folder) = &self.folder else {
            return Ok(());
        };
        // Another window may have added files.
        self.files = Self::load(Some(folder.clone())).files;
        self.files.retain(|other| *other != file);
        self.files.insert(0, file);
        self.files.truncate(MAX_FILES);
        let lines = self.files.iter().filter_map(|file| file.to_str());
        let text: String = lines.flat_map(|line| [line, "\n"]).collect();
        write_state(folder, FILE_NAME, &text)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(recent: &RecentFiles) -> Vec<String> {
        let name = |(file, _): (PathBuf, bool)| file.file_name().unwrap().to_str().unwrap().into();
        recent.files().into_iter().map(name).collect()
    }

    #[test]
    fn keeps_the_newest_ten_without_duplicates() {
        let folder = tempfile::tempdir().unwrap();
        let state = folder.path().join("state/guideway");
        let mut recent = RecentFiles::load(Some(state.clone()));
        assert!(recent.files().is_empty());
        for number in 0..14 {
            recent
                .add(&folder.path().join(format!("{number}")))
                .unwrap();
        }
        recent.add(&folder.path().join("7")).unwrap();
        let expected = ["7", "13", "12", "11", "10", "9", "8", "6", "5", "4"];
        assert_eq!(names(&recent), expected);
        assert_eq!(names(&RecentFiles::load(Some(state.clone()))), expected);
        assert_eq!(fs::read_dir(state).unwrap().count(), 1);
    }

    #[test]
    fn two_windows_share_the_list_and_missing_files_are_marked() {
        let folder = tempfile::tempdir().unwrap();
        let windows = [(); 2].map(|()| RecentFiles::load(Some(folder.path().to_owned())));
        let there = folder.path().join("there");
        fs::write(&there, "").unwrap();
        let [mut first, mut second] = windows;
        first.add(&folder.path().join("gone")).unwrap();
        second.add(&there).unwrap();
        let files: Vec<bool> = second.files().into_iter().map(|(_, is)| is).collect();
        assert_eq!(
            (names(&second), files),
            (vec!["there".into(), "gone".into()], vec![true, false])
        );
    }

    #[test]
    fn reports_write_errors_and_omits_names_with_line_breaks() {
        let folder = tempfile::tempdir().unwrap();
        let blocked = folder.path().join("file");
        fs::write(&blocked, "").unwrap();
        assert!(
            RecentFiles::load(Some(blocked))
                .add(Path::new("a"))
                .is_err()
        );
        let mut recent = RecentFiles::load(Some(folder.path().to_owned()));
        recent.add(Path::new("two\nlines")).unwrap();
        assert!(recent.files().is_empty());
        assert!(RecentFiles::load(None).add(Path::new("a")).is_ok());
    }
}
