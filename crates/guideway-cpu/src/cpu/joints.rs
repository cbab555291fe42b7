//! Joints between the segments of curves, those of a chain of curves one after the other.

use std::ops::Range;

use guideway_spline::{Point, greater};

use super::LANES;
use super::cluster::Members;

/// Joints that are copied at once: a run rarely has more.
const AT_ONCE: usize = LANES;
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

/// The joints of runs that lie one after the other, each with the number of the first of its points.
#[derive(Default)]
pub(super) struct Joints {
    x: Vec<f32>,
    y: Vec<f32>,
    /// |C''| / 8 there.
    bend: Vec<f32>,
}

/// Joints in the order in which they are drawn: the runs of a chain share those where they meet.
#[derive(Default)]
pub(super) struct Chains {
    pub(super) x: Vec<f32>,
    pub(super) y: Vec<f32>,
    /// How far the segment behind a joint may bend away from a straight line.
    pub(super) bend: Vec<f32>,
    /// How far that lets a joint be from a line that passes it: its square, with the sign.
    pub(super) room: Vec<f32>,
    /// The first control point of the segment behind a joint.
    pub(super) segment: Vec<u32>,
    len: usize,
    chains: Vec<Chain>,
}

/// What is drawn without lifting the pen.
#[derive(Clone, Copy, Debug)]
pub(super) struct Chain {
    pub(super) round: usize,
    /// Whose it is.
    pub(super) members: Members,
    end: usize,
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

    fn joints(&self) -> usize {
        self.points as usize - 2
    }

    /// Where it begins and ends.
    pub(super) fn ends(&self, joints: &Joints) -> [Point<f32>; 2] {
        let first = self.first as usize;
        [first, first + self.joints() - 1].map(|i| Point::new(joints.x[i], joints.y[i]))
    }
}

impl Joints {
    /// Finds those of all runs; between two of them lie some that mean nothing.
    #[inline(always)]
    pub(super) fn find(&mut self, points: &mut Vec<Point<f32>>) {
        let len = points.len().next_multiple_of(LANES);
        points.resize(len + 2, Point::default());
        for list in [&mut self.x, &mut self.y, &mut self.bend] {
            list.resize(len + SLACK, 0.0);
        }
        for first in (0..len).step_by(LANES) {
            let Some(points) = points[first..].first_chunk::<{ LANES + 2 }>() else {
                return;
            };
            let (mut xs, mut ys, mut bends) = ([0.0; LANES], [0.0; LANES], [0.0; LANES]);
            for i in 0..LANES {
                let [a, b, c] = [points[i], points[i + 1], points[i + 2]];
                xs[i] = (a.x + b.x * 4.0 + c.x) * (1.0 / 6.0);
                ys[i] = (a.y + b.y * 4.0 + c.y) * (1.0 / 6.0);
                let x = a.x - b.x * 2.0 + c.x;
                let y = a.y - b.y * 2.0 + c.y;
                bends[i] = (x * x + y * y).sqrt() * 0.125;
            }
            self.x[first..first + LANES].copy_from_slice(&xs);
            self.y[first..first + LANES].copy_from_slice(&ys);
            self.bend[first..first + LANES].copy_from_slice(&bends);
        }
    }

    pub(super) fn bytes(&self) -> u64 {
        let floats = self.x.capacity() + self.y.capacity() + self.bend.capacity();
        (floats * size_of::<f32>()) as u64
    }
}

impl Chains {
    /// Lets go of all; makes room for the joints of some runs.
    #[inline(always)]
    pub(super) fn begin(&mut self, runs: &[Run]) {
        let joints: usize = runs.iter().map(Run::joints).sum();
        for list in [&mut self.x, &mut self.y, &mut self.bend, &mut self.room] {
            list.resize(joints + SLACK, 0.0);
        }
        self.segment.resize(joints + SLACK, 0);
        self.chains.clear();
        self.len = 0;
    }

    /// Adds the joints of a run, which goes on from the last one or begins anew.
    #[inline(always)]
    pub(super) fn push(&mut self, joints: &Joints, run: &Run, goes_on: bool) {
        let from = run.first as usize;
        let mut to = self.len;
        if goes_on {
            // Its first joint takes the place of the last one before, and lines leave room for the gap.
            to -= 1;
            let gap = [joints.x[from] - self.x[to], joints.y[from] - self.y[to]];
            self.bend[to - 1] += gap[0].abs() + gap[1].abs();
        }
        self.len = to + run.joints();
        let mut copied = 0;
        while copied < run.joints() {
            let (from, to) = (from + copied, to + copied);
            copied += AT_ONCE;
            self.x[to..to + AT_ONCE].copy_from_slice(&joints.x[from..from + AT_ONCE]);
            self.y[to..to + AT_ONCE].copy_from_slice(&joints.y[from..from + AT_ONCE]);
            let bends = &joints.bend[from..from + AT_ONCE + 1];
            let (own, segments) = (&mut self.bend[to..to + AT_ONCE], &mut self.segment[to..]);
            for i in 0..AT_ONCE {
                own[i] = greater(bends[i], bends[i + 1]);
            }
            for (segment, i) in segments[..AT_ONCE].iter_mut().zip(from as u32..) {
                *segment = i;
            }
        }
    }

    /// Ends a chain.
    #[inline(always)]
    pub(super) fn end(&mut self, round: usize, members: Members) {
        self.chains.push(Chain {
            round,
            members,
            end: self.len,
        });
    }

    /// Finds how far each joint may be off, once all are there. What is found for the first and the last of a chain means
    /// nothing.
    #[inline(always)]
    pub(super) fn leave_room(&mut self, tolerance: f32) {
        let lists = self.bend.array_windows().zip(&mut self.room[1..]);
        for (&[before, behind], room) in lists {
            let left = tolerance - greater(before, behind);
            *room = left * left.abs();
        }
    }

    /// All chains, with the numbers of their joints.
    pub(super) fn iter(&self) -> impl Iterator<Item = (Chain, Range<usize>)> {
        self.chains.iter().scan(0, |start, &chain| {
            Some((chain, std::mem::replace(start, chain.end)..chain.end))
        })
    }

    pub(super) fn at(&self, joint: usize) -> Point<f32> {
        Point::new(self.x[joint], self.y[joint])
    }

    pub(super) fn bytes(&self) -> u64 {
        let lists = [&self.x, &self.y, &self.bend, &self.room].map(Vec::capacity);
        let words = lists.into_iter().sum::<usize>() + self.segment.capacity();
        (words * size_of::<f32>() + self.chains.capacity() * size_of::<Chain>()) as u64
    }
}
