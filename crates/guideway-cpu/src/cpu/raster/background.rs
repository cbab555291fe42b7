//! Composites coverage over the background color.

use guideway_scene::Rgba;

use crate::cpu::ground::samples::{SOLID, SamplePattern};

/// Colors by the number of covered samples.
pub(crate) type SolidRamp = [[u8; 4]; SamplePattern::<SOLID>::COUNT + 1];

/// The colors of pixels of which an opaque color covers 0, 1, ... or all samples.
pub(crate) fn solid_ramp(color: Rgba, background: Rgba) -> SolidRamp {
    let background = Background::new(background);
    std::array::from_fn(|count| {
        let [r, g, b, a] = [color.r, color.g, color.b, 1].map(|c| f32::from(c) * count as f32);
        background.composite::<SOLID>([r, g, b, a])
    })
}

/// The color below all paths.
pub(crate) struct Background {
    bytes: [u8; 4],
    rgb: [f32; 3],
    opacity: f32,
}

impl Background {
    pub(crate) fn new(background: Rgba) -> Self {
        let bytes @ [r, g, b, a] = background.to_u32().to_be_bytes();
        Self {
            bytes,
            rgb: [r, g, b].map(f32::from),
            opacity: f32::from(a) / 255.0,
        }
    }

    /// Color of a pixel from the sum over its samples, composited over the background: straight
    /// alpha.
    #[inline(always)]
    pub(crate) fn composite<const C: usize>(&self, sum: [f32; 4]) -> [u8; 4] {
        let a_sample = 1.0 / SamplePattern::<C>::COUNT as f32;
        if sum[3] == 0.0 {
            return self.bytes;
        }
        let transmitted = (1.0 - sum[3] * a_sample).max(0.0) * self.opacity;
        let opacity = sum[3] * a_sample + transmitted;
        let channel = |i: usize| {
            let color = sum[i] * a_sample + self.rgb[i] * transmitted;
            // Most backgrounds are opaque: avoid the division.
            let color = if self.opacity < 1.0 {
                color / opacity
            } else {
                color
            };
            (color + 0.5) as u8
        };
        let alpha = (opacity * 255.0 + 0.5) as u8;
        [channel(0), channel(1), channel(2), alpha]
    }
}
