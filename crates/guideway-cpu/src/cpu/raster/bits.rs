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

/// The samples of a window whose first column is `left` that are set from `first` to `end`
/// (exclusive), row by row.
#[cfg(not(all(target_arch = "wasm32", target_feature = "simd128")))]
#[inline(always)]
pub(crate) fn window_bits(first: &[u32; ROWS], end: &[u32; ROWS], left: u32) -> SampleBlock {
    let mut block = [0; ROWS];
    for ((word, &first), &end) in block.iter_mut().zip(first).zip(end) {
        *word = high_bits(first.max(left) - left) ^ high_bits(end.max(left) - left);
    }
    block
}

/// As elsewhere. The vectors of browsers have no shift by a number per lane, but a byte of the
/// result has only nine values: a look-up by [`u8x16_swizzle`] finds all at once.
#[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
#[inline(always)]
pub(crate) fn window_bits(first: &[u32; ROWS], end: &[u32; ROWS], left: u32) -> SampleBlock {
    use std::arch::wasm32::{
        u8x16, u8x16_min, u8x16_shuffle, u8x16_splat, u8x16_sub_sat, u8x16_swizzle, u32x4,
        u32x4_extract_lane, u32x4_max, u32x4_min, u32x4_splat, u32x4_sub, v128, v128_xor,
    };
    /// Sample rows per vector.
    const STEP: usize = 4;
    let high_bits = |of: &[u32; ROWS], i: usize| -> v128 {
        let at = u32x4(of[i], of[i + 1], of[i + 2], of[i + 3]);
        let left = u32x4_splat(left);
        let count = u32x4_min(u32x4_sub(u32x4_max(at, left), left), u32x4_splat(u32::BITS));
        let bytes =
            u8x16_shuffle::<0, 0, 0, 0, 4, 4, 4, 4, 8, 8, 8, 8, 12, 12, 12, 12>(count, count);
        let below = u8x16(0, 8, 16, 24, 0, 8, 16, 24, 0, 8, 16, 24, 0, 8, 16, 24);
        let of_byte = u8x16_min(u8x16_sub_sat(bytes, below), u8x16_splat(u8::BITS as u8));
        let high = u8x16(
            0xFF, 0xFE, 0xFC, 0xF8, 0xF0, 0xE0, 0xC0, 0x80, 0, 0, 0, 0, 0, 0, 0, 0,
        );
        u8x16_swizzle(high, of_byte)
    };
    let mut block = [0; ROWS];
    for (step, words) in block.chunks_exact_mut(STEP).enumerate() {
        let bits = v128_xor(high_bits(first, step * STEP), high_bits(end, step * STEP));
        words[0] = u32x4_extract_lane::<0>(bits);
        words[1] = u32x4_extract_lane::<1>(bits);
        words[2] = u32x4_extract_lane::<2>(bits);
        words[3] = u32x4_extract_lane::<3>(bits);
    }
    block
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
