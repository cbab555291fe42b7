//! Lines of small clusters in numbers of 16 bits, of which a vector holds twice as many as of floats.
//!
//! All is rounded to steps of a 64th of a pixel, about what kept lines are rounded to already. What depends on the place of
//! a line is a whole number of steps, so a line that is moved by whole pixels covers the same samples, moved by as much.

mod caps;
mod stroke;
#[cfg(test)]
mod tests;

use std::ops::{Range, RangeInclusive};

use guideway_spline::Point;

pub(super) use self::caps::Caps;
use self::stroke::{Borders, Stroke};
use super::LANES;
use super::canvas::{Canvas, Cuts, TILE_PX, set_bits};
use super::disc::Disc;
use super::polylines::{Polylines, bits_below};
use super::span::{ROWS, SOLID, Spans};
use super::stroke::{Batch, Boxes};

/// Steps of a pixel.
const STEPS: i32 = 64;
/// From one row of samples to the next.
const ROW_STEPS: i32 = STEPS / ROWS as i32;
/// From one sample of a row to the next.
const COLUMN_STEPS: i32 = STEPS / SOLID as i32;
/// Farthest that a cluster reaches from its middle, and half the width of its widest stroke, in pixels. No end of a line is
/// then farther than 280 px from the corner of a tile that its cluster touches, and sums with half chords do not overflow.
const MOST_REACH_PX: f64 = 120.0;
const MOST_RADIUS_PX: f64 = 8.0;
/// Half the width of the thinnest stroke: of thinner ones the half step that borders are rounded by is too large a part, and all
/// that share a pixel are off alike.
const LEAST_RADIUS_PX: f64 = 0.5;

/// Whether lines of a cluster that reaches so far, with strokes of these radii, fit.
pub(super) fn fits(reach_px: f64, radii_px: RangeInclusive<f64>) -> bool {
    reach_px <= MOST_REACH_PX
        && *radii_px.start() >= LEAST_RADIUS_PX
        && *radii_px.end() <= MOST_RADIUS_PX
}

/// Kept lines as they lie in one tile.
pub(super) struct Fixed<'a> {
    lines: &'a Polylines<i16>,
    /// A unit of the lines in steps, in parts of 2^15.
    scale: i32,
    /// Where their middle lies, in whole steps.
    offset: [i16; 2],
    /// What is left of a step there and the half that rounds to the nearest, in parts of 2^15.
    rest: [i32; 2],
}

/// Lines side by side, one a lane: the end of lesser y, and the other.
struct Ends {
    x: [[i16; LANES]; 2],
    y: [[i16; LANES]; 2],
}

impl<'a> Fixed<'a> {
    /// Units of the lines are more than half a step and at most one.
    #[inline(always)]
    pub(super) fn new(lines: &'a Polylines<i16>, unit_px: f64, middle_px: Point<f64>) -> Self {
        const ONE: f64 = (1 << 15) as f64;
        let steps = middle_px * f64::from(STEPS);
        let whole = Point::new(steps.x.floor(), steps.y.floor());
        let rest = |steps: f64| ((steps + 0.5) * ONE) as i32;
        Self {
            lines,
            scale: (unit_px * f64::from(STEPS) * ONE).round() as i32,
            offset: [whole.x as i16, whole.y as i16],
            rest: [rest(steps.x - whole.x), rest(steps.y - whole.y)],
        }
    }

    /// Covers samples with the lines that begin at the vertices of `range`.
    #[inline(always)]
    pub(super) fn stroke(
        &self,
        canvas: &mut Canvas<SOLID>,
        range: Range<usize>,
        disc: &Disc<SOLID>,
    ) {
        let caps = &disc.caps;
        for first in range.clone().step_by(LANES) {
            let Some(ends) = self.ends(first) else {
                return;
            };
            let begins = self.lines.begin_bits(first) & bits_below(range.end - first);
            let boxes = ends.boxes(caps.reach);
            let open = boxes.open(canvas.open());
            let todo = begins & open.lines;
            if todo == 0 {
                continue;
            }
            let borders = Borders::new(&ends, caps.radius);
            if todo & borders.level != 0 {
                let batch = ends.as_floats(disc.radius);
                let slopes = batch.slopes();
                for lane in set_bits(todo & borders.level) {
                    let part = boxes.part(lane % LANES, &open);
                    batch.stroke(lane % LANES, &slopes, part, canvas, disc);
                }
            }
            for lane in set_bits(todo & !borders.level) {
                let stroke = Stroke::new(&ends, &borders, lane % LANES, caps);
                canvas.stroke(&(&stroke, caps), boxes.part(lane % LANES, &open));
            }
        }
    }

    #[inline(always)]
    fn ends(&self, first: usize) -> Option<Ends> {
        let x = self.placed(&self.lines.x, first, 0)?;
        let y = self.placed(&self.lines.y, first, 1)?;
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
    fn placed(&self, of: &[i16], first: usize, axis: usize) -> Option<[[i16; LANES]; 2]> {
        let starts: &[i16; LANES] = of.get(first..)?.first_chunk()?;
        let ends: &[i16; LANES] = of.get(first + 1..)?.first_chunk()?;
        let mut placed = [[0; LANES]; 2];
        for i in 0..LANES {
            placed[0][i] = self.place(starts[i], axis);
        }
        for i in 0..LANES {
            placed[1][i] = self.place(ends[i], axis);
        }
        Some(placed)
    }

    /// Where a coordinate lies. Padding behind the last vertex may lie anywhere.
    #[inline(always)]
    fn place(&self, at: i16, axis: usize) -> i16 {
        let steps = (i32::from(at) * self.scale + self.rest[axis]) >> 15;
        (steps as i16).wrapping_add(self.offset[axis])
    }
}

impl Cuts for (&Stroke, &Caps) {
    #[inline(always)]
    fn width_px(&self) -> u32 {
        2 * self.1.reach as u32 / STEPS as u32
    }

    #[inline(always)]
    fn pixels(&self, row: usize) -> u32 {
        self.0.pixels(row, self.1.reach)
    }

    #[inline(always)]
    fn spans(&self, row: usize) -> Spans {
        self.0.spans(row, self.1)
    }
}

/// The pixel of the tile that is nearest to a position.
#[inline(always)]
fn pixel_of(at: i16) -> u16 {
    const MOST: i16 = TILE_PX as i16 - 1;
    (at >> STEPS.trailing_zeros()).clamp(0, MOST) as u16
}

impl Ends {
    /// The pixels that strokes which reach so far may touch.
    #[inline(always)]
    fn boxes(&self, reach: i16) -> Boxes {
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
        Boxes::new(rows, columns, inside)
    }

    /// Lines of the same ends, in columns of samples.
    #[inline(always)]
    fn as_floats(&self, radius: f32) -> Batch<SOLID> {
        const COLUMN: f32 = 1.0 / COLUMN_STEPS as f32;
        let (mut x, mut y) = ([[0.0; LANES]; 2], [[0.0; LANES]; 2]);
        for end in 0..2 {
            for i in 0..LANES {
                x[end][i] = f32::from(self.x[end][i]) * COLUMN;
                y[end][i] = f32::from(self.y[end][i]) * COLUMN;
            }
        }
        Batch::new(x, y, radius)
    }
}
