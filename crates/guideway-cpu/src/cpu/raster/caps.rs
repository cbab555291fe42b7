//! Half chords of round caps: per stroke width, a table of the half length that each row of samples
//! cuts from the cap, for every position of its center.

use super::fixed_point::caps::FixedCapTable;
use crate::cpu::ground::samples::{ROWS, SOLID, SamplePattern, clamp};
use crate::cpu::ground::tile::LANES;

/// Positions of a center between two rows of samples: 1/128 px apart.
pub(crate) const PHASES: i32 = 8;
/// Half chord of rows beside the cap: far to the other side.
pub(crate) const NONE: f32 = -1e9;
/// Largest radius with a table, in pixels; half chords of larger caps are computed when needed.
const MAX_TABLE_PX: usize = 8;

/// Half chords of the caps of one radius.
#[derive(Debug, Default)]
pub(crate) struct CapTable<const C: usize> {
    pub(crate) radius: f32,
    /// Per phase of the center, half chords from far above it to far below; empty for large radii.
    halves: Vec<f32>,
    /// Half chords of the fixed-point rasterizer.
    pub(crate) fixed: FixedCapTable,
    /// Rows per phase, and rows above the center.
    rows: i32,
    rows_above: i32,
}

impl<const C: usize> CapTable<C> {
    /// Replaces the table by that of another radius, in columns.
    pub(crate) fn resize(&mut self, radius: f32) {
        if self.radius == radius {
            return;
        }
        self.radius = radius;
        self.halves.clear();
        if C == SOLID {
            self.fixed.resize(radius / C as f32);
        }
        if radius > (MAX_TABLE_PX * C) as f32 {
            return;
        }
        self.rows_above = (radius / SamplePattern::<C>::ROW_STEP) as i32 + 2 + LANES as i32;
        self.rows = 2 * self.rows_above + 1;
        for phase in 0..PHASES {
            let rows = (-self.rows_above..=self.rows_above).map(|row| row * PHASES - phase);
            self.halves
                .extend(rows.map(|off| half_chord::<C>(radius, off)));
        }
    }

    /// Half chords of a row of pixels for a center `center` phases below the first row of samples.
    #[inline(always)]
    pub(crate) fn half_chords(&self, center: i32, pixel_row: usize) -> [f32; LANES] {
        let first_row = (pixel_row * LANES) as i32;
        if self.halves.is_empty() {
            let mut halves = [0.0; LANES];
            for (half, row) in halves.iter_mut().zip(first_row..) {
                *half = half_chord::<C>(self.radius, row * PHASES - center);
            }
            return halves;
        }
        let (row, phase) = (center.div_euclid(PHASES), center.rem_euclid(PHASES));
        let above = (first_row - row + self.rows_above).clamp(0, self.rows - LANES as i32);
        let first = (phase * self.rows + above) as usize;
        // A slice needs one bounds check for all lanes.
        let Some(halves) = self.halves.get(first..first + LANES) else {
            return [NONE; LANES];
        };
        let mut all = [0.0; LANES];
        all.copy_from_slice(halves);
        all
    }
}

/// Half chord at a distance of `off_phases` from the center.
#[inline(always)]
fn half_chord<const C: usize>(radius: f32, off_phases: i32) -> f32 {
    let off = off_phases as f32 * (SamplePattern::<C>::ROW_STEP / PHASES as f32);
    let square = (radius - off) * (radius + off);
    let half = SamplePattern::<C>::snap(clamp(square, f32::MAX).sqrt());
    let is_beside = off.abs() > radius + SamplePattern::<C>::SLACK;
    if is_beside { NONE } else { half }
}

/// Tables held at a time, for paths with own widths.
const TABLES: usize = 3;

/// The tables of the last few radii.
#[derive(Debug, Default)]
pub(crate) struct CapTables<const C: usize> {
    all: [CapTable<C>; TABLES],
    /// Index of the table in use, and of the one that is replaced next.
    last: usize,
    next: usize,
}

impl<const C: usize> CapTables<C> {
    /// The table of a radius in columns.
    #[inline(always)]
    pub(crate) fn of(&mut self, radius: f32) -> &CapTable<C> {
        if self.all[self.last].radius != radius {
            self.find(radius);
        }
        &self.all[self.last]
    }

    #[cold]
    fn find(&mut self, radius: f32) {
        let there = self.all.iter().position(|caps| caps.radius == radius);
        self.last = there.unwrap_or(self.next);
        if there.is_none() {
            self.all[self.last].resize(radius);
            self.next = (self.next + 1) % TABLES;
        }
    }

    /// Upper bound of the heap bytes held.
    pub(crate) fn bytes() -> u64 {
        let rows = 2 * (MAX_TABLE_PX * ROWS + 2 + LANES) + 1;
        let floats = TABLES * rows * PHASES as usize * size_of::<f32>();
        let caps = if C == SOLID { TABLES } else { 0 };
        floats as u64 + caps as u64 * FixedCapTable::bytes(MAX_TABLE_PX)
    }
}
