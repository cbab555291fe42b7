//! File input with read-ahead: a thread reads the file sequentially into the page cache, and
//! readers on other threads wait until their range is cached.
//!
//! ```text
//!            cached                read ahead (at most 256 MiB)
//! |==========================|----------------------------------|..............|
//!      readers at random ^   ^ cached_to                        ^ requested_to + MAX_AHEAD_BYTES
//! ```

use std::fs::File;
use std::io;
use std::os::unix::fs::FileExt;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, OnceLock, PoisonError};
use std::thread;
use std::time::Duration;

use guideway_layout::SourceFile;

/// Bytes per read: the page cache then holds few large folios, which are cheaper to look up than
/// many small ones.
const CHUNK_BYTES: usize = 1 << 20;
/// Largest distance between the furthest request and the read-ahead, so that new pages do not evict
/// pages that readers still need.
const MAX_AHEAD_BYTES: usize = 1 << 28;
/// Time after which a waiting thread looks for other work again.
const RECHECK_INTERVAL: Duration = Duration::from_micros(100);

/// A file that is read in parts, and ahead on request.
pub(crate) struct ReadAheadFile {
    file: File,
    path: PathBuf,
    len: usize,
    /// Set once read-ahead starts.
    progress: OnceLock<Arc<ReadProgress>>,
}

/// Progress of the read-ahead thread, shared with the readers that wait for it.
#[derive(Default)]
struct ReadProgress {
    state: Mutex<State>,
    has_changed: Condvar,
}

#[derive(Default)]
struct State {
    /// End of the cached bytes; `usize::MAX` once the thread has ended.
    cached_to: usize,
    /// Largest end that a reader requested.
    requested_to: usize,
    /// True once the file is closed.
    is_closed: bool,
}

impl ReadAheadFile {
    /// Wraps an open file of `bytes` bytes at `path`.
    pub(crate) fn new(file: File, bytes: u64, path: &Path) -> Self {
        Self {
            file,
            path: path.to_owned(),
            len: usize::try_from(bytes).unwrap_or(usize::MAX),
            progress: OnceLock::new(),
        }
    }

    pub(super) fn len(&self) -> usize {
        self.len
    }

    /// The file, to be read again later; `None` if the system does not allow it.
    pub(super) fn source_file(&self) -> Option<SourceFile> {
        SourceFile::new(self.file.try_clone().ok()?).ok()
    }

    /// Starts a thread that reads the file from beginning to end, so that the disk never waits for
    /// decoding. Later reads wait for that thread.
    pub(super) fn read_ahead(&self) {
        if self.len <= CHUNK_BYTES {
            return;
        }
        self.progress.get_or_init(|| {
            let progress = Arc::<ReadProgress>::default();
            let reader = ReadAhead {
                path: self.path.clone(),
                progress: Arc::clone(&progress),
            };
            let len = self.len;
            // Without a thread the reader is dropped, which releases all waiting readers.
            let _ = thread::Builder::new().spawn(move || reader.read(len, MAX_AHEAD_BYTES));
            progress
        });
    }

    pub(super) fn read(&self, from: usize, to: &mut [u8]) -> io::Result<()> {
        if let Some(progress) = self.progress.get() {
            progress.wait_for(from + to.len());
        }
        self.file.read_exact_at(to, from as u64)
    }
}

impl Drop for ReadAheadFile {
    fn drop(&mut self) {
        if let Some(progress) = self.progress.get() {
            progress.change(|state| state.is_closed = true);
        }
    }
}

/// Task of the read-ahead thread. It discards the bytes; they stay in the page cache.
struct ReadAhead {
    path: PathBuf,
    progress: Arc<ReadProgress>,
}

impl ReadAhead {
    fn read(self, len: usize, max_ahead: usize) {
        // A separate file description: the kernel detects sequential reads per description.
        let Ok(file) = File::open(&self.path) else {
            return;
        };
        let mut chunk = vec![0; CHUNK_BYTES];
        let mut is_cached = true;
        for from in (0..len).step_by(CHUNK_BYTES) {
            let may_continue = |state: &State| {
                state.is_closed || from <= state.requested_to.saturating_add(max_ahead)
            };
            if self.progress.wait_until(may_continue).is_closed {
                return;
            }
            let end = len.min(from + CHUNK_BYTES);
            // After the first uncached chunk all are read: probing would break the sequential
            // pattern. The probe is the middle of a chunk, because sniffing has cached the first
            // bytes.
            is_cached = is_cached && is_in_page_cache(&file, usize::midpoint(from, end) as u64);
            if !is_cached && file.read_at(&mut chunk, from as u64).is_err() {
                return;
            }
            self.progress.change(|state| state.cached_to = end);
        }
    }
}

impl Drop for ReadAhead {
    fn drop(&mut self) {
        self.progress.change(|state| state.cached_to = usize::MAX);
    }
}

impl ReadProgress {
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

    /// Waits until the bytes up to `end` are cached. A rayon worker runs other tasks meanwhile.
    fn wait_for(&self, end: usize) {
        let is_cached = |state: &State| state.cached_to >= end;
        if is_cached(&self.lock()) {
            return;
        }
        self.change(|state| state.requested_to = state.requested_to.max(end));
        loop {
            let has_worked = rayon::yield_now() == Some(rayon::Yield::Executed);
            let timeout = if has_worked {
                Duration::ZERO
            } else {
                RECHECK_INTERVAL
            };
            let waited = self
                .has_changed
                .wait_timeout_while(self.lock(), timeout, |state| !is_cached(state));
            if is_cached(&waited.unwrap_or_else(PoisonError::into_inner).0) {
                return;
            }
        }
    }

    fn lock(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// Returns whether a byte of a file is in the page cache, so that a read does not wait for the
/// disk.
#[cfg(target_os = "linux")]
fn is_in_page_cache(file: &File, at: u64) -> bool {
    use rustix::io::{ReadWriteFlags, preadv2};
    let mut byte = [0];
    let mut bytes = [io::IoSliceMut::new(&mut byte)];
    preadv2(file, &mut bytes, at, ReadWriteFlags::NOWAIT).is_ok_and(|count| count > 0)
}

/// Other systems have no such query.
#[cfg(not(target_os = "linux"))]
fn is_in_page_cache(_file: &File, _at: u64) -> bool {
    false
}

#[cfg(test)]
mod tests {
    use super::*;

    const LEN: usize = 3 * CHUNK_BYTES + 5;

    fn byte(at: usize) -> u8 {
        (at * at / 7) as u8
    }

    /// Writes a temporary file; returns its folder and path.
    fn file() -> (tempfile::TempDir, PathBuf) {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("bytes");
        let bytes: Vec<u8> = (0..LEN).map(byte).collect();
        std::fs::write(&path, bytes).unwrap();
        (folder, path)
    }

    #[test]
    fn reads_any_range_before_during_and_after_read_ahead() {
        let (_folder, path) = file();
        let file = ReadAheadFile::new(File::open(&path).unwrap(), LEN as u64, &path);
        assert_eq!(file.len(), LEN);
        for pass in 0..3 {
            for from in [LEN - 9, 0, 2 * CHUNK_BYTES - 4, CHUNK_BYTES + 1] {
                let mut bytes = [0; 9];
                file.read(from, &mut bytes).unwrap();
                assert_eq!(bytes, std::array::from_fn(|i| byte(from + i)), "{pass}");
            }
            file.read_ahead();
        }
    }

    #[test]
    fn truncated_or_unreadable_file_fails_without_blocking() {
        let (_folder, path) = file();
        let file = ReadAheadFile::new(File::open(&path).unwrap(), LEN as u64, &path);
        let shorter = File::options().write(true).open(&path).unwrap();
        shorter.set_len(CHUNK_BYTES as u64).unwrap();
        file.read_ahead();
        let read = |from| file.read(from, &mut [0; 9]);
        assert!(read(0).is_ok());
        let gone = read(2 * CHUNK_BYTES).unwrap_err();
        assert_eq!(gone.kind(), io::ErrorKind::UnexpectedEof);
        // A folder opens but cannot be read.
        let progress = Arc::default();
        let reader = ReadAhead {
            path: path.parent().unwrap().to_owned(),
            progress: Arc::clone(&progress),
        };
        reader.read(LEN, MAX_AHEAD_BYTES);
        progress.wait_for(LEN);
    }

    #[test]
    fn read_ahead_stops_at_its_limit_and_when_the_file_closes() {
        let (_folder, path) = file();
        for is_closed in [false, true] {
            let progress = Arc::default();
            let reader = ReadAhead {
                path: path.clone(),
                progress: Arc::clone(&progress),
            };
            let reading = thread::spawn(move || reader.read(LEN, CHUNK_BYTES));
            let cached = |end| {
                progress
                    .wait_until(|state| state.cached_to >= end)
                    .cached_to
            };
            assert_eq!(cached(2 * CHUNK_BYTES), 2 * CHUNK_BYTES);
            if is_closed {
                progress.change(|state| state.is_closed = true);
            } else {
                progress.wait_for(3 * CHUNK_BYTES);
                assert!(cached(LEN) >= LEN);
            }
            reading.join().unwrap();
            assert_eq!(cached(LEN), usize::MAX);
        }
    }
}
