//! Which curves go on from which: they are drawn as one, and the longest first, for those cover most.

#[cfg(test)]
mod tests;

use guideway_spline::{Point, greater};

use super::LANES;
use super::joints::{Chain, Joints, Run};
use super::polylines::ROUNDS;

/// Runs that are looked at together.
const MOST: usize = u64::BITS as usize;
/// No run.
const NONE: u32 = u32::MAX;
/// What goes on straight turns by less than some 20 degrees: this is the tangent.
const STRAIGHT: f32 = 0.4;
/// Classes of lengths, each twice as long as the next: all from so many units on are of the first.
const CLASSES: usize = 6;
const LONG: f32 = 1024.0;
/// The part of all chains that is drawn by the end of each round, in 64ths: the more is covered by those before, the more
/// are looked at together.
const ENDS: [usize; ROUNDS] = [8, 16, 24, 36, 64];

/// What goes on from what.
#[derive(Default)]
pub(super) struct Links {
    /// The run behind each.
    next: Vec<u32>,
    /// The run that each chain begins with, and the class of its length.
    heads: Vec<(u32, u8)>,
    /// Those runs in the order in which chains are drawn.
    order: Vec<u32>,
}

/// Some runs.
struct Group {
    /// Where each begins and ends, nowhere for those that there are not, and how it gets from one to the other.
    starts: Side,
    ends: Side,
    along: Side,
    /// Whether there is a run before each, a bit.
    taken: u64,
}

/// For each of some runs, which may follow it: a bit each.
struct Behind {
    /// Those that begin where it ends, within a unit to the side as well as up and down.
    near: [u64; MOST],
    /// Of those, the ones that go on nearly straight.
    straight: [u64; MOST],
}

/// Points, for vectors.
struct Side {
    x: [f32; MOST],
    y: [f32; MOST],
}

impl Links {
    /// Finds which runs are drawn as one, if any may be joined, and in which order.
    #[inline(always)]
    pub(super) fn find(&mut self, runs: &[Run], points: &[Point<f32>], joins: bool) {
        self.next.clear();
        self.next.resize(runs.len(), NONE);
        self.heads.clear();
        for (group, runs) in runs.chunks(MOST).enumerate() {
            let first = group * MOST;
            let next = &mut self.next[first..][..runs.len()];
            let mut group = Group::new(runs, points);
            if joins {
                group.link(first, next);
            }
            // Of a ring none is the first: then one is.
            let mut left = low_bits(runs.len());
            for firsts in [!group.taken, u64::MAX] {
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

    /// Gives the chains in the order in which they are drawn, and their joints.
    #[inline(always)]
    pub(super) fn chain(
        &self,
        (runs, points): (&[Run], &[Point<f32>]),
        joints: &mut Joints,
        chains: &mut Vec<Chain>,
    ) {
        chains.clear();
        let mut round = 0;
        for (i, &head) in self.order.iter().enumerate() {
            while i * MOST >= ENDS[round] * self.order.len() {
                round += 1;
            }
            let start = joints.len();
            let (mut run, mut members, mut goes_on) = (head, 0, false);
            while run != NONE {
                let this = &runs[run as usize];
                joints.add(this, goes_on, points);
                members |= this.member;
                (run, goes_on) = (self.next[run as usize], true);
            }
            chains.push(Chain {
                round,
                members,
                joints: start..joints.len(),
            });
        }
    }

    pub(super) fn bytes(&self) -> u64 {
        let words = self.next.capacity() + self.order.capacity();
        (words * size_of::<u32>() + self.heads.capacity() * size_of::<(u32, u8)>()) as u64
    }
}

impl Group {
    #[inline(always)]
    fn new(runs: &[Run], points: &[Point<f32>]) -> Self {
        let nowhere = || Side {
            x: [f32::NAN; MOST],
            y: [f32::NAN; MOST],
        };
        let mut group = Self {
            starts: nowhere(),
            ends: nowhere(),
            along: nowhere(),
            taken: 0,
        };
        for (i, run) in runs.iter().enumerate().take(MOST) {
            let [start, end] = run.ends(points);
            group.starts.set(i, start);
            group.ends.set(i, end);
            group.along.set(i, end - start);
        }
        group
    }

    /// Joins runs: gives the number behind each, counted from `first`, to `next`.
    #[inline(always)]
    fn link(&mut self, first: usize, next: &mut [u32]) {
        let Behind { near, straight } = self.behind();
        // What goes on nearly straight is joined first, and only what something goes on from is looked at. No branches within: nothing tells
        // which is still free.
        for behind in [straight, near] {
            let mut runs = not_zero(&behind) & low_bits(next.len());
            while runs != 0 {
                let run = runs.trailing_zeros() as usize;
                runs &= runs - 1;
                let next = &mut next[run];
                let is_free = u64::from(*next == NONE).wrapping_neg();
                let behind = behind[run] & !self.taken & is_free;
                let last = (behind | 1).ilog2();
                self.taken |= behind & 1 << last;
                if behind != 0 {
                    *next = first as u32 + last;
                }
            }
        }
    }

    /// Compares all runs with all others.
    #[inline(always)]
    fn behind(&self) -> Behind {
        const HALF: usize = u32::BITS as usize;
        let (mut near, mut straight) = ([0; MOST], [0; MOST]);
        for half in [0, HALF] {
            for first in (0..MOST).step_by(LANES) {
                let (mut near_bits, mut straight_bits) = ([0_u32; LANES], [0_u32; LANES]);
                for behind in 0..HALF {
                    let start = self.starts.at(half + behind);
                    let on = self.along.at(half + behind);
                    for i in 0..LANES {
                        let end = self.ends.at(first + i);
                        let along = self.along.at(first + i);
                        let gap = greater((end.x - start.x).abs(), (end.y - start.y).abs());
                        let aside = along.x * on.y - along.y * on.x;
                        let is_straight = aside.abs() < STRAIGHT * along.dot(on);
                        let near = if gap <= 1.0 { 1 << behind } else { 0 };
                        near_bits[i] |= near;
                        straight_bits[i] |= if is_straight { near } else { 0 };
                    }
                }
                for i in 0..LANES {
                    near[first + i] |= u64::from(near_bits[i]) << half;
                    straight[first + i] |= u64::from(straight_bits[i]) << half;
                }
            }
        }
        Behind { near, straight }
    }

    /// Goes along a chain: takes its runs from those that are left, opens it if it is a ring, and gives its length.
    #[inline(always)]
    fn follow(&self, start: usize, first: usize, next: &mut [u32], left: &mut u64) -> f32 {
        let (mut run, mut length) = (start, 0.0);
        loop {
            *left &= !(1 << run);
            let along = self.along.at(run);
            length += along.x.abs() + along.y.abs();
            let behind = next[run];
            if behind == NONE {
                return length;
            }
            let behind = behind as usize - first;
            if *left >> behind & 1 == 0 {
                next[run] = NONE;
                return length;
            }
            run = behind;
        }
    }
}

impl Side {
    #[inline(always)]
    fn at(&self, run: usize) -> Point<f32> {
        Point::new(self.x[run % MOST], self.y[run % MOST])
    }

    #[inline(always)]
    fn set(&mut self, run: usize, to: Point<f32>) {
        (self.x[run % MOST], self.y[run % MOST]) = (to.x, to.y);
    }
}

/// The class of a length: the longest are of the first.
#[inline(always)]
fn class(length: f32) -> u8 {
    // What is half as long has an exponent that is one less.
    let shorter =
        (LONG.to_bits() as i32 - 1 - length.to_bits() as i32) >> (f32::MANTISSA_DIGITS - 1);
    (shorter + 1).clamp(0, CLASSES as i32 - 1) as u8
}

/// Which of some words are not zero, a bit each.
#[inline(always)]
fn not_zero(words: &[u64; MOST]) -> u64 {
    let mut bits = 0;
    for (i, &word) in words.iter().enumerate() {
        bits |= u64::from(word != 0) << i;
    }
    bits
}

fn low_bits(count: usize) -> u64 {
    u64::MAX >> (MOST - count)
}
