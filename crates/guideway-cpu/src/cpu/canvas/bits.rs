//! Words whose bits stand for samples, pixels or rows.

use super::{Block, MOST_WINDOW_PX};

/// The pixels of a word all of whose samples are set, a bit each.
#[inline(always)]
pub(super) fn full_pixels<const C: usize>(word: u32) -> u32 {
    // A sum carries into the highest bit of a pixel if all below it are set.
    let high = high_bits_of_pixels::<C>();
    let full = ((word & !high) + (high >> (C - 1))) & word & high;
    if C == 16 {
        return full >> 15 & 1 | full >> 30;
    }
    // Brings every eighth bit together, in the highest ones.
    full.wrapping_mul(1 << 21 | 1 << 14 | 1 << 7 | 1) >> 28
}

/// The highest bit of each pixel of a word.
const fn high_bits_of_pixels<const C: usize>() -> u32 {
    if C == 16 { 0x8000_8000 } else { 0x8080_8080 }
}

/// The numbers of the bits that are set.
#[inline(always)]
pub(in crate::cpu) fn set_bits(mut bits: u32) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        let lowest = (bits != 0).then(|| bits.trailing_zeros() as usize);
        bits &= bits.wrapping_sub(1);
        lowest
    })
}

/// A word with its lowest `count` bits set: all, if that is more than it has.
#[inline(always)]
pub(super) fn low_bits(count: u32) -> u32 {
    !high_bits(count)
}

/// A word without its lowest `count` bits: none, if that is all it has.
#[inline(always)]
pub(super) fn high_bits(count: u32) -> u32 {
    // As a choice between two values this is one instruction on a vector.
    u32::MAX.unbounded_shl(count)
}

/// How many samples are set of each pixel of a block: bits are summed within bytes, then bytes within pixels.
#[inline(always)]
pub(super) fn pixel_counts<const C: usize>(block: &Block) -> [u16; MOST_WINDOW_PX] {
    let bytes: [u8; size_of::<Block>()] = bytemuck::cast(*block);
    let mut counts = [0; size_of::<Block>()];
    for (count, byte) in counts.iter_mut().zip(bytes) {
        *count = byte.count_ones() as u8;
    }
    let counts: Block = bytemuck::cast(counts);
    // At most 8 a word, so 128 in all: the bytes do not overflow.
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
