//! Errors of preparing, editing and rendering a scene, and the errors that a person reads.

use guideway_layout::UserError;

use crate::SceneError;
use crate::edit::EditError;

/// Longest side of a picture, in pixels: a row and a column fit 16 bits each.
pub(crate) const MAX_SIDE_PX: u32 = 65_535;

/// Most pixels of a frame in memory: 4 GiB of RGBA. Larger pictures are drawn in strips.
pub(crate) const MAX_FRAME_PIXELS: usize = 1 << 30;

/// The reason why a method produced no picture.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum RenderError {
    /// A side of the picture is zero or too long.
    #[error(
        "cannot draw a picture of {width} x {height} pixels: each side takes 1 to {MAX_SIDE_PX} \
         pixels"
    )]
    FrameSize {
        /// Requested width, in pixels.
        width: u64,
        /// Requested height, in pixels.
        height: u64,
    },
    /// The method draws only whole frames, and the picture exceeds the largest frame.
    #[error(
        "this method cannot draw a picture of {width} x {height} pixels: it draws no strips, and \
         a whole frame holds at most {} million pixels",
        MAX_FRAME_PIXELS / 1_000_000
    )]
    Strips {
        /// Width of the picture, in pixels.
        width: u32,
        /// Height of the picture, in pixels.
        height: u32,
    },
    /// The view's center or scale is out of range.
    #[error(
        "cannot draw the view around ({x_m:?}, {y_m:?}) at {px_per_m:?} pixels per meter: the \
         center must be within 1e12 m of the origin and the scale between 1e-9 and 1e9 pixels per \
         meter"
    )]
    View {
        /// Requested center, in meters.
        x_m: f64,
        /// Requested center, in meters.
        y_m: f64,
        /// Requested scale, in pixels per meter.
        px_per_m: f64,
    },
    /// The method needs more memory than the budget allows.
    #[error(
        "method `{method}` needs {needed_bytes} bytes for {what}, but the budget is {budget_bytes}"
    )]
    Budget {
        /// Name of the method.
        method: &'static str,
        /// Purpose of the memory.
        what: &'static str,
        /// Bytes needed.
        needed_bytes: u64,
        /// Bytes allowed.
        budget_bytes: u64,
    },
    /// The method does not support this scene or style.
    #[error("method `{method}` cannot draw {what}")]
    Unsupported {
        /// Name of the method.
        method: &'static str,
        /// The unsupported feature.
        what: String,
        /// An alternative that works, as a sentence.
        remedy: String,
    },
    /// The device was lost or ran out of memory.
    #[error("the device of method `{method}` failed: {what}")]
    Device {
        /// Name of the method.
        method: &'static str,
        /// The failure, the operation that failed, and a remedy.
        what: String,
    },
    /// The scene rejects the edit.
    #[error(transparent)]
    Edit(EditError),
    /// The caller cancelled the work.
    #[error("cancelled")]
    Cancelled,
}

impl RenderError {
    /// [`RenderError::Unsupported`] of a method: the feature that it cannot draw, and a sentence
    /// with an alternative that works.
    pub fn unsupported(method: &'static str, what: impl Into<String>, remedy: &str) -> Self {
        Self::Unsupported {
            method,
            what: what.into(),
            remedy: remedy.to_owned(),
        }
    }
}

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
