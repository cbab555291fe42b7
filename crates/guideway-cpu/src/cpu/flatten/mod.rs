//! Flatten stage: turns the curves of visible clusters into polylines within a tolerance, and
//! caches them.
//!
//! ```text
//!   control points -> knots -> chains -> polylines      `cluster_lines`: cached per cluster
//!                     `knots`  `chain_curves`  `simplify`, `polylines`
//!
//!   control points --------------------> lines in pixels `clipped`: clusters too large for 16 bits
//! ```

pub(super) mod chain_curves;
pub(super) mod clipped;
pub(super) mod cluster_lines;
pub(super) mod knots;
pub(super) mod line_cache;
pub(super) mod polylines;
pub(super) mod simplify;
#[cfg(test)]
mod tests;
pub(super) mod tile_lines;
