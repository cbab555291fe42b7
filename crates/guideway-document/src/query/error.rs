//! Errors of parsing a query.

/// The reason why a query is invalid.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("at character {at}: {what}")]
pub struct QueryError {
    /// Position of the error, in characters from 1.
    pub at: usize,
    /// The problem and a remedy.
    pub what: String,
}
