use std::rc::Rc;

use glow::HasContext;

use super::Gl;

const PIXEL_BYTES: u64 = 4;

/// A picture on the device, 8 bits each of red, green, blue and opacity. Its first row is its upper one.
pub(crate) struct Target {
    gl: Rc<Gl>,
    width: u32,
    height: u32,
    samples: u32,
    /// What is drawn into.
    drawn: Surface,
    /// What the samples of each pixel come together in, when there are several.
    resolved: Option<Surface>,
}

impl Target {
    /// Bytes of a target of so many pixels.
    pub(crate) fn bytes_for(pixels: u64, samples: u32) -> u64 {
        let surfaces = if samples > 1 { samples + 1 } else { 1 };
        pixels * u64::from(surfaces) * PIXEL_BYTES
    }

    /// A target of this size in pixels, with 1 or more samples each.
    pub(crate) fn new(gl: &Rc<Gl>, width: u32, height: u32, samples: u32) -> Result<Self, String> {
        let resolved = match samples {
            1 => None,
            _ => Some(Surface::new(gl, width, height, 1)?),
        };
        Ok(Self {
            gl: Rc::clone(gl),
            width,
            height,
            samples,
            drawn: Surface::new(gl, width, height, samples)?,
            resolved,
        })
    }

    /// Whether it is of this size.
    pub(crate) fn is(&self, width: u32, height: u32, samples: u32) -> bool {
        (self.width, self.height, self.samples) == (width, height, samples)
    }

    /// Bytes that it takes.
    pub(crate) fn bytes(&self) -> u64 {
        Self::bytes_for(u64::from(self.width) * u64::from(self.height), self.samples)
    }

    /// Fills it with one color, and draws into it from now on through a square viewport of `viewport_side`
    /// whose middle is at pixel (`middle_x`, `middle_y`).
    pub(crate) fn begin(&self, rgba: [f32; 4], middle_x: i32, middle_y: i32, viewport_side: u32) {
        let raw = &self.gl.raw;
        let (side, half) = (viewport_side as i32, viewport_side as i32 / 2);
        unsafe {
            raw.bind_framebuffer(glow::FRAMEBUFFER, Some(self.drawn.framebuffer));
            raw.clear_buffer_f32_slice(glow::COLOR, 0, &rgba);
            raw.viewport(middle_x - half, middle_y - half, side, side);
        }
    }

    /// Brings the samples of each pixel together by their mean.
    pub(crate) fn resolve(&self) {
        let Some(resolved) = &self.resolved else {
            return;
        };
        let (w, h) = (self.width as i32, self.height as i32);
        unsafe {
            self.gl.raw.blit_named_framebuffer(
                Some(self.drawn.framebuffer),
                Some(resolved.framebuffer),
                0,
                0,
                w,
                h,
                0,
                0,
                w,
                h,
                glow::COLOR_BUFFER_BIT,
                glow::NEAREST,
            );
        }
    }

    /// Reads the upper left `width` x `height` pixels into rows of `row_pixels` pixels each.
    ///
    /// # Panics
    /// When the target or `pixels` is smaller.
    pub(crate) fn read(&self, width: u32, height: u32, row_pixels: u32, pixels: &mut [[u8; 4]]) {
        assert!(width <= self.width && height <= self.height && width <= row_pixels && height > 0);
        let needed = (height as usize - 1) * row_pixels as usize + width as usize;
        assert!(pixels.len() >= needed);
        let raw = &self.gl.raw;
        let source = self.resolved.as_ref().unwrap_or(&self.drawn);
        unsafe {
            raw.bind_framebuffer(glow::READ_FRAMEBUFFER, Some(source.framebuffer));
            raw.pixel_store_i32(glow::PACK_ROW_LENGTH, row_pixels as i32);
            raw.read_pixels(
                0,
                0,
                width as i32,
                height as i32,
                glow::RGBA,
                glow::UNSIGNED_BYTE,
                glow::PixelPackData::Slice(Some(pixels.as_flattened_mut())),
            );
        }
    }
}

struct Surface {
    gl: Rc<Gl>,
    framebuffer: glow::Framebuffer,
    renderbuffer: glow::Renderbuffer,
}

impl Surface {
    fn new(gl: &Rc<Gl>, width: u32, height: u32, samples: u32) -> Result<Self, String> {
        let raw = &gl.raw;
        let (w, h) = (width as i32, height as i32);
        let surface = unsafe {
            Self {
                gl: Rc::clone(gl),
                framebuffer: raw.create_framebuffer()?,
                renderbuffer: raw.create_renderbuffer()?,
            }
        };
        let what = format!("a picture of {width} x {height} pixels with {samples} samples each");
        let bytes = u64::from(width) * u64::from(height) * u64::from(samples) * PIXEL_BYTES;
        unsafe {
            raw.bind_renderbuffer(glow::RENDERBUFFER, Some(surface.renderbuffer));
            if samples > 1 {
                raw.renderbuffer_storage_multisample(
                    glow::RENDERBUFFER,
                    samples as i32,
                    glow::RGBA8,
                    w,
                    h,
                );
            } else {
                raw.renderbuffer_storage(glow::RENDERBUFFER, glow::RGBA8, w, h);
            }
        }
        gl.check_allocation(&what, bytes)?;
        let complete = unsafe {
            raw.bind_framebuffer(glow::FRAMEBUFFER, Some(surface.framebuffer));
            raw.framebuffer_renderbuffer(
                glow::FRAMEBUFFER,
                glow::COLOR_ATTACHMENT0,
                glow::RENDERBUFFER,
                Some(surface.renderbuffer),
            );
            raw.check_framebuffer_status(glow::FRAMEBUFFER) == glow::FRAMEBUFFER_COMPLETE
        };
        if complete {
            Ok(surface)
        } else {
            Err(format!("it cannot draw into {what}"))
        }
    }
}

impl Drop for Surface {
    fn drop(&mut self) {
        unsafe {
            self.gl.raw.delete_framebuffer(self.framebuffer);
            self.gl.raw.delete_renderbuffer(self.renderbuffer);
        }
    }
}
