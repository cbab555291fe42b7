//! Geometry: stores the curves of all paths in flat buffers, maps and replaces them.
//!
//! | module | does |
//! |---|---|
//! | `buffers` | holds control points as `f32` or `f64`, and finds ranges in lists of ends |
//! | `hulls` | holds the bounding box of the control points of each path |
//! | `store` | [`Geometry`]: holds runs and paths, reads them, appends paths |
//! | `parts` | visits the points and hulls of some paths by all threads |
//! | `transform` | maps control points; bounds the result and its rounding error |
//! | `replace` | copies paths, and replaces their curves |

mod buffers;
mod hulls;
mod parts;
mod replace;
mod store;
#[cfg(test)]
mod tests;
mod transform;

pub use hulls::{Hulls, append_hulls};
pub use store::Geometry;
