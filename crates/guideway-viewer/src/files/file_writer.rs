//! Writes one file at a time in the background: a layout, a project, a PNG, an SVG or a PDF. All
//! that it does to a disk, which may be slow or gone, is done there: also the look at what a file
//! would replace.

use std::io;
use std::path::PathBuf;
use std::sync::Arc;

use guideway_layout::UserError;

use super::watcher::Stamp;
use crate::background::{BackgroundTask, RepaintHandle};
use crate::services::{Job, LostPart};

/// The file being written, if any.
#[derive(Default)]
pub(crate) struct FileWriter {
    current: Option<Write>,
}

struct Write {
    task: BackgroundTask<Result<WriteOutcome, UserError>>,
    target: WriteTarget,
    /// Progress, if the writer reports it.
    job: Option<Arc<Job>>,
}

/// The file of a write.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum WriteTarget {
    Layout(PathBuf),
    Project(PathBuf),
    Picture,
}

/// The outcome of a write without an error.
#[derive(Debug)]
pub(crate) enum WriteOutcome {
    /// The file is written; a sentence for the user.
    Written(String),
    /// The layout is written.
    Saved {
        /// The state of the file after that.
        state: Stamp,
        /// Result of the copy of the file as read, which is made for the journal before.
        copied: io::Result<()>,
    },
    /// Nothing is written: the user has not agreed to replace the file that is there.
    Exists,
    /// Nothing is written: the user has not accepted these losses.
    TooLossy(Vec<LostPart>),
}

/// The end of a write.
pub(crate) struct Written {
    pub(crate) result: Result<WriteOutcome, UserError>,
    pub(crate) target: WriteTarget,
}

impl FileWriter {
    /// Returns `true` if a file is being written.
    pub(crate) fn is_busy(&self) -> bool {
        self.current.is_some()
    }

    /// Starts to write. Requires [`Self::is_busy`] to be
    /// false: a write in progress would lose its result.
    pub(crate) fn start(
        &mut self,
        target: WriteTarget,
        job: Option<Arc<Job>>,
        repaint: &RepaintHandle,
        write: impl FnOnce() -> Result<WriteOutcome, UserError> + Send + 'static,
    ) {
        self.current = Some(Write {
            task: BackgroundTask::start(repaint, write),
            target,
            job,
        });
    }

    /// Progress of the file being written, if the writer reports it.
    pub(crate) fn job(&self) -> Option<&Job> {
        self.current.as_ref()?.job.as_deref()
    }

    /// Takes the result of a finished write.
    pub(crate) fn poll(&mut self) -> Option<Written> {
        let result = self.current.as_ref()?.task.result()?;
        let write = self.current.take()?;
        Some(Written {
            result: result.flatten(),
            target: write.target,
        })
    }
}

#[cfg(test)]
mod tests {
    use std::sync::mpsc;
    use std::thread;
    use std::time::Duration;

    use super::*;

    #[test]
    fn is_busy_until_the_result_is_taken() {
        let mut writer = FileWriter::default();
        let (finish, rest) = mpsc::channel::<()>();
        let repaint: RepaintHandle = Arc::new(|| {});
        writer.start(WriteTarget::Picture, None, &repaint, move || {
            let _ = rest.recv();
            Ok(WriteOutcome::Written("saved".into()))
        });
        assert!(writer.poll().is_none() && writer.is_busy());
        drop(finish);
        let written = (0..5_000).find_map(|_| {
            thread::sleep(Duration::from_millis(1));
            writer.poll()
        });
        let outcome = written.unwrap().result.unwrap();
        assert!(matches!(outcome, WriteOutcome::Written(text) if text == "saved"));
        assert!(!writer.is_busy());
    }
}
