//! Copies of solid masks: the samples of blocks in which pixels are open, and nothing of full ones.

use super::{CoverageMask, DirtyBits};
use crate::cpu::ground::samples::SOLID;
use crate::cpu::ground::tile::{PixelRows, TILE_PX};
use crate::cpu::raster::bits::{SampleBlock, set_bits};

/// The samples of a tile.
pub(crate) struct StoredMask {
    open_pixels: PixelRows,
    open: DirtyBits<SOLID>,
    /// Blocks with samples and open pixels.
    touched: DirtyBits<SOLID>,
    /// Their samples, window by window.
    blocks: Vec<SampleBlock>,
}

impl StoredMask {
    /// Most heap bytes of a copy.
    pub(crate) const MAX_BYTES: u64 = (SOLID * TILE_PX * size_of::<SampleBlock>()) as u64;
}

impl CoverageMask<SOLID> {
    /// A copy of the mask.
    pub(crate) fn stored(&self) -> StoredMask {
        let mut touched = self.touched;
        for (touched, open) in touched.iter_mut().zip(self.open) {
            *touched &= open;
        }
        let count: u32 = touched.iter().map(|rows| rows.count_ones()).sum();
        let mut blocks = Vec::with_capacity(count as usize);
        for (window, &touched) in self.shape.iter().zip(&touched) {
            blocks.extend(set_bits(touched).map(|row| window[row]));
        }
        StoredMask {
            open_pixels: self.open_pixels,
            open: self.open,
            touched,
            blocks,
        }
    }

    /// Sets the mask to a copy.
    pub(crate) fn load(&mut self, stored: &StoredMask) {
        self.clear_shape();
        self.closes = true;
        (self.open_pixels, self.open) = (stored.open_pixels, stored.open);
        (self.touched, self.translucent) = (stored.touched, [0; SOLID]);
        let mut blocks = stored.blocks.iter();
        for (window, &touched) in self.shape.iter_mut().zip(&stored.touched) {
            for (row, block) in set_bits(touched).zip(&mut blocks) {
                window[row] = *block;
            }
        }
    }
}
