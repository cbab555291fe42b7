//! Size limits of pictures. Public through [`FrameSize`](crate::FrameSize) and [`Frame`](crate::Frame).

/// Longest side of a picture, in pixels: a row and a column fit 16 bits each.
pub(crate) const MAX_SIDE_PX: u32 = 65_535;

/// Most pixels of a frame in memory: 4 GiB of RGBA. Larger pictures are drawn in strips.
pub(crate) const MAX_FRAME_PIXELS: usize = 1 << 30;
