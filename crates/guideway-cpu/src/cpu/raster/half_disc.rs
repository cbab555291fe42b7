//! Butt caps: the half disc beyond one end of a path, which its stroke leaves out.

use std::ops::Range;

use guideway_scene::PathEnd;
use guideway_spline::Point;

use super::bits::{WINDOW_COLUMNS, high_bits};
use super::capsule::RowSpans;
use super::coverage_mask::CoverageMask;
use crate::cpu::ground::samples::{SamplePattern, columns, round};
use crate::cpu::ground::snapped_view::STEPS_PER_PX;
use crate::cpu::ground::tile::{LANES, TILE_PX};

/// Distance, in pixels, by which the disc is larger than the round cap: more than all rounding. The
/// stroke has no sample there.
const MARGIN_PX: f64 = 1.0 / 16.0;

/// A half disc relative to a tile.
///
/// ```text
///   stroke  ---------.
///   row of  ---------|####.    first..end: from the plane through the end
///   samples     end  *#####    to the circle
///           ---------|####'
///           ---------'
/// ```
pub(crate) struct HalfDisc {
    /// The end of the path, in pixels from the corner of the tile, in whole steps of the view.
    end: Point<f64>,
    outward: Point<f64>,
    radius_px: f64,
}

impl HalfDisc {
    /// The half disc at an end whose place in the tile is `end_px`.
    pub(crate) fn new(end: &PathEnd, end_px: Point<f64>, radius_px: f64) -> Self {
        Self {
            end: end_px,
            // The y axis of pictures points down.
            outward: Point::new(end.outward.x, -end.outward.y),
            radius_px: radius_px + MARGIN_PX,
        }
    }

    /// The rows of pixels that it may touch.
    pub(crate) fn rows(&self) -> Range<usize> {
        let first = (self.end.y - self.radius_px).max(0.0) as usize;
        let end = (self.end.y + self.radius_px).ceil().max(0.0) as usize;
        first..end.min(TILE_PX)
    }

    /// Its samples in one row of pixels of `C` columns each. Moved by whole pixels it has the same
    /// ones: all that depends on its place is exact.
    pub(crate) fn spans<const C: usize>(&self, pixel_row: usize) -> RowSpans {
        let mut spans = RowSpans {
            first: [0; LANES],
            end: [0; LANES],
        };
        for i in 0..LANES {
            let row_px = f64::from(SamplePattern::<C>::ROW_Y[i]) / C as f64;
            let below = pixel_row as f64 + row_px - self.end.y;
            let Some([left, right]) = self.chord(below) else {
                continue;
            };
            let to_sample = SamplePattern::<C>::TO_SAMPLE[i];
            let at = |offset: f64| {
                let place = self.end.x + (offset * STEPS_PER_PX).round() / STEPS_PER_PX;
                round(columns::<C>(place) + to_sample, (TILE_PX * C) as f32)
            };
            spans.first[i] = at(left);
            spans.end[i] = at(right).max(spans.first[i]);
        }
        spans
    }

    /// The part of a row at a distance below the end, in pixels to the right of it.
    fn chord(&self, below: f64) -> Option<[f64; 2]> {
        let half = (self.radius_px.powi(2) - below.powi(2)).max(0.0).sqrt();
        let across = self.outward.x;
        // The plane cuts the row where x * across + below * outward.y is 0.
        let plane = -below * self.outward.y / across;
        let [left, right] = match across {
            0.0 if below * self.outward.y > 0.0 => [-half, half],
            0.0 => return None,
            _ if across > 0.0 => [plane.max(-half), half],
            _ => [-half, plane.min(half)],
        };
        (left < right).then_some([left, right])
    }
}

impl<const C: usize> CoverageMask<C> {
    /// Takes a half disc out of the shape.
    #[inline(always)]
    pub(crate) fn remove(&mut self, disc: &HalfDisc) {
        for row in disc.rows() {
            let spans = disc.spans::<C>(row);
            for window in 0..C {
                if self.touched[window] >> row & 1 == 0 {
                    continue;
                }
                let left = (window * WINDOW_COLUMNS) as u32;
                let block = &mut self.shape[window][row];
                for ((word, &first), &end) in block.iter_mut().zip(&spans.first).zip(&spans.end) {
                    *word &= !(high_bits(first.max(left) - left) ^ high_bits(end.max(left) - left));
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cpu::ground::samples::{LAYERED, ROWS};

    /// Compares every sample of a tile with the definition.
    #[track_caller]
    fn check(end_px: Point<f64>, angle: f64, radius_px: f64) {
        let (y, x) = angle.sin_cos();
        let end = PathEnd {
            at: Point::default(),
            outward: Point::new(x, -y),
        };
        let disc = HalfDisc::new(&end, end_px, radius_px);
        let mut found = 0;
        for row in 0..TILE_PX * ROWS {
            let spans = disc.spans::<LAYERED>(row / ROWS);
            let is_row = disc.rows().contains(&(row / ROWS));
            let span = spans.first[row % ROWS]..spans.end[row % ROWS];
            assert!(is_row || span.is_empty(), "{row} of {:?}", disc.rows());
            for column in 0..TILE_PX * LAYERED {
                let [x, y] = [column, row].map(|at| (at as f64 + 0.5) / LAYERED as f64);
                let from_end = Point::new(x, y) - end_px;
                let beyond = from_end.dot(disc.outward);
                let outside = from_end.norm() - disc.radius_px;
                if beyond.abs() > 1e-3 && outside.abs() > 1e-3 {
                    let holds = beyond > 0.0 && outside < 0.0;
                    assert_eq!(
                        span.contains(&(column as u32)),
                        holds,
                        "{from_end:?} at {angle}"
                    );
                    found += u32::from(holds);
                }
            }
        }
        assert!(found > 0, "{end_px:?}");
    }

    #[test]
    fn spans_are_the_samples_beyond_the_end() {
        for (i, radius_px) in [0.75, 2.0, 6.0, 30.0].into_iter().enumerate() {
            for turn in 0..16 {
                let angle = f64::from(turn) * std::f64::consts::TAU / 16.0;
                check(Point::new(12.25 + i as f64, 15.5), angle, radius_px);
            }
            check(Point::new(-0.25, 3.0), 0.3, radius_px);
        }
    }
}
