//! The scene (what is drawn) and the contract of every render method (how a scene becomes a frame).
//!
//! A [`Scene`] resolves the styles of a layout once: color, width and draw order of every path. It
//! keeps the layout's own control points; a method subtracts the center of the view in `f64` before
//! it rounds to `f32`, which preserves millimeters 10,000 km from the origin without a second copy.
//!
//! A [`Method`] prepares a scene once ([`Prepared`]) and renders any [`View`] of it into a [`Frame`];
//! its [`Report`] accounts for every path. All methods agree on the picture:
//!
//! - A path covers a point when its distance to the path's center line is at most half the stroke
//!   width.
//! - The color of a point is that of the topmost covering path, composited over the paths below it
//!   while it is translucent. A pixel is the mean over its square, of sRGB values as stored.
//! - Density shading shows the mean number of paths that cover a pixel ([`density`]).

pub mod cluster;
mod color;
mod color_by;
pub mod density;
mod edit;
mod error;
mod frame;
mod method;
mod report;
mod scene;
mod sheet;
mod strip;
mod style;
mod view;
mod width;

pub use color::Rgba;
pub use color_by::{ColorBy, Legend, LegendEntry};
pub use edit::{Edit, EditError, Insertion};
pub use error::RenderError;
pub use frame::{Frame, FrameSize};
pub use method::{Budget, Cancel, Edited, Method, MethodInfo, Prepared};
pub use report::{Clock, Preparation, Report, Stage, Work, elapsed_ms};
pub use scene::{LayoutCopy, PathState, Scene, SceneError, SceneOptions};
pub use sheet::{Sheet, Text};
pub use strip::Strip;
pub use style::{Shading, Style};
pub use view::View;
pub use width::LineRule;
