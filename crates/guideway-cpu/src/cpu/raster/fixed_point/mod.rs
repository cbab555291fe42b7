//! The rasterizer in 16-bit integers, for small clusters of one color: a register holds twice as
//! many integers as floats.
//!
//! Lengths are rounded to steps of 1/64 pixel, about as much as cached lines are rounded already.
//! All numbers that depend on the position of a line are whole steps, so a line moved by whole
//! pixels covers the same samples, moved by as much.

pub(super) mod caps;
pub(super) mod capsule;
pub(super) mod line_batch;
#[cfg(test)]
mod tests;
