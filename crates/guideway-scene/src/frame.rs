use crate::RenderError;

/// Width and height of a picture, in pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FrameSize {
    width: u32,
    height: u32,
}

impl FrameSize {
    /// Longest side, in pixels.
    pub const MAX_SIDE: u32 = 65_535;

    /// A size.
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

    /// The same width, and another height that is one of a picture.
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

/// A picture: rows from the top, 8-bit sRGB with straight alpha. Keep it for the next frame.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Frame {
    size: FrameSize,
    rgba: Vec<[u8; 4]>,
}

impl Frame {
    /// Most pixels of a frame; a larger picture is drawn in [strips](crate::Strip).
    pub const MAX_PIXELS: usize = 1 << 30;

    /// A transparent black picture.
    pub fn new(size: FrameSize) -> Self {
        Self {
            size,
            rgba: vec![[0; 4]; size.pixels()],
        }
    }

    /// Takes another size if need be; the pixels are then undefined.
    pub fn resize(&mut self, size: FrameSize) {
        self.size = size;
        if size.pixels() > self.rgba.capacity() {
            // The system clears new memory when it is first written: by the threads that draw.
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

    /// All pixels, row by row from the top, to be written.
    pub fn pixels_mut(&mut self) -> &mut [[u8; 4]] {
        &mut self.rgba
    }

    /// All bytes: R, G, B, A of each pixel.
    pub fn bytes(&self) -> &[u8] {
        self.rgba.as_flattened()
    }
}
