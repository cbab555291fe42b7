//! Errors of editing a scene.

use std::fmt;

/// The reason why a scene rejects an edit. The scene is unchanged.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum EditError {
    /// The scene has no such path row.
    UnknownPath {
        /// The requested row.
        path: u32,
        /// Number of rows.
        rows: usize,
    },
    /// A control point would not be finite, or exceed the coordinate limit.
    OutOfBounds {
        /// Row of the path; `None` for a path that is not part of the scene yet.
        path: Option<u32>,
    },
    /// The layout has no such level or node.
    UnknownReference {
        /// `level` or `node`.
        what: &'static str,
        /// The requested row.
        row: u32,
    },
    /// The number of curves differs from the number of paths.
    CurveCountMismatch,
    /// A transform names a path twice.
    DuplicatePath {
        /// Row of the path.
        path: u32,
    },
}

impl fmt::Display for EditError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::UnknownPath { path, rows } => {
                write!(f, "unknown path row {path}: the scene has {rows} rows")
            }
            Self::OutOfBounds { path: Some(path) } => {
                write!(
                    f,
                    "the path in row {path} would exceed the coordinate limit of 1e9 m"
                )
            }
            Self::OutOfBounds { path: None } => {
                write!(
                    f,
                    "a new path needs finite points within the coordinate limit of 1e9 m"
                )
            }
            Self::UnknownReference { what, row } => write!(f, "unknown {what} row {row}"),
            Self::CurveCountMismatch => write!(f, "the edit needs exactly one curve per path"),
            Self::DuplicatePath { path } => {
                write!(
                    f,
                    "the edit names the path in row {path} twice; name each path once"
                )
            }
        }
    }
}

impl std::error::Error for EditError {}
