//! The colors of pixels over what lies below all paths.

use guideway_scene::Rgba;

use super::span::{SOLID, Samples};

/// Colors by the number of samples covered.
pub(super) type SolidColors = [[u8; 4]; Samples::<SOLID>::COUNT + 1];

/// The colors of pixels of which one opaque color covers from none to all samples.
pub(super) fn solid_colors(color: Rgba, background: Rgba) -> SolidColors {
    let backdrop = Backdrop::new(background);
    std::array::from_fn(|count| {
        let [r, g, b, a] = [color.r, color.g, color.b, 1].map(|c| f32::from(c) * count as f32);
        backdrop.below::<SOLID>([r, g, b, a])
    })
}

/// What lies below all paths.
pub(super) struct Backdrop {
    bytes: [u8; 4],
    rgb: [f32; 3],
    opacity: f32,
}

impl Backdrop {
    pub(super) fn new(background: Rgba) -> Self {
        let bytes @ [r, g, b, a] = background.to_u32().to_be_bytes();
        Self {
            bytes,
            rgb: [r, g, b].map(f32::from),
            opacity: f32::from(a) / 255.0,
        }
    }

    /// The mean of a pixel's samples, of which `sum` is the sum, over the background: straight alpha.
    #[inline(always)]
    pub(super) fn below<const C: usize>(&self, sum: [f32; 4]) -> [u8; 4] {
        let a_sample = 1.0 / Samples::<C>::COUNT as f32;
        if sum[3] == 0.0 {
            return self.bytes;
        }
        let shines = (1.0 - sum[3] * a_sample).max(0.0) * self.opacity;
        let opacity = sum[3] * a_sample + shines;
        let channel = |i: usize| {
            let color = sum[i] * a_sample + self.rgb[i] * shines;
            // A division is worth avoiding: most backgrounds are opaque.
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
