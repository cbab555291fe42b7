//! Scene: a layout with every path's color, width, state and draw order resolved.
//!
//! | file | content |
//! |---|---|
//! | `model` | [`Scene`], its options and queries |
//! | `states` | states of paths, their numbers, the draw order |
//! | `census` | counts of colors and widths, kept by edits |
//! | `bounds` | bounding box of the drawn curves |
//! | `level` | the level that a scene shows |
//! | `error` | [`SceneError`] |

mod bounds;
mod census;
mod error;
mod level;
mod model;
mod states;

pub use error::{NoOpaqueColor, SceneError};
pub(crate) use model::{Colors, own_color};
pub use model::{LayoutCopy, PathState, Scene, SceneOptions};
