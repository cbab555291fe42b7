//! Joints between the segments of curves, those of a chain of curves one after the other.

use std::ops::Range;

use guideway_spline::{Point, greater};

use super::LANES;
use super::cluster::Members;

/// Joints that are copied at once: a run rarely has more.
const AT_ONCE: usize = LANES;
/// Bits of half a word.
const HALF: usize = u32::BITS as usize;
/// What lies behind the last joint of a list, so that any can be the first of a vector.
const SLACK: usize = 2 * LANES;

/// A run of control points among those of a cluster.
#[derive(Clone, Copy, Debug)]
pub(super) struct Run {
    /// Whose it is, a bit.
    pub(super) member: Members,
    first: u32,
    points: u32,
}

/// What is drawn without lifting the pen.
#[derive(Clone, Debug)]
pub(super) struct Chain {
    pub(super) round: usize,
    /// Whose it is.
    pub(super) members: Members,
    pub(super) joints: Range<usize>,
}

/// The joints of runs, each with the number of the first of its points, and behind them copies of those of chains: the runs of
/// a chain share those where they meet.
#[derive(Default)]
pub(super) struct Joints {
    pub(super) x: Vec<f32>,
    pub(super) y: Vec<f32>,
    /// How far the segment behind a joint may bend away from a straight line: the greatest |C''| / 8.
    pub(super) bend: Vec<f32>,
    /// How far that lets a joint be from a line that passes it: its square, with the sign. That of the first and the last of a
    /// chain means nothing.
    pub(super) room: Vec<f32>,
    /// The numbers of which the copies are.
    copied: Vec<u32>,
    /// The number of the first copy.
    first_copy: usize,
    tolerance: f32,
}

impl Run {
    /// None if it has no segment.
    pub(super) fn new(member: usize, points: Range<usize>) -> Option<Self> {
        (points.len() >= 4).then_some(Self {
            member: 1 << member,
            first: points.start as u32,
            points: points.len() as u32,
        })
    }

    pub(super) fn joints(&self) -> Range<usize> {
        let first = self.first as usize;
        first..first + self.points as usize - 2
    }

    /// Where it begins and ends.
    pub(super) fn ends(&self, joints: &Joints) -> [Point<f32>; 2] {
        let Range { start, end } = self.joints();
        [start, end - 1].map(|i| joints.at(i))
    }
}

impl Joints {
    /// Finds those of all runs, for lines that are off by at most a tolerance; between two runs lie some that mean nothing.
    #[inline(always)]
    pub(super) fn find(&mut self, points: &mut Vec<Point<f32>>, tolerance: f32) {
        let len = points.len().next_multiple_of(LANES);
        points.resize(len + 3, Point::default());
        self.first_copy = len;
        self.tolerance = tolerance;
        self.copied.clear();
        // Copies are no more than runs have.
        let most = 2 * len + SLACK;
        for list in [&mut self.x, &mut self.y, &mut self.bend, &mut self.room] {
            if list.len() < most {
                list.resize(most, 0.0);
            }
        }
        for first in (0..len).step_by(LANES) {
            let Some(points) = points[first..].first_chunk::<{ LANES + 3 }>() else {
                return;
            };
            let (mut xs, mut ys, mut bends) = ([0.0; LANES], [0.0; LANES], [0.0; LANES]);
            for i in 0..LANES {
                let [a, b, c, d] = [points[i], points[i + 1], points[i + 2], points[i + 3]];
                xs[i] = (a.x + b.x * 4.0 + c.x) * (1.0 / 6.0);
                ys[i] = (a.y + b.y * 4.0 + c.y) * (1.0 / 6.0);
                let here = [a.x - b.x * 2.0 + c.x, a.y - b.y * 2.0 + c.y];
                let next = [b.x - c.x * 2.0 + d.x, b.y - c.y * 2.0 + d.y];
                let here = here[0] * here[0] + here[1] * here[1];
                let next = next[0] * next[0] + next[1] * next[1];
                bends[i] = greater(here, next).sqrt() * 0.125;
            }
            self.x[first..first + LANES].copy_from_slice(&xs);
            self.y[first..first + LANES].copy_from_slice(&ys);
            self.bend[first..first + LANES].copy_from_slice(&bends);
        }
        let lists = self.bend[..len].array_windows().zip(&mut self.room[1..]);
        for (&[before, behind], room) in lists {
            *room = room_beside(tolerance, before, behind);
        }
    }

    /// Adds copies of those of a run, which goes on from the last one or begins anew.
    #[inline(always)]
    pub(super) fn copy(&mut self, run: &Run, goes_on: bool) {
        let joints = run.joints();
        let mut to = self.end();
        if goes_on {
            // Its first joint takes the place of the last one before, and lines leave room for the gap.
            to -= 1;
            self.copied.pop();
            let gap = self.at(joints.start) - self.at(to);
            self.bend[to - 1] += gap.x.abs() + gap.y.abs();
        }
        let mut from = joints.start;
        let seam = to;
        while from < joints.end {
            for list in [&mut self.x, &mut self.y, &mut self.bend, &mut self.room] {
                let Some(&joints) = list[from..].first_chunk::<AT_ONCE>() else {
                    return;
                };
                list[to..to + AT_ONCE].copy_from_slice(&joints);
            }
            from += AT_ONCE;
            to += AT_ONCE;
        }
        self.copied.extend(joints.start as u32..joints.end as u32);
        if goes_on {
            for joint in [seam - 1, seam] {
                let [before, behind] = [self.bend[joint - 1], self.bend[joint]];
                self.room[joint] = room_beside(self.tolerance, before, behind);
            }
        }
    }

    /// Which joints are on segments that bend too much for any line over several, a bit each, and a word more.
    #[inline(always)]
    pub(super) fn find_without_room(&self, found: &mut Vec<u64>) {
        found.resize(self.end().div_ceil(u64::BITS as usize) + 1, 0);
        for (word, rooms) in found.iter_mut().zip(self.room.chunks(u64::BITS as usize)) {
            let (halves, _) = rooms.as_chunks();
            let halves = halves
                .iter()
                .zip(0..)
                .map(|(rooms, half)| u64::from(without_room(rooms)) << (half * HALF));
            *word = halves.fold(0, |all, half| all | half);
        }
    }

    /// The number of the next copy.
    pub(super) fn end(&self) -> usize {
        self.first_copy + self.copied.len()
    }

    pub(super) fn at(&self, joint: usize) -> Point<f32> {
        Point::new(self.x[joint], self.y[joint])
    }

    /// The first control point of the segment behind a joint.
    pub(super) fn segment(&self, joint: usize) -> usize {
        match joint.checked_sub(self.first_copy) {
            Some(copy) => self.copied[copy] as usize,
            None => joint,
        }
    }

    pub(super) fn bytes(&self) -> u64 {
        let lists = [&self.x, &self.y, &self.bend, &self.room].map(Vec::capacity);
        let words = lists.into_iter().sum::<usize>() + self.copied.capacity();
        (words * size_of::<f32>()) as u64
    }
}

/// How far a joint between two segments that bend may be from a line that passes it: its square, with the sign.
#[inline(always)]
fn room_beside(tolerance: f32, before: f32, behind: f32) -> f32 {
    let left = tolerance - greater(before, behind);
    left * left.abs()
}

/// Which of half a word of joints have no room, a bit each.
#[inline(always)]
fn without_room(rooms: &[f32; HALF]) -> u32 {
    let mut bits = [0; LANES];
    for (lanes, chunk) in rooms.as_chunks::<LANES>().0.iter().zip(0..) {
        for i in 0..LANES {
            bits[i] |= if lanes[i] < 0.0 {
                1 << (chunk * LANES + i)
            } else {
                0
            };
        }
    }
    bits.iter().fold(0, |all, bit| all | bit)
}
