//! The stroke of one line: a capsule, and the samples that it covers in each row of a tile.

use guideway_spline::{greater, lesser};

use super::caps::{CapTable, NONE, PHASES};
use crate::cpu::ground::samples::{SamplePattern, clamp, round};
use crate::cpu::ground::tile::{LANES, TILE_PX};

/// Center of a cap for `y` in columns, in phases from the first row of samples.
#[inline(always)]
pub(crate) fn phases<const C: usize>(y: f32) -> i32 {
    // Limit of rounding by addition; farther centers are far outside of the tile.
    const MAX: f32 = (1 << 21) as f32;
    const ROUND: f32 = 1.5 * (1 << 23) as f32;
    let per_row = 1.0 / SamplePattern::<C>::ROW_STEP;
    let phases = lesser(greater((y * per_row - 0.5) * PHASES as f32, -MAX), MAX);
    (phases + ROUND).to_bits() as i32 - ROUND.to_bits() as i32
}

/// A line with round caps, in columns from the tile's corner.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Capsule {
    /// The end of lesser y, and the other.
    pub(crate) x: [f32; 2],
    pub(crate) y: [f32; 2],
    /// Their y in [`phases`].
    pub(crate) phases: [i32; 2],
    /// Change of x per column of y.
    pub(crate) slope: f32,
    /// Half the length that a row of samples cuts from the stroke between its caps.
    pub(crate) half: f32,
    /// Distance below an end at which the left border leaves its cap, and above at which the right
    /// one does. NaN for level lines: their borders are in no row.
    pub(crate) border_offset: f32,
}

/// Per row of samples of a row of pixels: the first covered sample and the end (exclusive).
pub(crate) struct RowSpans {
    pub(crate) first: [u32; LANES],
    pub(crate) end: [u32; LANES],
}

impl Capsule {
    /// The pixels of a row that the line may touch within its radius, one bit each; all for level
    /// lines.
    #[inline(always)]
    pub(crate) fn pixels<const C: usize>(&self, radius: f32, pixel_row: usize) -> u32 {
        /// More than all rounding.
        const MARGIN_PX: f32 = 0.5;
        const LAST: f32 = (TILE_PX - 1) as f32;
        if self.border_offset.is_nan() {
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

    /// The samples covered in one row of pixels of `columns` samples.
    ///
    /// A capsule is convex, so a row of samples cuts it in one interval: from the leftmost of both
    /// caps and the left border to the rightmost.
    ///
    /// ```text
    ///             border_offset
    ///           .-|-.
    ///          (  *  `-.          upper cap
    ///   row -----#########-----   first..end
    ///           `-.   `-.
    ///              `-.  *  )      lower cap
    ///                 `---'
    /// ```
    #[inline(always)]
    pub(crate) fn spans<const C: usize>(
        &self,
        caps: &CapTable<C>,
        pixel_row: usize,
        columns: f32,
    ) -> RowSpans {
        let mut spans = RowSpans {
            first: [0; LANES],
            end: [0; LANES],
        };
        let row_y = (pixel_row * C) as f32;
        let upper = caps.half_chords(self.phases[0], pixel_row);
        let lower = caps.half_chords(self.phases[1], pixel_row);
        for i in 0..LANES {
            let y = row_y + SamplePattern::<C>::ROW_Y[i];
            let to_sample = SamplePattern::<C>::TO_SAMPLE[i];
            let middle = self.x[0] + SamplePattern::<C>::snap((y - self.y[0]) * self.slope);
            let is_between =
                |border_offset| (y >= self.y[0] + border_offset) & (y <= self.y[1] + border_offset);
            let left = lesser(self.x[0] - upper[i], self.x[1] - lower[i]);
            let right = greater(self.x[0] + upper[i], self.x[1] + lower[i]);
            let left_border = if is_between(self.border_offset) {
                middle - self.half
            } else {
                -NONE
            };
            let right_border = if is_between(-self.border_offset) {
                middle + self.half
            } else {
                NONE
            };
            spans.first[i] = round(
                lesser(left, left_border) + (to_sample - SamplePattern::<C>::SLACK),
                columns,
            );
            let end = round(
                greater(right, right_border) + (to_sample + SamplePattern::<C>::SLACK),
                columns,
            );
            spans.end[i] = end.max(spans.first[i]);
        }
        spans
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cpu::ground::samples::{LAYERED, ROWS, SOLID};
    use crate::cpu::raster::line_batch::{capsule, level_capsule};

    /// Numbers from 0 to 1, the same in every run.
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

    /// Compares with the distance of every sample, in pixels.
    #[track_caller]
    fn check<const C: usize>(a: [f32; 2], b: [f32; 2], radius: f32) {
        let unit = C as f32;
        let mut caps = CapTable::<C>::default();
        caps.resize(radius * unit);
        let capsule = capsule::<C>(a.map(|v| v * unit), b.map(|v| v * unit), radius * unit);
        for row in 0..32 * ROWS {
            let spans = capsule.spans(&caps, row / ROWS, 32.0 * unit);
            let shift = SamplePattern::<C>::TO_SAMPLE[row % ROWS];
            for column in 0..32 * C {
                let x = (column as f32 + 0.5 - shift) / unit;
                let at = [x, (row as f32 + 0.5) / ROWS as f32];
                let beyond = distance(at, a, b) - radius;
                let span = spans.first[row % ROWS]..spans.end[row % ROWS];
                // Caps are rounded to 1/128 px.
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
    fn spans_match_the_distance_of_every_sample() {
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
    fn level_upright_and_zero_length_lines_match_too() {
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
        let mut caps = CapTable::<LAYERED>::default();
        caps.resize(16.0);
        let spans = level_capsule::<LAYERED>([-144.0, 480.0], 8.5 + 144.0).spans(&caps, 8, 256.0);
        assert_eq!((spans.first[8], spans.end[8]), (0, 256));
        assert_eq!((spans.first[7], spans.end[7]), (256, 256));
    }

    #[test]
    fn a_line_moved_by_whole_pixels_covers_the_same_samples() {
        check_moved::<SOLID>();
        check_moved::<LAYERED>();
    }

    fn check_moved<const C: usize>() {
        const DOWN_PX: usize = 7;
        let right = 11 * C as u32;
        let mut next = numbers();
        for i in 0..200 {
            let mut point = || [next() * 100.0, next() * 100.0].map(SamplePattern::<C>::snap);
            let (a, b) = (point(), point());
            let mut caps = CapTable::<C>::default();
            caps.resize([0.7, 12.0, 300.0][i % 3]);
            let moved = |p: [f32; 2]| [p[0] + right as f32, p[1] + (DOWN_PX * C) as f32];
            let here = capsule::<C>(a, b, caps.radius);
            let there = capsule::<C>(moved(a), moved(b), caps.radius);
            for row in 0..16 {
                let here = here.spans(&caps, row, 128.0);
                let there = there.spans(&caps, row + DOWN_PX, 512.0);
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
