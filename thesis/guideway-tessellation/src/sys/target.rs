//! Render targets: RGBA pictures on the device, with one or more samples per pixel.

use std::rc::Rc;

use glow::HasContext;

use super::Gl;
use crate::error::GlError;

const PIXEL_BYTES: u64 = 4;

/// A picture on the device, with 8 bits per RGBA channel. Its first row is the top row.
pub(crate) struct Target {
    gl: Rc<Gl>,
    width: u32,
    height: u32,
    samples: u32,
    /// The surface that draws write.
    drawn: Surface,
    /// The surface of the mean of all samples, when a pixel has several.
    resolved: Option<Surface>,
}

impl Target {
    /// Bytes of a target of `pixels` pixels.
    pub(crate) fn bytes_for(pixels: u64, samples: u32) -> u64 {
        let surfaces = if samples > 1 { samples + 1 } else { 1 };
        pixels * u64::from(surfaces) * PIXEL_BYTES
    }

    /// Allocates a target of this size in pixels, with 1 or more samples per pixel.
    ///
    /// # Errors
    /// When the device is out of memory, or cannot draw into the format.
    pub(crate) fn new(gl: &Rc<Gl>, width: u32, height: u32, samples: u32) -> Result<Self, GlError> {
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

    /// Returns `true` if the target has this size.
    pub(crate) fn has_size(&self, width: u32, height: u32, samples: u32) -> bool {
        (self.width, self.height, self.samples) == (width, height, samples)
    }

    /// Bytes on the device.
    pub(crate) fn bytes(&self) -> u64 {
        Self::bytes_for(u64::from(self.width) * u64::from(self.height), self.samples)
    }

    /// Clears the target to one color, and makes it the target of draws through a square viewport
    /// of `viewport_side` pixels centered at pixel (`center_x`, `center_y`).
    pub(crate) fn begin(&self, rgba: [f32; 4], center_x: i32, center_y: i32, viewport_side: u32) {
        let raw = &self.gl.raw;
        let (side, half) = (viewport_side as i32, viewport_side as i32 / 2);
        // SAFETY: the framebuffer belongs to this context; the color is a slice of four numbers.
        unsafe {
            raw.bind_framebuffer(glow::FRAMEBUFFER, Some(self.drawn.framebuffer));
            raw.clear_buffer_f32_slice(glow::COLOR, 0, &rgba);
            raw.viewport(center_x - half, center_y - half, side, side);
        }
    }

    /// Averages the samples of each pixel.
    pub(crate) fn resolve(&self) {
        let Some(resolved) = &self.resolved else {
            return;
        };
        let (w, h) = (self.width as i32, self.height as i32);
        // SAFETY: both framebuffers belong to this context; no memory of the host is passed.
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
    /// When the target or `pixels` is too small.
    pub(crate) fn read(&self, width: u32, height: u32, row_pixels: u32, pixels: &mut [[u8; 4]]) {
        assert!(width <= self.width && height <= self.height && width <= row_pixels && height > 0);
        let needed = (height as usize - 1) * row_pixels as usize + width as usize;
        assert!(pixels.len() >= needed);
        let raw = &self.gl.raw;
        let source = self.resolved.as_ref().unwrap_or(&self.drawn);
        // SAFETY: the assertions keep the pixels that are read within the slice.
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

/// A framebuffer with one color renderbuffer.
struct Surface {
    gl: Rc<Gl>,
    framebuffer: glow::Framebuffer,
    renderbuffer: glow::Renderbuffer,
}

impl Surface {
    fn new(gl: &Rc<Gl>, width: u32, height: u32, samples: u32) -> Result<Self, GlError> {
        let raw = &gl.raw;
        let (w, h) = (width as i32, height as i32);
        // SAFETY: the context is current; the call makes an object and takes no memory of the host.
        let surface = unsafe {
            Self {
                gl: Rc::clone(gl),
                framebuffer: raw
                    .create_framebuffer()
                    .map_err(GlError::create("framebuffer"))?,
                renderbuffer: raw
                    .create_renderbuffer()
                    .map_err(GlError::create("renderbuffer"))?,
            }
        };
        let picture =
            format!("a picture of {width} x {height} pixels with {samples} samples per pixel");
        let bytes = u64::from(width) * u64::from(height) * u64::from(samples) * PIXEL_BYTES;
        // SAFETY: the object belongs to this context, which is current; no memory of the host is
        // passed.
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
        gl.check_allocation(&picture, bytes)?;
        // SAFETY: the object belongs to this context, which is current; no memory of the host is
        // passed.
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
            Err(GlError::Framebuffer { picture })
        }
    }
}

impl Drop for Surface {
    fn drop(&mut self) {
        // SAFETY: the objects belong to this context, and nothing uses them afterwards.
        unsafe {
            self.gl.raw.delete_framebuffer(self.framebuffer);
            self.gl.raw.delete_renderbuffer(self.renderbuffer);
        }
    }
}
