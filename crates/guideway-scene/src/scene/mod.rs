//! Scene: a layout with every path's color, width, state and draw order resolved.
//!
//! | file | content |
//! |---|---|
//! | `model` | [`Scene`], its options and queries |
//! | `bounds` | bounding box of the drawn curves |
//! | `level` | the level that a scene shows |
//! | `error` | [`SceneError`] |

mod bounds;
mod error;
mod level;
mod model;

pub use error::{NoOpaqueColor, SceneError};
pub(crate) use model::Colors;
pub use model::{LayoutCopy, PathState, Scene, SceneOptions};
