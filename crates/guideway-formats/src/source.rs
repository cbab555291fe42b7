//! What every reader is handed: a name for messages, limits, and who follows the read.

use guideway_layout::Limits;

use crate::{Problem, ReadError};

/// How to read.
#[derive(Clone, Default)]
pub struct ReadOptions<'a> {
    /// What is too much.
    pub limits: Limits,
    /// Who is told how far it is, and may stop it.
    pub progress: Option<&'a dyn Progress>,
}

/// Follows a long read, and may stop it.
pub trait Progress: Sync {
    /// `done` of `total` steps are done; the unit is the reader's own.
    fn advance(&self, done: u64, total: u64) {
        let _ = (done, total);
    }

    /// Whether to stop: the read then ends with [`Problem::Cancelled`].
    fn cancelled(&self) -> bool {
        false
    }
}

/// What is being read, and how: handed to every reader.
#[derive(Clone, Copy)]
pub(crate) struct Source<'a> {
    /// Name of the file in messages.
    pub(crate) name: &'a str,
    /// How to read.
    pub(crate) options: &'a ReadOptions<'a>,
}

impl Source<'_> {
    /// An error of this source.
    pub(crate) fn fail(&self, problem: Problem) -> ReadError {
        ReadError::new(self.name, problem)
    }

    /// Ends the read if the caller asked for that.
    pub(crate) fn check_cancelled(&self) -> Result<(), ReadError> {
        match self.options.progress {
            Some(progress) if progress.cancelled() => Err(self.fail(Problem::Cancelled)),
            _ => Ok(()),
        }
    }
}
