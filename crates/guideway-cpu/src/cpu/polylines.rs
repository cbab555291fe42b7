use std::ops::Range;

use guideway_spline::mem::prefetch;
use guideway_spline::{Bounds, Point, greater, lesser};

use super::LANES;
use super::cluster::Members;

/// Pieces are drawn in so many rounds.
pub(super) const ROUNDS: usize = 5;

/// A number that vertices are kept in.
pub(super) trait Coordinate: Copy + Default + PartialOrd + Into<f32> {
    /// The least one that is not below a number, and the greatest that is not above.
    fn at_least(x: f32) -> Self;
    fn at_most(x: f32) -> Self;
}

impl Coordinate for i16 {
    #[inline(always)]
    fn at_least(x: f32) -> Self {
        // Numbers beyond 16 bits become the last ones within.
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

/// Lines of some paths: vertices, each joined with the next unless a piece ends between them.
///
/// A piece is a stretch of one path of at most as many lines as there are lanes.
#[derive(Debug, Default)]
pub(super) struct Polylines<T> {
    /// Vertices, and lanes enough behind the last that each can be the first of a batch.
    pub(super) x: Vec<T>,
    pub(super) y: Vec<T>,
    /// A bit for each vertex: whether a line begins there.
    begins: Vec<u16>,
    /// The first vertex of each piece, and the end of the last.
    firsts: Vec<u32>,
    /// Whose each piece is, or the chain of paths that it is a part of.
    members: Vec<Members>,
    /// The box of each piece: least x and y, greatest x and y.
    boxes: [Vec<T>; 4],
    /// Where each round of pieces ends.
    rounds: [u32; ROUNDS],
    /// Number of paths and of lines.
    counts: [u32; 2],
}

impl<T: Coordinate> Polylines<T> {
    /// Lets go of all lines, not of the memory.
    pub(super) fn clear(&mut self) {
        let Self {
            x,
            y,
            begins,
            firsts,
            members,
            boxes,
            rounds: _,
            counts,
        } = self;
        *counts = [0, 0];
        x.clear();
        y.clear();
        begins.clear();
        firsts.clear();
        members.clear();
        boxes.iter_mut().for_each(Vec::clear);
    }

    /// Adds a piece: the vertices of as many lines as there are lanes, or fewer. It begins where the last one
    /// of the same path ended, or anywhere.
    #[inline(always)]
    pub(super) fn push(&mut self, members: Members, vertices: &[Point<T>]) {
        let first = self.x.len();
        self.firsts.push(first as u32);
        self.members.push(members);
        self.x.extend(vertices.iter().map(|v| v.x));
        self.y.extend(vertices.iter().map(|v| v.y));
        self.begins.resize(self.x.len().div_ceil(LANES), 0);
        self.begin(first, vertices.len() - 1);
        let (mut least, mut most) = (vertices[0], vertices[0]);
        for v in vertices {
            least = Point {
                x: lesser(least.x, v.x),
                y: lesser(least.y, v.y),
            };
            most = Point {
                x: greater(most.x, v.x),
                y: greater(most.y, v.y),
            };
        }
        for (side, value) in self
            .boxes
            .iter_mut()
            .zip([least.x, least.y, most.x, most.y])
        {
            side.push(value);
        }
    }

    /// Takes note that so many lines begin at a vertex and those behind it.
    #[inline(always)]
    fn begin(&mut self, first: usize, lines: usize) {
        self.counts[1] += lines as u32;
        let bits = ((1_u32 << lines) - 1) << (first % LANES);
        self.begins[first / LANES] |= bits as u16;
        if let Some(next) = self.begins.get_mut(first / LANES + 1) {
            *next |= (bits >> LANES) as u16;
        }
    }

    /// Ends a round.
    pub(super) fn end_round(&mut self, round: usize) {
        self.rounds[round] = self.members.len() as u32;
    }

    /// The pieces of some rounds that follow each other.
    pub(super) fn of_rounds(&self, rounds: Range<usize>) -> Range<usize> {
        let end = |rounds: usize| rounds.checked_sub(1).map_or(0, |last| self.rounds[last]);
        end(rounds.start) as usize..end(rounds.end) as usize
    }

    /// Ends the list.
    pub(super) fn finish(&mut self) {
        let members = self.members.iter().fold(0, |all, of_piece| all | of_piece);
        self.counts[0] = members.count_ones();
        self.firsts.push(self.x.len() as u32);
        let padded = self.x.len() + LANES;
        self.x.resize(padded, T::default());
        self.y.resize(padded, T::default());
        self.begins.resize(self.begins.len() + 2, 0);
        for side in &mut self.boxes {
            side.resize(self.members.len() + LANES, T::default());
        }
    }

    /// Becomes a copy that takes no more memory than it has to.
    pub(super) fn copy_from(&mut self, other: &Self) {
        copy(&mut self.x, &other.x);
        copy(&mut self.y, &other.y);
        copy(&mut self.begins, &other.begins);
        copy(&mut self.firsts, &other.firsts);
        copy(&mut self.members, &other.members);
        for (to, from) in self.boxes.iter_mut().zip(&other.boxes) {
            copy(to, from);
        }
        (self.rounds, self.counts) = (other.rounds, other.counts);
    }

    /// Asks for the vertices and the boxes of pieces.
    #[inline(always)]
    pub(super) fn ask_for(&self) {
        prefetch(&self.x);
        prefetch(&self.y);
        prefetch(&self.begins);
        prefetch(&self.firsts);
        for side in &self.boxes {
            prefetch(side);
        }
    }

    /// Number of paths and of lines.
    pub(super) fn paths_and_lines(&self) -> [u32; 2] {
        self.counts
    }

    /// Number of paths and of lines of the pieces whose box meets another.
    #[inline(always)]
    pub(super) fn count_within(&self, within: &Bounds<f32>) -> [u32; 2] {
        let end = self.pieces();
        let (mut drawn, mut made): (Members, _) = (0, 0);
        for first in (0..end).step_by(LANES) {
            let hits = self.hit_bits(first, end, within);
            let of_lanes = first..end.min(first + LANES);
            let firsts = self.firsts[of_lanes.start..=of_lanes.end].array_windows();
            let pieces = self.members[of_lanes].iter().zip(firsts);
            // No branches: which pieces are in sight nothing foretells.
            for (lane, (&members, &[first, end])) in pieces.enumerate() {
                let is_hit = hits >> lane & 1;
                drawn |= members & Members::from(is_hit).wrapping_neg();
                made += (end - first - 1) & is_hit.wrapping_neg();
            }
        }
        [drawn.count_ones(), made]
    }

    /// Counts as others.
    pub(super) fn set_paths_and_lines(&mut self, counts: [u32; 2]) {
        self.counts = counts;
    }

    /// The box of a piece.
    #[inline(always)]
    pub(super) fn bounds(&self, piece: usize) -> Bounds<f32> {
        let [left, top, right, bottom] = &self.boxes;
        Bounds {
            min: Point::new(left[piece].into(), top[piece].into()),
            max: Point::new(right[piece].into(), bottom[piece].into()),
        }
    }

    /// Number of pieces.
    pub(super) fn pieces(&self) -> usize {
        self.members.len()
    }

    /// Whose a piece is, or one of those.
    pub(super) fn member(&self, piece: usize) -> usize {
        self.members[piece].trailing_zeros() as usize
    }

    /// The vertices where the lines of some pieces begin, and some between where none does.
    pub(super) fn begins_of(&self, pieces: Range<usize>) -> Range<usize> {
        let end = self.firsts[pieces.end] as usize;
        self.firsts[pieces.start] as usize..end.saturating_sub(1)
    }

    /// Whether a line begins at each of a lane's number of vertices from `first` on: a bit each.
    #[inline(always)]
    pub(super) fn begin_bits(&self, first: usize) -> u32 {
        let word = first / LANES;
        let bits = u32::from(self.begins[word]) | u32::from(self.begins[word + 1]) << LANES;
        bits >> (first % LANES) & 0xffff
    }

    /// Which of a lane's number of pieces from `first` on, and before `end`, have a box that meets another:
    /// a bit each.
    #[inline(always)]
    pub(super) fn hit_bits(&self, first: usize, end: usize, within: &Bounds<f32>) -> u32 {
        let sides = self
            .boxes
            .each_ref()
            .map(|side| side[first..].first_chunk::<LANES>());
        let [Some(left), Some(top), Some(right), Some(bottom)] = sides else {
            return 0;
        };
        let most = [T::at_most(within.max.x), T::at_most(within.max.y)];
        let least = [T::at_least(within.min.x), T::at_least(within.min.y)];
        let mut bits = [0_u16; LANES];
        for i in 0..LANES {
            // No shortcuts: they would be branches.
            let meets = (left[i] <= most[0])
                & (top[i] <= most[1])
                & (right[i] >= least[0])
                & (bottom[i] >= least[1]);
            bits[i] = if meets { 1 << i } else { 0 };
        }
        let all = bits.iter().fold(0, |all, bit| all | bit);
        u32::from(all) & bits_below(end - first)
    }

    /// Bytes held.
    pub(super) fn bytes(&self) -> u64 {
        let boxes: usize = self.boxes.iter().map(Vec::capacity).sum();
        let coordinates = self.x.capacity() + self.y.capacity() + boxes;
        let bytes = coordinates * size_of::<T>()
            + self.begins.capacity() * size_of::<u16>()
            + self.firsts.capacity() * size_of::<u32>()
            + self.members.capacity() * size_of::<Members>();
        bytes as u64
    }
}

/// A bit for each lane below a number.
#[inline(always)]
pub(super) fn bits_below(lane: usize) -> u32 {
    if lane < LANES {
        (1 << lane) - 1
    } else {
        (1 << LANES) - 1
    }
}

/// Vertices on their way into [`Polylines`], until there are enough for a piece.
pub(super) struct Pen<T> {
    vertices: [Point<T>; LANES + 1],
    len: usize,
    members: Members,
}

impl<T: Coordinate> Pen<T> {
    pub(super) fn new() -> Self {
        Self {
            vertices: [Point {
                x: T::default(),
                y: T::default(),
            }; LANES + 1],
            len: 0,
            members: 0,
        }
    }

    /// Begins with a chain.
    #[inline(always)]
    pub(super) fn set(&mut self, members: Members) {
        (self.members, self.len) = (members, 0);
    }

    /// Goes to the first vertex, or draws a line to another.
    #[inline(always)]
    pub(super) fn draw(&mut self, vertex: Point<T>, lines: &mut Polylines<T>) {
        if self.len > LANES {
            lines.push(self.members, &self.vertices);
            self.vertices[0] = self.vertices[LANES];
            self.len = 1;
        }
        self.vertices[self.len] = vertex;
        self.len += 1;
    }

    /// Ends the lines of a chain.
    #[inline(always)]
    pub(super) fn lift(&mut self, lines: &mut Polylines<T>) {
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
