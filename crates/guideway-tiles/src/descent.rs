//! Finds the blocks of tiles that paths meet: from the whole square down, with ever fewer paths.

use guideway_layout::RunPoints;
use guideway_scene::Scene;
use guideway_spline::{Bounds, Point, Real, greater, lesser, uniform};
use rayon::prelude::*;

use crate::{Tile, TileGrid};

/// Paths from which on all threads filter them.
const MANY_PATHS: usize = 1 << 12;

/// Most halvings of a segment: enough for one across 2^16 tiles.
const MAX_HALVINGS: u32 = 18;

/// The shown paths of a scene over a grid.
#[derive(Clone, Copy)]
pub(crate) struct Descent<'a> {
    pub(crate) scene: &'a Scene,
    pub(crate) grid: &'a TileGrid,
    /// Distance from a path up to which it touches a tile, in meters of the grid.
    pub(crate) reach_m: f64,
}

impl Descent<'_> {
    /// Calls `visit` with each tile of a zoom that paths may touch, in the order of their numbers,
    /// and with the rows of these paths in draw order. Descends into the tiles above that pass
    /// `is_wanted`.
    ///
    /// # Errors
    /// Those of `visit`.
    pub(crate) fn for_each<E>(
        &self,
        zoom: u8,
        is_wanted: &impl Fn(Tile) -> bool,
        visit: &mut impl FnMut(Tile, &[u32]) -> Result<(), E>,
    ) -> Result<(), E> {
        self.descend(Tile::WORLD, self.scene.draw_order(), zoom, is_wanted, visit)
    }

    /// As [`Self::for_each`], from a tile and the rows of the paths that may touch it on.
    pub(crate) fn descend<E>(
        &self,
        tile: Tile,
        above: &[u32],
        zoom: u8,
        is_wanted: &impl Fn(Tile) -> bool,
        visit: &mut impl FnMut(Tile, &[u32]) -> Result<(), E>,
    ) -> Result<(), E> {
        if !is_wanted(tile) {
            return Ok(());
        }
        let rows = self.touching(tile, above);
        if rows.is_empty() {
            return Ok(());
        }
        if tile.z == zoom {
            return visit(tile, &rows);
        }
        for child in tile.children() {
            self.descend(child, &rows, zoom, is_wanted, visit)?;
        }
        Ok(())
    }

    /// The rows among some that may touch a tile, in their order.
    pub(crate) fn touching(&self, tile: Tile, rows: &[u32]) -> Vec<u32> {
        let square = self.grid.bounds(tile).inflated(self.reach_m);
        let touches = |row: &u32| self.touches(*row as usize, square);
        match rows.len() < MANY_PATHS {
            true => rows.iter().copied().filter(|row| touches(row)).collect(),
            false => rows.par_iter().copied().filter(touches).collect(),
        }
    }

    /// Returns `true` if a segment of a path may meet a square.
    fn touches(&self, row: usize, square: Bounds<f64>) -> bool {
        let Some(hull) = self.scene.hulls().of([row]) else {
            return false;
        };
        if !hull.intersects(square) {
            return false;
        }
        // Most hulls are smaller than the square or within it: their segments say no more.
        let is_within = square.contains(hull.min) && square.contains(hull.max);
        let (size, side) = (hull.size(), square.size().x);
        if is_within || size.x.max(size.y) <= side / 4.0 {
            return true;
        }
        let mut runs = self.scene.layout().paths.geometry().runs(row);
        runs.any(|run| match run {
            RunPoints::F32(points) => has_segment_in(points, square),
            RunPoints::F64(points) => has_segment_in(points, square),
        })
    }
}

/// Returns `true` if a segment may meet a square.
fn has_segment_in<T: Real>(points: &[Point<T>], square: Bounds<f64>) -> bool {
    let mut segments = points.array_windows();
    segments.any(|segment: &[Point<T>; 4]| {
        segment_hull(segment).intersects(square)
            && meets(&segment.map(Point::to_f64), square, MAX_HALVINGS)
    })
}

/// Returns `true` if a segment may meet a square, by the hulls of parts of it that are small beside
/// the square. The hull of a long diagonal line is mostly empty.
fn meets(segment: &[Point<f64>; 4], square: Bounds<f64>, halvings: u32) -> bool {
    let hull = segment_hull(segment);
    let size = hull.size();
    let is_small = size.x.max(size.y) <= square.size().x / 4.0;
    hull.intersects(square)
        && (is_small || halvings == 0 || {
            let mut halves = uniform::halves(segment).into_iter();
            halves.any(|half| meets(&half, square, halvings - 1))
        })
}

/// Box of the control points of a segment.
pub(crate) fn segment_hull<T: Real>(segment: &[Point<T>; 4]) -> Bounds<f64> {
    let [first, rest @ ..] = segment.map(|p| p.to_f64());
    let mut hull = Bounds {
        min: first,
        max: first,
    };
    for p in rest {
        hull.min = Point::new(lesser(p.x, hull.min.x), lesser(p.y, hull.min.y));
        hull.max = Point::new(greater(p.x, hull.max.x), greater(p.y, hull.max.y));
    }
    hull
}
