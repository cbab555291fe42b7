//! The per-pixel method of the thesis (section 4.3): samples curves into lines, sorts the lines
//! into the cells of a uniform grid, and tests every pixel against the lines of its cell.
//!
//! | stage | input | output | module |
//! |---|---|---|---|
//! | measure | scene | local origin, grid bounds | `local` |
//! | pack | paths | control points per segment | `pack` |
//! | build | control points | lines per cell, in chunks | `grid_builder`, `chunk` |
//! | check | view, style | shader parameters, or an error | `frame_context` |
//! | plan | parameters, counts per cell | passes, ranges of tiles | `pass_plan`, `pass`, `split` |
//! | draw | passes | RGBA pixels | `prepared`, `picture_buffers` |
//!
//! The lists of 3 x 2 cells, numbered from the lower left, with three lines:
//!
//! ```text
//! +-------+-------+-------+
//! | aaaaaaaaaaa   |       |    cell      0    1     2    3    4    5
//! +-------+-------+-------+    counts    1    2     1    1    1    0
//! | bbbbbbbbb ccccccccc   |    starts    0    1     3    4    5    6
//! +-------+-------+-------+    lists     b    b c   c    a    a
//! ```
//!
//! Cost: a pixel tests every line of its cell; a line takes 16 bytes per cell that it overlaps.
//!
//! `params` and `kernels` hold the interface to the shaders; `method` is the entry, `variant` its
//! shared state.

mod chunk;
mod count_table;
mod error;
mod frame_context;
mod grid_builder;
mod kernels;
mod local;
mod method;
mod options;
mod pack;
mod params;
mod pass;
mod pass_plan;
mod picture_buffers;
mod prepared;
mod split;
#[cfg(test)]
mod tests;
mod variant;

pub use error::{GridError, OptionsError};
pub use method::Grid;
pub use options::{Antialias, Binning, GridOptions, PrefixSum};

/// The parts that other per-pixel methods share: coordinates, checks of views, coverage, buffers of
/// pictures and the scan.
pub mod per_pixel {
    pub use crate::frame_context::{Widths, opaque_color, packed_rgba, radius_m};
    pub use crate::local::LocalScene;
    pub use crate::params::{
        ADD_SUMS, HALF_EDGE_PX, SCAN_BLOCKS, SCAN_SUMS, SCAN_THREADS, TILE_PX,
    };
    pub use crate::picture_buffers::{PIXEL_BYTES, PictureBuffers, PictureLayout, Purpose};

    /// Shader text: blends a color over the background.
    pub const BLEND: &str = include_str!("shaders/blend.wgsl");
    /// Shader text: a point of a segment.
    pub const CURVE: &str = include_str!("shaders/curve.wgsl");
    /// Shader text: the distance of a point to a line.
    pub const LINE: &str = include_str!("shaders/line.wgsl");
    /// Shader text: coverage from the distance to the nearest line.
    pub const NEAREST: &str = include_str!("shaders/nearest.wgsl");
    /// Shader text: coverage from 32 samples per pixel.
    pub const SAMPLES: &str = include_str!("shaders/samples.wgsl");
}
