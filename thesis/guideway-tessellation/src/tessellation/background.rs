use guideway_scene::Rgba;

use super::camera::rgba;

/// What lies below the lines, and how it is stored on the device.
///
/// The mean of several samples is right for colors multiplied with their opacity. With an opaque background,
/// or one sample, that is the same.
#[derive(Clone, Copy, Debug)]
pub(super) struct Background {
    color: Rgba,
    is_multiplied: bool,
}

impl Background {
    /// A background below `samples` samples a pixel.
    pub(super) fn new(color: Rgba, samples: u32) -> Self {
        Self {
            color,
            is_multiplied: samples > 1 && !color.is_opaque(),
        }
    }

    /// As the device keeps it.
    pub(super) fn stored(&self) -> [f32; 4] {
        let [r, g, b, a] = rgba(self.color);
        if self.is_multiplied {
            [r * a, g * a, b * a, a]
        } else {
            [r, g, b, a]
        }
    }

    /// Makes pixels from the device what frames hold: colors apart from their opacity.
    pub(super) fn restore(&self, pixels: &mut [[u8; 4]]) {
        if !self.is_multiplied {
            return;
        }
        for [r, g, b, a] in pixels.iter_mut().filter(|p| p[3] > 0) {
            for channel in [r, g, b] {
                *channel = (f32::from(*channel) * 255.0 / f32::from(*a)).round() as u8;
            }
        }
    }
}
