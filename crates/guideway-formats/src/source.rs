//! Read options: limits and progress observer of a read, and the source handle that readers
//! receive.

use std::sync::atomic::{AtomicU64, Ordering};

use guideway_layout::{Layout, Limits};
use guideway_spline::Bounds;

use crate::{Format, Problem, ReadError};

/// Limits and observer of a read.
#[derive(Clone, Default)]
pub struct ReadOptions<'a> {
    /// Largest sizes that are accepted.
    pub limits: Limits,
    /// Formats that are read; `None` for all.
    pub formats: Option<&'a [Format]>,
    /// Observer of the progress, which may cancel the read.
    pub progress: Option<&'a dyn Progress>,
    /// Box in meters whose paths are wanted; `None` for all. A reader may leave out paths whose
    /// control points all lie beyond it: that of Arrow files skips the record batches whose extents
    /// miss it, and references to the nodes in them. If it does, the counts of the provenance have
    /// the [`BYTES_READ`](crate::BYTES_READ).
    pub area: Option<Bounds<f64>>,
}

/// Count in the provenance of a layout that was read in part: the bytes of its file that were read.
pub const BYTES_READ: &str = "bytes read";
/// Count in the provenance of a layout that was read in part: the bytes of its file.
pub const FILE_BYTES: &str = "bytes";

/// Observes a long read or write, and may cancel a read.
pub trait Progress: Sync {
    /// Receives that `done` of `total` steps are done; their unit depends on the reader.
    fn advance(&self, done: u64, total: u64) {
        let _ = (done, total);
    }

    /// Receives the number of paths so far.
    fn paths(&self, done: u64) {
        let _ = done;
    }

    /// Returns whether to stop: the read then ends with [`Problem::Cancelled`].
    fn cancelled(&self) -> bool {
        false
    }
}

/// Counts the paths that a writer has written, for an observer.
pub(crate) struct WrittenPaths<'p> {
    progress: Option<&'p dyn Progress>,
    done: AtomicU64,
    total: u64,
}

impl<'p> WrittenPaths<'p> {
    /// Counts the paths of a layout.
    pub(crate) fn of(layout: &Layout, progress: &'p dyn Progress) -> Self {
        Self {
            progress: Some(progress),
            done: AtomicU64::new(0),
            total: layout.paths.len() as u64,
        }
    }

    /// Counts for nobody.
    pub(crate) fn unwatched() -> Self {
        Self {
            progress: None,
            done: AtomicU64::new(0),
            total: 0,
        }
    }

    /// The observer.
    pub(crate) fn progress(&self) -> Option<&'p dyn Progress> {
        self.progress
    }

    /// Counts one more path.
    pub(crate) fn count(&self) {
        /// Paths between two messages to the observer, which cost more than a path of a few bytes.
        const STEP: u64 = 256;
        let done = self.done.fetch_add(1, Ordering::Relaxed) + 1;
        if let Some(progress) = self.progress
            && (done.is_multiple_of(STEP) || done == self.total)
        {
            progress.advance(done, self.total);
            progress.paths(done);
        }
    }
}

/// Steps of a read per byte of the file: one as it comes into memory, the others as it is
/// understood. Measured: reading a LIF file of 700 MB takes 6 s, understanding it 30 s.
pub(crate) const STEPS_PER_BYTE: u64 = 6;

/// Name and options of a file that is being read.
#[derive(Clone, Copy)]
pub(crate) struct Source<'a> {
    /// Name of the file in error texts.
    pub(crate) name: &'a str,
    /// Limits and observer.
    pub(crate) options: &'a ReadOptions<'a>,
}

impl Source<'_> {
    /// Makes an error that names this source.
    pub(crate) fn fail(&self, problem: Problem) -> ReadError {
        ReadError::new(self.name, problem)
    }

    /// Reports that a part of the bytes in memory is understood, and the paths so far.
    pub(crate) fn advance(&self, [done, total]: [u64; 2], paths: usize) {
        if let Some(progress) = self.options.progress {
            let total = total.max(done);
            let steps = total + done.saturating_mul(STEPS_PER_BYTE - 1);
            progress.advance(steps, total.saturating_mul(STEPS_PER_BYTE));
            progress.paths(paths as u64);
        }
    }

    /// Fails if files of a format are not to be read.
    pub(crate) fn check_format(&self, format: Format) -> Result<(), ReadError> {
        match self.options.formats {
            Some(formats) if !formats.contains(&format) => {
                Err(self.fail(Problem::FormatOff(format)))
            }
            _ => Ok(()),
        }
    }

    /// Fails if the observer cancels the read.
    pub(crate) fn check_cancelled(&self) -> Result<(), ReadError> {
        match self.options.progress {
            Some(progress) if progress.cancelled() => Err(self.fail(Problem::Cancelled)),
            _ => Ok(()),
        }
    }
}
