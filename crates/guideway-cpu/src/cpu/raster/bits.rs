//! Bit operations on words of samples, pixels or rows.

use crate::cpu::ground::samples::{ROWS, SOLID};

/// Sample columns per window: neighboring pixels that share a block. A tile of `C` columns per
/// pixel has `C` windows.
pub(crate) const WINDOW_COLUMNS: usize = u32::BITS as usize;
/// Most pixels per window.
pub(crate) const MAX_WINDOW_PX: usize = WINDOW_COLUMNS / SOLID;

/// The samples of one row of pixels of a window: a word per row of samples.
pub(crate) type SampleBlock = [u32; ROWS];

/// Marks the pixels of a word all of whose samples are set.
#[inline(always)]
pub(crate) fn full_pixels<const C: usize>(word: u32) -> u32 {
    // The sum carries into the highest bit of a pixel if all bits below it are set.
    let high = high_bits_of_pixels::<C>();
    let full = ((word & !high) + (high >> (C - 1))) & word & high;
    if C == 16 {
        return full >> 15 & 1 | full >> 30;
    }
    // The product gathers every eighth bit in the highest four.
    full.wrapping_mul(1 << 21 | 1 << 14 | 1 << 7 | 1) >> 28
}

/// The highest bit of each pixel of a word.
const fn high_bits_of_pixels<const C: usize>() -> u32 {
    if C == 16 { 0x8000_8000 } else { 0x8080_8080 }
}

/// Indices of the bits that are set, ascending.
#[inline(always)]
pub(crate) fn set_bits(mut bits: u32) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        let lowest = (bits != 0).then(|| bits.trailing_zeros() as usize);
        bits &= bits.wrapping_sub(1);
        lowest
    })
}

/// A word with its lowest `count` bits set; with all, if it has fewer.
#[inline(always)]
pub(crate) fn low_bits(count: u32) -> u32 {
    !high_bits(count)
}

/// A word without its lowest `count` bits; 0, if it has fewer.
#[inline(always)]
pub(crate) fn high_bits(count: u32) -> u32 {
    // A select, which is one vector instruction.
    u32::MAX.unbounded_shl(count)
}

/// Number of samples set per pixel of a block: sums bits within bytes, then bytes within pixels.
#[inline(always)]
pub(crate) fn pixel_counts<const C: usize>(block: &SampleBlock) -> [u16; MAX_WINDOW_PX] {
    let bytes: [u8; size_of::<SampleBlock>()] = bytemuck::cast(*block);
    let mut counts = [0; size_of::<SampleBlock>()];
    for (count, byte) in counts.iter_mut().zip(bytes) {
        *count = byte.count_ones() as u8;
    }
    let counts: SampleBlock = bytemuck::cast(counts);
    // At most 8 per word, 128 in all: the bytes do not overflow.
    let mut sums = 0;
    for words in counts {
        sums += words;
    }
    let bytes = u32::to_le_bytes(sums).map(u16::from);
    std::array::from_fn(|pixel| {
        let of_pixel = bytes.iter().skip(pixel * C / 8).take(C / 8);
        of_pixel.sum()
    })
}
