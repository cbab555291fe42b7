//! The contract between a scene and every render method: what goes in, what comes out, what may fail.
//!
//! The picture that all methods agree on:
//!
//! - A path covers a point when its distance to the path's center line is at most half the stroke width.
//! - The color of a point is that of the covering path drawn last, over what lies below if it is
//!   translucent. A pixel is the mean over its square, of sRGB values as they are stored.
//! - In density shading a pixel shows how many paths cover it on average ([`density`]).
//!
//! [`Method`] is immutable and shared; what a scene needs is kept in [`Prepared`]; a [`View`] is cheap to
//! change; a [`Report`] accounts for every path.

pub mod density;
mod error;
mod frame;
mod method;
mod report;
mod sheet;
mod strip;
mod view;

pub use error::RenderError;
pub use frame::{Frame, FrameSize};
pub use method::{Budget, Cancel, Edited, Method, MethodInfo, NO_PATH, Prepared, Shading, Style};
pub use report::{Clock, Preparation, Report, Stage, Work, elapsed_ms};
pub use sheet::{Sheet, Text};
pub use strip::Strip;
pub use view::View;
