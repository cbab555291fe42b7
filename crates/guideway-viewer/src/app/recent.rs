//! Files that were open lately, remembered from one run to the next.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// Files remembered; older ones are forgotten.
const MOST: usize = 10;
const FILE: &str = "recent-files";

/// Files that were open lately, the newest first.
pub(crate) struct Recent {
    /// Where they are written down; none if nowhere.
    folder: Option<PathBuf>,
    files: Vec<PathBuf>,
}

impl Recent {
    /// Those of earlier runs. What cannot be read is as if there were none.
    pub(super) fn of(folder: Option<PathBuf>) -> Self {
        let text = folder
            .as_ref()
            .and_then(|folder| fs::read_to_string(folder.join(FILE)).ok());
        let text = text.unwrap_or_default();
        let lines = text.lines().filter(|line| !line.is_empty());
        Self {
            files: lines.take(MOST).map(PathBuf::from).collect(),
            folder,
        }
    }

    /// The files, and whether each is still there.
    pub(crate) fn files(&self) -> Vec<(PathBuf, bool)> {
        let state = |file: &PathBuf| (file.clone(), file.is_file());
        self.files.iter().map(state).collect()
    }

    /// A file was opened.
    ///
    /// # Errors
    /// When that cannot be written down.
    pub(super) fn add(&mut self, file: &Path) -> io::Result<()> {
        let file = std::path::absolute(file)?;
        // Names are kept a line each: one that is no text, or more than a line of it, is not remembered.
        if file.to_str().is_none_or(|name| name.contains(['\n', '\r'])) {
            return Ok(());
        }
        let Some(folder) = &self.folder else {
            return Ok(());
        };
        // Another window may have opened some since.
        self.files = Self::of(Some(folder.clone())).files;
        self.files.retain(|other| *other != file);
        self.files.insert(0, file);
        self.files.truncate(MOST);
        let lines = self.files.iter().filter_map(|file| file.to_str());
        let text: String = lines.flat_map(|line| [line, "\n"]).collect();
        fs::create_dir_all(folder)?;
        // Whole or not at all, however many windows write it.
        let new = folder.join(format!("{FILE}.{}", std::process::id()));
        fs::write(&new, text)?;
        fs::rename(&new, folder.join(FILE))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(recent: &Recent) -> Vec<String> {
        let name = |(file, _): (PathBuf, bool)| file.file_name().unwrap().to_str().unwrap().into();
        recent.files().into_iter().map(name).collect()
    }

    #[test]
    fn the_newest_ten_are_remembered_each_once() {
        let folder = tempfile::tempdir().unwrap();
        let state = folder.path().join("state/guideway");
        let mut recent = Recent::of(Some(state.clone()));
        assert!(recent.files().is_empty());
        for number in 0..14 {
            recent
                .add(&folder.path().join(format!("{number}")))
                .unwrap();
        }
        recent.add(&folder.path().join("7")).unwrap();
        let expected = ["7", "13", "12", "11", "10", "9", "8", "6", "5", "4"];
        assert_eq!(names(&recent), expected);
        assert_eq!(names(&Recent::of(Some(state.clone()))), expected);
        assert_eq!(fs::read_dir(state).unwrap().count(), 1);
    }

    #[test]
    fn two_windows_lose_nothing_and_a_missing_file_is_told() {
        let folder = tempfile::tempdir().unwrap();
        let windows = [(); 2].map(|()| Recent::of(Some(folder.path().to_owned())));
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
    fn what_cannot_be_written_down_is_told_and_odd_names_are_left_out() {
        let folder = tempfile::tempdir().unwrap();
        let blocked = folder.path().join("file");
        fs::write(&blocked, "").unwrap();
        assert!(Recent::of(Some(blocked)).add(Path::new("a")).is_err());
        let mut recent = Recent::of(Some(folder.path().to_owned()));
        recent.add(Path::new("two\nlines")).unwrap();
        assert!(recent.files().is_empty());
        assert!(Recent::of(None).add(Path::new("a")).is_ok());
    }
}
