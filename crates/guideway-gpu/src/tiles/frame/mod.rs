//! Draws a frame: from a view to pixels.
//!
//! | file | purpose |
//! |---|---|
//! | `context`, `line_lod`, `window` | a view of a scene, the LOD of its lines, the tiles to draw |
//! | `capacity`, `line_buffers`, `tile_buffers` | buffers whose size depends on the view |
//! | `line_source` | origin of a window's lines: flattened or cached |
//! | `dispatch_plan`, `workgroups` | the dispatches of a window with their buffers and sizes |
//! | `occlusion` | decides when to draw in two occlusion passes |
//! | `target` | buffers and caches that pass from one picture to the next |
//! | `renderer` | arguments and result of the draw functions |
//! | `near_points` | keeps exact points of near clusters on the device |
//! | `draw_window`, `draw` | draw a window; draw a picture window by window, and fetch it |
//! | `presenter` | writes a picture to a texture instead |

pub(crate) mod capacity;
pub(crate) mod context;
pub(crate) mod dispatch_plan;
pub(crate) mod draw;
mod draw_window;
pub(crate) mod line_buffers;
pub(crate) mod line_lod;
pub(crate) mod line_source;
mod near_points;
pub(crate) mod occlusion;
pub(crate) mod presenter;
pub(crate) mod renderer;
pub(crate) mod target;
pub(crate) mod tile_buffers;
pub(crate) mod window;
mod workgroups;
