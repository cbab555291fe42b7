//! The pixels that one thread writes.

use std::mem::take;
use std::ops::Range;

use super::canvas::TILE_PX;

/// Tiles side by side, with their rows of pixels.
pub(super) struct Stretch<'a, P> {
    pub(super) columns: Range<usize>,
    /// Empty below the picture.
    rows: [&'a mut [P]; TILE_PX],
}

impl<'a, P> Stretch<'a, P> {
    /// A row of tiles, by its rows of pixels.
    pub(super) fn new(pixels: &'a mut [P], width_px: usize) -> Self {
        let mut rows = pixels.chunks_exact_mut(width_px);
        Self {
            columns: 0..width_px.div_ceil(TILE_PX),
            rows: std::array::from_fn(|_| rows.next().unwrap_or_default()),
        }
    }

    /// Its left and its right half.
    pub(super) fn halves(self) -> [Self; 2] {
        let Range { start, end } = self.columns;
        let middle = start + self.columns.len() / 2;
        let left_px = (middle - start) * TILE_PX;
        let mut rows = self
            .rows
            .map(|row| <[_; 2]>::from(row.split_at_mut(left_px.min(row.len()))));
        let [left, right] = [0, 1].map(|half| rows.each_mut().map(|row| take(&mut row[half])));
        [(start..middle, left), (middle..end, right)].map(|(columns, rows)| Self { columns, rows })
    }

    /// Some rows of some pixels of a tile, from its upper left corner.
    pub(super) fn tile(
        &mut self,
        column: usize,
        columns_px: Range<usize>,
        rows_px: Range<usize>,
    ) -> Pixels<'_, 'a, P> {
        let left_px = (column - self.columns.start) * TILE_PX;
        Pixels {
            rows: &mut self.rows[rows_px],
            within: left_px + columns_px.start..left_px + columns_px.end,
        }
    }
}

/// The pixels of a part of a tile.
pub(super) struct Pixels<'s, 'a, P> {
    rows: &'s mut [&'a mut [P]],
    within: Range<usize>,
}

impl<P> Pixels<'_, '_, P> {
    /// Its rows, from the upper one on.
    #[inline(always)]
    pub(super) fn rows(&mut self) -> impl Iterator<Item = &mut [P]> {
        let within = &self.within;
        self.rows.iter_mut().map(|row| &mut row[within.clone()])
    }
}
