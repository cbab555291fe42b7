//! The units of a vector tile.

/// Units along each side of a vector tile. A line is at most 2 units off its curve: 1 by
/// flattening, and less than 1 by rounding.
pub const EXTENT: u32 = 4096;
/// Part of a tile by which lines reach beyond its border, so that wide strokes have no seams there.
pub(super) const BUFFER_SHARE: f64 = 1.0 / 64.0;
