//! How much work a view is, and how it is cut: into passes, so that no thread runs for long, and these into
//! ranges of tiles, so that no submit does.

use std::ops::Range;

use guideway_spline::{Bounds, Point};

use crate::cut::Cutter;
use crate::params::{ALL, TILE_PX};
use crate::shot::Shot;
use crate::table::Table;

/// Distance tests that looking up a cell takes the time of.
const TESTS_A_LOOK: f64 = 2.0;

/// What every pixel does at a time.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Pass {
    pub(super) chunk: usize,
    /// Of the rows of cells that a pixel looks into, from its lowest.
    pub(super) cell_rows: Range<u32>,
    /// Of the lines of each cell.
    pub(super) lines: Range<u32>,
    pub(super) is_first: bool,
    pub(super) is_last: bool,
    /// How many passes its chunk takes.
    share: u64,
}

/// All passes of a picture: over the chunks that have these tables.
pub(super) fn passes<'a>(
    shot: &Shot,
    tables: impl IntoIterator<Item = &'a Table>,
    most_rounds: u32,
) -> Vec<Pass> {
    let mut passes = Vec::new();
    let [columns, rows] = [0, 1].map(|axis| shot.most_cells(axis));
    for (chunk, table) in tables.into_iter().enumerate() {
        // A thread goes rows x (1 + columns x (1 + lines)) times round its loops.
        let rows_at_once = (most_rounds / (1 + 2 * columns)).clamp(1, rows);
        let lines_at_once = (most_rounds / rows_at_once - 1) / columns;
        let lines_at_once = lines_at_once.saturating_sub(1).max(1);
        let of_rows = parts(rows, rows_at_once);
        let of_lines = parts(table.most(), lines_at_once);
        for lines in &of_lines {
            passes.extend(of_rows.iter().map(|cell_rows| Pass {
                chunk,
                cell_rows: cell_rows.clone(),
                lines: lines.clone(),
                is_first: false,
                is_last: false,
                share: (of_rows.len() * of_lines.len()) as u64,
            }));
        }
    }
    if let Some(first) = passes.first_mut() {
        first.is_first = true;
    }
    if let Some(last) = passes.last_mut() {
        last.is_last = true;
    }
    passes
}

/// Parts of so many things, so many at once; the last part has no end.
pub(super) fn parts(count: u32, at_once: u32) -> Vec<Range<u32>> {
    let mut parts: Vec<_> = (0..count.max(1))
        .step_by(at_once.max(1) as usize)
        .map(|first| first..first.saturating_add(at_once))
        .collect();
    if let Some(last) = parts.last_mut() {
        last.end = ALL;
    }
    parts
}

impl Pass {
    /// Cuts the tiles of some rows of pixels into what is drawn at a time.
    pub(super) fn cut(
        &self,
        shot: &Shot,
        table: &Table,
        rows: &Range<u32>,
        mut cutter: Cutter,
    ) -> Vec<Range<u32>> {
        let tiles_across = shot.view.size().width().div_ceil(TILE_PX);
        for top in rows.clone().step_by(TILE_PX as usize) {
            let bottom = rows.end.min(top + TILE_PX);
            cutter.push(tiles_across, shot.work(table, top..bottom) / self.share);
        }
        cutter.finish()
    }
}

/// How pixels and cells meet along one axis.
struct Axis {
    /// All that the pixels look into.
    cells: Range<usize>,
    /// Most pixels that look into one cell.
    pixels_a_cell: f64,
    cells_a_pixel: f64,
}

impl Shot {
    /// Most cells that a pixel looks into along one axis.
    fn most_cells(&self, axis: usize) -> u32 {
        if self.excess_m() == 0.0 {
            return 1;
        }
        let per_m = f64::from(self.grid.cells_per_m[axis]);
        // One more than such a length can meet makes up for rounding.
        let met = (2.0 * self.excess_m() * per_m).floor() + 3.0;
        met.min(f64::from(self.cells)) as u32
    }

    /// Distance tests of some rows of pixels, at most; or other work of that size.
    fn work(&self, table: &Table, rows: Range<u32>) -> u64 {
        let (width, height) = (
            f64::from(self.view.size().width()),
            f64::from(rows.end - rows.start),
        );
        let corner = |x: f64, y: u32| {
            let point = Point::new(x, f64::from(y));
            let [x, y] = self
                .local
                .local_from_world(self.view.world_from_pixel(point));
            Point::new(f64::from(x), f64::from(y))
        };
        let seen = Bounds {
            min: corner(0.0, rows.end),
            max: corner(width, rows.start),
        };
        let pixels = width * height;
        if !seen.intersects(self.box_m()) {
            return pixels as u64;
        }
        let across = self.axis(0, seen.min.x, seen.max.x, width);
        let down = self.axis(1, seen.min.y, seen.max.y, height);
        let lines = table.within(across.cells.clone(), down.cells.clone());
        let tests = lines as f64 * across.pixels_a_cell * down.pixels_a_cell;
        let looks = pixels * across.cells_a_pixel * down.cells_a_pixel;
        (tests + looks * TESTS_A_LOOK) as u64
    }

    /// Which cells the pixels from `low_m` to `high_m` look into, so many pixels there are.
    fn axis(&self, axis: usize, low_m: f64, high_m: f64, pixels: f64) -> Axis {
        let per_m = f64::from(self.grid.cells_per_m[axis]);
        let excess_m = self.excess_m();
        let cell = |at_m: f64| ((at_m - f64::from(self.grid.origin_m[axis])) * per_m).floor();
        // One cell more on each side makes up for rounding.
        let cells = f64::from(self.cells);
        let first = (cell(low_m - excess_m) - 1.0).clamp(0.0, cells - 1.0);
        let end = (cell(high_m + excess_m) + 2.0).clamp(1.0, cells);
        let cell_px = self.view.px_per_m() * (1.0 / per_m + 2.0 * excess_m) + 1.0;
        Axis {
            cells: first as usize..end as usize,
            pixels_a_cell: pixels.min(cell_px),
            cells_a_pixel: (2.0 * excess_m * per_m + 1.0).min(cells),
        }
    }
}
