//! Knots: the end points of the segments of chained curves, with the tolerance of each.
//!
//! Input: runs of control points and their order in chains. Output per knot: its position, the
//! distance by which the segment behind it leaves its chord, and the slack, which is the tolerance
//! that remains for a line that passes the knot.

use std::ops::Range;

use guideway_spline::{Point, greater};

use crate::cpu::ground::tile::LANES;
use guideway_scene::cluster::Members;

/// Bits of half a word.
const HALF: usize = u32::BITS as usize;
/// Elements behind the last knot of a list, so that a vector can start at any knot.
const PADDING: usize = 2 * LANES;

/// A run of control points in a cluster.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CurveRun {
    /// The member it belongs to: one bit.
    pub(crate) member: Members,
    first: u32,
    points: u32,
}

/// Curves that are drawn as one polyline.
#[derive(Clone, Debug)]
pub(crate) struct Chain {
    pub(crate) pass: usize,
    /// The members it belongs to.
    pub(crate) members: Members,
    pub(crate) knots: Range<usize>,
}

/// The knots of all chains, one chain after the other. Runs of a chain share the knots where they
/// meet.
#[derive(Default)]
pub(crate) struct Knots {
    /// Number of knots; list elements behind it are unspecified.
    len: usize,
    pub(crate) x: Vec<f32>,
    pub(crate) y: Vec<f32>,
    /// Most that the segment behind a knot leaves its chord: the larger |C''| / 8 of its ends.
    pub(crate) bend: Vec<f32>,
    /// Most that a knot may be from a line that passes it: signed square. Unspecified for the first
    /// and the last knot of a chain.
    pub(crate) slack: Vec<f32>,
    /// Index of the first control point of the segment behind a knot.
    segment: Vec<u32>,
}

impl CurveRun {
    /// A run of one member; `None` without a segment.
    pub(crate) fn new(member: usize, points: Range<usize>) -> Option<Self> {
        (points.len() >= 4).then_some(Self {
            member: 1 << member,
            first: points.start as u32,
            points: points.len() as u32,
        })
    }

    /// Its first and last point.
    #[inline(always)]
    pub(crate) fn ends(&self, points: &[Point<f32>]) -> [Point<f32>; 2] {
        let run = &points[self.first as usize..][..self.points as usize];
        let (Some(first), Some(last)) = (run.first_chunk::<3>(), run.last_chunk::<3>()) else {
            return [Point::default(); 2];
        };
        // Both ends share one vector.
        let [a, b, c] = [0, 1, 2].map(|i| [first[i].x, first[i].y, last[i].x, last[i].y]);
        let mut ends = [0.0; 4];
        for i in 0..4 {
            ends[i] = (a[i] + b[i] * 4.0 + c[i]) * (1.0 / 6.0);
        }
        [Point::new(ends[0], ends[1]), Point::new(ends[2], ends[3])]
    }
}

impl Knots {
    /// Removes all knots, for new control points. Appends padding to `points`.
    pub(crate) fn reset(&mut self, points: &mut Vec<Point<f32>>) {
        points.resize(points.len() + PADDING, Point::default());
        self.len = 0;
        // Runs have fewer knots than points.
        let max_len = points.len() + PADDING;
        for list in [&mut self.x, &mut self.y, &mut self.bend, &mut self.slack] {
            if list.len() < max_len {
                list.resize(max_len, 0.0);
            }
        }
        if self.segment.len() < max_len {
            self.segment.resize(max_len, 0);
        }
    }

    /// Appends the knots of a run, which continues the last one or begins a chain.
    #[inline(always)]
    pub(crate) fn add(&mut self, run: &CurveRun, goes_on: bool, points: &[Point<f32>]) {
        let first = run.first as usize;
        // The first knot replaces the last one of the run before.
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
            // The gap between the two runs counts as a bend.
            let gap = self.at(self.len) - before;
            self.bend[self.len - 1] += gap.x.abs() + gap.y.abs();
        }
        self.len += count;
    }

    /// Computes the slack of all knots for lines within `tolerance` of their curve.
    #[inline(always)]
    pub(crate) fn find_slack(&mut self, tolerance: f32) {
        let lists = self.bend[..self.len]
            .array_windows()
            .zip(&mut self.slack[1..]);
        for (&[before, behind], slack) in lists {
            *slack = slack_beside(tolerance, before, behind);
        }
    }

    /// Marks knots without slack, one bit each: a segment beside them bends too much for a line
    /// over several segments. Writes one word more than needed.
    #[inline(always)]
    pub(crate) fn mark_without_slack(&self, found: &mut Vec<u64>) {
        found.resize(self.len.div_ceil(u64::BITS as usize) + 1, 0);
        for (word, slacks) in found.iter_mut().zip(self.slack.chunks(u64::BITS as usize)) {
            let (halves, _) = slacks.as_chunks();
            let halves = halves
                .iter()
                .zip(0..)
                .map(|(slacks, half)| u64::from(without_slack(slacks)) << (half * HALF));
            *word = halves.fold(0, |all, half| all | half);
        }
    }

    /// Number of knots.
    pub(crate) fn len(&self) -> usize {
        self.len
    }

    pub(crate) fn at(&self, knot: usize) -> Point<f32> {
        Point::new(self.x[knot], self.y[knot])
    }

    /// Index of the first control point of the segment behind a knot.
    pub(crate) fn segment(&self, knot: usize) -> usize {
        self.segment[knot] as usize
    }

    pub(crate) fn bytes(&self) -> u64 {
        let lists = [&self.x, &self.y, &self.bend, &self.slack].map(Vec::capacity);
        let words = lists.into_iter().sum::<usize>() + self.segment.capacity();
        (words * size_of::<f32>()) as u64
    }
}

/// Slack of a knot between two segments that bend: signed square.
#[inline(always)]
fn slack_beside(tolerance: f32, before: f32, behind: f32) -> f32 {
    let left = tolerance - greater(before, behind);
    left * left.abs()
}

/// Marks knots without slack, one bit each.
#[inline(always)]
fn without_slack(slacks: &[f32; HALF]) -> u32 {
    let mut bits = [0; LANES];
    for (lanes, chunk) in slacks.as_chunks::<LANES>().0.iter().zip(0..) {
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
