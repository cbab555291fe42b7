//! Sizes that several stages share. The drawing of a tile is in [`crate::cpu`].

/// Pixels along each side of a tile: a row of pixels is one 32-bit word.
pub(crate) const TILE_PX: usize = u32::BITS as usize;

/// SIMD lanes of all loops: sample rows of a pixel, or lines. 16 lanes of `f32` are one register of
/// AVX-512, two of AVX2, four of SSE or NEON.
pub(crate) const LANES: usize = 16;

/// Passes in which the lines of a cluster are drawn, the longest chains first. Measured on D1, all
/// paths in view (docs/performance.md): with five, 1.3 of 3 million lines are rasterized, and the
/// later passes skip the rest.
pub(crate) const PASSES: usize = 5;

/// Largest distance from its origin, in units, that a cluster with cached lines may reach. Derived:
/// below `i16::MAX`, with a margin for rounding.
pub(crate) const MAX_UNITS: f64 = 32_000.0;

/// One bit per pixel of a tile: a word per row.
pub(crate) type PixelRows = [u32; TILE_PX];

/// Halves that the samples of each pixel of a tile count, summed over paths. Below 0 only by the
/// rounding of an end.
pub(crate) type SampleHalves = [[i32; TILE_PX]; TILE_PX];
