//! Half chords of round caps in steps of the fixed-point rasterizer.

use crate::cpu::ground::fixed_steps::{MAX_RADIUS_PX, ROW_STEPS, STEPS};
use crate::cpu::ground::samples::ROWS;
use crate::cpu::ground::tile::LANES;

/// Half chord of rows beside the cap: far to the other side of any tile.
const NONE: i16 = i16::MIN;
/// Distance of a row outside of a cap up to which it touches it, in steps: a border through a row
/// covers it.
const SLACK: f32 = 0.1;

/// Half chords of the caps of one radius, in steps.
#[derive(Debug, Default)]
pub(crate) struct FixedCapTable {
    pub(crate) radius: f32,
    /// Distance from its line up to which a stroke reaches.
    pub(crate) reach: i16,
    /// Distance of each row of samples from the first, in pixels, times 2^15. A field, because the
    /// compiler generates slower code for a constant.
    pub(crate) row_parts: [i16; LANES],
    /// Per position of the center between two rows: half chords from far above it to far below.
    halves: Vec<i16>,
    /// Rows per position, and rows above the center.
    rows: i32,
    rows_above: i32,
}

/// Positions of the half chords for one center: of all rows, and of the first row of pixels.
#[derive(Clone, Copy)]
pub(crate) struct CapRows {
    first: i32,
    top: i32,
}

impl FixedCapTable {
    pub(crate) fn resize(&mut self, radius_px: f32) {
        // The cull stage rejects larger radii.
        self.radius = radius_px.min(MAX_RADIUS_PX as f32) * STEPS as f32;
        self.reach = self.radius as i16 + 1;
        self.row_parts = std::array::from_fn(|row| (row << 15 >> ROWS.trailing_zeros()) as i16);
        // One row of pixels more on either side, whose rows have no half chords.
        self.rows_above = (self.radius / ROW_STEPS as f32) as i32 + 2 + LANES as i32;
        self.rows = 2 * self.rows_above + 1;
        self.halves.clear();
        for place in 0..ROW_STEPS {
            let rows = -self.rows_above..=self.rows_above;
            let radius = self.radius;
            self.halves
                .extend(rows.map(|row| half_chord(radius, (row * ROW_STEPS - place) as f32)));
        }
    }

    /// Upper bound of the heap bytes for a radius.
    pub(crate) fn bytes(radius_px: usize) -> u64 {
        let rows = 2 * (radius_px * ROWS + 2 + LANES) + 1;
        (rows * ROW_STEPS as usize * size_of::<i16>()) as u64
    }

    /// The rows around a center `center` steps below the upper side of the tile.
    #[inline(always)]
    pub(crate) fn around(&self, center: i16) -> CapRows {
        // Rows lie in the middle of their strip.
        let below = i32::from(center) - ROW_STEPS / 2;
        let first = (below & (ROW_STEPS - 1)) * self.rows;
        let row = below >> ROW_STEPS.trailing_zeros();
        CapRows {
            first,
            top: first + self.rows_above - row,
        }
    }

    /// Half chords of a row of pixels.
    #[inline(always)]
    pub(crate) fn half_chords(&self, around: CapRows, pixel_row: usize) -> [i16; LANES] {
        let last = around.first + self.rows - LANES as i32;
        let at = around.top + (pixel_row * LANES) as i32;
        let at = at.max(around.first).min(last) as usize;
        let Some(halves) = self.halves.get(at..at + LANES) else {
            return [NONE; LANES];
        };
        let mut all = [0; LANES];
        all.copy_from_slice(halves);
        all
    }
}

/// Half chord at a distance from the center.
fn half_chord(radius: f32, off: f32) -> i16 {
    if off.abs() > radius + SLACK {
        return NONE;
    }
    ((radius - off) * (radius + off)).max(0.0).sqrt().round() as i16
}
