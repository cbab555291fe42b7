//! [`Tile`]: the address of a tile, and its number in an archive.

/// The deepest zoom: a pixel of a map of the earth is half a millimeter then.
pub const MAX_ZOOM: u8 = 28;

/// Width and height of a raster tile, in pixels.
pub const TILE_PX: u32 = 256;

/// Address of a tile: zoom z has 2^z columns from the left and as many rows from the top.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Tile {
    /// Zoom: 0 to [`MAX_ZOOM`].
    pub z: u8,
    /// Column, from the left.
    pub x: u32,
    /// Row, from the top.
    pub y: u32,
}

impl Tile {
    /// The tile of zoom 0.
    pub const WORLD: Self = Self { z: 0, x: 0, y: 0 };

    /// A tile; `None` if the zoom has no such column or row, or is beyond [`MAX_ZOOM`].
    pub fn new(z: u8, x: u32, y: u32) -> Option<Self> {
        let exists = z <= MAX_ZOOM && x.max(y) < 1 << z;
        exists.then_some(Self { z, x, y })
    }

    /// The four tiles of the next zoom that cover this one, in the order of their numbers.
    pub(crate) fn children(self) -> [Self; 4] {
        let child = |i: u32| Self {
            z: self.z + 1,
            x: 2 * self.x + i % 2,
            y: 2 * self.y + i / 2,
        };
        let mut all = [0, 1, 2, 3].map(child);
        all.sort_by_key(|tile| tile.id());
        all
    }

    /// The tile, some zooms above, that this one is a part of.
    pub(crate) fn above(self, zooms: u8) -> Self {
        Self {
            z: self.z - zooms,
            x: self.x >> zooms,
            y: self.y >> zooms,
        }
    }

    /// All tiles, some zooms below, that cover this one, in the order of their numbers.
    pub(crate) fn descendants(self, zooms: u8) -> Vec<Self> {
        let mut tiles = vec![self];
        for _ in 0..zooms {
            tiles = tiles.into_iter().flat_map(Self::children).collect();
        }
        tiles
    }

    /// Number of the tile in an archive: the tiles of all zooms above come before it, then those
    /// of its zoom along a Hilbert curve (PMTiles, version 3, section "tile ID").
    pub fn id(self) -> u64 {
        tiles_above(self.z) + self.index()
    }

    /// Number of the last tile, some zooms below, within this one.
    pub(crate) fn last_id(self, zooms: u8) -> u64 {
        tiles_above(self.z + zooms) + ((self.index() + 1) << (2 * zooms)) - 1
    }

    /// Number of the tile along the Hilbert curve of its zoom.
    pub(crate) fn index(self) -> u64 {
        let (mut x, mut y) = (self.x, self.y);
        let mut index = 0;
        for bit in (0..self.z).rev() {
            let (right, below) = (x >> bit & 1, y >> bit & 1);
            index = index << 2 | u64::from((3 * right) ^ below);
            if below == 0 {
                if right == 1 {
                    // Only the bits below this one count from here on.
                    (x, y) = (!x, !y);
                }
                (x, y) = (y, x);
            }
        }
        index
    }
}

/// Number of tiles of all zooms above one.
fn tiles_above(zoom: u8) -> u64 {
    ((1 << (2 * zoom)) - 1) / 3
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_those_of_the_specification() {
        // The table of the specification, and the last tile of zoom 8.
        let known = [
            ((0, 0, 0), 0),
            ((1, 0, 0), 1),
            ((1, 0, 1), 2),
            ((1, 1, 1), 3),
            ((1, 1, 0), 4),
            ((2, 0, 0), 5),
            ((12, 3423, 1763), 19_078_479),
        ];
        for ((z, x, y), id) in known {
            assert_eq!(Tile::new(z, x, y).unwrap().id(), id, "{z}/{x}/{y}");
        }
        assert_eq!(Tile::new(3, 8, 0), None);
        assert_eq!(Tile::new(MAX_ZOOM + 1, 0, 0), None);
    }

    #[test]
    fn descendants_are_in_the_order_of_their_numbers_without_gaps() {
        for parent in Tile::WORLD.descendants(3) {
            let ids = parent.descendants(2).into_iter().map(Tile::id);
            let first = parent.descendants(2)[0].id();
            assert!(ids.eq(first..first + 16), "{parent:?}");
            assert_eq!(parent.last_id(2), first + 15);
            for tile in parent.descendants(2) {
                assert_eq!(tile.above(2), parent);
            }
        }
    }
}
