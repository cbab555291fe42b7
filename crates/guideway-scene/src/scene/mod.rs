//! Scene: a layout with every path's color, width, state and draw order resolved.
//!
//! | file | content |
//! |---|---|
//! | `model`, `options` | [`Scene`], its queries and options |
//! | `coloring` | [`Coloring`]: the color of each path, and what it means |
//! | `path_state`, `draw_order` | [`PathState`]; the order in which shown paths are drawn |
//! | `states` | sets and counts states, adds and drops rows |
//! | `census`, `styles` | counts of colors and widths, kept by edits; what shown paths share |
//! | `bounds` | bounding box of the drawn curves |
//! | `level` | the level that a scene shows |
//! | `error` | [`SceneError`] |

mod bounds;
mod census;
mod coloring;
mod draw_order;
mod error;
mod level;
mod model;
mod options;
mod path_state;
mod states;
mod styles;

pub use coloring::Coloring;
pub(crate) use coloring::Colors;
pub use error::{NoOpaqueColor, SceneError};
pub use model::{LayoutCopy, Scene};
pub use options::SceneOptions;
pub use path_state::PathState;
