//! The disc around the end of a path: a capsule without length, whose samples take fewer steps.

use super::caps::CapTable;
use super::capsule::{RowSpans, phases};
use super::coverage_mask::RowCoverage;
use crate::cpu::ground::samples::{SamplePattern, round};
use crate::cpu::ground::tile::{LANES, TILE_PX};

/// A disc, in columns from the tile's corner.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Disc {
    x: f32,
    /// Its y in [`phases`].
    phases: i32,
}

impl Disc {
    #[inline(always)]
    pub(crate) fn new<const C: usize>(x: f32, y: f32) -> Self {
        Self {
            x,
            phases: phases::<C>(y),
        }
    }
}

impl<const C: usize> RowCoverage for (&Disc, &CapTable<C>) {
    #[inline(always)]
    fn width_px(&self) -> u32 {
        (2.0 / C as f32 * self.1.radius) as u32
    }

    #[inline(always)]
    fn pixels(&self, _row: usize) -> u32 {
        u32::MAX
    }

    /// The same as those of a capsule from the center to itself.
    #[inline(always)]
    fn spans(&self, row: usize) -> RowSpans {
        let (Disc { x, phases }, columns) = (*self.0, (TILE_PX * C) as f32);
        let halves = self.1.half_chords(phases, row);
        let mut spans = RowSpans {
            first: [0; LANES],
            end: [0; LANES],
        };
        for (i, &half) in halves.iter().enumerate() {
            let to_sample = SamplePattern::<C>::TO_SAMPLE[i];
            spans.first[i] = round(x - half + (to_sample - SamplePattern::<C>::SLACK), columns);
            let end = round(x + half + (to_sample + SamplePattern::<C>::SLACK), columns);
            spans.end[i] = end.max(spans.first[i]);
        }
        spans
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cpu::ground::samples::LAYERED;
    use crate::cpu::raster::line_batch::capsule;

    #[test]
    fn spans_are_those_of_a_capsule_without_length() {
        for (i, radius) in [0.3, 4.8, 11.0, 40.0, 700.0].into_iter().enumerate() {
            let mut caps = CapTable::<LAYERED>::default();
            caps.resize(radius);
            for step in 0..200 {
                let x = (step * 37 % 600) as f32 - 40.0 + i as f32 / 16.0;
                let y = (step * 53 % 600) as f32 - 40.0 + step as f32 / 64.0;
                let capsule = capsule::<LAYERED>([x, y], [x, y], radius);
                let disc = Disc::new::<LAYERED>(x, y);
                for row in 0..TILE_PX {
                    let expected = (&capsule, &caps).spans(row);
                    let spans = (&disc, &caps).spans(row);
                    assert_eq!(spans.first, expected.first, "{x} {y} {radius} {row}");
                    assert_eq!(spans.end, expected.end, "{x} {y} {radius} {row}");
                }
            }
        }
    }
}
