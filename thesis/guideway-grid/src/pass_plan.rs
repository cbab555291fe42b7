//! Plans the work of a picture: splits it into passes, so that no thread runs for long, and each
//! pass into ranges of tiles, so that no submission does.
//!
//! Input: the frame context and the counts per cell. Output: passes, and tile ranges per pass.

use std::ops::Range;

use guideway_spline::{Bounds, Point};

use crate::count_table::CountTable;
use crate::frame_context::FrameContext;
use crate::params::TILE_PX;
use crate::pass::Pass;
use crate::split::{WorkSplitter, equal_ranges};

/// Time of a cell look-up in distance tests.
const TESTS_PER_LOOKUP: f64 = 2.0;

/// Lists the passes of a picture over the chunks with these tables. No thread of a pass loops more
/// than `max_iterations` times, unless one line per cell already takes more.
pub(super) fn passes<'a>(
    context: &FrameContext,
    tables: impl IntoIterator<Item = &'a CountTable>,
    max_iterations: u32,
) -> Vec<Pass> {
    let mut passes = Vec::new();
    let [columns, rows] = [0, 1].map(|axis| max_cells_per_pixel(context, axis));
    for (chunk, table) in tables.into_iter().enumerate() {
        // A thread loops rows x (1 + columns x (1 + lines)) times.
        let rows_at_once = (max_iterations / (1 + 2 * columns)).clamp(1, rows);
        let lines_at_once = (max_iterations / rows_at_once - 1) / columns;
        let lines_at_once = lines_at_once.saturating_sub(1).max(1);
        let row_ranges = equal_ranges(rows, rows_at_once);
        let line_ranges = equal_ranges(table.max_count(), lines_at_once);
        for lines in &line_ranges {
            passes.extend(row_ranges.iter().map(|cell_rows| Pass {
                chunk,
                cell_rows: cell_rows.clone(),
                lines: lines.clone(),
                is_first: false,
                is_last: false,
                passes_of_chunk: (row_ranges.len() * line_ranges.len()) as u64,
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

/// Splits the tiles of some pixel rows into the ranges of one dispatch each.
pub(super) fn tile_ranges(
    pass: &Pass,
    context: &FrameContext,
    table: &CountTable,
    rows: &Range<u32>,
    mut splitter: WorkSplitter,
) -> Vec<Range<u32>> {
    let tiles_across = context.view.size().width().div_ceil(TILE_PX);
    for top in rows.clone().step_by(TILE_PX as usize) {
        let bottom = rows.end.min(top + TILE_PX);
        let work = work_of_rows(context, table, top..bottom);
        splitter.push(tiles_across, work / pass.passes_of_chunk);
    }
    splitter.finish()
}

/// The overlap of pixels and cells along one axis.
struct AxisOverlap {
    /// All cells that the pixels read.
    cells: Range<usize>,
    /// Most pixels that read one cell.
    pixels_per_cell: f64,
    cells_per_pixel: f64,
}

/// Most cells that a pixel reads along one axis.
fn max_cells_per_pixel(context: &FrameContext, axis: usize) -> u32 {
    if context.excess_m() == 0.0 {
        return 1;
    }
    let per_m = f64::from(context.grid.cells_per_m[axis]);
    // An interval of n cells overlaps at most n + 2; one more covers rounding.
    let overlapped = (2.0 * context.excess_m() * per_m).floor() + 3.0;
    overlapped.min(f64::from(context.cells)) as u32
}

/// Upper bound of the work of some pixel rows, in distance tests.
fn work_of_rows(context: &FrameContext, table: &CountTable, rows: Range<u32>) -> u64 {
    let (width, height) = (
        f64::from(context.view.size().width()),
        f64::from(rows.end - rows.start),
    );
    let corner = |x: f64, y: u32| {
        let point = Point::new(x, f64::from(y));
        let [x, y] = context
            .local
            .local_from_world(context.view.world_from_pixel(point));
        Point::new(f64::from(x), f64::from(y))
    };
    let visible = Bounds {
        min: corner(0.0, rows.end),
        max: corner(width, rows.start),
    };
    let pixels = width * height;
    if !visible.intersects(context.draw_bounds_m()) {
        return pixels as u64;
    }
    let across = axis_overlap(context, 0, visible.min.x, visible.max.x, width);
    let down = axis_overlap(context, 1, visible.min.y, visible.max.y, height);
    let lines = table.sum(across.cells.clone(), down.cells.clone());
    let tests = lines as f64 * across.pixels_per_cell * down.pixels_per_cell;
    let lookups = pixels * across.cells_per_pixel * down.cells_per_pixel;
    (tests + lookups * TESTS_PER_LOOKUP) as u64
}

/// The cells that `pixels` pixels from `low_m` to `high_m` read along one axis.
fn axis_overlap(
    context: &FrameContext,
    axis: usize,
    low_m: f64,
    high_m: f64,
    pixels: f64,
) -> AxisOverlap {
    let per_m = f64::from(context.grid.cells_per_m[axis]);
    let excess_m = context.excess_m();
    let cell = |at_m: f64| ((at_m - f64::from(context.grid.origin_m[axis])) * per_m).floor();
    // One cell more on each side covers rounding.
    let cells = f64::from(context.cells);
    let first = (cell(low_m - excess_m) - 1.0).clamp(0.0, cells - 1.0);
    let end = (cell(high_m + excess_m) + 2.0).clamp(1.0, cells);
    let cell_px = context.view.px_per_m() * (1.0 / per_m + 2.0 * excess_m) + 1.0;
    AxisOverlap {
        cells: first as usize..end as usize,
        pixels_per_cell: pixels.min(cell_px),
        cells_per_pixel: (2.0 * excess_m * per_m + 1.0).min(cells),
    }
}
