//! The background: converts its color for the device, and pixels back from it.

use guideway_scene::Rgba;

use super::camera::rgba;

/// The color below the lines, and its form on the device.
///
/// The mean of several samples is correct only for premultiplied colors. An opaque background or a
/// single sample needs no multiplication.
#[derive(Clone, Copy, Debug)]
pub(super) struct Background {
    color: Rgba,
    is_premultiplied: bool,
}

impl Background {
    /// A background for `samples` samples per pixel.
    pub(super) fn new(color: Rgba, samples: u32) -> Self {
        Self {
            color,
            is_premultiplied: samples > 1 && !color.is_opaque(),
        }
    }

    /// The color in the form of the device.
    pub(super) fn stored(&self) -> [f32; 4] {
        let [r, g, b, a] = rgba(self.color);
        if self.is_premultiplied {
            [r * a, g * a, b * a, a]
        } else {
            [r, g, b, a]
        }
    }

    /// Converts pixels from the device to those of frames, which are not premultiplied.
    pub(super) fn restore(&self, pixels: &mut [[u8; 4]]) {
        if !self.is_premultiplied {
            return;
        }
        for [r, g, b, a] in pixels.iter_mut().filter(|p| p[3] > 0) {
            for channel in [r, g, b] {
                *channel = (f32::from(*channel) * 255.0 / f32::from(*a)).round() as u8;
            }
        }
    }
}
