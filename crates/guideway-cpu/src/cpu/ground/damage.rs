//! Tiles of a strip, and the part of each tile that has to be drawn.

use std::ops::Range;

use guideway_scene::Strip;

use super::tile::TILE_PX;

/// A band of the picture in tiles: whole rows of them.
#[derive(Clone, Debug, Default)]
pub(crate) struct TileGrid {
    /// Number of tiles per row.
    pub(crate) columns: usize,
    /// Rows of tiles, counted from the top of the view.
    pub(crate) rows: Range<usize>,
}

impl TileGrid {
    /// The tiles of a strip.
    pub(crate) fn of(strip: &Strip) -> Self {
        let rows = strip.rows();
        Self {
            columns: (strip.size().width() as usize).div_ceil(TILE_PX),
            rows: rows.start as usize / TILE_PX..(rows.end as usize).div_ceil(TILE_PX),
        }
    }

    /// Number of tiles.
    pub(crate) fn len(&self) -> usize {
        self.columns * self.rows.len()
    }

    /// Index of a tile, row by row.
    #[inline(always)]
    pub(crate) fn tile(&self, column: usize, row: usize) -> usize {
        (row - self.rows.start) * self.columns + column
    }
}

/// The damaged pixels of a tile, relative to its upper left corner.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct DamageRect {
    left: u8,
    right: u8,
    top: u8,
    bottom: u8,
}

impl DamageRect {
    pub(crate) fn is_empty(self) -> bool {
        self.left >= self.right
    }

    /// Columns of pixels.
    pub(crate) fn columns(self) -> Range<usize> {
        usize::from(self.left)..usize::from(self.right)
    }

    /// Rows of pixels.
    pub(crate) fn rows(self) -> Range<usize> {
        usize::from(self.top)..usize::from(self.bottom)
    }

    /// The smallest rectangle that holds both.
    fn union(self, other: Self) -> Self {
        if self.is_empty() {
            return other;
        }
        Self {
            left: self.left.min(other.left),
            right: self.right.max(other.right),
            top: self.top.min(other.top),
            bottom: self.bottom.max(other.bottom),
        }
    }
}

/// The pixels of a strip that have to be drawn: one rectangle per tile.
#[derive(Default)]
pub(crate) struct DamageMap {
    grid: TileGrid,
    rects: Vec<DamageRect>,
}

impl DamageMap {
    /// Sets the map to an undamaged strip.
    pub(crate) fn clear(&mut self, strip: &Strip) {
        self.grid = TileGrid::of(strip);
        self.rects.clear();
        self.rects.resize(self.grid.len(), DamageRect::default());
    }

    /// Sets the map to a strip of which every pixel is damaged.
    pub(crate) fn fill(&mut self, strip: &Strip) {
        self.clear(strip);
        let rows = strip.rows();
        let rows_px = rows.start as usize..rows.end as usize;
        self.add(0..strip.size().width() as usize, rows_px);
    }

    /// Adds a rectangle of pixels of the strip.
    pub(crate) fn add(&mut self, columns_px: Range<usize>, rows_px: Range<usize>) {
        let within = |range: &Range<usize>, tile: usize| {
            let corner = tile * TILE_PX;
            let start = range.start.max(corner) - corner;
            let end = range.end.min(corner + TILE_PX) - corner;
            [start as u8, end as u8]
        };
        for row in tiles(&rows_px) {
            for column in tiles(&columns_px) {
                let [left, right] = within(&columns_px, column);
                let [top, bottom] = within(&rows_px, row);
                let rect = &mut self.rects[self.grid.tile(column, row)];
                *rect = rect.union(DamageRect {
                    left,
                    right,
                    top,
                    bottom,
                });
            }
        }
    }

    /// The damage of one tile.
    #[inline(always)]
    pub(crate) fn at(&self, column: usize, row: usize) -> DamageRect {
        self.rects[self.grid.tile(column, row)]
    }

    /// Adds the rest of each damaged tile of the strip.
    pub(crate) fn widen_to_tiles(&mut self, strip: &Strip) {
        let mut all = Self::default();
        all.fill(strip);
        for (rect, all) in self.rects.iter_mut().zip(all.rects) {
            if !rect.is_empty() {
                *rect = all;
            }
        }
    }

    /// Columns and rows of pixels of each rectangle, in pixels of the view.
    pub(crate) fn rects_px(&self) -> impl Iterator<Item = (Range<usize>, Range<usize>)> {
        let damaged = self.rects.iter().enumerate();
        let damaged = damaged.filter(|(_, rect)| !rect.is_empty());
        damaged.map(|(tile, rect)| {
            let (column, row) = (tile % self.grid.columns, tile / self.grid.columns);
            let corner = [column, row + self.grid.rows.start].map(|tile| tile * TILE_PX);
            let from =
                |corner: usize, range: Range<usize>| corner + range.start..corner + range.end;
            (
                from(corner[0], rect.columns()),
                from(corner[1], rect.rows()),
            )
        })
    }

    /// Heap bytes held.
    pub(crate) fn bytes(&self) -> u64 {
        (self.rects.capacity() * size_of::<DamageRect>()) as u64
    }
}

/// The tiles that a range of pixels overlaps.
fn tiles(range_px: &Range<usize>) -> Range<usize> {
    if range_px.is_empty() {
        return 0..0;
    }
    range_px.start / TILE_PX..range_px.end.div_ceil(TILE_PX)
}

#[cfg(test)]
mod tests {
    use guideway_scene::{FrameSize, View};
    use guideway_spline::Point;

    use super::*;

    #[test]
    fn rectangles_are_split_at_tile_borders_and_united_within() {
        let mut damage = DamageMap::default();
        let size = FrameSize::new(100, 70).unwrap();
        damage.clear(&Strip::whole(
            &View::new(size, Point::default(), 1.0).unwrap(),
        ));
        assert_eq!(damage.rects_px().count(), 0);
        damage.add(60..70, 10..12);
        damage.add(3..3, 0..70);
        let rects: Vec<_> = damage.rects_px().collect();
        assert_eq!(rects, [(60..64, 10..12), (64..70, 10..12)]);
        damage.add(62..63, 30..33);
        let rects: Vec<_> = damage.rects_px().collect();
        let expected = [(60..64, 10..32), (64..70, 10..12), (62..63, 32..33)];
        assert_eq!(rects, expected);
        let size = FrameSize::new(100, 70).unwrap();
        damage.widen_to_tiles(&Strip::whole(
            &View::new(size, Point::default(), 1.0).unwrap(),
        ));
        let rects: Vec<_> = damage.rects_px().collect();
        let expected = [(32..64, 0..32), (64..96, 0..32), (32..64, 32..64)];
        assert_eq!(rects, expected);
        damage.add(0..100, 0..70);
        let area: usize = damage.rects_px().map(|(x, y)| x.len() * y.len()).sum();
        assert_eq!(area, 100 * 70);
    }
}
