//! The round ends of strokes.

use super::LANES;
use super::fixed::Caps;
use super::span::{ROWS, SOLID, Samples, clamp};

/// Fractions of the distance between rows of samples that the centers of discs are rounded to: 1/128 of a
/// pixel.
pub(super) const PHASES: i32 = 8;
/// Half a chord where there is none: far to the other side.
pub(super) const NONE: f32 = -1e9;
/// The radius up to which half chords are kept, in pixels: larger discs are found as they are needed.
const MOST_KEPT_PX: usize = 8;

/// A disc of one radius around any center: half of each chord that a row of samples cuts from it.
#[derive(Debug, Default)]
pub(super) struct Disc<const C: usize> {
    pub(super) radius: f32,
    /// For each phase of the center, half chords from far above it to far below; none of a large disc.
    halves: Vec<f32>,
    /// The same for lines in whole numbers, all of one color.
    pub(super) caps: Caps,
    /// Rows of a phase, and those before the one at the center.
    rows: i32,
    rows_above: i32,
}

impl<const C: usize> Disc<C> {
    /// Becomes a disc of another radius.
    pub(super) fn resize(&mut self, radius: f32) {
        if self.radius == radius {
            return;
        }
        self.radius = radius;
        self.halves.clear();
        if C == SOLID {
            self.caps.resize(radius / C as f32);
        }
        if radius > (MOST_KEPT_PX * C) as f32 {
            return;
        }
        self.rows_above = (radius / Samples::<C>::ROW_STEP) as i32 + 2 + LANES as i32;
        self.rows = 2 * self.rows_above + 1;
        for phase in 0..PHASES {
            let rows = (-self.rows_above..=self.rows_above).map(|row| row * PHASES - phase);
            self.halves
                .extend(rows.map(|off| half_chord::<C>(radius, off)));
        }
    }

    /// Half chords of a row of pixels, when the center is so many phases below the first row of all.
    #[inline(always)]
    pub(super) fn half_chords(&self, center: i32, pixel_row: usize) -> [f32; LANES] {
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
        // As a slice it is looked at once whether all are there.
        let Some(halves) = self.halves.get(first..first + LANES) else {
            return [NONE; LANES];
        };
        let mut all = [0.0; LANES];
        all.copy_from_slice(halves);
        all
    }
}

/// Half the chord of a disc so many phases from its center.
#[inline(always)]
fn half_chord<const C: usize>(radius: f32, off_phases: i32) -> f32 {
    let off = off_phases as f32 * (Samples::<C>::ROW_STEP / PHASES as f32);
    let square = (radius - off) * (radius + off);
    let half = Samples::<C>::snap(clamp(square, f32::MAX).sqrt());
    let is_beside = off.abs() > radius + Samples::<C>::SLACK;
    if is_beside { NONE } else { half }
}

/// Discs that are kept for paths of other widths.
const MOST_DISCS: usize = 3;

/// The discs of the last few radii.
#[derive(Debug, Default)]
pub(super) struct Discs<const C: usize> {
    all: [Disc<C>; MOST_DISCS],
    /// Which one was asked for last, and which one becomes the next that is not there.
    last: usize,
    next: usize,
}

impl<const C: usize> Discs<C> {
    /// The disc of a radius in columns.
    #[inline(always)]
    pub(super) fn of(&mut self, radius: f32) -> &Disc<C> {
        if self.all[self.last].radius != radius {
            self.find(radius);
        }
        &self.all[self.last]
    }

    #[cold]
    fn find(&mut self, radius: f32) {
        let there = self.all.iter().position(|disc| disc.radius == radius);
        self.last = there.unwrap_or(self.next);
        if there.is_none() {
            self.all[self.last].resize(radius);
            self.next = (self.next + 1) % MOST_DISCS;
        }
    }

    /// Most bytes that they hold.
    pub(super) fn bytes() -> u64 {
        let rows = 2 * (MOST_KEPT_PX * ROWS + 2 + LANES) + 1;
        let floats = MOST_DISCS * rows * PHASES as usize * size_of::<f32>();
        let caps = if C == SOLID { MOST_DISCS } else { 0 };
        floats as u64 + caps as u64 * Caps::bytes(MOST_KEPT_PX)
    }
}
