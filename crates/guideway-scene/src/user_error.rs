//! Converts the errors of scenes and frames into the error that a person reads.

use guideway_layout::UserError;

use crate::{RenderError, SceneError};

impl From<SceneError> for UserError {
    fn from(error: SceneError) -> Self {
        let (code, kind) = match &error {
            SceneError::UnknownLevel { .. } => ("unknown-level", "level"),
            SceneError::UnknownColumn { .. } => ("unknown-column", "column"),
        };
        let remedy = format!("Name an existing {kind}; `guideway info FILE` lists them");
        Self::new(code, error.to_string(), remedy)
    }
}

impl From<RenderError> for UserError {
    fn from(error: RenderError) -> Self {
        let (code, remedy) = match &error {
            RenderError::FrameSize { .. } => ("size", "Choose a smaller picture size (`--size`)"),
            RenderError::Strips { .. } => (
                "size",
                "Render with `--method cpu`, which has no such limit, or choose a smaller picture \
                 size (`--size`)",
            ),
            RenderError::View { .. } => ("view", "Omit `--center` and `--scale` to show all paths"),
            RenderError::Budget { .. } => (
                "memory",
                "Allow more memory (`--memory`) or choose a smaller picture size (`--size`)",
            ),
            RenderError::Unsupported { remedy, .. } => ("unsupported", remedy.as_str()),
            RenderError::Device { .. } => (
                "device",
                "Use `--method cpu`, which needs no graphics device; `guideway methods` lists all",
            ),
            RenderError::Edit(_) => (
                "edit",
                "Run `guideway check`: it names the paths that lie too far from the origin to move",
            ),
            RenderError::Cancelled => ("cancelled", "Run the command again"),
        };
        Self::new(code, error.to_string(), remedy)
    }
}
