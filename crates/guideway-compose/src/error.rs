//! Errors of composing a picture.

use guideway_envelope::NoEnvelope;
use guideway_formats::{ReadError, SaveError};
use guideway_layout::UserError;
use guideway_scene::{RenderError, SceneError};

/// Why a picture was not composed.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ComposeError {
    /// A render method failed, the view is out of range, or the caller cancelled.
    #[error(transparent)]
    Render(#[from] RenderError),
    /// The layout of a floor plan has no scene.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// The file was not written.
    #[error(transparent)]
    Save(#[from] SaveError),
    /// The image of a floor plan was not read.
    #[error(transparent)]
    Image(#[from] ImageError),
    /// Swept areas were requested, and none of the paths has one.
    #[error("no path has an envelope: {reason}")]
    NoEnvelope {
        /// The most frequent reason.
        reason: NoEnvelope,
    },
}

/// Why an image was not read as a floor plan.
#[derive(Debug, thiserror::Error)]
#[error("{}: cannot read the image: {}", .0.file, .0.problem)]
pub struct ImageError(#[from] pub ReadError);

impl From<ImageError> for UserError {
    fn from(error: ImageError) -> Self {
        let remedy = error.0.remedy();
        Self::new("image", error.to_string(), remedy)
    }
}

impl From<ComposeError> for UserError {
    fn from(error: ComposeError) -> Self {
        match error {
            ComposeError::Render(error) => error.into(),
            ComposeError::Scene(error) => error.into(),
            ComposeError::Save(error) => error.into(),
            ComposeError::Image(error) => error.into(),
            ComposeError::NoEnvelope { .. } => Self::new(
                "usage",
                error.to_string(),
                "Give the size of the vehicle, such as `--envelope 2x1.2`",
            ),
        }
    }
}
