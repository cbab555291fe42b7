use std::fs::File;
use std::io;
use std::os::unix::fs::FileExt;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, OnceLock, PoisonError};
use std::thread;
use std::time::Duration;

/// So much is asked for at once: the system keeps it in few large pieces then, which cost far less to find than many small ones.
const PIECE: usize = 1 << 20;
/// No more than this is read ahead of what was asked for, lest what comes pushes out what was not looked at yet.
const MOST: usize = 1 << 28;
/// Whoever waits and finds nothing to do looks again after this.
const PATIENCE: Duration = Duration::from_micros(100);

/// A file.
pub(crate) struct OnDisk {
    file: File,
    path: PathBuf,
    len: usize,
    /// Once it is read ahead.
    ahead: OnceLock<Arc<Ahead>>,
}

/// What the thread that reads ahead and those who follow it know of each other.
#[derive(Default)]
struct Ahead {
    state: Mutex<State>,
    has_changed: Condvar,
}

#[derive(Default)]
struct State {
    /// So many bytes are in memory, or nobody looks after those that are not.
    reached: usize,
    /// So many were asked for.
    asked: usize,
    /// Nobody reads the file any more.
    is_over: bool,
}

impl OnDisk {
    /// An open file of so many bytes; `path` is where it was found.
    pub(crate) fn new(file: File, bytes: u64, path: &Path) -> Self {
        Self {
            file,
            path: path.to_owned(),
            len: usize::try_from(bytes).unwrap_or(usize::MAX),
            ahead: OnceLock::new(),
        }
    }

    pub(super) fn len(&self) -> usize {
        self.len
    }

    /// Has a thread that does nothing else read the file from its beginning to its end, so that the disk never waits for those
    /// who look at what was read. They wait for that thread.
    pub(super) fn read_ahead(&self) {
        if self.len <= PIECE {
            return;
        }
        self.ahead.get_or_init(|| {
            let ahead = Arc::<Ahead>::default();
            let reader = Reader {
                path: self.path.clone(),
                ahead: Arc::clone(&ahead),
            };
            let len = self.len;
            // If the system has no thread for it, the reader is dropped, and the file is read all the same.
            let _ = thread::Builder::new().spawn(move || reader.read(len, MOST));
            ahead
        });
    }

    pub(super) fn read(&self, from: usize, to: &mut [u8]) -> io::Result<()> {
        if let Some(ahead) = self.ahead.get() {
            ahead.follow(from + to.len());
        }
        self.file.read_exact_at(to, from as u64)
    }
}

impl Drop for OnDisk {
    fn drop(&mut self) {
        if let Some(ahead) = self.ahead.get() {
            ahead.change(|state| state.is_over = true);
        }
    }
}

/// Reads a file ahead: what it reads is thrown away, but is in memory then.
struct Reader {
    path: PathBuf,
    ahead: Arc<Ahead>,
}

impl Reader {
    fn read(self, len: usize, most: usize) {
        // Where two read through one open file, the system takes neither for one who reads on and on.
        let Ok(file) = File::open(&self.path) else {
            return;
        };
        let mut piece = vec![0; PIECE];
        let mut is_there = true;
        for from in (0..len).step_by(PIECE) {
            let may_go_on =
                |state: &State| state.is_over || from <= state.asked.saturating_add(most);
            if self.ahead.wait_until(may_go_on).is_over {
                return;
            }
            let end = len.min(from + PIECE);
            // Whatever follows what is not there has to be read, and asking would look as if reads were in no order.
            // The first bytes of a file were looked at already: the middle of a piece tells.
            is_there = is_there && is_in_memory(&file, usize::midpoint(from, end) as u64);
            if !is_there && file.read_at(&mut piece, from as u64).is_err() {
                return;
            }
            self.ahead.change(|state| state.reached = end);
        }
    }
}

impl Drop for Reader {
    fn drop(&mut self) {
        self.ahead.change(|state| state.reached = usize::MAX);
    }
}

impl Ahead {
    fn change(&self, change: impl FnOnce(&mut State)) {
        change(&mut self.lock());
        self.has_changed.notify_all();
    }

    fn wait_until(&self, holds: impl Fn(&State) -> bool) -> MutexGuard<'_, State> {
        let changed = self
            .has_changed
            .wait_while(self.lock(), |state| !holds(state));
        changed.unwrap_or_else(PoisonError::into_inner)
    }

    /// Waits until so many bytes are in memory. Who shares work with other threads does some of it meanwhile.
    fn follow(&self, end: usize) {
        let has_come = |state: &State| state.reached >= end;
        if has_come(&self.lock()) {
            return;
        }
        self.change(|state| state.asked = state.asked.max(end));
        loop {
            let has_worked = rayon::yield_now() == Some(rayon::Yield::Executed);
            let patience = if has_worked { Duration::ZERO } else { PATIENCE };
            let waited = self
                .has_changed
                .wait_timeout_while(self.lock(), patience, |state| !has_come(state));
            if has_come(&waited.unwrap_or_else(PoisonError::into_inner).0) {
                return;
            }
        }
    }

    fn lock(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// Whether a byte of a file can be had without waiting. What others have just written or read can, and need not be read once more.
#[cfg(target_os = "linux")]
fn is_in_memory(file: &File, at: u64) -> bool {
    use rustix::io::{ReadWriteFlags, preadv2};
    let mut byte = [0];
    let mut bytes = [io::IoSliceMut::new(&mut byte)];
    preadv2(file, &mut bytes, at, ReadWriteFlags::NOWAIT).is_ok_and(|count| count > 0)
}

/// Elsewhere there is no telling.
#[cfg(not(target_os = "linux"))]
fn is_in_memory(_file: &File, _at: u64) -> bool {
    false
}

#[cfg(test)]
mod tests {
    use super::*;

    const LEN: usize = 3 * PIECE + 5;

    fn byte(at: usize) -> u8 {
        (at * at / 7) as u8
    }

    /// A file, and where it is.
    fn file() -> (tempfile::TempDir, PathBuf) {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("bytes");
        let bytes: Vec<u8> = (0..LEN).map(byte).collect();
        std::fs::write(&path, bytes).unwrap();
        (folder, path)
    }

    #[test]
    fn any_part_is_read_before_while_and_after_it_is_read_ahead() {
        let (_folder, path) = file();
        let file = OnDisk::new(File::open(&path).unwrap(), LEN as u64, &path);
        assert_eq!(file.len(), LEN);
        for round in 0..3 {
            for from in [LEN - 9, 0, 2 * PIECE - 4, PIECE + 1] {
                let mut bytes = [0; 9];
                file.read(from, &mut bytes).unwrap();
                assert_eq!(bytes, std::array::from_fn(|i| byte(from + i)), "{round}");
            }
            file.read_ahead();
        }
    }

    #[test]
    fn what_is_gone_is_an_error_and_nobody_waits_for_it() {
        let (_folder, path) = file();
        let file = OnDisk::new(File::open(&path).unwrap(), LEN as u64, &path);
        let shorter = File::options().write(true).open(&path).unwrap();
        shorter.set_len(PIECE as u64).unwrap();
        file.read_ahead();
        let read = |from| file.read(from, &mut [0; 9]);
        assert!(read(0).is_ok());
        let gone = read(2 * PIECE).unwrap_err();
        assert_eq!(gone.kind(), io::ErrorKind::UnexpectedEof);
        // A folder opens, and cannot be read.
        let ahead = Arc::default();
        let reader = Reader {
            path: path.parent().unwrap().to_owned(),
            ahead: Arc::clone(&ahead),
        };
        reader.read(LEN, MOST);
        ahead.follow(LEN);
    }

    #[test]
    fn it_is_read_no_farther_ahead_than_it_may_be_and_not_when_nobody_reads_it() {
        let (_folder, path) = file();
        for is_over in [false, true] {
            let ahead = Arc::default();
            let reader = Reader {
                path: path.clone(),
                ahead: Arc::clone(&ahead),
            };
            let reading = thread::spawn(move || reader.read(LEN, PIECE));
            let reached = |end| ahead.wait_until(|state| state.reached >= end).reached;
            assert_eq!(reached(2 * PIECE), 2 * PIECE);
            if is_over {
                ahead.change(|state| state.is_over = true);
            } else {
                ahead.follow(3 * PIECE);
                assert!(reached(LEN) >= LEN);
            }
            reading.join().unwrap();
            assert_eq!(reached(LEN), usize::MAX);
        }
    }
}
