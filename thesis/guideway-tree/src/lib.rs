//! The per-pixel methods that the thesis proposes instead of its grid (sections 6.1.1 and 6.3): an
//! AABB tree and a linear quadtree over the segments of all curves, built on the device.
//!
//! | stage | input | output | module |
//! |---|---|---|---|
//! | pack | paths in Hilbert order | control points, segments, keys | `pack` |
//! | build | control points | the structure of each chunk | `step`, `chunk` |
//! | draw | view, structures | RGBA pixels | `prepared`, `draw` |
//! | edit | moved curves | new control points, fitted trees | `edit` |
//!
//! ```text
//! tree:      keys --emit--> nodes --fit--> boxes          an edit fits the boxes again
//! quadtree:  points --keys--> keys --sort--> sorted keys  in each frame
//! ```
//!
//! Both test a pixel against the lines between uniform samples of a segment, as the grid does, but
//! compute the lines in the test instead of storing them. A walk that takes long stops and resumes
//! in the next dispatch.
//!
//! `options`, `params` and `method` hold the options, the interface to the shaders and the entry.

mod chunk;
mod draw;
mod edit;
mod method;
mod options;
mod pack;
mod params;
mod prepared;
mod step;

pub use method::{TreeError, Trees};
pub use options::{OptionsError, Structure, TreeOptions};
