//! Joints between the segments of curves, those of a chain of curves one after the other.

use std::ops::Range;

use guideway_spline::{Point, greater};

use super::LANES;
use super::cluster::Members;

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

/// The joints of chains, one chain after the other: the runs of a chain share those where they meet.
#[derive(Default)]
pub(super) struct Joints {
    /// How many there are; what the lists hold behind them means nothing.
    len: usize,
    pub(super) x: Vec<f32>,
    pub(super) y: Vec<f32>,
    /// How far the segment behind a joint may bend away from a straight line: the greatest |C''| / 8.
    pub(super) bend: Vec<f32>,
    /// How far that lets a joint be from a line that passes it: its square, with the sign. That of the first and the last of a
    /// chain means nothing.
    pub(super) room: Vec<f32>,
    /// The number of the first control point of the segment behind a joint.
    segment: Vec<u32>,
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

    /// Where it begins and ends.
    #[inline(always)]
    pub(super) fn ends(&self, points: &[Point<f32>]) -> [Point<f32>; 2] {
        let run = &points[self.first as usize..][..self.points as usize];
        let (Some(first), Some(last)) = (run.first_chunk::<3>(), run.last_chunk::<3>()) else {
            return [Point::default(); 2];
        };
        // Both at once, by one vector.
        let [a, b, c] = [0, 1, 2].map(|i| [first[i].x, first[i].y, last[i].x, last[i].y]);
        let mut ends = [0.0; 4];
        for i in 0..4 {
            ends[i] = (a[i] + b[i] * 4.0 + c[i]) * (1.0 / 6.0);
        }
        [Point::new(ends[0], ends[1]), Point::new(ends[2], ends[3])]
    }
}

impl Joints {
    /// Begins with none, of some control points, behind which there have to be some that mean nothing.
    pub(super) fn begin(&mut self, points: &mut Vec<Point<f32>>) {
        points.resize(points.len() + SLACK, Point::default());
        self.len = 0;
        // There are fewer than points.
        let most = points.len() + SLACK;
        for list in [&mut self.x, &mut self.y, &mut self.bend, &mut self.room] {
            if list.len() < most {
                list.resize(most, 0.0);
            }
        }
        if self.segment.len() < most {
            self.segment.resize(most, 0);
        }
    }

    /// Adds those of a run, which goes on from the last one or begins a chain.
    #[inline(always)]
    pub(super) fn add(&mut self, run: &Run, goes_on: bool, points: &[Point<f32>]) {
        let first = run.first as usize;
        // Its first joint takes the place of the last one before.
        self.len -= usize::from(goes_on);
        let before = self.at(self.len);
        let count = run.points as usize - 2;
        for done in (0..count).step_by(LANES) {
            let (from, to) = (first + done, self.len + done);
            let Some(points) = points[from..].first_chunk::<{ LANES + 3 }>() else {
                return;
            };
            let (mut xs, mut ys, mut bends) = ([0.0; LANES], [0.0; LANES], [0.0; LANES]);
            let mut segments = [0; LANES];
            for i in 0..LANES {
                let [a, b, c, d] = [points[i], points[i + 1], points[i + 2], points[i + 3]];
                xs[i] = (a.x + b.x * 4.0 + c.x) * (1.0 / 6.0);
                ys[i] = (a.y + b.y * 4.0 + c.y) * (1.0 / 6.0);
                let here = [a.x - b.x * 2.0 + c.x, a.y - b.y * 2.0 + c.y];
                let next = [b.x - c.x * 2.0 + d.x, b.y - c.y * 2.0 + d.y];
                let here = here[0] * here[0] + here[1] * here[1];
                let next = next[0] * next[0] + next[1] * next[1];
                bends[i] = greater(here, next).sqrt() * 0.125;
                segments[i] = (from + i) as u32;
            }
            self.x[to..to + LANES].copy_from_slice(&xs);
            self.y[to..to + LANES].copy_from_slice(&ys);
            self.bend[to..to + LANES].copy_from_slice(&bends);
            self.segment[to..to + LANES].copy_from_slice(&segments);
        }
        if goes_on {
            // Lines leave room for the gap.
            let gap = self.at(self.len) - before;
            self.bend[self.len - 1] += gap.x.abs() + gap.y.abs();
        }
        self.len += count;
    }

    /// Finds how much room all have, for lines that are off by at most a tolerance.
    #[inline(always)]
    pub(super) fn find_room(&mut self, tolerance: f32) {
        let lists = self.bend[..self.len]
            .array_windows()
            .zip(&mut self.room[1..]);
        for (&[before, behind], room) in lists {
            *room = room_beside(tolerance, before, behind);
        }
    }

    /// Which joints are on segments that bend too much for any line over several, a bit each, and a word more.
    #[inline(always)]
    pub(super) fn find_without_room(&self, found: &mut Vec<u64>) {
        found.resize(self.len.div_ceil(u64::BITS as usize) + 1, 0);
        for (word, rooms) in found.iter_mut().zip(self.room.chunks(u64::BITS as usize)) {
            let (halves, _) = rooms.as_chunks();
            let halves = halves
                .iter()
                .zip(0..)
                .map(|(rooms, half)| u64::from(without_room(rooms)) << (half * HALF));
            *word = halves.fold(0, |all, half| all | half);
        }
    }

    /// How many there are.
    pub(super) fn len(&self) -> usize {
        self.len
    }

    pub(super) fn at(&self, joint: usize) -> Point<f32> {
        Point::new(self.x[joint], self.y[joint])
    }

    /// The first control point of the segment behind a joint.
    pub(super) fn segment(&self, joint: usize) -> usize {
        self.segment[joint] as usize
    }

    pub(super) fn bytes(&self) -> u64 {
        let lists = [&self.x, &self.y, &self.bend, &self.room].map(Vec::capacity);
        let words = lists.into_iter().sum::<usize>() + self.segment.capacity();
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
