//! Covers samples with batches of sixteen lines in fixed point; long level lines fall back to
//! floats.

use std::ops::Range;

use guideway_spline::Point;

use super::caps::FixedCapTable;
use super::capsule::{Borders, Ends, FixedCapsule, pixel_of};
use crate::cpu::flatten::polylines::{Polylines, bits_below};
use crate::cpu::ground::fixed_steps::{COLUMN_STEPS, STEPS};
use crate::cpu::ground::samples::SOLID;
use crate::cpu::ground::tile::{LANES, TILE_PX};
use crate::cpu::raster::bits::set_bits;
use crate::cpu::raster::caps::CapTable;
use crate::cpu::raster::capsule::RowSpans;
use crate::cpu::raster::coverage_mask::{CoverageMask, RowCoverage};
use crate::cpu::raster::line_batch::{LineBatch, LineBoxes};

/// Cached lines relative to a tile.
pub(crate) struct FixedLines<'a> {
    lines: &'a Polylines<i16>,
    /// Steps per unit of the vertices, times 2^15.
    scale: i32,
    /// Origin of the vertices, in whole steps.
    offset: [i16; 2],
    /// The fraction of a step of the origin, and the half that rounds to nearest, times 2^15.
    rest: [i32; 2],
}

impl<'a> FixedLines<'a> {
    /// Maps lines to a tile: a unit is `unit_px` pixels (more than half a step, at most one), and
    /// the origin lies at `origin_px` from the corner.
    #[inline(always)]
    pub(crate) fn new(lines: &'a Polylines<i16>, unit_px: f64, origin_px: Point<f64>) -> Self {
        const ONE: f64 = (1 << 15) as f64;
        let steps = origin_px * f64::from(STEPS);
        let whole = Point::new(steps.x.floor(), steps.y.floor());
        let rest = |steps: f64| ((steps + 0.5) * ONE) as i32;
        Self {
            lines,
            scale: (unit_px * f64::from(STEPS) * ONE).round() as i32,
            offset: [whole.x as i16, whole.y as i16],
            rest: [rest(steps.x - whole.x), rest(steps.y - whole.y)],
        }
    }

    /// Covers samples with the lines that start at the vertices of `range`.
    #[inline(always)]
    pub(crate) fn stroke(
        &self,
        mask: &mut CoverageMask<SOLID>,
        range: Range<usize>,
        caps: &CapTable<SOLID>,
    ) {
        let fixed = &caps.fixed;
        for first in range.clone().step_by(LANES) {
            let Some(ends) = self.ends(first) else {
                return;
            };
            let starts = self.lines.line_start_bits(first) & bits_below(range.end - first);
            let boxes = ends.boxes(fixed.reach);
            let open = boxes.open(mask.open());
            let visible = starts & open.lines;
            if visible == 0 {
                continue;
            }
            let borders = Borders::new(&ends, fixed.radius);
            if visible & borders.level != 0 {
                let batch = ends.as_floats(caps.radius);
                let slopes = batch.slopes();
                for lane in set_bits(visible & borders.level) {
                    let pixel_box = boxes.pixel_box(lane % LANES, &open);
                    batch.stroke(lane % LANES, &slopes, pixel_box, mask, caps);
                }
            }
            for lane in set_bits(visible & !borders.level) {
                let capsule = FixedCapsule::new(&ends, &borders, lane % LANES, fixed);
                let pixel_box = boxes.pixel_box(lane % LANES, &open);
                mask.stroke(&(&capsule, fixed), pixel_box);
            }
        }
    }

    #[inline(always)]
    fn ends(&self, first: usize) -> Option<Ends> {
        let x = self.mapped(&self.lines.x, first, 0)?;
        let y = self.mapped(&self.lines.y, first, 1)?;
        let mut ends = Ends { x, y };
        for i in 0..LANES {
            let is_up = if y[1][i] < y[0][i] { -1 } else { 0 };
            let swapped = (x[0][i] ^ x[1][i]) & is_up;
            ends.x[0][i] = x[0][i] ^ swapped;
            ends.x[1][i] = x[1][i] ^ swapped;
            ends.y[0][i] = y[0][i].min(y[1][i]);
            ends.y[1][i] = y[0][i].max(y[1][i]);
        }
        Some(ends)
    }

    /// One coordinate of both ends of each line.
    #[inline(always)]
    fn mapped(&self, of: &[i16], first: usize, axis: usize) -> Option<[[i16; LANES]; 2]> {
        let starts: &[i16; LANES] = of.get(first..)?.first_chunk()?;
        let ends: &[i16; LANES] = of.get(first + 1..)?.first_chunk()?;
        let mut mapped = [[0; LANES]; 2];
        for i in 0..LANES {
            mapped[0][i] = self.map(starts[i], axis);
        }
        for i in 0..LANES {
            mapped[1][i] = self.map(ends[i], axis);
        }
        Some(mapped)
    }

    /// Maps a coordinate. Padding behind the last vertex maps to any value.
    #[inline(always)]
    fn map(&self, at: i16, axis: usize) -> i16 {
        let steps = (i32::from(at) * self.scale + self.rest[axis]) >> 15;
        (steps as i16).wrapping_add(self.offset[axis])
    }
}

impl RowCoverage for (&FixedCapsule, &FixedCapTable) {
    #[inline(always)]
    fn width_px(&self) -> u32 {
        2 * self.1.reach as u32 / STEPS as u32
    }

    #[inline(always)]
    fn pixels(&self, row: usize) -> u32 {
        self.0.pixels(row, self.1.reach)
    }

    #[inline(always)]
    fn spans(&self, row: usize) -> RowSpans {
        self.0.spans(row, self.1)
    }
}

impl Ends {
    /// The pixels that strokes of this reach may touch.
    #[inline(always)]
    fn boxes(&self, reach: i16) -> LineBoxes {
        const SIDE: i16 = (TILE_PX as i32 * STEPS) as i16;
        let (mut rows, mut columns) = ([[0; LANES]; 2], [[0; LANES]; 2]);
        let mut inside = [0; LANES];
        for i in 0..LANES {
            let left = self.x[0][i].min(self.x[1][i]) - reach;
            let right = self.x[0][i].max(self.x[1][i]) + reach;
            let top = self.y[0][i] - reach;
            let bottom = self.y[1][i] + reach;
            let is_inside = (right > 0) & (left < SIDE) & (bottom > 0) & (top < SIDE);
            inside[i] = if is_inside { -1 } else { 0 };
            rows[0][i] = pixel_of(top);
            rows[1][i] = pixel_of(bottom);
            columns[0][i] = pixel_of(left);
            columns[1][i] = pixel_of(right);
        }
        LineBoxes::new(rows, columns, inside)
    }

    /// The same lines in columns of samples.
    #[inline(always)]
    fn as_floats(&self, radius: f32) -> LineBatch<SOLID> {
        const COLUMN: f32 = 1.0 / COLUMN_STEPS as f32;
        let (mut x, mut y) = ([[0.0; LANES]; 2], [[0.0; LANES]; 2]);
        for end in 0..2 {
            for i in 0..LANES {
                x[end][i] = f32::from(self.x[end][i]) * COLUMN;
                y[end][i] = f32::from(self.y[end][i]) * COLUMN;
            }
        }
        LineBatch::new(x, y, radius)
    }
}
