//! Polylines of a cluster in a layout for SIMD: coordinates, pieces with boxes, passes of pieces.

use std::ops::Range;

use guideway_spline::mem::prefetch;
use guideway_spline::{Bounds, Point, greater, lesser};

use crate::cpu::ground::tile::{LANES, PASSES};
use guideway_scene::cluster::Members;

/// Number type of vertices.
pub(crate) trait Coordinate: Copy + Default + PartialOrd + Into<f32> {
    /// The least value that is not below `x`.
    fn at_least(x: f32) -> Self;
    /// The greatest value that is not above `x`.
    fn at_most(x: f32) -> Self;
}

impl Coordinate for i16 {
    #[inline(always)]
    fn at_least(x: f32) -> Self {
        // The cast saturates.
        x.ceil() as Self
    }

    #[inline(always)]
    fn at_most(x: f32) -> Self {
        x.floor() as Self
    }
}

impl Coordinate for f32 {
    #[inline(always)]
    fn at_least(x: f32) -> Self {
        x
    }

    #[inline(always)]
    fn at_most(x: f32) -> Self {
        x
    }
}

/// The lines of some paths as a list of vertices, each joined with the next unless a piece ends
/// there.
///
/// ```text
///   vertices  0   1   2   3 | 4   5 | 6   7   8
///   lines     *---*---*---*   *---*   *---*---*
///   starts    1   1   1   0   1   0   1   1   0      one bit per vertex
///   pieces    0               1       2
/// ```
///
/// A piece is a part of one chain, of at most as many lines as there are lanes.
#[derive(Debug, Default)]
pub(crate) struct Polylines<T> {
    /// Coordinates of the vertices, and padding, so that a batch can start at any vertex.
    pub(crate) x: Vec<T>,
    pub(crate) y: Vec<T>,
    /// One bit per vertex at which a line starts.
    starts: Vec<u16>,
    /// First vertex of each piece, and the end of the last one.
    firsts: Vec<u32>,
    /// Members whose curves each piece belongs to.
    members: Vec<Members>,
    /// Boxes of the pieces: minimum of x and y, maximum of x and y.
    boxes: [Vec<T>; 4],
    /// End of each pass, in pieces.
    passes: [u32; PASSES],
    /// Number of paths and of lines.
    counts: [u32; 2],
}

impl<T: Coordinate> Polylines<T> {
    /// Removes all lines, but keeps the memory.
    pub(crate) fn clear(&mut self) {
        let Self {
            x,
            y,
            starts,
            firsts,
            members,
            boxes,
            passes: _,
            counts,
        } = self;
        *counts = [0, 0];
        x.clear();
        y.clear();
        starts.clear();
        firsts.clear();
        members.clear();
        boxes.iter_mut().for_each(Vec::clear);
    }

    /// Appends a piece of at most as many lines as there are lanes.
    #[inline(always)]
    pub(crate) fn push(&mut self, members: Members, vertices: &[Point<T>]) {
        let first = self.x.len();
        self.firsts.push(first as u32);
        self.members.push(members);
        self.x.extend(vertices.iter().map(|v| v.x));
        self.y.extend(vertices.iter().map(|v| v.y));
        self.starts.resize(self.x.len().div_ceil(LANES), 0);
        self.mark_starts(first, vertices.len() - 1);
        let (mut min, mut max) = (vertices[0], vertices[0]);
        for v in vertices {
            min = Point {
                x: lesser(min.x, v.x),
                y: lesser(min.y, v.y),
            };
            max = Point {
                x: greater(max.x, v.x),
                y: greater(max.y, v.y),
            };
        }
        for (side, value) in self.boxes.iter_mut().zip([min.x, min.y, max.x, max.y]) {
            side.push(value);
        }
    }

    /// Marks the starts of `lines` lines from a vertex on.
    #[inline(always)]
    fn mark_starts(&mut self, first: usize, lines: usize) {
        self.counts[1] += lines as u32;
        let bits = ((1_u32 << lines) - 1) << (first % LANES);
        self.starts[first / LANES] |= bits as u16;
        if let Some(next) = self.starts.get_mut(first / LANES + 1) {
            *next |= (bits >> LANES) as u16;
        }
    }

    /// Ends a pass.
    pub(crate) fn end_pass(&mut self, pass: usize) {
        self.passes[pass] = self.members.len() as u32;
    }

    /// The pieces of consecutive passes.
    pub(crate) fn pieces_of_passes(&self, passes: Range<usize>) -> Range<usize> {
        let end = |passes: usize| passes.checked_sub(1).map_or(0, |last| self.passes[last]);
        end(passes.start) as usize..end(passes.end) as usize
    }

    /// Ends the list: counts the paths and adds padding.
    pub(crate) fn finish(&mut self) {
        let members = self.members.iter().fold(0, |all, of_piece| all | of_piece);
        self.counts[0] = members.count_ones();
        self.firsts.push(self.x.len() as u32);
        let padded = self.x.len() + LANES;
        self.x.resize(padded, T::default());
        self.y.resize(padded, T::default());
        self.starts.resize(self.starts.len() + 2, 0);
        for side in &mut self.boxes {
            side.resize(self.members.len() + LANES, T::default());
        }
    }

    /// Copies another list into memory of just its size.
    pub(crate) fn copy_from(&mut self, other: &Self) {
        copy(&mut self.x, &other.x);
        copy(&mut self.y, &other.y);
        copy(&mut self.starts, &other.starts);
        copy(&mut self.firsts, &other.firsts);
        copy(&mut self.members, &other.members);
        for (to, from) in self.boxes.iter_mut().zip(&other.boxes) {
            copy(to, from);
        }
        (self.passes, self.counts) = (other.passes, other.counts);
    }

    /// Prefetches vertices and boxes.
    #[inline(always)]
    pub(crate) fn prefetch(&self) {
        prefetch(&self.x);
        prefetch(&self.y);
        prefetch(&self.starts);
        prefetch(&self.firsts);
        for side in &self.boxes {
            prefetch(side);
        }
    }

    /// Number of paths and of lines.
    pub(crate) fn path_and_line_counts(&self) -> [u32; 2] {
        self.counts
    }

    /// Number of paths and of lines of the pieces whose boxes meet `within`.
    #[inline(always)]
    pub(crate) fn count_within(&self, within: &Bounds<f32>) -> [u32; 2] {
        let end = self.pieces();
        let (mut paths, mut line_count): (Members, _) = (0, 0);
        for first in (0..end).step_by(LANES) {
            let met = self.pieces_meeting(first, end, within);
            let of_lanes = first..end.min(first + LANES);
            let firsts = self.firsts[of_lanes.start..=of_lanes.end].array_windows();
            let pieces = self.members[of_lanes].iter().zip(firsts);
            // No branches: whether a piece is met is unpredictable.
            for (lane, (&members, &[first, end])) in pieces.enumerate() {
                let is_met = met >> lane & 1;
                paths |= members & Members::from(is_met).wrapping_neg();
                line_count += (end - first - 1) & is_met.wrapping_neg();
            }
        }
        [paths.count_ones(), line_count]
    }

    /// Replaces the number of paths and of lines.
    pub(crate) fn set_counts(&mut self, counts: [u32; 2]) {
        self.counts = counts;
    }

    /// The box of a piece.
    #[inline(always)]
    pub(crate) fn bounds(&self, piece: usize) -> Bounds<f32> {
        let [left, top, right, bottom] = &self.boxes;
        Bounds {
            min: Point::new(left[piece].into(), top[piece].into()),
            max: Point::new(right[piece].into(), bottom[piece].into()),
        }
    }

    /// Number of pieces.
    pub(crate) fn pieces(&self) -> usize {
        self.members.len()
    }

    /// The member of a piece; one of them if several were chained.
    pub(crate) fn member(&self, piece: usize) -> usize {
        self.members[piece].trailing_zeros() as usize
    }

    /// The range of vertices at which the lines of some pieces start. A few of its vertices start
    /// none.
    pub(crate) fn line_starts(&self, pieces: Range<usize>) -> Range<usize> {
        let end = self.firsts[pieces.end] as usize;
        self.firsts[pieces.start] as usize..end.saturating_sub(1)
    }

    /// Marks the vertices from `first` on at which a line starts: one bit per lane.
    #[inline(always)]
    pub(crate) fn line_start_bits(&self, first: usize) -> u32 {
        let word = first / LANES;
        let bits = u32::from(self.starts[word]) | u32::from(self.starts[word + 1]) << LANES;
        bits >> (first % LANES) & 0xffff
    }

    /// Marks the pieces from `first` on, and before `end`, whose boxes meet `within`: one bit per
    /// lane.
    #[inline(always)]
    pub(crate) fn pieces_meeting(&self, first: usize, end: usize, within: &Bounds<f32>) -> u32 {
        let sides = self
            .boxes
            .each_ref()
            .map(|side| side[first..].first_chunk::<LANES>());
        let [Some(left), Some(top), Some(right), Some(bottom)] = sides else {
            return 0;
        };
        let max = [T::at_most(within.max.x), T::at_most(within.max.y)];
        let min = [T::at_least(within.min.x), T::at_least(within.min.y)];
        let mut bits = [0_u16; LANES];
        for i in 0..LANES {
            // No short circuits: they would be branches.
            let meets = (left[i] <= max[0])
                & (top[i] <= max[1])
                & (right[i] >= min[0])
                & (bottom[i] >= min[1]);
            bits[i] = if meets { 1 << i } else { 0 };
        }
        let all = bits.iter().fold(0, |all, bit| all | bit);
        u32::from(all) & bits_below(end - first)
    }

    /// Heap bytes held.
    pub(crate) fn bytes(&self) -> u64 {
        let boxes: usize = self.boxes.iter().map(Vec::capacity).sum();
        let coordinates = self.x.capacity() + self.y.capacity() + boxes;
        let bytes = coordinates * size_of::<T>()
            + self.starts.capacity() * size_of::<u16>()
            + self.firsts.capacity() * size_of::<u32>()
            + self.members.capacity() * size_of::<Members>();
        bytes as u64
    }
}

/// One bit for each lane below a number.
#[inline(always)]
pub(crate) fn bits_below(lane: usize) -> u32 {
    if lane < LANES {
        (1 << lane) - 1
    } else {
        (1 << LANES) - 1
    }
}

/// Collects the vertices of a chain and writes them to [`Polylines`] piece by piece.
pub(crate) struct PolylineWriter<T> {
    vertices: [Point<T>; LANES + 1],
    len: usize,
    members: Members,
}

impl<T: Coordinate> PolylineWriter<T> {
    pub(crate) fn new() -> Self {
        Self {
            vertices: [Point {
                x: T::default(),
                y: T::default(),
            }; LANES + 1],
            len: 0,
            members: 0,
        }
    }

    /// Begins a chain.
    #[inline(always)]
    pub(crate) fn begin_chain(&mut self, members: Members) {
        (self.members, self.len) = (members, 0);
    }

    /// Appends a vertex: the first of a chain, or the end of a line from the one before.
    #[inline(always)]
    pub(crate) fn push(&mut self, vertex: Point<T>, lines: &mut Polylines<T>) {
        if self.len > LANES {
            lines.push(self.members, &self.vertices);
            self.vertices[0] = self.vertices[LANES];
            self.len = 1;
        }
        self.vertices[self.len] = vertex;
        self.len += 1;
    }

    /// Ends a chain.
    #[inline(always)]
    pub(crate) fn finish_chain(&mut self, lines: &mut Polylines<T>) {
        if self.len > 1 {
            lines.push(self.members, &self.vertices[..self.len]);
        }
        self.len = 0;
    }
}

fn copy<T: Copy>(to: &mut Vec<T>, from: &[T]) {
    to.clear();
    to.reserve_exact(from.len());
    to.extend_from_slice(from);
}
