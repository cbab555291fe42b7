//! From a layout to a scene: what is drawn, in which color and width, and what lies over what.
//!
//! A [`Scene`] resolves styles once, so that every render method agrees on them. It holds the layout's
//! own control points: methods take them relative to the center of the view in `f64`, which keeps
//! millimeters at 10,000 km from the origin without a second copy.

mod color;
mod color_by;
mod edit;
mod scene;
mod width;

pub use color::Rgba;
pub use color_by::{ColorBy, Legend, LegendEntry};
pub use edit::{Edit, EditError, Insertion};
pub use scene::{LayoutCopy, PathState, Scene, SceneError, SceneOptions};
pub use width::LineRule;
