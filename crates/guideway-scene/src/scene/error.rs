//! Errors of building a scene from a layout, and of queries about it.

use std::fmt;

use guideway_layout::near_names;

/// The reason why scene options do not fit a layout.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum SceneError {
    /// The layout has no such level.
    UnknownLevel {
        /// The requested level.
        asked: String,
        /// Levels of the layout.
        known: Vec<String>,
    },
    /// The layout has no such column to color by.
    UnknownColumn {
        /// The requested column.
        asked: String,
        /// Columns of the layout.
        known: Vec<String>,
    },
}

impl fmt::Display for SceneError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (what, asked, known) = match self {
            Self::UnknownLevel { asked, known } => ("level", asked, known),
            Self::UnknownColumn { asked, known } => ("column", asked, known),
        };
        if known.is_empty() {
            write!(f, "unknown {what} `{asked}`: this layout has no {what}s")
        } else {
            write!(f, "unknown {what} `{asked}`; ")?;
            let near = near_names(asked, known.iter().map(String::as_str));
            if let [nearest, ..] = near[..] {
                write!(f, "did you mean `{nearest}`? ")?;
            }
            write!(f, "The layout has: {}", known.join(", "))
        }
    }
}

impl std::error::Error for SceneError {}

/// The reason why the paths of a scene share no opaque color.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum NoOpaqueColor {
    /// Paths have different colors.
    #[error("paths of several colors")]
    Several,
    /// All paths have the same translucent color.
    #[error("translucent paths")]
    Translucent,
}
