//! Sums the work of a picture from the counters of its windows.

use guideway_scene::Work;

use super::layouts::FrameCounters;

/// Work of the windows of a picture.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct WorkTotals {
    tests: u64,
    atomics: u64,
    words_read: u64,
    words_written: u64,
}

impl WorkTotals {
    /// Adds the work of a window.
    pub(crate) fn add(&mut self, counters: &FrameCounters) {
        let [tests, atomics, words_read, words_written] = [0, 1, 2, 3]
            .map(|i| u64::from(counters.work[2 * i]) | u64::from(counters.work[2 * i + 1]) << 32);
        self.tests += tests;
        self.atomics += atomics;
        self.words_read += words_read;
        self.words_written += words_written;
    }

    /// The sums, words as bytes.
    pub(crate) fn work(&self) -> Work {
        let bytes = |words: u64| Some(words * size_of::<u32>() as u64);
        Work {
            tests: Some(self.tests),
            atomics: Some(self.atomics),
            bytes_read: bytes(self.words_read),
            bytes_written: bytes(self.words_written),
        }
    }
}
