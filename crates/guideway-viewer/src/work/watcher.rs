use std::collections::HashMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::mpsc::{self, Receiver, RecvTimeoutError, Sender};
use std::thread;
use std::time::{Duration, SystemTime};

use super::Wake;

/// How often files are looked at. Looking works on every kind of disk and network, and sees a file that was
/// replaced by another one; notifications of the system do not.
const PERIOD: Duration = Duration::from_secs(1);

/// Watches files and says which have changed on disk.
pub(crate) struct Watcher {
    files: Sender<Vec<PathBuf>>,
    changed: Receiver<(PathBuf, Stamp)>,
}

/// What tells one state of a file from another; none if there is no file.
pub(crate) type Stamp = Option<(SystemTime, u64)>;

impl Watcher {
    pub(crate) fn start(wake: Wake) -> Self {
        let (files, new_files) = mpsc::channel::<Vec<PathBuf>>();
        let (sender, changed) = mpsc::channel();
        thread::spawn(move || {
            let mut watch = Watch::default();
            loop {
                match new_files.recv_timeout(PERIOD) {
                    Ok(files) => watch.set_files(files),
                    Err(RecvTimeoutError::Timeout) => {
                        for file in watch.look() {
                            if sender.send(file).is_err() {
                                return;
                            }
                            wake();
                        }
                    }
                    Err(RecvTimeoutError::Disconnected) => return,
                }
            }
        });
        Self { files, changed }
    }

    /// Watches these from now on, in place of any before. A file that is named again is taken as it is now.
    pub(crate) fn set_files(&self, files: Vec<PathBuf>) {
        // The thread ends with this object and not before.
        let _ = self.files.send(files);
    }

    /// Files that have changed, and their states since.
    pub(crate) fn changed(&self) -> impl Iterator<Item = (PathBuf, Stamp)> {
        self.changed.try_iter()
    }
}

#[derive(Default)]
struct Watch {
    /// What was last told of each file, and what was seen since.
    files: HashMap<PathBuf, (Stamp, Stamp)>,
}

impl Watch {
    fn set_files(&mut self, files: Vec<PathBuf>) {
        let state = |file: PathBuf| {
            let stamp = stamp(&file);
            (file, (stamp, stamp))
        };
        self.files = files.into_iter().map(state).collect();
    }

    /// Files that have changed, and have then stayed the same from one look to the next: those still being
    /// written, or away for a moment, are left for later.
    fn look(&mut self) -> Vec<(PathBuf, Stamp)> {
        let mut changed = Vec::new();
        for (file, (told, seen)) in &mut self.files {
            let now = stamp(file);
            if now == *seen && now != *told && now.is_some() {
                *told = now;
                changed.push((file.clone(), now));
            }
            *seen = now;
        }
        changed
    }
}

pub(crate) fn stamp(file: &Path) -> Stamp {
    let metadata = fs::metadata(file).ok()?;
    Some((metadata.modified().ok()?, metadata.len()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_change_is_told_once_and_when_it_is_over() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("a.txt");
        fs::write(&file, "1").unwrap();
        let mut watch = Watch::default();
        watch.set_files(vec![file.clone()]);
        assert!(watch.look().is_empty());
        fs::write(&file, "12").unwrap();
        assert!(watch.look().is_empty(), "it may still be written");
        assert_eq!(watch.look(), [(file.clone(), stamp(&file))]);
        assert!(watch.look().is_empty(), "told once");
        fs::remove_file(&file).unwrap();
        assert!(
            watch.look().is_empty() && watch.look().is_empty(),
            "it may come back"
        );
        fs::write(&file, "123").unwrap();
        watch.look();
        assert_eq!(watch.look(), [(file.clone(), stamp(&file))]);
    }
}
