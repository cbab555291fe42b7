//! Resolves coverage masks to RGBA.

use super::background::{Background, SolidRamp};
use super::bits::{pixel_counts, set_bits};
use super::coverage_mask::CoverageMask;
use super::tile_rows::TilePixels;
use crate::cpu::ground::samples::{LAYERED, SOLID, SamplePattern};
use crate::cpu::ground::simd::{SimdLevel, simd_dispatch};
use crate::cpu::ground::tile::TILE_PX;

/// Pixels per window of a solid mask.
const WINDOW_PX: usize = CoverageMask::<SOLID>::WINDOW_PX;

/// The colors of a part of a tile.
type Colors<'s, 'a> = TilePixels<'s, 'a, [u8; 4]>;

/// A mask and the colors that it resolves to.
#[derive(Clone, Copy)]
pub(crate) enum ResolveSource<'a> {
    /// One opaque color: a ramp by the number of covered samples.
    Solid(&'a CoverageMask<SOLID>, &'a SolidRamp),
    /// Composited colors over the background.
    Layered(&'a CoverageMask<LAYERED>, &'a Background),
}

impl ResolveSource<'_> {
    /// Writes the colors of the `width_px` leftmost pixels of each row.
    pub(crate) fn resolve(self, simd: SimdLevel, width_px: usize, pixels: &mut Colors<'_, '_>) {
        resolve_by(simd, self, width_px, pixels);
    }
}

simd_dispatch!(
    fn resolve_by(source: ResolveSource<'_>, width_px: usize, pixels: &mut Colors<'_, '_>)
    by resolve
);

#[inline(always)]
fn resolve(source: ResolveSource<'_>, width_px: usize, pixels: &mut Colors<'_, '_>) {
    match source {
        ResolveSource::Solid(mask, ramp) => resolve_solid(mask, width_px, ramp, pixels),
        ResolveSource::Layered(mask, background) => {
            for (row, pixels) in pixels.rows().enumerate() {
                resolve_layered_row(mask, row, background, pixels);
            }
        }
    }
}

/// Resolves one row of composited colors.
#[inline(always)]
pub(super) fn resolve_layered_row(
    mask: &CoverageMask<LAYERED>,
    row: usize,
    background: &Background,
    pixels: &mut [[u8; 4]],
) {
    for (pixel, sum) in pixels.iter_mut().zip(&mask.sums[row]) {
        *pixel = background.composite::<LAYERED>(*sum);
    }
}

/// Resolves a solid mask row by row.
#[inline(always)]
fn resolve_solid(
    mask: &CoverageMask<SOLID>,
    width_px: usize,
    ramp: &SolidRamp,
    pixels: &mut Colors<'_, '_>,
) {
    let seen = 0..width_px.div_ceil(WINDOW_PX);
    let touched = mask.touched[seen.clone()]
        .iter()
        .fold(0, |all, flags| all | flags);
    let open = &mask.open[seen];
    let full = !open.iter().fold(0, |any, flags| any | flags);
    let empty = open.iter().fold(!touched, |all, flags| all & flags);
    for (row, pixels) in pixels.rows().enumerate() {
        if full >> row & 1 == 1 {
            pixels.fill(ramp[SamplePattern::<SOLID>::COUNT]);
        } else if empty >> row & 1 == 1 {
            pixels.fill(ramp[0]);
        } else {
            resolve_solid_row(mask, row, ramp, pixels);
        }
    }
}

/// Resolves one row of a solid mask.
#[inline(always)]
fn resolve_solid_row(
    mask: &CoverageMask<SOLID>,
    row: usize,
    ramp: &SolidRamp,
    pixels: &mut [[u8; 4]],
) {
    if let Ok(full_width) = pixels.try_into() {
        return resolve_full_width(mask, row, ramp, full_width);
    }
    let mut full_width = [[0; 4]; TILE_PX];
    resolve_full_width(mask, row, ramp, &mut full_width);
    pixels.copy_from_slice(&full_width[..pixels.len()]);
}

/// Resolves a row as wide as a tile: the fixed width lets the compiler use vectors. Branches are
/// left to windows that are covered in part.
#[inline(always)]
fn resolve_full_width(
    mask: &CoverageMask<SOLID>,
    row: usize,
    ramp: &SolidRamp,
    pixels: &mut [[u8; 4]; TILE_PX],
) {
    let [none, all] = [ramp[0], ramp[SamplePattern::<SOLID>::COUNT]];
    let mut in_part = 0;
    for (window, pixels) in pixels.chunks_exact_mut(WINDOW_PX).enumerate() {
        let is_open = mask.open[window] >> row & 1;
        pixels.fill(if is_open == 1 { none } else { all });
        in_part |= (is_open & mask.touched[window] >> row) << window;
    }
    for window in set_bits(in_part) {
        let counts = pixel_counts::<SOLID>(&mask.shape[window % SOLID][row]);
        let pixels = &mut pixels[window % SOLID * WINDOW_PX..][..WINDOW_PX];
        for (pixel, count) in pixels.iter_mut().zip(counts) {
            *pixel = ramp[usize::from(count)];
        }
    }
}
