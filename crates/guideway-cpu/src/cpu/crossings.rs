//! Which tiles the lines of wide clusters cross: of a cluster seen from near, most tiles within its box see next to nothing.

use std::ops::Range;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use guideway_spline::{Point, greater, lesser};
use rayon::prelude::*;

use super::canvas::TILE_PX;
use super::cluster::Lines;
use super::index::Index;
use super::polylines::Coordinate;
use super::shot::Shot;
use super::sight::{Sight, Sights};
use super::stroke::Placed;
use super::threads::{own, sum};
use super::tiles::{Grid, Parts};

/// Tiles within the box of a cluster, at least, from which on it pays to list its lines where they lie.
const LEAST_TILES: usize = 64;
/// Lines of such a cluster for each of the tiles, at most: of more, each tile rather looks at all.
const MOST_LINES_A_TILE: usize = 8;
/// More than all by which lines are rounded where they are drawn.
const MARGIN_PX: f32 = 0.25;

/// Lines of a piece that may leave a mark on a tile.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Crossing {
    /// Key of the cluster's sight.
    pub(super) key: u32,
    pub(super) piece: u32,
    /// The vertices where they begin: the first, and that behind the last.
    pub(super) begins: [u32; 2],
}

/// What crosses which tile, cluster by cluster.
pub(super) struct Crossings {
    /// Tiles within the box of a cluster from which on it may be listed by its lines.
    pub(super) least_tiles: usize,
    /// Keys of the clusters that are.
    keys: Vec<u32>,
    /// The tiles that each crosses, at least as many lists as keys.
    of_clusters: Vec<Vec<(u32, Crossing)>>,
    /// For each thread and tile, where in its list the tile was last entered.
    entries: Vec<Mutex<Vec<u32>>>,
}

/// A frame whose lines are there.
#[derive(Clone, Copy)]
pub(super) struct Drawn<'a> {
    pub(super) shot: &'a Shot<'a>,
    pub(super) index: &'a Index,
    pub(super) sights: &'a Sights,
    pub(super) parts: &'a Parts,
    pub(super) grid: &'a Grid,
}

/// Lines as they lie in the picture, in pixels.
type Lying<'a, T> = Placed<'a, T, 1>;

impl Crossings {
    pub(super) fn new() -> Self {
        Self {
            least_tiles: LEAST_TILES,
            keys: Vec::new(),
            of_clusters: Vec::new(),
            entries: Vec::new(),
        }
    }

    /// Finds those of all wide clusters, unless there are more than `most`; then of none.
    pub(super) fn find(&mut self, drawn: Drawn<'_>, most: usize) {
        let is_wide = |sight: &Sight| {
            let tiles = sight.columns().len() * sight.rows().len();
            let lines = || drawn.index.made[sight.cluster as usize].paths_and_lines[1];
            tiles >= self.least_tiles && lines() as usize <= MOST_LINES_A_TILE * tiles
        };
        self.keys.clear();
        let wide = drawn.sights.with_keys().filter(|(_, s)| is_wide(s));
        self.keys.extend(wide.map(|(key, _)| key));
        if self.of_clusters.len() < self.keys.len() {
            self.of_clusters.resize_with(self.keys.len(), Vec::new);
        }
        self.entries
            .resize_with(rayon::current_num_threads(), Mutex::default);
        let (total, entries) = (AtomicUsize::new(0), &self.entries);
        let found = self.of_clusters.par_iter_mut().zip(&self.keys);
        found.for_each(|(found, &key)| {
            found.clear();
            if total.load(Ordering::Relaxed) <= most {
                let mut entries = own(entries);
                entries.resize(drawn.grid.len(), 0);
                find(drawn, key, &mut entries, found);
                total.fetch_add(found.len(), Ordering::Relaxed);
            }
        });
        if total.into_inner() > most {
            *self = Self {
                least_tiles: self.least_tiles,
                ..Self::new()
            };
        }
    }

    /// The other clusters of some chunks, with their keys.
    pub(super) fn others<'a>(
        &'a self,
        sights: &'a Sights,
        chunks: Range<usize>,
    ) -> impl Iterator<Item = (u32, &'a Sight)> {
        let first_key = Sights::first_key(chunks.start);
        let wide = self.keys.partition_point(|&key| key < first_key);
        let mut wide = self.keys[wide..].iter().peekable();
        let all = sights.with_keys_of(chunks);
        all.filter(move |(key, _)| wide.next_if_eq(&key).is_none())
    }

    /// For each wide cluster what of it crosses which tile.
    pub(super) fn lists(&self) -> &[Vec<(u32, Crossing)>] {
        &self.of_clusters[..self.keys.len()]
    }

    pub(super) fn bytes(&self) -> u64 {
        let found: usize = self.of_clusters.iter().map(Vec::capacity).sum();
        let words = self.keys.capacity() as u64 + sum(&self.entries, |e| e.capacity() as u64);
        (found * size_of::<(u32, Crossing)>()) as u64 + words * size_of::<u32>() as u64
    }
}

fn find(drawn: Drawn<'_>, key: u32, entries: &mut [u32], found: &mut Vec<(u32, Crossing)>) {
    let sight = drawn.sights.get(key);
    match &drawn.index.lines[sight.cluster as usize] {
        Lines::None => {}
        Lines::Kept(unit_m, lines) => {
            let unit_px = unit_m * drawn.shot.view.px_per_m();
            let lying = Lying::kept(lines, unit_px, sight.middle_px);
            find_of(drawn, &lying, key, entries, found);
        }
        Lines::Cut(lines) => {
            let lying = Lying::cut(lines, Point::default());
            find_of(drawn, &lying, key, entries, found);
        }
    }
}

fn find_of<T: Coordinate>(
    drawn: Drawn<'_>,
    lying: &Lying<'_, T>,
    key: u32,
    entries: &mut [u32],
    found: &mut Vec<(u32, Crossing)>,
) {
    let (shot, lines) = (drawn.shot, lying.lines);
    let paths = drawn.index.paths_of(drawn.sights.get(key).cluster);
    let common_px = shot.common_radius_px();
    for piece in 0..lines.pieces() {
        let path = || paths[lines.member(piece)];
        let radius_px = common_px.unwrap_or_else(|| shot.radius_px(path()));
        let reach_px = radius_px as f32 + MARGIN_PX;
        let begins = lines.begins_of(piece..piece + 1);
        let piece = piece as u32;
        for (begin, vertex) in (begins.start as u32..).zip(begins) {
            let line = [lying.vertex(vertex), lying.vertex(vertex + 1)];
            for_each_tile(line, reach_px, drawn.grid, |column, row| {
                let tile = drawn.grid.tile(column, row);
                // What was written there for other lists means nothing: the tile and the piece say so.
                let last = found.get_mut(entries[tile] as usize);
                match last.filter(|(at, last)| *at == tile as u32 && last.piece == piece) {
                    Some((_, last)) => last.begins[1] = begin + 1,
                    None if drawn.parts.at(column, row).is_empty() => {}
                    None => {
                        entries[tile] = found.len() as u32;
                        let begins = [begin, begin + 1];
                        found.push((tile as u32, Crossing { key, piece, begins }));
                    }
                }
            });
        }
    }
}

/// Calls `found` with the column and the row of each tile that a line reaches into.
fn for_each_tile(
    [a, b]: [Point<f32>; 2],
    reach_px: f32,
    grid: &Grid,
    mut found: impl FnMut(usize, usize),
) {
    /// Of lines that are more level than this, all rows of tiles see all.
    const LEVEL_PX: f32 = 1.0;
    let (top, bottom) = if a.y < b.y { (a, b) } else { (b, a) };
    let along = bottom - top;
    let is_level = along.y < LEVEL_PX;
    let slope = along.x / greater(along.y, LEVEL_PX);
    let x_at = |y: f32| top.x + (lesser(greater(y, top.y), bottom.y) - top.y) * slope;
    for row in tiles(top.y - reach_px, bottom.y + reach_px) {
        if !grid.rows.contains(&row) {
            continue;
        }
        let row_y = (row * TILE_PX) as f32;
        let (from, to) = if is_level {
            (a.x, b.x)
        } else {
            let below = row_y + TILE_PX as f32;
            (x_at(row_y - reach_px), x_at(below + reach_px))
        };
        let columns = tiles(lesser(from, to) - reach_px, greater(from, to) + reach_px);
        for column in columns.start..columns.end.min(grid.columns) {
            found(column, row);
        }
    }
}

/// The tiles from one place to another; none left of or above the first.
fn tiles(from_px: f32, to_px: f32) -> Range<usize> {
    let tile = |px: f32| px * (1.0 / TILE_PX as f32);
    // A float below zero becomes 0.
    tile(from_px) as usize..(tile(to_px) + 1.0) as usize
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The distance from a line to a square, by many points of the line.
    fn distance([a, b]: [Point<f32>; 2], corner: Point<f32>) -> f32 {
        let side = TILE_PX as f32;
        let at = |i: u16| {
            let p = a + (b - a) * (f32::from(i) / 2000.0) - corner;
            let [x, y] = [p.x, p.y].map(|v| greater(-v, greater(v - side, 0.0)));
            x.hypot(y)
        };
        (0..=2000).map(at).fold(f32::INFINITY, f32::min)
    }

    #[test]
    fn a_line_crosses_the_tiles_that_it_reaches_into_and_few_others() {
        let grid = Grid {
            columns: 9,
            rows: 2..10,
        };
        let mut state = 3_u32;
        let mut next = move || {
            state = state.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
            (state >> 8) as f32 / (1 << 24) as f32 * 400.0 - 50.0
        };
        let (mut reached, mut listed) = (0, 0);
        for i in 0..300 {
            let a = Point::new(next(), next());
            let b = match i % 4 {
                0 => Point::new(next(), a.y + 0.3),
                1 => Point::new(a.x, next()),
                2 => a + Point::new(next(), next()) * 0.1,
                _ => Point::new(next(), next()),
            };
            let mut found = vec![false; grid.len()];
            for_each_tile([a, b], 2.0, &grid, |column, row| {
                let tile = (row - grid.rows.start) * grid.columns + column;
                assert_eq!(tile, grid.tile(column, row));
                assert!(!std::mem::replace(&mut found[tile], true));
            });
            for (tile, found) in found.into_iter().enumerate() {
                let (column, row) = (tile % grid.columns, tile / grid.columns + grid.rows.start);
                let corner = Point::new(column as f32, row as f32) * TILE_PX as f32;
                let is_near = distance([a, b], corner) < 2.0;
                assert!(found || !is_near, "{a:?} {b:?} {corner:?}");
                (reached, listed) = (reached + u32::from(is_near), listed + u32::from(found));
            }
        }
        assert!(listed < reached + reached / 5, "{listed} for {reached}");
    }
}
