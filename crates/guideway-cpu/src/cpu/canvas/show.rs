//! What was covered becomes pixels.

use super::bits::{pixel_counts, set_bits};
use super::{Canvas, TILE_PX};
use crate::cpu::backdrop::{Backdrop, SolidColors};
use crate::cpu::span::{LAYERED, SOLID, Samples};
use crate::cpu::stretch::Pixels;
use crate::cpu::vectors::{LaneWidth, by_lane_width};

/// The colors of a part of a tile.
type Colors<'s, 'a> = Pixels<'s, 'a, [u8; 4]>;

/// How a canvas is shown.
#[derive(Clone, Copy)]
pub(in crate::cpu) enum Look<'a> {
    /// One opaque color, by how much of a pixel it covers.
    Solid(&'a Canvas<SOLID>, &'a SolidColors),
    /// Colors over what lies below them.
    Layers(&'a Canvas<LAYERED>, &'a Backdrop),
}

impl Look<'_> {
    /// Gives the pixels of a part of a tile, so wide, their colors.
    pub(in crate::cpu) fn show(
        self,
        lane_width: LaneWidth,
        width_px: usize,
        pixels: &mut Colors<'_, '_>,
    ) {
        show_by(lane_width, self, width_px, pixels);
    }
}

by_lane_width!(
    fn show_by(look: Look<'_>, width_px: usize, pixels: &mut Colors<'_, '_>)
    by show
);

#[inline(always)]
fn show(look: Look<'_>, width_px: usize, pixels: &mut Colors<'_, '_>) {
    match look {
        Look::Solid(canvas, colors) => canvas.show(width_px, colors, pixels),
        Look::Layers(canvas, backdrop) => {
            for (row, pixels) in pixels.rows().enumerate() {
                canvas.row_over(row, backdrop, pixels);
            }
        }
    }
}

impl<const C: usize> Canvas<C> {
    /// The colors of each row of pixels that were laid over the background.
    #[inline(always)]
    pub(super) fn row_over(&self, row: usize, backdrop: &Backdrop, pixels: &mut [[u8; 4]]) {
        for (pixel, sum) in pixels.iter_mut().zip(&self.sums[row]) {
            *pixel = backdrop.below::<C>(*sum);
        }
    }

    /// The pixels of a solid shape, a row after the other, by how many of their samples it covers.
    #[inline(always)]
    fn show(&self, width_px: usize, colors: &SolidColors, pixels: &mut Colors<'_, '_>) {
        let seen = 0..width_px.div_ceil(Self::WINDOW_PX);
        let touched = self.touched[seen.clone()]
            .iter()
            .fold(0, |all, flags| all | flags);
        let open = &self.open[seen];
        let filled = !open.iter().fold(0, |any, flags| any | flags);
        let empty = open.iter().fold(!touched, |all, flags| all & flags);
        for (row, pixels) in pixels.rows().enumerate() {
            if filled >> row & 1 == 1 {
                pixels.fill(colors[Samples::<SOLID>::COUNT]);
            } else if empty >> row & 1 == 1 {
                pixels.fill(colors[0]);
            } else {
                self.solid_row(row, colors, pixels);
            }
        }
    }

    /// The pixels of one row of a solid shape.
    #[inline(always)]
    fn solid_row(&self, row: usize, colors: &SolidColors, pixels: &mut [[u8; 4]]) {
        if let Ok(whole) = pixels.try_into() {
            return self.whole_row(row, colors, whole);
        }
        let mut whole = [[0; 4]; TILE_PX];
        self.whole_row(row, colors, &mut whole);
        pixels.copy_from_slice(&whole[..pixels.len()]);
    }

    /// The same for as many pixels as a tile is wide: of a number that is known, the compiler fills them by vectors. Branches are left
    /// to windows that are covered in part.
    #[inline(always)]
    fn whole_row(&self, row: usize, colors: &SolidColors, pixels: &mut [[u8; 4]; TILE_PX]) {
        let [none, all] = [colors[0], colors[Samples::<SOLID>::COUNT]];
        let mut in_part = 0;
        for (window, pixels) in pixels.chunks_exact_mut(Self::WINDOW_PX).enumerate() {
            let is_open = self.open[window] >> row & 1;
            pixels.fill(if is_open == 1 { none } else { all });
            in_part |= (is_open & self.touched[window] >> row) << window;
        }
        for window in set_bits(in_part) {
            let counts = pixel_counts::<C>(&self.shape[window % C][row]);
            let pixels = &mut pixels[window % C * Self::WINDOW_PX..][..Self::WINDOW_PX];
            for (pixel, count) in pixels.iter_mut().zip(counts) {
                *pixel = colors[usize::from(count)];
            }
        }
    }
}
