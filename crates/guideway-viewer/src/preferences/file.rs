//! The file of the preferences: TOML in the state folder, beside the list of recent files.

use std::fs;
use std::io::{self, ErrorKind};
use std::path::PathBuf;

use guideway_layout::shown_path;

use super::state_folder::write_state;
use super::values::Preferences;

const FILE_NAME: &str = "window.toml";

/// The file, and its content as last read or written.
pub(crate) struct PreferencesFile {
    /// `None` keeps nothing.
    folder: Option<PathBuf>,
    saved: Preferences,
    /// True after an error of a write, which is said once.
    is_unwritable: bool,
}

impl PreferencesFile {
    /// Reads the file. A missing one has the defaults, as has a damaged one, with a notice.
    pub(crate) fn load(folder: Option<PathBuf>) -> (Self, Option<String>) {
        let path = folder.as_ref().map(|folder| folder.join(FILE_NAME));
        let text = path.as_ref().map_or(Ok(String::new()), fs::read_to_string);
        let read = match text {
            Ok(text) => {
                toml::from_str::<Preferences>(&text).map_err(|error| error.message().to_owned())
            }
            Err(error) if error.kind() == ErrorKind::NotFound => Ok(Preferences::default()),
            Err(error) => Err(error.to_string()),
        };
        let (saved, notice) = match read {
            Ok(preferences) => (preferences.in_range(), None),
            Err(why) => {
                let file = shown_path(&path.unwrap_or_default());
                let notice = format!(
                    "The settings in {file} cannot be read, so the window has its default ones: \
                     {why}"
                );
                (Preferences::default(), Some(notice))
            }
        };
        let file = Self {
            folder,
            saved,
            is_unwritable: false,
        };
        (file, notice)
    }

    /// The preferences as last read or written.
    pub(crate) fn saved(&self) -> &Preferences {
        &self.saved
    }

    /// Writes the preferences if they have changed. Returns a notice the first time that this
    /// fails.
    pub(crate) fn save(&mut self, preferences: &Preferences) -> Option<String> {
        let folder = self
            .folder
            .as_ref()
            .filter(|_| *preferences != self.saved)?;
        let text =
            toml::to_string(preferences).map_err(|error| io::Error::other(error.to_string()));
        let written = text.and_then(|text| write_state(folder, FILE_NAME, &text));
        self.saved.clone_from(preferences);
        let error = written.err()?;
        let is_new = !std::mem::replace(&mut self.is_unwritable, true);
        let folder = shown_path(folder);
        is_new.then(|| format!("The settings cannot be written to {folder}: {error}"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn changed() -> Preferences {
        let mut preferences = Preferences {
            panel_width: 410.0,
            ..Preferences::default()
        };
        preferences.look.has_arrows = false;
        preferences.look.width_m = Some(0.35);
        preferences.window.position = Some([3.0, 40.0]);
        preferences
    }

    #[test]
    fn file_holds_all_values() {
        let folder = tempfile::tempdir().unwrap();
        let state = folder.path().join("state");
        let (mut file, notice) = PreferencesFile::load(Some(state.clone()));
        assert_eq!((file.saved(), notice), (&Preferences::default(), None));
        assert_eq!(file.save(&changed()), None);
        let (again, notice) = PreferencesFile::load(Some(state.clone()));
        assert_eq!((again.saved(), notice), (&changed(), None));
        assert_eq!(fs::read_dir(&state).unwrap().count(), 1);
        // A file of a later version has more, and one of an earlier version less.
        let text = "panel-width = 410.0\nfuture = 3\n[look]\nhas-grid = false\n";
        fs::write(state.join(FILE_NAME), text).unwrap();
        let (file, notice) = PreferencesFile::load(Some(state));
        assert!(notice.is_none() && !file.saved().look.has_grid);
        assert!(file.saved().look.has_arrows);
    }

    #[test]
    fn damaged_file_has_the_defaults_and_one_notice() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join(FILE_NAME);
        for damaged in [&b"[look"[..], b"panel-width = \"wide\"", b"\xff\xfe"] {
            fs::write(&path, damaged).unwrap();
            let (mut file, notice) = PreferencesFile::load(Some(folder.path().to_owned()));
            assert_eq!(file.saved(), &Preferences::default());
            assert!(notice.unwrap().contains("window.toml"));
            assert_eq!(file.save(&changed()), None, "it is mended by the next save");
        }
        for odd in [
            "panel-width = nan",
            "[look]\nwidth-m = -3.0\nmin-px = 1e300",
        ] {
            fs::write(&path, odd).unwrap();
            let (file, notice) = PreferencesFile::load(Some(folder.path().to_owned()));
            assert_eq!((file.saved(), notice), (&Preferences::default(), None));
        }
    }

    #[test]
    fn unwritable_folder_is_said_once() {
        let folder = tempfile::tempdir().unwrap();
        let blocked = folder.path().join("file");
        let (mut file, _) = PreferencesFile::load(Some(blocked.clone()));
        fs::write(&blocked, "").unwrap();
        assert!(file.save(&changed()).is_some());
        assert_eq!(file.save(&Preferences::default()), None);
    }
}
