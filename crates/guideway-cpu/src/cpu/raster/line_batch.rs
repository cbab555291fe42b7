//! Sixteen lines side by side: the pixels that each may touch, its slope, and the capsule around
//! it.

use std::ops::Range;

use guideway_spline::{greater, lesser};

use super::bits::set_bits;
use super::caps::CapTable;
use super::capsule::{Capsule, RowSpans, phases};
use super::coverage_mask::{CoverageMask, PixelBox, RowCoverage};
use crate::cpu::flatten::polylines::{Coordinate, bits_below};
use crate::cpu::flatten::tile_lines::TileLines;
use crate::cpu::ground::samples::{SamplePattern, round};
use crate::cpu::ground::tile::{LANES, TILE_PX};

/// Per line, the rows of pixels with open blocks that it may touch: one bit each.
pub(crate) struct OpenRows {
    rows: [u32; LANES],
    /// One bit per line with such a row.
    pub(crate) lines: u32,
}

/// Sixteen lines side by side, one per lane, of one stroke width. In columns from the tile's
/// corner.
pub(crate) struct LineBatch<const C: usize> {
    /// The end of lesser y, and the other.
    x: [[f32; LANES]; 2],
    y: [[f32; LANES]; 2],
    radius: f32,
}

/// Slopes and border offsets of the capsules.
pub(crate) struct LineSlopes {
    phases: [[i32; LANES]; 2],
    slope: [f32; LANES],
    half: [f32; LANES],
    border_offset: [f32; LANES],
}

/// The pixels that each line may touch: first and last row and column.
pub(crate) struct LineBoxes {
    first_row: [u32; LANES],
    last_row: [u32; LANES],
    first_column: [u32; LANES],
    last_column: [u32; LANES],
    /// All bits set if the line may touch the tile, otherwise none.
    inside: [u32; LANES],
}

/// Adds the lines that start at the vertices of `range` to the shape in a mask.
#[inline(always)]
pub(crate) fn stroke_lines<T: Coordinate, const C: usize>(
    mapped: &TileLines<'_, T, C>,
    mask: &mut CoverageMask<C>,
    range: Range<usize>,
    caps: &CapTable<C>,
) {
    for first in range.clone().step_by(LANES) {
        let Some(batch) = batch_at(mapped, first, caps.radius) else {
            return;
        };
        let starts = mapped.lines.line_start_bits(first) & bits_below(range.end - first);
        let boxes = batch.boxes();
        let open = boxes.open(mask.open());
        let visible = starts & open.lines;
        if visible == 0 {
            continue;
        }
        let slopes = batch.slopes();
        for lane in set_bits(visible) {
            let pixel_box = boxes.pixel_box(lane % LANES, &open);
            batch.stroke(lane % LANES, &slopes, pixel_box, mask, caps);
        }
    }
}

#[inline(always)]
fn batch_at<T: Coordinate, const C: usize>(
    mapped: &TileLines<'_, T, C>,
    first: usize,
    radius: f32,
) -> Option<LineBatch<C>> {
    let x = ends::<T, C>(&mapped.lines.x, first, mapped.scale, mapped.offset.x)?;
    let y = ends::<T, C>(&mapped.lines.y, first, mapped.scale, mapped.offset.y)?;
    Some(LineBatch::new(x, y, radius))
}

/// One coordinate of both ends of each line.
#[inline(always)]
fn ends<T: Coordinate, const C: usize>(
    of: &[T],
    first: usize,
    scale: f32,
    offset: f32,
) -> Option<[[f32; LANES]; 2]> {
    let starts: &[T; LANES] = of.get(first..)?.first_chunk()?;
    let ends: &[T; LANES] = of.get(first + 1..)?.first_chunk()?;
    // A loop: the closure of a map may not be inlined, and then misses the vector instructions.
    let mut mapped = [[0.0; LANES]; 2];
    for i in 0..LANES {
        mapped[0][i] = SamplePattern::<C>::snap(starts[i].into() * scale) + offset;
        mapped[1][i] = SamplePattern::<C>::snap(ends[i].into() * scale) + offset;
    }
    Some(mapped)
}

impl<const C: usize> LineBatch<C> {
    /// Lines from their first to their second ends.
    #[inline(always)]
    pub(crate) fn new(x: [[f32; LANES]; 2], y: [[f32; LANES]; 2], radius: f32) -> Self {
        let mut batch = Self { x, y, radius };
        for i in 0..LANES {
            let is_up = y[1][i] < y[0][i];
            batch.x[0][i] = choose(is_up, x[1][i], x[0][i]);
            batch.x[1][i] = choose(is_up, x[0][i], x[1][i]);
            batch.y[0][i] = lesser(y[0][i], y[1][i]);
            batch.y[1][i] = greater(y[0][i], y[1][i]);
        }
        batch
    }

    /// Adds the visible part of one line to the shape in a mask.
    #[inline(always)]
    pub(crate) fn stroke(
        &self,
        lane: usize,
        slopes: &LineSlopes,
        pixel_box: PixelBox,
        mask: &mut CoverageMask<C>,
        caps: &CapTable<C>,
    ) {
        mask.stroke(&(&self.capsule(slopes, lane), caps), pixel_box);
    }

    /// The capsule around one line.
    #[inline(always)]
    pub(crate) fn capsule(&self, slopes: &LineSlopes, lane: usize) -> Capsule {
        Capsule {
            x: self.x.map(|x| x[lane]),
            y: self.y.map(|y| y[lane]),
            phases: slopes.phases.map(|phases| phases[lane]),
            slope: slopes.slope[lane],
            half: slopes.half[lane],
            border_offset: slopes.border_offset[lane],
        }
    }

    #[inline(always)]
    pub(crate) fn boxes(&self) -> LineBoxes {
        let side = (TILE_PX * C) as f32;
        let mut boxes = LineBoxes::EMPTY;
        for i in 0..LANES {
            let left = lesser(self.x[0][i], self.x[1][i]) - self.radius;
            let right = greater(self.x[0][i], self.x[1][i]) + self.radius;
            let top = self.y[0][i] - self.radius;
            let bottom = self.y[1][i] + self.radius;
            let is_inside = (right > 0.0) & (left < side) & (bottom > 0.0) & (top < side);
            boxes.inside[i] = if is_inside { u32::MAX } else { 0 };
            boxes.first_row[i] = pixel_at::<C>(top);
            boxes.last_row[i] = pixel_at::<C>(bottom);
            boxes.first_column[i] = pixel_at::<C>(left);
            boxes.last_column[i] = pixel_at::<C>(right);
        }
        boxes
    }

    #[inline(always)]
    pub(crate) fn slopes(&self) -> LineSlopes {
        /// Least height of a line, in columns, whose borders differ from those of its caps.
        const LEVEL: f32 = 1.0 / 64.0;
        let mut slopes = LineSlopes {
            phases: [[0; LANES]; 2],
            slope: [0.0; LANES],
            half: [0.0; LANES],
            border_offset: [0.0; LANES],
        };
        for i in 0..LANES {
            let (dx, dy) = (self.x[1][i] - self.x[0][i], self.y[1][i] - self.y[0][i]);
            let length = (dx * dx + dy * dy).sqrt();
            let height = greater(dy, LEVEL);
            slopes.slope[i] = dx / height;
            slopes.half[i] = SamplePattern::<C>::snap(self.radius * length / height);
            let border_offset = SamplePattern::<C>::snap(self.radius * dx / greater(length, LEVEL));
            slopes.border_offset[i] = choose(dy < LEVEL, f32::NAN, border_offset);
            slopes.phases[0][i] = phases::<C>(self.y[0][i]);
            slopes.phases[1][i] = phases::<C>(self.y[1][i]);
        }
        slopes
    }
}

impl<const C: usize> RowCoverage for (&Capsule, &CapTable<C>) {
    #[inline(always)]
    fn width_px(&self) -> u32 {
        (2.0 / C as f32 * self.1.radius) as u32
    }

    #[inline(always)]
    fn pixels(&self, row: usize) -> u32 {
        self.0.pixels::<C>(self.1.radius, row)
    }

    #[inline(always)]
    fn spans(&self, row: usize) -> RowSpans {
        self.0.spans(self.1, row, (TILE_PX * C) as f32)
    }
}

/// The capsule around a level line, for tests.
#[cfg(test)]
pub(crate) fn level_capsule<const C: usize>(x: [f32; 2], y: f32) -> Capsule {
    capsule::<C>([x[0], y], [x[1], y], 1.0)
}

/// The capsule around a line, for tests.
#[cfg(test)]
pub(crate) fn capsule<const C: usize>(a: [f32; 2], b: [f32; 2], radius: f32) -> Capsule {
    let [x, y] = [0, 1].map(|axis| [[a[axis]; LANES], [b[axis]; LANES]]);
    let batch = LineBatch::<C>::new(x, y, radius);
    batch.capsule(&batch.slopes(), 0)
}

impl LineBoxes {
    const EMPTY: Self = Self {
        first_row: [0; LANES],
        last_row: [0; LANES],
        first_column: [0; LANES],
        last_column: [0; LANES],
        inside: [0; LANES],
    };

    /// Boxes from first and last rows and columns; `inside` is -1 for lines that may touch the
    /// tile.
    #[inline(always)]
    pub(crate) fn new(
        rows: [[u16; LANES]; 2],
        columns: [[u16; LANES]; 2],
        inside: [i16; LANES],
    ) -> Self {
        let mut boxes = Self::EMPTY;
        for i in 0..LANES {
            boxes.first_row[i] = rows[0][i].into();
            boxes.last_row[i] = rows[1][i].into();
            boxes.first_column[i] = columns[0][i].into();
            boxes.last_column[i] = columns[1][i].into();
            boxes.inside[i] = i32::from(inside[i]) as u32;
        }
        boxes
    }

    /// The pixels of a line that may be open.
    #[inline(always)]
    pub(crate) fn pixel_box(&self, lane: usize, open: &OpenRows) -> PixelBox {
        let pixels = u32::MAX << self.first_column[lane]
            & u32::MAX >> (TILE_PX as u32 - 1 - self.last_column[lane]);
        PixelBox {
            rows: open.rows[lane],
            pixels,
        }
    }

    /// Finds the rows with open blocks that each line may touch.
    #[inline(always)]
    pub(crate) fn open<const C: usize>(&self, open: &[u32; C]) -> OpenRows {
        let window_px = CoverageMask::<C>::WINDOW_PX as u32;
        let mut all = [0; LANES];
        let mut bits = [0; LANES];
        for i in 0..LANES {
            let rows =
                u32::MAX << self.first_row[i] & u32::MAX >> (TILE_PX as u32 - 1 - self.last_row[i]);
            let mut open_rows = 0;
            for (window, &open) in open.iter().enumerate() {
                let left = window as u32 * window_px;
                let is_touched =
                    (self.first_column[i] < left + window_px) & (self.last_column[i] >= left);
                open_rows |= if is_touched { open } else { 0 };
            }
            all[i] = open_rows & rows & self.inside[i];
            bits[i] = if all[i] != 0 { 1 << i } else { 0 };
        }
        OpenRows {
            rows: all,
            lines: bits.iter().fold(0, |all, bit| all | bit),
        }
    }
}

/// The pixel of the tile nearest to a position; on a border, possibly the one before it.
#[inline(always)]
fn pixel_at<const C: usize>(x: f32) -> u32 {
    round(x * (1.0 / C as f32) - 0.5, TILE_PX as f32 - 1.0)
}

/// Selects by bits: as a branch of two values it may become two stores.
#[inline(always)]
fn choose(is_first: bool, first: f32, second: f32) -> f32 {
    let mask = u32::from(is_first).wrapping_neg();
    f32::from_bits(first.to_bits() & mask | second.to_bits() & !mask)
}
