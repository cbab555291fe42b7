use std::ops::Range;
use std::sync::atomic::{AtomicU32, Ordering};

use guideway_render::{Cancel, FrameSize, RenderError};
use rayon::prelude::*;

use super::lines::{Line, Lines, Shot, TooMuch};
use super::span::TILE_PX;

/// The tiles of a band of the picture: whole rows of them.
#[derive(Clone, Debug)]
pub(super) struct Grid {
    pub(super) columns: usize,
    pub(super) rows: Range<usize>,
}

/// Lines and tiles meet in `f32`: a line this near to a tile counts as touching it, in pixels. It also
/// holds what the spans of a tile add to a capsule.
const MARGIN_PX: f32 = 1.0 / 64.0;

impl Grid {
    /// The tiles of a whole picture.
    pub(super) fn whole(size: FrameSize) -> Self {
        let tiles = |side_px: u32| (side_px as usize).div_ceil(TILE_PX);
        Self {
            columns: tiles(size.width()),
            rows: 0..tiles(size.height()),
        }
    }

    /// Number of tiles.
    pub(super) fn len(&self) -> usize {
        self.columns * self.rows.len()
    }

    /// The rows of tiles that a line may touch.
    pub(super) fn rows_of(&self, line: &Line, radius_px: f32) -> Range<usize> {
        let reach = radius_px + MARGIN_PX;
        let top = line.start.y.min(line.end.y) - reach;
        let bottom = line.start.y.max(line.end.y) + reach;
        tiles_between(top, bottom, &self.rows)
    }

    /// The columns of tiles that a line may touch in one row of tiles: those near the part of it that is
    /// within reach of the row.
    pub(super) fn columns_of(&self, line: &Line, radius_px: f32, row: usize) -> Range<usize> {
        let reach = radius_px + MARGIN_PX;
        let (start, end) = (line.start, line.end);
        let along = end - start;
        let mut ends = [start.x, end.x];
        // Within a pixel, slopes are not worth a division, nor safe for one.
        if along.y.abs() > 1.0 {
            let top = (row * TILE_PX) as f32 - reach;
            let bottom = ((row + 1) * TILE_PX) as f32 + reach;
            let x_at = |y: f32| start.x + along.x * ((y - start.y) / along.y).clamp(0.0, 1.0);
            ends = [x_at(top), x_at(bottom)];
        }
        let left = ends[0].min(ends[1]) - reach;
        let right = ends[0].max(ends[1]) + reach;
        tiles_between(left, right, &(0..self.columns))
    }

    /// Calls `visit` with the index of each tile that a line may touch.
    fn tiles_of(&self, line: &Line, radius_px: f32, mut visit: impl FnMut(usize)) {
        for row in self.rows_of(line, radius_px) {
            for column in self.columns_of(line, radius_px, row) {
                visit((row - self.rows.start) * self.columns + column);
            }
        }
    }
}

/// Those of `tiles` that hold a position from `least` to `most` pixels.
fn tiles_between(least: f32, most: f32, tiles: &Range<usize>) -> Range<usize> {
    if most < 0.0 {
        return tiles.start..tiles.start;
    }
    // A float below zero becomes 0 as an integer.
    let first = least as usize / TILE_PX;
    let end = most as usize / TILE_PX + 1;
    let first = first.clamp(tiles.start, tiles.end);
    first..end.clamp(first, tiles.end)
}

/// Which lines touch each tile, by number, in draw order.
///
/// Two passes over the lines: one counts, and so fixes where everything goes; the other puts it there. The
/// place of a number does not depend on which thread comes first.
#[derive(Default)]
pub(super) struct Bins {
    /// For each group of lines, how many touch each tile; then where the next of them goes.
    tables: Vec<Vec<u32>>,
    /// Where the numbers of each tile end.
    ends: Vec<u32>,
    numbers: Vec<AtomicU32>,
}

impl Bins {
    /// Bytes of the tables for `groups` of lines on so many tiles.
    pub(super) fn table_bytes(groups: usize, tiles: usize) -> u64 {
        ((groups + 1) * tiles * size_of::<u32>()) as u64
    }

    /// Bytes held.
    pub(super) fn bytes(&self) -> u64 {
        let tables: usize = self.tables.iter().map(Vec::capacity).sum();
        ((tables + self.ends.capacity() + self.numbers.capacity()) * size_of::<u32>()) as u64
    }

    /// Lets go of all memory when it is more than that.
    pub(super) fn shrink(&mut self, limit_bytes: u64) {
        if self.bytes() > limit_bytes {
            *self = Self::default();
        }
    }

    /// Finds which lines touch which tiles.
    pub(super) fn fill(
        &mut self,
        shot: &Shot<'_>,
        lines: &Lines,
        grid: &Grid,
        limit_bytes: u64,
    ) -> Result<Result<(), TooMuch>, RenderError> {
        let groups = lines.groups().len();
        let held = Lines::bytes_for(lines.len()) + Self::table_bytes(groups, grid.len());
        if held > limit_bytes {
            return Ok(Err(TooMuch));
        }
        self.tables.resize_with(groups, Vec::new);
        let tables = self.tables.par_iter_mut();
        tables
            .zip(lines.groups())
            .try_for_each(|(table, (_, lines))| {
                table.clear();
                table.resize(grid.len(), 0);
                visit(shot, lines, grid, |tile, _| table[tile] += 1)
            })?;
        let total = self.numbers_in_all();
        let needed = held + total * size_of::<u32>() as u64;
        let Some(total) = u32::try_from(total).ok().filter(|_| needed <= limit_bytes) else {
            return Ok(Err(TooMuch));
        };
        self.place(grid.len());
        self.numbers.resize_with(total as usize, AtomicU32::default);
        let numbers = &self.numbers;
        let tables = self.tables.par_iter_mut();
        tables
            .zip(lines.groups())
            .try_for_each(|(table, (first, lines))| {
                visit(shot, lines, grid, |tile, index| {
                    numbers[table[tile] as usize].store(first + index, Ordering::Relaxed);
                    table[tile] += 1;
                })
            })?;
        Ok(Ok(()))
    }

    fn numbers_in_all(&self) -> u64 {
        let sum = |table: &Vec<u32>| table.iter().map(|&n| u64::from(n)).sum::<u64>();
        self.tables.par_iter().map(sum).sum()
    }

    /// Turns counts into places: tile after tile, and within a tile group after group.
    fn place(&mut self, tiles: usize) {
        self.ends.clear();
        let mut next = 0;
        for tile in 0..tiles {
            for table in &mut self.tables {
                let count = std::mem::replace(&mut table[tile], next);
                next += count;
            }
            self.ends.push(next);
        }
    }

    /// Numbers of the lines that touch a tile, in draw order.
    pub(super) fn tile(&self, tile: usize) -> impl DoubleEndedIterator<Item = u32> {
        let start = if tile == 0 { 0 } else { self.ends[tile - 1] };
        let numbers = &self.numbers[start as usize..self.ends[tile] as usize];
        numbers.iter().map(|n| n.load(Ordering::Relaxed))
    }
}

/// Calls `visit` with each tile and the index of each line that touches it, in the order of the lines.
fn visit(
    shot: &Shot<'_>,
    lines: &[Line],
    grid: &Grid,
    mut visit: impl FnMut(usize, u32),
) -> Result<(), RenderError> {
    const LINES_A_CHECK: usize = 1 << 12;
    for (chunk, lines) in lines.chunks(LINES_A_CHECK).enumerate() {
        Cancel::check(shot.cancel)?;
        for (i, line) in lines.iter().enumerate() {
            let index = (chunk * LINES_A_CHECK + i) as u32;
            let radius_px = shot.radius_px(line.path) as f32;
            grid.tiles_of(line, radius_px, |tile| visit(tile, index));
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use guideway_spline::Point;

    use super::super::span::Capsule;
    use super::*;

    #[test]
    fn every_tile_with_a_covered_sample_is_visited() {
        let size = FrameSize::new(100, 70).unwrap();
        let whole = Grid::whole(size);
        let mut state = 1_u32;
        let mut next = || {
            state = state.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
            (state >> 8) as f32 / (1 << 24) as f32
        };
        for i in 0..500 {
            let mut point = || Point::new(next() * 140.0 - 20.0, next() * 110.0 - 20.0);
            let (start, end) = (point(), point());
            let end = if i % 3 == 0 {
                Point::new(end.x, start.y + 1e-4)
            } else {
                end
            };
            let line = Line {
                start,
                end,
                path: 0,
            };
            let radius_px = [0.1, 1.5, 20.0][i % 3];
            let mut found = vec![0; whole.len()];
            whole.tiles_of(&line, radius_px, |tile| found[tile] += 1);
            assert!(found.iter().all(|&n| n <= 1));
            let banded = Grid {
                rows: 2..4,
                ..whole.clone()
            };
            let mut in_band = vec![0; banded.len()];
            banded.tiles_of(&line, radius_px, |tile| in_band[tile] += 1);
            assert_eq!(in_band, found[2 * whole.columns..4 * whole.columns]);
            for (tile, &found) in found.iter().enumerate() {
                let corner = Point::new((tile % 7 * 16) as f32, (tile / 7 * 16) as f32);
                let capsule = Capsule::new(start - corner, end - corner, radius_px);
                let is_covered = capsule.pixel_rows().any(|row| {
                    let spans = capsule.spans(row);
                    spans.first.iter().zip(&spans.end).any(|(a, b)| a < b)
                });
                assert!(
                    !is_covered || found == 1,
                    "{start:?} {end:?} {radius_px} {corner:?}"
                );
            }
        }
    }
}
