//! The stroke of one line in fixed point: its borders, and the samples it covers in each row of a
//! tile.

use super::caps::{CapRows, FixedCapTable};
use crate::cpu::ground::fixed_steps::{COLUMN_STEPS, ROW_STEPS, STEPS};
use crate::cpu::ground::samples::SOLID;
use crate::cpu::ground::tile::{LANES, TILE_PX};
use crate::cpu::raster::capsule::RowSpans;

/// Largest slope of a border, in x per y. The borders of short lines that are more level vanish
/// between the caps.
const MAX_SLOPE: f32 = 200.0;
/// Largest width of a short line, in steps.
const SHORT: i16 = 8 * STEPS as i16;
/// Fraction bits of a slope.
const SLOPE_BITS: u32 = 14;

/// Ends of sixteen lines, one line per lane, in steps: the end of lesser y, and the other.
pub(crate) struct Ends {
    pub(crate) x: [[i16; LANES]; 2],
    pub(crate) y: [[i16; LANES]; 2],
}

/// The pixel of the tile nearest to a position in steps.
#[inline(always)]
pub(crate) fn pixel_of(at: i16) -> u16 {
    const MAX: i16 = TILE_PX as i16 - 1;
    (at >> STEPS.trailing_zeros()).clamp(0, MAX) as u16
}

/// Borders of the strokes between their caps, one stroke per lane: left, then right.
pub(crate) struct Borders {
    /// Points where they leave the upper cap. Borders of level lines are in no row.
    x: [[i16; LANES]; 2],
    y: [[i16; LANES]; 2],
    /// Height from there to the lower cap.
    height: [i16; LANES],
    /// Change of x per y, times 2^14.
    slope: [i32; LANES],
    /// One bit per long, nearly level line: it needs floats.
    pub(crate) level: u32,
}

impl Borders {
    #[inline(always)]
    pub(crate) fn new(ends: &Ends, radius: f32) -> Self {
        let mut borders = Self {
            x: [[0; LANES]; 2],
            y: [[0; LANES]; 2],
            height: [0; LANES],
            slope: [0; LANES],
            level: 0,
        };
        let mut level = [0; LANES];
        for (i, level) in level.iter_mut().enumerate() {
            let [dx, dy] = [ends.x[1][i] - ends.x[0][i], ends.y[1][i] - ends.y[0][i]];
            let [x, y] = [f32::from(dx), f32::from(dy)];
            let part = radius / (x * x + y * y).max(1.0).sqrt();
            let is_level = x.abs() > MAX_SLOPE * y;
            let is_long = dx.abs() > SHORT;
            *level = if is_level & is_long { 1 << i } else { 0 };
            let [offset_x, offset_y] = [nearest_int(y * part) as i16, nearest_int(x * part) as i16];
            borders.x[0][i] = ends.x[0][i] - offset_x;
            borders.x[1][i] = ends.x[0][i] + offset_x;
            let nowhere = i16::MAX;
            borders.y[0][i] = if is_level {
                nowhere
            } else {
                ends.y[0][i] + offset_y
            };
            borders.y[1][i] = if is_level {
                nowhere
            } else {
                ends.y[0][i] - offset_y
            };
            borders.height[i] = if is_level { 0 } else { dy };
            let slope = if is_level { 0.0 } else { x / y.max(1.0) };
            borders.slope[i] = nearest_int(slope * (1 << SLOPE_BITS) as f32);
        }
        borders.level = level.iter().fold(0, |all, bit| all | bit);
        borders
    }
}

/// Rounds a number below 2^22 to the nearest integer.
#[inline(always)]
fn nearest_int(x: f32) -> i32 {
    const ROUND: f32 = 1.5 * (1 << 23) as f32;
    (x + ROUND).to_bits() as i32 - ROUND.to_bits() as i32
}

/// One stroke.
pub(crate) struct FixedCapsule {
    x: [i16; 2],
    y: [i16; 2],
    caps: [CapRows; 2],
    /// Points where its borders leave the upper cap and reach the lower one.
    border_x: [i16; 2],
    border_y: [i16; 2],
    border_end: [i16; 2],
    slope: i32,
    /// Offset of a border in each row of samples from the first row of a pixel.
    row_offsets: [i16; LANES],
}

impl FixedCapsule {
    #[inline(always)]
    pub(crate) fn new(ends: &Ends, borders: &Borders, lane: usize, caps: &FixedCapTable) -> Self {
        // No maps of arrays: their closures may not be inlined, and then miss the vector
        // instructions.
        let slope = borders.slope[lane];
        let slope_per_px = (slope >> (SLOPE_BITS - STEPS.trailing_zeros())) as i16;
        let mut row_offsets = [0; LANES];
        for (offset, &part) in row_offsets.iter_mut().zip(&caps.row_parts) {
            *offset = ((i32::from(part) * i32::from(slope_per_px) + (1 << 14)) >> 15) as i16;
        }
        let [y0, y1] = [ends.y[0][lane], ends.y[1][lane]];
        let [left_y, right_y] = [borders.y[0][lane], borders.y[1][lane]];
        let height = borders.height[lane];
        Self {
            x: [ends.x[0][lane], ends.x[1][lane]],
            y: [y0, y1],
            caps: [caps.around(y0), caps.around(y1)],
            border_x: [borders.x[0][lane], borders.x[1][lane]],
            border_y: [left_y, right_y],
            border_end: [
                left_y.saturating_add(height),
                right_y.saturating_add(height),
            ],
            slope,
            row_offsets,
        }
    }

    /// The pixels of a row that the line may touch within its reach, one bit each; not for level
    /// lines.
    #[inline(always)]
    pub(crate) fn pixels(&self, pixel_row: usize, reach: i16) -> u32 {
        let top = pixel_row as i32 * STEPS - i32::from(reach);
        let bottom = top + STEPS + 2 * i32::from(reach);
        let (a, b) = (self.x_at(top), self.x_at(bottom));
        let first = pixel_of((a.min(b) - i32::from(reach)) as i16);
        let last = pixel_of((a.max(b) + 1 + i32::from(reach)) as i16);
        u32::MAX << first & u32::MAX >> (TILE_PX as u16 - 1 - last)
    }

    /// x of the line at a height, or at the nearer end.
    #[inline(always)]
    fn x_at(&self, y: i32) -> i32 {
        let [y0, y1] = [i32::from(self.y[0]), i32::from(self.y[1])];
        let below = i64::from((y - y0).max(0).min(y1 - y0));
        i32::from(self.x[0]) + ((below * i64::from(self.slope)) >> SLOPE_BITS) as i32
    }

    /// x of a border at a height.
    #[inline(always)]
    fn border(&self, side: usize, y: i32) -> i16 {
        let below = i64::from(y - i32::from(self.border_y[side]));
        let half = 1 << (SLOPE_BITS - 1);
        let offset = (below * i64::from(self.slope) + half) >> SLOPE_BITS;
        // 16 bits hold it wherever the border is in the row of pixels.
        (i64::from(self.border_x[side]) + offset) as i16
    }

    /// The samples covered in one row of pixels; see
    /// [`crate::cpu::raster::capsule::Capsule::spans`].
    #[inline(always)]
    pub(crate) fn spans(&self, pixel_row: usize, caps: &FixedCapTable) -> RowSpans {
        const COLUMNS: i16 = (TILE_PX * SOLID) as i16;
        const HALF: i16 = COLUMN_STEPS as i16 / 2;
        let first_y = pixel_row as i32 * STEPS + ROW_STEPS / 2;
        let upper = caps.half_chords(self.caps[0], pixel_row);
        let lower = caps.half_chords(self.caps[1], pixel_row);
        let left_border = self.border(0, first_y);
        let right_border = self.border(1, first_y);
        let (mut firsts, mut ends) = ([0; LANES], [0; LANES]);
        for i in 0..LANES {
            let y = first_y as i16 + i as i16 * ROW_STEPS as i16;
            let [x0, x1] = self.x;
            let left = (x0.saturating_sub(upper[i])).min(x1.saturating_sub(lower[i]));
            let right = (x0.saturating_add(upper[i])).max(x1.saturating_add(lower[i]));
            let has_left = (y >= self.border_y[0]) & (y <= self.border_end[0]);
            let has_right = (y >= self.border_y[1]) & (y <= self.border_end[1]);
            let left_border = left_border.saturating_add(self.row_offsets[i]);
            let right_border = right_border.saturating_add(self.row_offsets[i]);
            let left = left.min(if has_left { left_border } else { i16::MAX });
            let right = right.max(if has_right { right_border } else { i16::MIN });
            // Odd rows are shifted by half the distance of two samples.
            let shift = if i % 2 == 0 { HALF / 2 } else { -HALF / 2 };
            // Samples on the left border are covered, those on the right border are not: rounding
            // puts many borders on samples.
            let to_sample = shift + HALF - 1;
            let first = left.saturating_add(to_sample) >> COLUMN_STEPS.trailing_zeros();
            let end = right.saturating_add(to_sample) >> COLUMN_STEPS.trailing_zeros();
            firsts[i] = first.clamp(0, COLUMNS);
            ends[i] = end.max(firsts[i]).min(COLUMNS);
        }
        let mut spans = RowSpans {
            first: [0; LANES],
            end: [0; LANES],
        };
        for i in 0..LANES {
            spans.first[i] = u32::from(firsts[i] as u16);
            spans.end[i] = u32::from(ends[i] as u16);
        }
        spans
    }
}
