//! Errors of the writers.

use std::io;
use std::path::{Path, PathBuf};

#[cfg(feature = "arrow")]
use arrow_schema::ArrowError;
use guideway_layout::shown_path;

use crate::output::SaveError;

/// Reason why a file cannot be written.
#[derive(Debug, thiserror::Error)]
#[error("{}: {problem}", shown_path(.path))]
pub struct WriteError {
    /// Target file.
    pub path: PathBuf,
    /// The problem.
    pub problem: WriteProblem,
}

/// Problem of a file that cannot be written.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum WriteProblem {
    /// The operating system reported an error.
    #[error("cannot write the file: {0}")]
    Io(#[from] io::Error),
    /// A run has too few control points.
    #[error("path {id:?} has a run of {points} control points; a run needs 4")]
    TooFewPoints {
        /// Identifier of the path.
        id: String,
        /// Number of control points.
        points: usize,
    },
    /// A value does not match its column.
    #[error("column {column:?}: {detail}")]
    Value {
        /// Name of the column.
        column: String,
        /// Description of the mismatch.
        detail: String,
    },
    /// An order holds one route, but the paths form none.
    #[error("an order holds one route, but {detail}")]
    NotARoute {
        /// Description of the place where the paths do not connect.
        detail: String,
    },
    /// This build has no writer of the format.
    #[error("this build does not write {0}")]
    NotBuilt(&'static str),
    /// The Arrow library reported an error.
    #[cfg(feature = "arrow")]
    #[error("cannot encode the table: {0}")]
    Arrow(#[source] ArrowError),
}

impl WriteError {
    /// Returns the remedy, a sentence for the user.
    pub fn remedy(&self) -> &'static str {
        match &self.problem {
            WriteProblem::Io(problem) => SaveError::remedy_of(problem),
            WriteProblem::TooFewPoints { .. } => "Give the run four or more control points",
            WriteProblem::Value { .. } => {
                "Give each row one value per column, of the type of the column"
            }
            WriteProblem::NotARoute { .. } => {
                "Keep the paths of one route only, in the order in which a vehicle drives them"
            }
            WriteProblem::NotBuilt(_) => "Build Guideway with the feature of that format",
            #[cfg(feature = "arrow")]
            WriteProblem::Arrow(_) => "Please report this",
        }
    }
}

impl From<SaveError> for WriteError {
    fn from(error: SaveError) -> Self {
        fail(&error.path, error.problem.into())
    }
}

#[cfg(feature = "arrow")]
impl From<ArrowError> for WriteProblem {
    fn from(error: ArrowError) -> Self {
        match error {
            ArrowError::IoError(_, error) => Self::Io(error),
            other => Self::Arrow(other),
        }
    }
}

/// Adds the target to a problem.
pub(crate) fn fail(path: &Path, problem: WriteProblem) -> WriteError {
    WriteError {
        path: path.to_owned(),
        problem,
    }
}
