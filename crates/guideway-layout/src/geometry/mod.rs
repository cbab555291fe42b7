//! Curves of all paths, in flat buffers.
//!
//! | module | does |
//! |---|---|
//! | `buffers` | holds control points as `f32` or `f64`, and finds ranges in lists of ends |
//! | `hulls` | holds the bounding box of the control points of each path |
//! | `store` | [`Geometry`]: holds runs and paths, reads them, appends paths |
//! | `transform` | maps control points; bounds the result and its rounding error |
//! | `replace` | copies paths, and replaces their curves |

mod buffers;
mod hulls;
mod replace;
mod store;
#[cfg(test)]
mod tests;
mod transform;

pub use hulls::{Hulls, append_hulls};
pub use store::Geometry;
