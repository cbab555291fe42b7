//! Compositing of shapes from the highest draw rank down: sums of colors per pixel.

use guideway_scene::Rgba;

use super::{CoverageMask, Transmittance};
use crate::cpu::ground::samples::ROWS;
use crate::cpu::ground::tile::TILE_PX;
use crate::cpu::raster::bits::{
    MAX_WINDOW_PX, SampleBlock, WINDOW_COLUMNS, pixel_counts, set_bits,
};

impl<const C: usize> CoverageMask<C> {
    /// Composites a color where the shape is, below all colors before, and starts a new shape.
    #[inline(always)]
    pub(crate) fn composite(&mut self, color: Rgba) {
        let [r, g, b] = [color.r, color.g, color.b].map(f32::from);
        let ink = [r, g, b, 1.0];
        let opacity = f32::from(color.a) / 255.0;
        for window in 0..C {
            for row in set_bits(std::mem::take(&mut self.touched[window])) {
                let mut fresh = std::mem::take(&mut self.shape[window][row]);
                for (new, old) in fresh.iter_mut().zip(&self.opaque[window][row]) {
                    *new &= !old;
                }
                let weights = if color.is_opaque() && self.translucent[window] >> row & 1 == 0 {
                    pixel_counts::<C>(&fresh).map(f32::from)
                } else {
                    self.blend_translucent(window, row, &fresh, opacity)
                };
                let sums = &mut self.sums[row][window * Self::WINDOW_PX..];
                for (sum, weight) in sums.iter_mut().zip(weights).take(Self::WINDOW_PX) {
                    for (sum, part) in sum.iter_mut().zip(ink) {
                        *sum += part * weight;
                    }
                }
                if color.is_opaque() {
                    self.cover(window, row, &fresh);
                }
            }
        }
    }

    #[inline(always)]
    fn cover(&mut self, window: usize, row: usize, fresh: &SampleBlock) {
        let mut all = u32::MAX;
        for (old, new) in self.opaque[window][row].iter_mut().zip(fresh) {
            *old |= new;
            all &= *old;
        }
        self.close(window, row, all);
    }

    /// Blends a translucent color: takes `opacity` of the transmittance at the samples of `fresh`
    /// and returns the weight of the color per pixel.
    #[inline(always)]
    fn blend_translucent(
        &mut self,
        window: usize,
        row: usize,
        fresh: &SampleBlock,
        opacity: f32,
    ) -> [f32; MAX_WINDOW_PX] {
        const ALL: Transmittance = [[1.0; WINDOW_COLUMNS]; ROWS];
        if self.transmittance.is_empty() {
            self.transmittance = vec![[ALL; TILE_PX]; C];
        }
        let block = &mut self.transmittance[window][row];
        if self.translucent[window] >> row & 1 == 0 {
            self.translucent[window] |= 1 << row;
            *block = ALL;
        }
        let mut rows = 0_u32;
        for (row, word) in fresh.iter().enumerate() {
            rows |= u32::from(*word != 0) << row;
        }
        let rows = rows.trailing_zeros() as usize..(u32::BITS - rows.leading_zeros()) as usize;
        // Column by column: a sum over neighbors would be a chain of dependent additions.
        let mut taken = [[0.0; C]; MAX_WINDOW_PX];
        for row in rows {
            let (transmittance, word) = (&mut block[row % ROWS], fresh[row % ROWS]);
            let (pixels, _) = transmittance.as_chunks_mut::<C>();
            for (pixel, (transmittance, taken)) in pixels.iter_mut().zip(&mut taken).enumerate() {
                let bits = word >> (pixel * C);
                for column in 0..C {
                    let is_taken = bits >> column & 1 == 1;
                    let part = if is_taken {
                        transmittance[column] * opacity
                    } else {
                        0.0
                    };
                    taken[column] += part;
                    transmittance[column] -= part;
                }
            }
        }
        taken.map(|columns| columns.into_iter().sum())
    }
}
