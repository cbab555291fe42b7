//! Mutable access to the pixels of a row of tiles: splits them into halves for threads, and returns
//! the pixels of one tile.

use std::mem::take;
use std::ops::Range;

use crate::cpu::ground::tile::TILE_PX;

/// Neighboring tiles with their rows of pixels.
pub(crate) struct TileRows<'a, P> {
    pub(crate) columns: Range<usize>,
    /// Rows below the picture are empty.
    rows: [&'a mut [P]; TILE_PX],
}

impl<'a, P> TileRows<'a, P> {
    /// All tiles of a row, from its rows of pixels.
    pub(crate) fn new(pixels: &'a mut [P], width_px: usize) -> Self {
        let mut rows = pixels.chunks_exact_mut(width_px);
        Self {
            columns: 0..width_px.div_ceil(TILE_PX),
            rows: std::array::from_fn(|_| rows.next().unwrap_or_default()),
        }
    }

    /// Splits it into a left and a right half.
    pub(crate) fn halves(self) -> [Self; 2] {
        let Range { start, end } = self.columns;
        let middle = start + self.columns.len() / 2;
        let left_px = (middle - start) * TILE_PX;
        let mut rows = self
            .rows
            .map(|row| <[_; 2]>::from(row.split_at_mut(left_px.min(row.len()))));
        let [left, right] = [0, 1].map(|half| rows.each_mut().map(|row| take(&mut row[half])));
        [(start..middle, left), (middle..end, right)].map(|(columns, rows)| Self { columns, rows })
    }

    /// A rectangle of the pixels of a tile, relative to its upper left corner.
    pub(crate) fn tile(
        &mut self,
        column: usize,
        columns_px: Range<usize>,
        rows_px: Range<usize>,
    ) -> TilePixels<'_, 'a, P> {
        let left_px = (column - self.columns.start) * TILE_PX;
        TilePixels {
            rows: &mut self.rows[rows_px],
            within: left_px + columns_px.start..left_px + columns_px.end,
        }
    }
}

/// A rectangle of the pixels of a tile.
pub(crate) struct TilePixels<'s, 'a, P> {
    rows: &'s mut [&'a mut [P]],
    within: Range<usize>,
}

impl<P> TilePixels<'_, '_, P> {
    /// Its rows, from top to bottom.
    #[inline(always)]
    pub(crate) fn rows(&mut self) -> impl Iterator<Item = &mut [P]> {
        let within = &self.within;
        self.rows.iter_mut().map(|row| &mut row[within.clone()])
    }
}
