//! Line lists: per tile, the ranges of lines that may touch it, for clusters that span many tiles.
//!
//! In a magnified view few lines of a cluster cross any one tile of its box, so testing them all in
//! every tile would be slow.

use std::ops::Range;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use guideway_scene::cluster::ClusterIndex;
use guideway_spline::{Point, greater, lesser};
use rayon::prelude::*;

use super::cull::{VisibleCluster, VisibleClusters};
use crate::cpu::flatten::cluster_lines::ClusterLines;
use crate::cpu::flatten::line_cache::LineCache;
use crate::cpu::flatten::polylines::Coordinate;
use crate::cpu::flatten::tile_lines::TileLines;
use crate::cpu::ground::damage::{DamageMap, TileGrid};
use crate::cpu::ground::frame_context::FrameContext;
use crate::cpu::ground::per_thread::{sum, thread_slot};
use crate::cpu::ground::tile::TILE_PX;

/// Fewest tiles of a cluster whose lines are listed. Measured on two cores of a Xeon, 3 px wide:
/// D2 magnified 20 times takes 56 ms instead of 123 ms. From 32 tiles on, the lists alone take
/// 102 ms for the whole of D2.
const MIN_TILES: usize = 64;
/// Most lines per tile of such a cluster: with more, each tile tests all pieces instead.
const MAX_LINES_PER_TILE: usize = 8;
/// Distance from a stroke, in pixels, up to which a tile counts as touched: more than the
/// rasterizer rounds a line by.
const MARGIN_PX: f32 = 0.25;

/// Lines of one piece that may touch a tile.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct LineRange {
    /// Key of the visible cluster.
    pub(crate) key: u32,
    pub(crate) piece: u32,
    /// First vertex at which a line starts, and the end (exclusive).
    pub(crate) starts: [u32; 2],
}

/// Line ranges per cluster.
pub(crate) struct LineLists {
    /// Fewest tiles of a cluster whose lines are listed.
    pub(crate) min_tiles: usize,
    /// Keys of the clusters whose lines are listed.
    keys: Vec<u32>,
    /// Pairs of tile and line range of each of these clusters; may be longer than `keys`.
    lists: Vec<Vec<(u32, LineRange)>>,
    /// Per thread and tile: index of the last entry of the tile in the list that the thread fills.
    last_entries: Vec<Mutex<Vec<u32>>>,
}

/// A frame whose lines are flattened.
#[derive(Clone, Copy)]
pub(crate) struct BinInput<'a> {
    pub(crate) ctx: &'a FrameContext<'a>,
    pub(crate) index: &'a ClusterIndex,
    pub(crate) cache: &'a LineCache,
    pub(crate) visible: &'a VisibleClusters,
    pub(crate) damage: &'a DamageMap,
    pub(crate) grid: &'a TileGrid,
}

/// Lines in pixels of the picture: one column per pixel.
type PictureLines<'a, T> = TileLines<'a, T, 1>;

impl LineLists {
    pub(crate) fn new() -> Self {
        Self {
            min_tiles: MIN_TILES,
            keys: Vec::new(),
            lists: Vec::new(),
            last_entries: Vec::new(),
        }
    }

    /// Lists the lines of all clusters that span many tiles, or of no cluster if that takes more
    /// than `max` ranges.
    pub(crate) fn find(&mut self, input: BinInput<'_>, max: usize) {
        let is_wide = |cluster: &VisibleCluster| {
            let tiles = cluster.columns().len() * cluster.rows().len();
            let lines = || input.cache.states[cluster.cluster as usize].counts[1];
            tiles >= self.min_tiles && lines() as usize <= MAX_LINES_PER_TILE * tiles
        };
        self.keys.clear();
        let wide = input.visible.with_keys();
        let wide = wide.filter(|(_, cluster)| is_wide(cluster));
        self.keys.extend(wide.map(|(key, _)| key));
        if self.lists.len() < self.keys.len() {
            self.lists.resize_with(self.keys.len(), Vec::new);
        }
        self.last_entries
            .resize_with(rayon::current_num_threads(), Mutex::default);
        let (total, last_entries) = (AtomicUsize::new(0), &self.last_entries);
        let lists = self.lists.par_iter_mut().zip(&self.keys);
        lists.for_each(|(list, &key)| {
            list.clear();
            if total.load(Ordering::Relaxed) <= max {
                let mut last_entries = thread_slot(last_entries);
                last_entries.resize(input.grid.len(), 0);
                list_cluster(input, key, &mut last_entries, list);
                total.fetch_add(list.len(), Ordering::Relaxed);
            }
        });
        if total.into_inner() > max {
            *self = Self {
                min_tiles: self.min_tiles,
                ..Self::new()
            };
        }
    }

    /// The visible clusters of some chunks whose lines are not listed, with their keys.
    pub(crate) fn others<'a>(
        &'a self,
        visible: &'a VisibleClusters,
        chunks: Range<usize>,
    ) -> impl Iterator<Item = (u32, &'a VisibleCluster)> {
        let first_key = VisibleClusters::first_key(chunks.start);
        let wide = self.keys.partition_point(|&key| key < first_key);
        let mut wide = self.keys[wide..].iter().peekable();
        let all = visible.with_keys_of(chunks);
        all.filter(move |(key, _)| wide.next_if_eq(&key).is_none())
    }

    /// Pairs of tile and line range, per listed cluster.
    pub(crate) fn lists(&self) -> &[Vec<(u32, LineRange)>] {
        &self.lists[..self.keys.len()]
    }

    /// Heap bytes held.
    pub(crate) fn bytes(&self) -> u64 {
        let ranges: usize = self.lists.iter().map(Vec::capacity).sum();
        let entries = sum(&self.last_entries, |entries| entries.capacity() as u64);
        let words = self.keys.capacity() as u64 + entries;
        (ranges * size_of::<(u32, LineRange)>()) as u64 + words * size_of::<u32>() as u64
    }
}

/// Lists the line ranges of one cluster.
fn list_cluster(
    input: BinInput<'_>,
    key: u32,
    last_entries: &mut [u32],
    list: &mut Vec<(u32, LineRange)>,
) {
    let cluster = input.visible.get(key);
    match &input.cache.lines[cluster.cluster as usize] {
        ClusterLines::None => {}
        ClusterLines::Cached(unit_m, lines) => {
            let unit_px = unit_m * input.ctx.view.px_per_m();
            let lines = PictureLines::cached(lines, unit_px, cluster.origin_px);
            list_lines(input, &lines, key, last_entries, list);
        }
        ClusterLines::Clipped(lines) => {
            let lines = PictureLines::clipped(lines, Point::default());
            list_lines(input, &lines, key, last_entries, list);
        }
    }
}

fn list_lines<T: Coordinate>(
    input: BinInput<'_>,
    mapped: &PictureLines<'_, T>,
    key: u32,
    last_entries: &mut [u32],
    list: &mut Vec<(u32, LineRange)>,
) {
    let (ctx, lines) = (input.ctx, mapped.lines);
    let paths = input.index.rows_of(input.visible.get(key).cluster);
    let common_px = ctx.common_radius_px();
    for piece in 0..lines.pieces() {
        let path = || paths[lines.member(piece)];
        let radius_px = common_px.unwrap_or_else(|| ctx.radius_px(path()));
        let reach_px = radius_px as f32 + MARGIN_PX;
        let starts = lines.line_starts(piece..piece + 1);
        let piece = piece as u32;
        for (start, vertex) in (starts.start as u32..).zip(starts) {
            let line = [mapped.vertex(vertex), mapped.vertex(vertex + 1)];
            for_each_tile(line, reach_px, input.grid, |column, row| {
                let tile = input.grid.tile(column, row);
                // The entry may be that of another list: it counts only if tile and piece match.
                let last = list.get_mut(last_entries[tile] as usize);
                match last.filter(|(at, last)| *at == tile as u32 && last.piece == piece) {
                    Some((_, last)) => last.starts[1] = start + 1,
                    None if input.damage.at(column, row).is_empty() => {}
                    None => {
                        last_entries[tile] = list.len() as u32;
                        let starts = [start, start + 1];
                        list.push((tile as u32, LineRange { key, piece, starts }));
                    }
                }
            });
        }
    }
}

/// Calls `visit` with column and row of each tile of the grid that a stroke around a line may
/// touch.
fn for_each_tile(
    [a, b]: [Point<f32>; 2],
    reach_px: f32,
    grid: &TileGrid,
    mut visit: impl FnMut(usize, usize),
) {
    /// Lines of less height than this, in pixels, touch the same columns in every row of tiles.
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
            visit(column, row);
        }
    }
}

/// The tiles between two positions on one axis; none left of or above the first tile.
fn tiles(from_px: f32, to_px: f32) -> Range<usize> {
    let tile = |px: f32| px * (1.0 / TILE_PX as f32);
    // Casting a negative float gives 0.
    tile(from_px) as usize..(tile(to_px) + 1.0) as usize
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Distance from a line to a tile, by many points of the line.
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
    fn lists_every_touched_tile_and_few_others() {
        let grid = TileGrid {
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
