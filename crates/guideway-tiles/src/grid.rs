//! [`TileGrid`]: the square that zoom 0 shows as one tile, and the views of its parts.

use guideway_scene::{FrameSize, RenderError, View};
use guideway_spline::{Bounds, Point};

use crate::Tile;
use crate::tile::TILE_PX;

/// Width of the map of the earth in units of the grid: about a meter at middle latitudes, and a
/// power of two, so that scales are powers of two.
const EARTH_UNITS: f64 = (1 << 25) as f64;
/// Parts of a side of a plane's square, of which the layout leaves one free.
const MARGIN: f64 = 32.0;

/// The surface that a grid divides.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum GridKind {
    /// A plane, in the meters of the layout: a square around the layout, for it has no place on
    /// earth.
    Plane,
    /// The earth in Web Mercator (EPSG:3857), in units of 1 / 2^25 of its width.
    Earth,
}

/// A square and its division into 2^z x 2^z tiles at zoom z.
///
/// Its side is a power of two, and its corner a whole number of pixels of zoom 0. So every scale is
/// a power of two, and every tile begins at a whole pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TileGrid {
    kind: GridKind,
    corner: Point<f64>,
    side: f64,
}

impl TileGrid {
    /// The grid of the earth.
    pub const EARTH: Self = Self {
        kind: GridKind::Earth,
        corner: Point::new(-EARTH_UNITS / 2.0, EARTH_UNITS / 2.0),
        side: EARTH_UNITS,
    };

    /// The grid of a plane around `bounds`, in meters; `None` counts as a point at the origin.
    pub fn around(bounds: Option<Bounds<f64>>) -> Self {
        let origin = Point::new(0.0, 0.0);
        let bounds = bounds.unwrap_or(Bounds {
            min: origin,
            max: origin,
        });
        let size = bounds.size();
        let needed = size.x.max(size.y).max(1e-3) * (MARGIN / (MARGIN - 2.0));
        let side = needed.log2().ceil().exp2();
        let pixel = side / f64::from(TILE_PX);
        let center = bounds.center();
        Self {
            kind: GridKind::Plane,
            corner: Point::new(
                ((center.x - side / 2.0) / pixel).round() * pixel,
                ((center.y + side / 2.0) / pixel).round() * pixel,
            ),
            side,
        }
    }

    /// The grid of a plane by its upper left corner and its side; `None` unless the side is a power
    /// of two and the corner a whole number of pixels of zoom 0.
    pub fn plane(corner: Point<f64>, side: f64) -> Option<Self> {
        let pixel = side / f64::from(TILE_PX);
        let is_whole = |at: f64| (at / pixel).fract() == 0.0;
        let is_valid = (1e-6..=1e12).contains(&side) && side.log2().fract() == 0.0;
        (is_valid && is_whole(corner.x) && is_whole(corner.y)).then_some(Self {
            kind: GridKind::Plane,
            corner,
            side,
        })
    }

    /// The surface.
    pub fn kind(&self) -> GridKind {
        self.kind
    }

    /// Upper left corner of the square: meters of a plane, units on earth.
    pub fn corner(&self) -> Point<f64> {
        self.corner
    }

    /// Side of the square: meters of a plane, units on earth.
    pub fn side(&self) -> f64 {
        self.side
    }

    /// Pixels per meter, or per unit, of a zoom.
    pub fn px_per_m(&self, zoom: u8) -> f64 {
        f64::from(TILE_PX) * f64::from(zoom).exp2() / self.side
    }

    /// The square of a tile.
    pub fn bounds(&self, tile: Tile) -> Bounds<f64> {
        let side = self.side / f64::from(tile.z).exp2();
        let left = self.corner.x + f64::from(tile.x) * side;
        let top = self.corner.y - f64::from(tile.y) * side;
        Bounds {
            min: Point::new(left, top - side),
            max: Point::new(left + side, top),
        }
    }

    /// The first zoom of which one tile is not much larger than `bounds`: a few more show details.
    pub fn fitting_zoom(&self, bounds: Bounds<f64>) -> u8 {
        let size = bounds.size();
        let zooms = (self.side / size.x.max(size.y).max(1e-3)).log2().floor();
        zooms.clamp(0.0, f64::from(crate::MAX_ZOOM)) as u8
    }

    /// The view of a tile as the tiles that cover it, some zooms below, show it.
    ///
    /// # Errors
    /// When the layout lies too far away, or the scale is out of range.
    pub fn view(&self, tile: Tile, zooms: u8) -> Result<View, RenderError> {
        let side_px = TILE_PX << zooms;
        let size = FrameSize::new(side_px, side_px)?;
        let center = self.bounds(tile).center();
        View::new(size, center, self.px_per_m(tile.z + zooms))
    }

    /// Longitude and latitude in degrees of a point of the grid: of the map that a browser shows,
    /// of which a plane takes the whole.
    pub(crate) fn degrees(&self, at: Point<f64>) -> Point<f64> {
        let from_left = (at.x - self.corner.x) / self.side;
        let from_top = (self.corner.y - at.y) / self.side;
        let latitude = (std::f64::consts::PI * (1.0 - 2.0 * from_top))
            .sinh()
            .atan();
        Point::new(360.0 * from_left - 180.0, latitude.to_degrees())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn plane_holds_its_bounds_with_a_margin_and_begins_at_whole_pixels() {
        for (min, max) in [
            ((0.0, 0.0), (10.0, 3.0)),
            ((-7.3e6, 1e5), (-7.2e6, 3e5)),
            ((4.0, 5.0), (4.0, 5.0)),
        ] {
            let [min, max] = [min, max].map(|(x, y)| Point::new(x, y));
            let grid = TileGrid::around(Some(Bounds { min, max }));
            let square = grid.bounds(Tile::WORLD);
            let inner = square.inflated(-grid.side() / 64.0);
            assert!(inner.contains(min) && inner.contains(max), "{grid:?}");
            assert_eq!(TileGrid::plane(grid.corner(), grid.side()), Some(grid));
            let off = grid.corner() + Point::new(grid.side() / 1000.0, 0.0);
            assert_eq!(TileGrid::plane(off, grid.side()), None);
            assert_eq!(TileGrid::plane(grid.corner(), 0.9 * grid.side()), None);
            assert!(grid.px_per_m(3).log2().fract() == 0.0);
            assert!((square.min.x * grid.px_per_m(0)).fract() == 0.0);
            assert!((square.max.y * grid.px_per_m(0)).fract() == 0.0);
        }
    }

    #[test]
    fn tiles_divide_the_square_from_its_upper_left_corner() {
        let grid = TileGrid::EARTH;
        let world = grid.bounds(Tile::WORLD);
        let first = grid.bounds(Tile::new(1, 0, 0).unwrap());
        assert_eq!(first.min, Point::new(world.min.x, 0.0));
        assert_eq!(first.max, Point::new(0.0, world.max.y));
        let view = grid.view(Tile::new(2, 3, 0).unwrap(), 1).unwrap();
        assert_eq!(
            view.world_bounds(),
            grid.bounds(Tile::new(2, 3, 0).unwrap())
        );
        assert_eq!(view.size().width(), 2 * TILE_PX);
        let corner = grid.degrees(Point::new(world.min.x, world.max.y));
        assert!((corner.x + 180.0).abs() < 1e-9 && (corner.y - 85.051_128_8).abs() < 1e-6);
        assert!(grid.degrees(Point::new(0.0, 0.0)).norm() < 1e-9);
    }
}
