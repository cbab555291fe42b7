//! The error that reaches a person: a message, a remedy and a stable code for programs.

use std::error::Error;
use std::fmt;

/// The failure of a command or of an action in the window.
///
/// Every crate converts its own errors into this one (`impl From<ReadError> for UserError`), so
/// that the command and the window report the same failure in the same words.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UserError {
    /// Stable name of the kind of failure, for programs: it never changes.
    pub code: &'static str,
    /// Failure and place: starts with the file or option, without final period.
    pub message: String,
    /// Action that resolves it: an imperative sentence without final period.
    pub remedy: String,
}

impl UserError {
    /// An error with its three parts.
    pub fn new(code: &'static str, message: impl Into<String>, remedy: impl Into<String>) -> Self {
        Self {
            code,
            message: message.into(),
            remedy: remedy.into(),
        }
    }
}

impl fmt::Display for UserError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}. {}", self.message, self.remedy)
    }
}

impl Error for UserError {}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shows_message_then_remedy() {
        let error = UserError::new("save", "site.dxf: the disk is full", "Free some space");
        let shown = error.to_string();
        assert_eq!(shown, "site.dxf: the disk is full. Free some space");
    }
}
