//! Converts a failed read into the error that a person reads.

use guideway_layout::UserError;

use crate::ReadError;

impl From<ReadError> for UserError {
    fn from(error: ReadError) -> Self {
        let message = format!("{}: {}", error.file, error.problem);
        Self::new(error.code(), message, error.remedy())
    }
}
