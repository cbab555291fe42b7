use super::caps::{Around, Caps};
use super::{COLUMN_STEPS, Ends, LANES, ROW_STEPS, STEPS, pixel_of};
use crate::cpu::canvas::TILE_PX;
use crate::cpu::span::{SOLID, Spans};

/// The greatest slope of a border, in x for one in y. A border that is more level is next to nothing on a short line.
const MOST_SLOPE: f32 = 200.0;
/// The most of a short line, to the side.
const SHORT: i16 = 8 * STEPS as i16;
/// Parts of slopes, as a power of two.
const SLOPE_BITS: u32 = 14;

/// The borders of strokes between their caps, a stroke a lane: first the left ones.
pub(super) struct Borders {
    /// Where they leave the upper cap. Those of level lines are in no row.
    x: [[i16; LANES]; 2],
    y: [[i16; LANES]; 2],
    /// From there to where they reach the lower one.
    height: [i16; LANES],
    /// In x for one in y, in parts of 2^14.
    slope: [i32; LANES],
    /// Lines that are long and almost level, a bit each: they need floats.
    pub(super) level: u32,
}

impl Borders {
    #[inline(always)]
    pub(super) fn new(ends: &Ends, radius: f32) -> Self {
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
            let is_level = x.abs() > MOST_SLOPE * y;
            let is_long = dx.abs() > SHORT;
            *level = if is_level & is_long { 1 << i } else { 0 };
            let [aside, lean] = [whole(y * part) as i16, whole(x * part) as i16];
            borders.x[0][i] = ends.x[0][i] - aside;
            borders.x[1][i] = ends.x[0][i] + aside;
            let nowhere = i16::MAX;
            borders.y[0][i] = if is_level {
                nowhere
            } else {
                ends.y[0][i] + lean
            };
            borders.y[1][i] = if is_level {
                nowhere
            } else {
                ends.y[0][i] - lean
            };
            borders.height[i] = if is_level { 0 } else { dy };
            let slope = if is_level { 0.0 } else { x / y.max(1.0) };
            borders.slope[i] = whole(slope * (1 << SLOPE_BITS) as f32);
        }
        borders.level = level.iter().fold(0, |all, bit| all | bit);
        borders
    }
}

/// The nearest whole number of one below 2^22.
#[inline(always)]
fn whole(x: f32) -> i32 {
    const ROUND: f32 = 1.5 * (1 << 23) as f32;
    (x + ROUND).to_bits() as i32 - ROUND.to_bits() as i32
}

/// One stroke.
pub(super) struct Stroke {
    x: [i16; 2],
    y: [i16; 2],
    caps: [Around; 2],
    /// Where its borders leave the upper cap and reach the lower one.
    border_x: [i16; 2],
    border_y: [i16; 2],
    border_end: [i16; 2],
    slope: i32,
    /// How far borders go aside from the first row of samples of a pixel to each.
    aside: [i16; LANES],
}

impl Stroke {
    #[inline(always)]
    pub(super) fn new(ends: &Ends, borders: &Borders, lane: usize, caps: &Caps) -> Self {
        // No maps of arrays here: their closures may be left out of line, and then without vectors.
        let slope = borders.slope[lane];
        let a_pixel = (slope >> (SLOPE_BITS - STEPS.trailing_zeros())) as i16;
        let mut aside = [0; LANES];
        for (aside, &part) in aside.iter_mut().zip(&caps.parts) {
            *aside = ((i32::from(part) * i32::from(a_pixel) + (1 << 14)) >> 15) as i16;
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
            aside,
        }
    }

    /// The pixels of a row that the part of the line within reach of it may touch, a bit each; not of level lines.
    #[inline(always)]
    pub(super) fn pixels(&self, pixel_row: usize, reach: i16) -> u32 {
        let top = pixel_row as i32 * STEPS - i32::from(reach);
        let bottom = top + STEPS + 2 * i32::from(reach);
        let (a, b) = (self.x_at(top), self.x_at(bottom));
        let first = pixel_of((a.min(b) - i32::from(reach)) as i16);
        let last = pixel_of((a.max(b) + 1 + i32::from(reach)) as i16);
        u32::MAX << first & u32::MAX >> (TILE_PX as u16 - 1 - last)
    }

    /// Where the line is at a height, or at the end that is nearest to it.
    #[inline(always)]
    fn x_at(&self, y: i32) -> i32 {
        let [y0, y1] = [i32::from(self.y[0]), i32::from(self.y[1])];
        let below = i64::from((y - y0).max(0).min(y1 - y0));
        i32::from(self.x[0]) + ((below * i64::from(self.slope)) >> SLOPE_BITS) as i32
    }

    /// Where a border is in a row of samples.
    #[inline(always)]
    fn border(&self, side: usize, y: i32) -> i16 {
        let below = i64::from(y - i32::from(self.border_y[side]));
        let half = 1 << (SLOPE_BITS - 1);
        let aside = (below * i64::from(self.slope) + half) >> SLOPE_BITS;
        // It fits in 16 bits wherever the border is in the row of pixels.
        (i64::from(self.border_x[side]) + aside) as i16
    }

    /// The samples covered in one row of pixels, found as those of [`crate::cpu::span::Capsule`].
    #[inline(always)]
    pub(super) fn spans(&self, pixel_row: usize, caps: &Caps) -> Spans {
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
            let left_border = left_border.saturating_add(self.aside[i]);
            let right_border = right_border.saturating_add(self.aside[i]);
            let left = left.min(if has_left { left_border } else { i16::MAX });
            let right = right.max(if has_right { right_border } else { i16::MIN });
            // Every other row is shifted by half the distance of its samples.
            let shift = if i % 2 == 0 { HALF / 2 } else { -HALF / 2 };
            // Samples on the left border are covered, those on the right one are not: of rounded borders many are on one.
            let to_sample = shift + HALF - 1;
            let first = left.saturating_add(to_sample) >> COLUMN_STEPS.trailing_zeros();
            let end = right.saturating_add(to_sample) >> COLUMN_STEPS.trailing_zeros();
            firsts[i] = first.clamp(0, COLUMNS);
            ends[i] = end.max(firsts[i]).min(COLUMNS);
        }
        let mut spans = Spans {
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
