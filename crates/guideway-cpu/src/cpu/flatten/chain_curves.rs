//! Chains curves that share end points, so that they draw as one stroke, and orders the chains:
//! longest first, because they occlude most.
//!
//! Runs are compared in groups of 64, all with all: O(64 n) comparisons in SIMD lanes.

#[cfg(test)]
mod tests;

use guideway_spline::{Point, greater};

use super::knots::{Chain, CurveRun, Knots};
use crate::cpu::ground::tile::{LANES, PASSES};

/// Runs per group: one bit of a word each.
const GROUP_LEN: usize = u64::BITS as usize;
/// No run.
const NONE: u32 = u32::MAX;
/// Tangent of the largest turn, about 20 degrees, that counts as straight on.
const STRAIGHT: f32 = 0.4;
/// Length classes, each half as long as the one before. The first holds all chains of [`LONG`]
/// units or more.
const CLASSES: usize = 6;
const LONG: f32 = 1024.0;
/// End of each pass, in 64ths of all chains: later passes are larger, because more of the tile is
/// covered and more of their lines are skipped. Measured on D1 (`guideway bench d1 --methods cpu`):
/// other sizes make no difference.
const ENDS: [usize; PASSES] = [8, 16, 24, 36, 64];

/// Followers of runs, and the order of the chains.
#[derive(Default)]
pub(crate) struct CurveChains {
    /// The run that follows each run.
    next: Vec<u32>,
    /// First run of each chain, and the length class of the chain.
    heads: Vec<(u32, u8)>,
    /// First runs in drawing order.
    order: Vec<u32>,
}

/// Up to 64 runs.
struct RunGroup {
    /// First and last point of each run, and the vector between them; NaN where there is no run.
    starts: Coordinates,
    ends: Coordinates,
    along: Coordinates,
    /// One bit per run that follows another one.
    preceded: u64,
}

/// Candidates that may follow each run of a group: one bit each.
struct Followers {
    /// Runs that begin within one unit, on either axis, of its last point.
    touching: [u64; GROUP_LEN],
    /// Those of them that continue nearly straight.
    straight: [u64; GROUP_LEN],
}

/// Points, as one array per axis.
struct Coordinates {
    x: [f32; GROUP_LEN],
    y: [f32; GROUP_LEN],
}

impl CurveChains {
    /// Finds which runs follow each other, if `joins` allows it, and the order of the chains.
    #[inline(always)]
    pub(crate) fn link_runs(&mut self, runs: &[CurveRun], points: &[Point<f32>], joins: bool) {
        self.next.clear();
        self.next.resize(runs.len(), NONE);
        self.heads.clear();
        for (group, runs) in runs.chunks(GROUP_LEN).enumerate() {
            let first = group * GROUP_LEN;
            let next = &mut self.next[first..][..runs.len()];
            let mut group = RunGroup::new(runs, points);
            if joins {
                group.link(first, next);
            }
            // A ring has no first run: the second round takes any of its runs.
            let mut left = low_bits(runs.len());
            for firsts in [!group.preceded, u64::MAX] {
                while left & firsts != 0 {
                    let head = (left & firsts).trailing_zeros() as usize;
                    let length = group.follow(head, first, next, &mut left);
                    self.heads.push(((first + head) as u32, class(length)));
                }
            }
        }
        self.sort();
    }

    #[inline(always)]
    fn sort(&mut self) {
        let mut places = [0; CLASSES + 1];
        for &(_, class) in &self.heads {
            places[usize::from(class) + 1] += 1;
        }
        for class in 0..CLASSES {
            places[class + 1] += places[class];
        }
        self.order.resize(self.heads.len(), 0);
        for &(run, class) in &self.heads {
            let place = &mut places[usize::from(class)];
            self.order[*place] = run;
            *place += 1;
        }
    }

    /// Lists the chains in drawing order and appends their knots.
    #[inline(always)]
    pub(crate) fn append_knots(
        &self,
        (runs, points): (&[CurveRun], &[Point<f32>]),
        knots: &mut Knots,
        chains: &mut Vec<Chain>,
    ) {
        chains.clear();
        let mut pass = 0;
        for (i, &head) in self.order.iter().enumerate() {
            while i * GROUP_LEN >= ENDS[pass] * self.order.len() {
                pass += 1;
            }
            let start = knots.len();
            let (mut run, mut members, mut goes_on) = (head, 0, false);
            while run != NONE {
                let this = &runs[run as usize];
                knots.add(this, goes_on, points);
                members |= this.member;
                (run, goes_on) = (self.next[run as usize], true);
            }
            chains.push(Chain {
                pass,
                members,
                knots: start..knots.len(),
            });
        }
    }

    pub(crate) fn bytes(&self) -> u64 {
        let words = self.next.capacity() + self.order.capacity();
        (words * size_of::<u32>() + self.heads.capacity() * size_of::<(u32, u8)>()) as u64
    }
}

impl RunGroup {
    #[inline(always)]
    fn new(runs: &[CurveRun], points: &[Point<f32>]) -> Self {
        let nowhere = || Coordinates {
            x: [f32::NAN; GROUP_LEN],
            y: [f32::NAN; GROUP_LEN],
        };
        let mut group = Self {
            starts: nowhere(),
            ends: nowhere(),
            along: nowhere(),
            preceded: 0,
        };
        for (i, run) in runs.iter().enumerate().take(GROUP_LEN) {
            let [start, end] = run.ends(points);
            group.starts.set(i, start);
            group.ends.set(i, end);
            group.along.set(i, end - start);
        }
        group
    }

    /// Links runs: writes the index of the follower of each run, counted from `first`, to `next`.
    #[inline(always)]
    fn link(&mut self, first: usize, next: &mut [u32]) {
        let Followers { touching, straight } = self.compare();
        // Straight continuations first. Only runs with a candidate are visited, without branches:
        // whether a candidate is free is unpredictable.
        for candidates in [straight, touching] {
            let mut runs = not_zero(&candidates) & low_bits(next.len());
            while runs != 0 {
                let run = runs.trailing_zeros() as usize;
                runs &= runs - 1;
                let next = &mut next[run];
                let is_free = u64::from(*next == NONE).wrapping_neg();
                let free = candidates[run] & !self.preceded & is_free;
                let last = (free | 1).ilog2();
                self.preceded |= free & 1 << last;
                if free != 0 {
                    *next = first as u32 + last;
                }
            }
        }
    }

    /// Compares all runs with all others.
    #[inline(always)]
    fn compare(&self) -> Followers {
        const HALF: usize = u32::BITS as usize;
        let (mut touching, mut straight) = ([0; GROUP_LEN], [0; GROUP_LEN]);
        for half in [0, HALF] {
            for first in (0..GROUP_LEN).step_by(LANES) {
                let (mut touching_bits, mut straight_bits) = ([0_u32; LANES], [0_u32; LANES]);
                for other in 0..HALF {
                    let start = self.starts.at(half + other);
                    let next = self.along.at(half + other);
                    for i in 0..LANES {
                        let end = self.ends.at(first + i);
                        let along = self.along.at(first + i);
                        let gap = greater((end.x - start.x).abs(), (end.y - start.y).abs());
                        let cross = along.x * next.y - along.y * next.x;
                        let is_straight = cross.abs() < STRAIGHT * along.dot(next);
                        let touching = if gap <= 1.0 { 1 << other } else { 0 };
                        touching_bits[i] |= touching;
                        straight_bits[i] |= if is_straight { touching } else { 0 };
                    }
                }
                for i in 0..LANES {
                    touching[first + i] |= u64::from(touching_bits[i]) << half;
                    straight[first + i] |= u64::from(straight_bits[i]) << half;
                }
            }
        }
        Followers { touching, straight }
    }

    /// Follows a chain: removes its runs from `left`, cuts it open if it is a ring, returns its
    /// length.
    #[inline(always)]
    fn follow(&self, start: usize, first: usize, next: &mut [u32], left: &mut u64) -> f32 {
        let (mut run, mut length) = (start, 0.0);
        loop {
            *left &= !(1 << run);
            let along = self.along.at(run);
            length += along.x.abs() + along.y.abs();
            let next_run = next[run];
            if next_run == NONE {
                return length;
            }
            let next_run = next_run as usize - first;
            if *left >> next_run & 1 == 0 {
                next[run] = NONE;
                return length;
            }
            run = next_run;
        }
    }
}

impl Coordinates {
    #[inline(always)]
    fn at(&self, run: usize) -> Point<f32> {
        Point::new(self.x[run % GROUP_LEN], self.y[run % GROUP_LEN])
    }

    #[inline(always)]
    fn set(&mut self, run: usize, to: Point<f32>) {
        (self.x[run % GROUP_LEN], self.y[run % GROUP_LEN]) = (to.x, to.y);
    }
}

/// The length class of a chain.
#[inline(always)]
fn class(length: f32) -> u8 {
    // Half the length is one less in the exponent.
    let shorter =
        (LONG.to_bits() as i32 - 1 - length.to_bits() as i32) >> (f32::MANTISSA_DIGITS - 1);
    (shorter + 1).clamp(0, CLASSES as i32 - 1) as u8
}

/// Marks the words that are not zero, one bit each.
#[inline(always)]
fn not_zero(words: &[u64; GROUP_LEN]) -> u64 {
    let mut bits = 0;
    for (i, &word) in words.iter().enumerate() {
        bits |= u64::from(word != 0) << i;
    }
    bits
}

fn low_bits(count: usize) -> u64 {
    u64::MAX >> (GROUP_LEN - count)
}
