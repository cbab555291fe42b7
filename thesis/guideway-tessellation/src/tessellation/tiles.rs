//! Tiles of a picture that exceeds the viewport of the device or the budget.

use guideway_scene::FrameSize;

/// Side of the square viewport, in pixels. A power of two makes division exact, so that lines are
/// equal in all tiles. Lines outside the tile but inside the viewport are not clipped.
const VIEWPORT_SIDE: u32 = 1 << 14;

/// A picture in tiles of equal size; those at the right and bottom border show less.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Tiling {
    size: FrameSize,
    viewport_side: u32,
    /// Size of a tile, in pixels.
    pub(super) width: u32,
    pub(super) height: u32,
}

/// A rectangle of the picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Tile {
    /// The upper left pixel.
    pub(super) x: u32,
    pub(super) y: u32,
    pub(super) width: u32,
    pub(super) height: u32,
    pub(super) viewport_side: u32,
}

impl Tiling {
    /// The fewest tiles within the longest side of the device and a number of pixels. Returns
    /// `None` when the pixels do not suffice for one row of a tile.
    pub(super) fn new(size: FrameSize, longest_side: u32, max_pixels: u64) -> Option<Self> {
        let viewport_side = longest_side.min(VIEWPORT_SIDE).checked_ilog2()?;
        let viewport_side = 1 << viewport_side;
        let side = viewport_side / 2;
        let width = size.width().min(side);
        let rows = max_pixels.checked_div(u64::from(width))?;
        let height = u64::from(size.height().min(side)).min(rows) as u32;
        (height > 0).then_some(Self {
            size,
            viewport_side,
            width,
            height,
        })
    }

    /// Number of tiles.
    pub(super) fn count(&self) -> u32 {
        self.size.width().div_ceil(self.width) * self.size.height().div_ceil(self.height)
    }

    /// The upper left tile.
    pub(super) fn first(&self) -> Tile {
        self.tile(0, 0)
    }

    /// All tiles.
    pub(super) fn tiles(self) -> impl Iterator<Item = Tile> {
        let rows = (0..self.size.height()).step_by(self.height as usize);
        rows.flat_map(move |y| {
            let columns = (0..self.size.width()).step_by(self.width as usize);
            columns.map(move |x| self.tile(x, y))
        })
    }

    fn tile(&self, x: u32, y: u32) -> Tile {
        Tile {
            x,
            y,
            width: self.width.min(self.size.width() - x),
            height: self.height.min(self.size.height() - y),
            viewport_side: self.viewport_side,
        }
    }
}

impl Tile {
    /// The pixel of the tile at the center of the viewport.
    pub(super) fn viewport_center(&self) -> (u32, u32) {
        (self.width / 2, self.height / 2)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tiling(width: u32, height: u32, side: u32, pixels: u64) -> Option<Tiling> {
        Tiling::new(FrameSize::new(width, height).unwrap(), side, pixels)
    }

    #[test]
    fn tiles_cover_every_pixel_once() {
        for (width, height, side, pixels) in [
            (100, 70, 1 << 14, u64::MAX),
            (100, 70, 64, u64::MAX),
            (100, 70, 64, 100),
            (1, 70, 5, 3),
            (65_535, 1, 16_384, u64::MAX),
        ] {
            let tiling = tiling(width, height, side, pixels).unwrap();
            let mut covered = vec![0_u8; (width * height) as usize];
            for tile in tiling.tiles() {
                assert!(tile.width * 2 <= side && u64::from(tile.width * tile.height) <= pixels);
                for y in tile.y..tile.y + tile.height {
                    for x in tile.x..tile.x + tile.width {
                        covered[(y * width + x) as usize] += 1;
                    }
                }
            }
            assert!(covered.iter().all(|&times| times == 1));
            assert_eq!(tiling.tiles().count(), tiling.count() as usize);
        }
    }

    #[test]
    fn returns_none_when_a_row_does_not_fit() {
        assert_eq!(tiling(100, 70, 1 << 14, 99), None);
        assert_eq!(tiling(100, 70, 0, u64::MAX), None);
    }
}
