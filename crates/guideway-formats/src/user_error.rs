//! Converts a failed read or write into the error that a person reads.

use guideway_layout::{UserError, shown_text};

use crate::{ReadError, SaveError, WriteError, WriteProblem};

impl From<ReadError> for UserError {
    fn from(error: ReadError) -> Self {
        let message = format!("{}: {}", shown_text(&error.file), error.problem);
        Self::new(error.code(), message, error.remedy())
    }
}

impl From<WriteError> for UserError {
    fn from(error: WriteError) -> Self {
        let remedy = error.remedy();
        match error.problem {
            WriteProblem::Io(problem) => {
                let path = error.path;
                SaveError { path, problem }.into()
            }
            _ => Self::new("save", error.to_string(), remedy),
        }
    }
}
