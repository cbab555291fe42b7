use crate::EditError;

use crate::{Frame, FrameSize};

/// Why a picture could not be made.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum RenderError {
    /// A side of the picture is zero or too long.
    #[error(
        "a picture of {width} x {height} pixels cannot be made: each side takes 1 to {} pixels",
        FrameSize::MAX_SIDE
    )]
    FrameSize {
        /// Width asked for, in pixels.
        width: u64,
        /// Height asked for, in pixels.
        height: u64,
    },
    /// The method draws pictures only whole, and this one is too large for that.
    #[error(
        "this method cannot draw a picture of {width} x {height} pixels: it draws pictures only whole, with at most \
         {} million pixels",
        Frame::MAX_PIXELS / 1_000_000
    )]
    Strips {
        /// Width of the picture, in pixels.
        width: u32,
        /// Height of the picture, in pixels.
        height: u32,
    },
    /// The view's center or scale is not usable.
    #[error(
        "the view around ({x_m}, {y_m}) at {px_per_m} pixels a meter cannot be drawn: the center must be \
         within 1e12 m and the scale between 1e-9 and 1e9 pixels a meter"
    )]
    View {
        /// Center asked for, in meters.
        x_m: f64,
        /// Center asked for, in meters.
        y_m: f64,
        /// Scale asked for.
        px_per_m: f64,
    },
    /// The memory allowed does not do.
    #[error(
        "method `{method}` needs {needed_bytes} bytes for {what}, but the budget is {budget_bytes}"
    )]
    Budget {
        /// Name of the method.
        method: &'static str,
        /// What the memory is for.
        what: &'static str,
        /// Bytes needed.
        needed_bytes: u64,
        /// Bytes allowed.
        budget_bytes: u64,
    },
    /// The method has no way of drawing this.
    #[error("method `{method}` cannot draw {what}")]
    Unsupported {
        /// Name of the method.
        method: &'static str,
        /// What it cannot draw.
        what: String,
        /// What to ask for instead, a sentence.
        remedy: String,
    },
    /// The device gave up: it was lost, or had no memory left.
    #[error("method `{method}` was let down by its device: {what}")]
    Device {
        /// Name of the method.
        method: &'static str,
        /// What happened, at what, and what to try.
        what: String,
    },
    /// The scene cannot be changed like this.
    #[error(transparent)]
    Edit(EditError),
    /// The caller asked to stop.
    #[error("cancelled")]
    Cancelled,
}
