use std::ops::Range;

use guideway_scene::Strip;

use super::canvas::TILE_PX;

/// The tiles of a band of the picture: whole rows of them.
#[derive(Clone, Debug, Default)]
pub(super) struct Grid {
    pub(super) columns: usize,
    pub(super) rows: Range<usize>,
}

impl Grid {
    /// The tiles of a strip.
    pub(super) fn of(strip: &Strip) -> Self {
        let rows = strip.rows();
        Self {
            columns: (strip.size().width() as usize).div_ceil(TILE_PX),
            rows: rows.start as usize / TILE_PX..(rows.end as usize).div_ceil(TILE_PX),
        }
    }

    /// Number of tiles.
    pub(super) fn len(&self) -> usize {
        self.columns * self.rows.len()
    }

    /// The number of a tile, row after row.
    #[inline(always)]
    pub(super) fn tile(&self, column: usize, row: usize) -> usize {
        (row - self.rows.start) * self.columns + column
    }
}

/// The part of a tile that is drawn: pixels from its upper left corner.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Part {
    left: u8,
    right: u8,
    top: u8,
    bottom: u8,
}

impl Part {
    pub(super) fn is_empty(self) -> bool {
        self.left >= self.right
    }

    pub(super) fn columns(self) -> Range<usize> {
        usize::from(self.left)..usize::from(self.right)
    }

    pub(super) fn rows(self) -> Range<usize> {
        usize::from(self.top)..usize::from(self.bottom)
    }

    /// The smallest that holds both.
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

/// The part of each tile of a strip that is drawn.
#[derive(Default)]
pub(super) struct Parts {
    grid: Grid,
    parts: Vec<Part>,
}

impl Parts {
    /// Draws nothing of a strip.
    pub(super) fn clear(&mut self, strip: &Strip) {
        self.grid = Grid::of(strip);
        self.parts.clear();
        self.parts.resize(self.grid.len(), Part::default());
    }

    /// Draws all of a strip.
    pub(super) fn fill(&mut self, strip: &Strip) {
        self.clear(strip);
        let rows = strip.rows();
        let rows_px = rows.start as usize..rows.end as usize;
        self.add(0..strip.size().width() as usize, rows_px);
    }

    /// Draws some columns and rows of pixels too, all of them of the strip.
    pub(super) fn add(&mut self, columns_px: Range<usize>, rows_px: Range<usize>) {
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
                let part = &mut self.parts[self.grid.tile(column, row)];
                *part = part.union(Part {
                    left,
                    right,
                    top,
                    bottom,
                });
            }
        }
    }

    /// The part of one tile.
    #[inline(always)]
    pub(super) fn at(&self, column: usize, row: usize) -> Part {
        self.parts[self.grid.tile(column, row)]
    }

    /// Columns and rows of pixels of each part.
    pub(super) fn pixels(&self) -> impl Iterator<Item = (Range<usize>, Range<usize>)> {
        let drawn = self.parts.iter().enumerate().filter(|(_, p)| !p.is_empty());
        drawn.map(|(tile, part)| {
            let (column, row) = (tile % self.grid.columns, tile / self.grid.columns);
            let corner = [column, row + self.grid.rows.start].map(|place| place * TILE_PX);
            let from =
                |corner: usize, range: Range<usize>| corner + range.start..corner + range.end;
            (
                from(corner[0], part.columns()),
                from(corner[1], part.rows()),
            )
        })
    }

    pub(super) fn bytes(&self) -> u64 {
        (self.parts.capacity() * size_of::<Part>()) as u64
    }
}

/// The tiles of some pixels.
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
    fn parts_of_tiles_hold_the_pixels_and_no_tile_beside_them() {
        let mut parts = Parts::default();
        let size = FrameSize::new(100, 70).unwrap();
        parts.clear(&Strip::whole(
            &View::new(size, Point::default(), 1.0).unwrap(),
        ));
        assert_eq!(parts.pixels().count(), 0);
        parts.add(60..70, 10..12);
        parts.add(3..3, 0..70);
        let pixels: Vec<_> = parts.pixels().collect();
        assert_eq!(pixels, [(60..64, 10..12), (64..70, 10..12)]);
        parts.add(62..63, 30..33);
        let pixels: Vec<_> = parts.pixels().collect();
        let expected = [(60..64, 10..32), (64..70, 10..12), (62..63, 32..33)];
        assert_eq!(pixels, expected);
        parts.add(0..100, 0..70);
        let area: usize = parts.pixels().map(|(x, y)| x.len() * y.len()).sum();
        assert_eq!(area, 100 * 70);
    }
}
