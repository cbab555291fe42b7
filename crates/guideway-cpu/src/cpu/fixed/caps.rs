use super::{LANES, MOST_RADIUS_PX, ROW_STEPS, STEPS};
use crate::cpu::span::ROWS;

/// Half a chord where there is none: far to the other side of any tile.
const NONE: i16 = i16::MIN;
/// How far a row may lie outside of a disc and still touch it, in steps: a border through a row covers it.
const SLACK: f32 = 0.1;

/// The round ends of strokes of one radius, in steps.
#[derive(Debug, Default)]
pub(in crate::cpu) struct Caps {
    pub(super) radius: f32,
    /// How far a stroke reaches from its line.
    pub(super) reach: i16,
    /// What part of a pixel each row of samples lies below the first, in 2^15: held here, for of a constant the compiler makes
    /// something longer.
    pub(super) parts: [i16; LANES],
    /// For each place of the center between two rows, half chords of the rows from far above it to far below.
    halves: Vec<i16>,
    /// Rows of such a place, and those before the one at the center.
    rows: i32,
    rows_above: i32,
}

/// Where the half chords of a disc are: those of all rows around its center, and those of the tile's first row of pixels.
#[derive(Clone, Copy)]
pub(super) struct Around {
    first: i32,
    top: i32,
}

impl Caps {
    pub(in crate::cpu) fn resize(&mut self, radius_px: f32) {
        // Larger ones are never asked for.
        self.radius = radius_px.min(MOST_RADIUS_PX as f32) * STEPS as f32;
        self.reach = self.radius as i16 + 1;
        self.parts = std::array::from_fn(|row| (row << 15 >> ROWS.trailing_zeros()) as i16);
        // A row of pixels beyond on either side, so that it holds no half chords at all.
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

    /// Most bytes that those of a radius hold.
    pub(in crate::cpu) fn bytes(radius_px: usize) -> u64 {
        let rows = 2 * (radius_px * ROWS + 2 + LANES) + 1;
        (rows * ROW_STEPS as usize * size_of::<i16>()) as u64
    }

    /// Around a center so many steps below the upper border of the tile.
    #[inline(always)]
    pub(super) fn around(&self, center: i16) -> Around {
        // Rows lie in the middle of what they stand for.
        let below = i32::from(center) - ROW_STEPS / 2;
        let first = (below & (ROW_STEPS - 1)) * self.rows;
        let row = below >> ROW_STEPS.trailing_zeros();
        Around {
            first,
            top: first + self.rows_above - row,
        }
    }

    /// Half chords of a row of pixels.
    #[inline(always)]
    pub(super) fn half_chords(&self, around: Around, pixel_row: usize) -> [i16; LANES] {
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

/// Half the chord of a disc so far from its center.
fn half_chord(radius: f32, off: f32) -> i16 {
    if off.abs() > radius + SLACK {
        return NONE;
    }
    ((radius - off) * (radius + off)).max(0.0).sqrt().round() as i16
}
