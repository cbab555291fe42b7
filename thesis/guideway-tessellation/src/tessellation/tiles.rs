//! Pictures that are larger than the device draws at once, or than the budget holds.

use guideway_scene::FrameSize;

/// Side of the square that is drawn through, in pixels: a power of two, so that dividing by it is exact and
/// lines are the same in every tile. What is outside of a tile but within the square is not clipped.
const VIEWPORT_SIDE: u32 = 1 << 14;

/// A picture in tiles of one size; those at the right and lower border show less.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Tiling {
    size: FrameSize,
    viewport_side: u32,
    /// Size of a tile.
    pub(super) width: u32,
    pub(super) height: u32,
}

/// A part of the picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Tile {
    /// Its upper left pixel.
    pub(super) x: u32,
    pub(super) y: u32,
    pub(super) width: u32,
    pub(super) height: u32,
    pub(super) viewport_side: u32,
}

impl Tiling {
    /// The fewest tiles within a device's longest side and a number of pixels; none if those are less than
    /// one row of a tile.
    pub(super) fn new(size: FrameSize, longest_side: u32, most_pixels: u64) -> Option<Self> {
        let viewport_side = longest_side.min(VIEWPORT_SIDE).checked_ilog2()?;
        let viewport_side = 1 << viewport_side;
        let side = viewport_side / 2;
        let width = size.width().min(side);
        let rows = most_pixels.checked_div(u64::from(width))?;
        let height = u64::from(size.height().min(side)).min(rows) as u32;
        (height > 0).then_some(Self {
            size,
            viewport_side,
            width,
            height,
        })
    }

    /// How many tiles there are.
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
    /// The pixel of the tile that is in the middle of the viewport.
    pub(super) fn viewport_middle(&self) -> (u32, u32) {
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
            let mut seen = vec![0_u8; (width * height) as usize];
            for tile in tiling.tiles() {
                assert!(tile.width * 2 <= side && u64::from(tile.width * tile.height) <= pixels);
                for y in tile.y..tile.y + tile.height {
                    for x in tile.x..tile.x + tile.width {
                        seen[(y * width + x) as usize] += 1;
                    }
                }
            }
            assert!(seen.iter().all(|&times| times == 1));
            assert_eq!(tiling.tiles().count(), tiling.count() as usize);
        }
    }

    #[test]
    fn no_tile_is_less_than_a_row() {
        assert_eq!(tiling(100, 70, 1 << 14, 99), None);
        assert_eq!(tiling(100, 70, 0, u64::MAX), None);
    }
}
