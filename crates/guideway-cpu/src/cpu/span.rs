use guideway_spline::{greater, lesser};

use super::LANES;
use super::canvas::TILE_PX;
use super::disc::{Disc, NONE, PHASES};
use super::place::STEPS_PX;

/// Rows of samples of a pixel.
pub(super) const ROWS: usize = LANES;
/// Samples of each of them where colors or paths are told apart: those of the oracle.
pub(super) const LAYERED: usize = 16;
/// Samples of each of them where all is one color. Every other row is shifted by half their distance, so that
/// upright borders are told apart as finely as level ones.
pub(super) const SOLID: usize = 8;

/// Adding this rounds a small number to the nearest integer, in the low bits of the sum.
const ROUND: f32 = (1 << 23) as f32;

/// The samples of a pixel: `C` in each row, a column apart. Columns are the unit of all lengths here, so that a
/// circle is one.
pub(super) struct Samples<const C: usize>;

impl<const C: usize> Samples<C> {
    /// All of them.
    pub(super) const COUNT: usize = ROWS * C;
    /// From one row to the next.
    pub(super) const ROW_STEP: f32 = C as f32 / ROWS as f32;
    /// How far a sample may lie outside and still count as covered: a step and a half. It makes a border through a
    /// row of samples cover that row, as it does in exact arithmetic, wherever the picture begins.
    pub(super) const SLACK: f32 = 1.5 * C as f32 / STEPS_PX as f32;

    /// Where the rows lie below the upper border.
    const ROW_Y: [f32; LANES] = {
        let mut y = [0.0; LANES];
        let mut i = 0;
        while i < LANES {
            y[i] = (i as f32 + 0.5) * Self::ROW_STEP;
            i += 1;
        }
        y
    };

    /// What to add to a position so that it rounds to the first sample at or behind it.
    const TO_SAMPLE: [f32; LANES] = {
        let shifts = ROWS / C;
        let mut to_sample = [0.0; LANES];
        let mut i = 0;
        while i < LANES {
            to_sample[i] = 0.5 - ((i % shifts) as f32 + 0.5) / shifts as f32;
            i += 1;
        }
        to_sample
    };

    /// The nearest step, of which a pixel has [`STEPS_PX`].
    ///
    /// All that depends on the place of a line is such a multiple, so its sums are exact, and a line that is
    /// moved by whole pixels covers the same samples, moved by as much.
    #[inline(always)]
    pub(super) fn snap(x: f32) -> f32 {
        // Sums with it have a last digit of one step.
        let step = 1.5 * (1 << 23) as f32 * (C as f32 / STEPS_PX as f32);
        (x + step) - step
    }
}

/// The center of a disc in phases from the first row of samples, for `y` in columns.
#[inline(always)]
pub(super) fn phases<const C: usize>(y: f32) -> i32 {
    // Beyond what a float can be rounded to by addition nothing is in sight.
    const MOST: f32 = (1 << 21) as f32;
    const ROUND: f32 = 1.5 * (1 << 23) as f32;
    let per_row = 1.0 / Samples::<C>::ROW_STEP;
    let phases = lesser(greater((y * per_row - 0.5) * PHASES as f32, -MOST), MOST);
    (phases + ROUND).to_bits() as i32 - ROUND.to_bits() as i32
}

/// A line with round caps, from a tile's upper left corner.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Capsule {
    /// The end of lesser y, and the other.
    pub(super) x: [f32; 2],
    pub(super) y: [f32; 2],
    /// Their `y` by [`phases`].
    pub(super) phases: [i32; 2],
    /// From one row to the next, in x.
    pub(super) slope: f32,
    /// Half of what a row cuts from the stroke between its caps.
    pub(super) half: f32,
    /// How far below an end the left border leaves its cap, and the right one above. NaN of level lines:
    /// their borders are in no row.
    pub(super) lean: f32,
}

/// For each row of samples of one row of pixels, the first sample covered and the one after the last, or the same where
/// there is none.
pub(super) struct Spans {
    pub(super) first: [u32; LANES],
    pub(super) end: [u32; LANES],
}

impl Capsule {
    /// A level line.
    #[cfg(test)]
    pub(super) fn level<const C: usize>(x: [f32; 2], y: f32) -> Self {
        super::stroke::capsule::<C>([x[0], y], [x[1], y], 1.0)
    }

    /// The pixels of a row that the part of the line within reach of it may touch, a bit each; all of level lines.
    #[inline(always)]
    pub(super) fn pixels<const C: usize>(&self, radius: f32, pixel_row: usize) -> u32 {
        /// More than all that is rounded.
        const MARGIN_PX: f32 = 0.5;
        const LAST: f32 = (TILE_PX - 1) as f32;
        if self.lean.is_nan() {
            return u32::MAX;
        }
        let x_at = |y: f32| {
            self.x[0] + (lesser(greater(y, self.y[0]), self.y[1]) - self.y[0]) * self.slope
        };
        let row_y = (pixel_row * C) as f32;
        let (a, b) = (x_at(row_y - radius), x_at(row_y + C as f32 + radius));
        let pixel_at = |x: f32| clamp(x * (1.0 / C as f32), LAST) as u32;
        let margin = radius + MARGIN_PX * C as f32;
        u32::MAX << pixel_at(lesser(a, b) - margin)
            & u32::MAX >> (LAST as u32 - pixel_at(greater(a, b) + margin))
    }

    /// The samples covered in one row of pixels, of `columns` in all.
    ///
    /// A row of samples cuts the capsule in one interval, for it is convex: from the leftmost point of both
    /// discs and the left border to the rightmost.
    #[inline(always)]
    pub(super) fn spans<const C: usize>(
        &self,
        disc: &Disc<C>,
        pixel_row: usize,
        columns: f32,
    ) -> Spans {
        let mut spans = Spans {
            first: [0; LANES],
            end: [0; LANES],
        };
        let row_y = (pixel_row * C) as f32;
        let upper = disc.half_chords(self.phases[0], pixel_row);
        let lower = disc.half_chords(self.phases[1], pixel_row);
        for i in 0..LANES {
            let y = row_y + Samples::<C>::ROW_Y[i];
            let to_sample = Samples::<C>::TO_SAMPLE[i];
            let middle = self.x[0] + Samples::<C>::snap((y - self.y[0]) * self.slope);
            let is_between = |lean| (y >= self.y[0] + lean) & (y <= self.y[1] + lean);
            let left = lesser(self.x[0] - upper[i], self.x[1] - lower[i]);
            let right = greater(self.x[0] + upper[i], self.x[1] + lower[i]);
            let left_border = if is_between(self.lean) {
                middle - self.half
            } else {
                -NONE
            };
            let right_border = if is_between(-self.lean) {
                middle + self.half
            } else {
                NONE
            };
            spans.first[i] = round(
                lesser(left, left_border) + (to_sample - Samples::<C>::SLACK),
                columns,
            );
            let end = round(
                greater(right, right_border) + (to_sample + Samples::<C>::SLACK),
                columns,
            );
            spans.end[i] = end.max(spans.first[i]);
        }
        spans
    }
}

/// The nearest whole number from 0 to `most`.
#[inline(always)]
pub(super) fn round(x: f32, most: f32) -> u32 {
    (clamp(x, most) + ROUND).to_bits() - ROUND.to_bits()
}

/// As `f32::clamp` from 0, in two instructions: it may lose a NaN.
#[inline(always)]
pub(super) fn clamp(x: f32, most: f32) -> f32 {
    lesser(greater(x, 0.0), most)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cpu::stroke::capsule;

    /// Numbers between 0 and 1, the same on every run.
    fn numbers() -> impl FnMut() -> f32 {
        let mut state = 7_u64;
        move || {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1);
            (state >> 40) as f32 / (1 << 24) as f32
        }
    }

    fn distance(p: [f32; 2], a: [f32; 2], b: [f32; 2]) -> f32 {
        let [p, along] = [p, b].map(|p| [p[0] - a[0], p[1] - a[1]]);
        let square = along[0] * along[0] + along[1] * along[1];
        let t = (p[0] * along[0] + p[1] * along[1]) / square.max(1e-20);
        let t = t.clamp(0.0, 1.0);
        (p[0] - t * along[0]).hypot(p[1] - t * along[1])
    }

    /// Compares with the distance of each sample, in pixels.
    #[track_caller]
    fn check<const C: usize>(a: [f32; 2], b: [f32; 2], radius: f32) {
        let unit = C as f32;
        let mut disc = Disc::<C>::default();
        disc.resize(radius * unit);
        let capsule = capsule::<C>(a.map(|v| v * unit), b.map(|v| v * unit), radius * unit);
        for row in 0..32 * ROWS {
            let spans = capsule.spans(&disc, row / ROWS, 32.0 * unit);
            let shift = Samples::<C>::TO_SAMPLE[row % ROWS];
            for column in 0..32 * C {
                let x = (column as f32 + 0.5 - shift) / unit;
                let at = [x, (row as f32 + 0.5) / ROWS as f32];
                let beyond = distance(at, a, b) - radius;
                let span = spans.first[row % ROWS]..spans.end[row % ROWS];
                // Caps are rounded to 1/128 of a pixel.
                if beyond.abs() > 5e-3 {
                    assert_eq!(
                        span.contains(&(column as u32)),
                        beyond < 0.0,
                        "{a:?} {b:?} {radius} at {at:?}"
                    );
                }
            }
        }
    }

    #[test]
    fn spans_hold_the_samples_within_the_radius() {
        let mut next = numbers();
        for i in 0..100 {
            let mut point = || [next() * 48.0 - 8.0, next() * 48.0 - 8.0];
            let (a, b) = (point(), point());
            let radius = [0.01, 0.3, 0.75, 1.5, 6.0, 40.0][i % 6];
            check::<SOLID>(a, b, radius);
            check::<LAYERED>(a, b, radius);
        }
    }

    #[test]
    fn level_upright_and_vanishing_lines_are_no_exceptions() {
        for radius in [0.05, 0.75, 3.0] {
            check::<LAYERED>([3.1, 8.2], [12.7, 8.2], radius);
            check::<LAYERED>([12.7, 8.2], [3.1, 8.2], radius);
            check::<SOLID>([3.1, 2.2], [3.1, 12.9], radius);
            check::<SOLID>([3.1, 2.2], [3.1, 2.2], radius);
            check::<LAYERED>([3.1, 8.2], [12.7, 8.200_01], radius);
            check::<LAYERED>([-300.0, 8.2], [300.0, 8.3], radius);
        }
    }

    #[test]
    fn a_border_through_samples_covers_them() {
        let mut disc = Disc::<LAYERED>::default();
        disc.resize(16.0);
        let spans = Capsule::level::<LAYERED>([-144.0, 480.0], 8.5 + 144.0).spans(&disc, 8, 256.0);
        assert_eq!((spans.first[8], spans.end[8]), (0, 256));
        assert_eq!((spans.first[7], spans.end[7]), (256, 256));
    }

    #[test]
    fn whole_pixels_farther_down_and_right_the_same_samples_are_covered() {
        check_moved::<SOLID>();
        check_moved::<LAYERED>();
    }

    fn check_moved<const C: usize>() {
        const DOWN_PX: usize = 7;
        let right = 11 * C as u32;
        let mut next = numbers();
        for i in 0..200 {
            let mut point = || [next() * 100.0, next() * 100.0].map(Samples::<C>::snap);
            let (a, b) = (point(), point());
            let mut disc = Disc::<C>::default();
            disc.resize([0.7, 12.0, 300.0][i % 3]);
            let moved = |p: [f32; 2]| [p[0] + right as f32, p[1] + (DOWN_PX * C) as f32];
            let here = capsule::<C>(a, b, disc.radius);
            let there = capsule::<C>(moved(a), moved(b), disc.radius);
            for row in 0..16 {
                let here = here.spans(&disc, row, 128.0);
                let there = there.spans(&disc, row + DOWN_PX, 512.0);
                for lane in 0..LANES {
                    for column in 0..128 {
                        let is_here = (here.first[lane]..here.end[lane]).contains(&column);
                        let is_there =
                            (there.first[lane]..there.end[lane]).contains(&(column + right));
                        assert_eq!(is_here, is_there, "{a:?} {b:?} {row} {lane} {column}");
                    }
                }
            }
        }
    }
}
