//! Frame size and the RGBA pixel buffer that methods render into.

use crate::error::{MAX_FRAME_PIXELS, MAX_SIDE_PX, RenderError};

/// Width and height of a picture, in pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FrameSize {
    width: u32,
    height: u32,
}

impl FrameSize {
    /// Longest side, in pixels.
    pub const MAX_SIDE: u32 = MAX_SIDE_PX;

    /// A size of `width` x `height` pixels.
    ///
    /// # Errors
    /// [`RenderError::FrameSize`] when a side is 0 or longer than [`Self::MAX_SIDE`].
    pub fn new(width: u32, height: u32) -> Result<Self, RenderError> {
        if width.min(height) == 0 || width.max(height) > Self::MAX_SIDE {
            return Err(RenderError::FrameSize {
                width: u64::from(width),
                height: u64::from(height),
            });
        }
        Ok(Self { width, height })
    }

    /// The same width with another, valid height.
    pub(crate) fn with_height(self, height: u32) -> Self {
        Self { height, ..self }
    }

    /// Width in pixels.
    pub fn width(self) -> u32 {
        self.width
    }

    /// Height in pixels.
    pub fn height(self) -> u32 {
        self.height
    }

    /// Number of pixels.
    pub fn pixels(self) -> usize {
        self.width as usize * self.height as usize
    }
}

/// A picture in memory: rows from the top, 8-bit sRGB with straight alpha. Reuse it between frames.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Frame {
    size: FrameSize,
    rgba: Vec<[u8; 4]>,
}

impl Frame {
    /// Most pixels of a frame; draw a larger picture in [strips](crate::Strip).
    pub const MAX_PIXELS: usize = MAX_FRAME_PIXELS;

    /// A transparent black picture.
    pub fn new(size: FrameSize) -> Self {
        Self {
            size,
            rgba: vec![[0; 4]; size.pixels()],
        }
    }

    /// Changes the size; the pixels are undefined afterwards.
    pub fn resize(&mut self, size: FrameSize) {
        self.size = size;
        if size.pixels() > self.rgba.capacity() {
            // A fresh zeroed allocation is cleared lazily, by the threads that first write to it.
            self.rgba = vec![[0; 4]; size.pixels()];
        } else {
            self.rgba.resize(size.pixels(), [0; 4]);
        }
    }

    /// Size in pixels.
    pub fn size(&self) -> FrameSize {
        self.size
    }

    /// All pixels, row by row from the top.
    pub fn pixels(&self) -> &[[u8; 4]] {
        &self.rgba
    }

    /// All pixels for writing, row by row from the top.
    pub fn pixels_mut(&mut self) -> &mut [[u8; 4]] {
        &mut self.rgba
    }

    /// All bytes: R, G, B, A of each pixel.
    pub fn bytes(&self) -> &[u8] {
        self.rgba.as_flattened()
    }
}
