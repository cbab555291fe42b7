//! Detects files that other programs changed or removed, by polling their time and size.

use std::collections::HashMap;
use std::path::PathBuf;
use std::sync::mpsc::{self, Receiver, RecvTimeoutError, Sender};
use std::thread;
use std::time::Duration;

use crate::background::RepaintHandle;
use crate::services::FileStamp;

/// Polling interval. Polling works on every disk and network file system and sees replaced files;
/// notifications of the operating system do not.
const POLL_INTERVAL: Duration = Duration::from_secs(1);
/// Polls after which a missing file counts as gone: others replace files by removing them first.
const MISSING_POLLS: u32 = 3;

/// The thread that watches files.
pub(crate) struct Watcher {
    files: Sender<Vec<PathBuf>>,
    changed: Receiver<(PathBuf, Stamp)>,
}

/// The state of a file; `None` without a file.
pub(crate) type Stamp = Option<FileStamp>;

impl Watcher {
    pub(crate) fn start(repaint: RepaintHandle) -> Self {
        let (files, new_files) = mpsc::channel::<Vec<PathBuf>>();
        let (sender, changed) = mpsc::channel();
        // Without a thread no change is noticed.
        let _ = thread::Builder::new().spawn(move || {
            let mut states = FileStates::default();
            loop {
                match new_files.recv_timeout(POLL_INTERVAL) {
                    Ok(files) => states.set_files(files),
                    Err(RecvTimeoutError::Timeout) => {
                        for file in states.poll() {
                            if sender.send(file).is_err() {
                                return;
                            }
                            repaint();
                        }
                    }
                    Err(RecvTimeoutError::Disconnected) => return,
                }
            }
        });
        Self { files, changed }
    }

    /// Replaces the list of watched files; their present state counts as known.
    pub(crate) fn set_files(&self, files: Vec<PathBuf>) {
        // The thread ends only when `self` is dropped.
        let _ = self.files.send(files);
    }

    /// The changed files and their new states.
    pub(crate) fn changed(&self) -> impl Iterator<Item = (PathBuf, Stamp)> {
        self.changed.try_iter()
    }
}

#[derive(Default)]
struct FileStates {
    files: HashMap<PathBuf, WatchedFile>,
}

struct WatchedFile {
    reported: Stamp,
    seen: Stamp,
    /// Polls since the file was missed first.
    missing: u32,
}

impl FileStates {
    fn set_files(&mut self, files: Vec<PathBuf>) {
        let state = |file: PathBuf| {
            let stamp = FileStamp::of(&file);
            let state = WatchedFile {
                reported: stamp,
                seen: stamp,
                missing: 0,
            };
            (file, state)
        };
        self.files = files.into_iter().map(state).collect();
    }

    /// Files that changed and then stayed the same for one interval, or are missing for several:
    /// those that are still being written or are missing for a moment are reported later.
    fn poll(&mut self) -> Vec<(PathBuf, Stamp)> {
        let mut changed = Vec::new();
        for (file, state) in &mut self.files {
            let now = FileStamp::of(file);
            state.missing = if now.is_some() { 0 } else { state.missing + 1 };
            let is_certain = now.is_some() || state.missing >= MISSING_POLLS;
            if now == state.seen && now != state.reported && is_certain {
                state.reported = now;
                changed.push((file.clone(), now));
            }
            state.seen = now;
        }
        changed
    }
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;

    #[test]
    fn reports_a_change_once_after_writing_ends() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("a.txt");
        fs::write(&file, "1").unwrap();
        let mut states = FileStates::default();
        states.set_files(vec![file.clone()]);
        assert!(states.poll().is_empty());
        fs::write(&file, "12").unwrap();
        assert!(states.poll().is_empty(), "it may still be written");
        assert_eq!(states.poll(), [(file.clone(), FileStamp::of(&file))]);
        assert!(states.poll().is_empty(), "reported once");
        fs::remove_file(&file).unwrap();
        assert!(
            states.poll().is_empty() && states.poll().is_empty(),
            "it may come back"
        );
        fs::write(&file, "123").unwrap();
        states.poll();
        assert_eq!(states.poll(), [(file.clone(), FileStamp::of(&file))]);
        fs::remove_file(&file).unwrap();
        let polls = [(); 4].map(|()| states.poll());
        let gone = vec![(file, None)];
        assert_eq!(polls, [vec![], vec![], gone, vec![]], "gone, once");
    }
}
