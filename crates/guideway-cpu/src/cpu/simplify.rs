use std::ops::Range;

use guideway_spline::{Point, greater, uniform};

use super::LANES;
use super::joints::{Chain, Joints};

/// Bits of a word.
const WORD: usize = u64::BITS as usize;
/// Farthest that two joints may be from each other for one line.
const MOST: usize = 1 << 8;

/// From number `LANES - n` on, the first n bits of lanes are set.
static FIRST_LANES: [u32; 2 * LANES] = {
    let mut lanes = [0; 2 * LANES];
    let (set, _) = lanes.split_at_mut(LANES);
    let mut i = 0;
    while i < LANES {
        set[i] = u32::MAX;
        i += 1;
    }
    lanes
};

/// Draws chains as straight lines, no point of either farther than a tolerance from the other.
///
/// A line from joint to joint is taken if all joints between are near enough; else it is one to that farthest from it, and one
/// from there on (Douglas and Peucker 1973). Between two joints, a curve
/// leaves their chord by at most max |C''| / 8, and C'' is linear, so its greatest length is at a joint. The
/// points that near to a line form a convex set, so it holds all chords of joints that it holds: a joint may be as far
/// off as the tolerance leaves beside what the curve may bend on either side of it.
///
/// Lines of all chains are looked at together, then both parts of those that were too far off: what is found of one decides nothing for the next, so
/// that a processor need not wait.
#[derive(Default)]
pub(super) struct Chords {
    /// At which joints lines end, a bit each. What it says of the first and the last of a chain, and between chains, means nothing.
    ends: Vec<u64>,
    /// Those that joints are compared with, and those that come next.
    spans: Vec<Span>,
    halves: Vec<Span>,
    keys: Vec<u32>,
}

/// A line from one joint to another that has some between them.
#[derive(Clone, Copy, Debug, Default)]
struct Span {
    from: u32,
    to: u32,
}

impl Span {
    /// Whether a joint lies between its ends.
    fn is_long(self) -> bool {
        self.to > self.from + 1
    }
}

impl Chords {
    /// Finds those of some chains.
    #[inline(always)]
    pub(super) fn find(&mut self, all: &Joints, chains: &[Chain]) {
        all.find_without_room(&mut self.ends);
        self.spans.clear();
        for chain in chains {
            let (mut from, last) = (chain.joints.start, chain.joints.end - 1);
            for next in (from + 1..=last).step_by(WORD) {
                let ends = self.ends_from(next, last);
                // Between two that follow each other there is nothing to look at.
                let mut far = ends & !(ends << 1 | u64::from(from + 1 == next));
                while far != 0 {
                    let end = far.trailing_zeros() as usize;
                    far &= far - 1;
                    let before = ends & ((1 << end) - 1);
                    if let Some(bit) = before.checked_ilog2() {
                        from = next + bit as usize;
                    }
                    self.push(from, next + end);
                }
                if let Some(bit) = ends.checked_ilog2() {
                    from = next + bit as usize;
                }
            }
        }
        while !self.spans.is_empty() {
            self.keys.resize(self.spans.len(), 0);
            for (key, &span) in self.keys.iter_mut().zip(&self.spans) {
                *key = farthest(all, span);
            }
            self.divide();
        }
    }

    /// Takes, in place of all lines, both parts of those that some joint is too far from.
    #[inline(always)]
    fn divide(&mut self) {
        let Self {
            ends,
            spans,
            halves,
            keys,
        } = self;
        // No branches: half of all lines are too far off, and nothing tells which.
        halves.resize(2 * spans.len(), Span::default());
        let mut count = 0;
        for (&Span { from, to }, &key) in spans.iter().zip(&*keys) {
            let is_off = key > NUMBER_BITS;
            let joint = from + 1 + (key & NUMBER_BITS);
            ends[joint as usize / WORD] |= u64::from(is_off) << (joint as usize % WORD);
            for half in [Span { from, to: joint }, Span { from: joint, to }] {
                halves[count] = half;
                count += usize::from(is_off & half.is_long());
            }
        }
        halves.truncate(count);
        std::mem::swap(spans, halves);
    }

    /// Takes a line to be looked at, in parts if it is too long.
    #[inline(always)]
    fn push(&mut self, mut from: usize, end: usize) {
        while from < end {
            let to = end.min(from + MOST);
            self.ends[to / WORD] |= 1 << (to % WORD);
            let span = Span {
                from: from as u32,
                to: to as u32,
            };
            if span.is_long() {
                self.spans.push(span);
            }
            from = to;
        }
    }

    /// At which of the next joints of a chain lines end, a bit each, up to its last, where one always does.
    #[inline(always)]
    fn ends_from(&self, first: usize, last: usize) -> u64 {
        let (word, bit) = (first / WORD, first % WORD);
        let ends = self.ends[word] >> bit | self.ends[word + 1] << 1 << (WORD - 1 - bit);
        match last - first {
            beyond @ 0..WORD => ends & u64::MAX >> (WORD - 1 - beyond) | 1 << beyond,
            _ => ends,
        }
    }

    /// The vertices of a chain's lines, in order.
    #[inline(always)]
    pub(super) fn vertices(
        &self,
        all: &Joints,
        joints: &Range<usize>,
        points: &[Point<f32>],
        tolerance: f32,
        mut emit: impl FnMut(Point<f32>),
    ) {
        let (mut from, last) = (joints.start, joints.end - 1);
        emit(all.at(from));
        for next in (from + 1..=last).step_by(WORD) {
            let mut ends = self.ends_from(next, last);
            while ends != 0 {
                let to = next + ends.trailing_zeros() as usize;
                ends &= ends - 1;
                if to == from + 1 {
                    let segment = uniform::segment(points, all.segment(from));
                    cut(segment, all.bend[from], tolerance, &mut emit);
                }
                emit(all.at(to));
                from = to;
            }
        }
    }

    pub(super) fn bytes(&self) -> u64 {
        let spans = self.spans.capacity() + self.halves.capacity();
        let bytes = self.ends.capacity() * size_of::<u64>()
            + spans * size_of::<Span>()
            + self.keys.capacity() * size_of::<u32>();
        bytes as u64
    }
}

/// Gives the inner vertices of a segment that is bent too much for one line, at equal parts of its
/// parameter: n parts are n^2 times as straight.
#[inline(always)]
fn cut(segment: &[Point<f32>; 4], bend: f32, tolerance: f32, emit: &mut impl FnMut(Point<f32>)) {
    if bend > tolerance {
        let parts = (bend / tolerance).sqrt().ceil();
        let [c0, c1, c2, c3] = uniform::polynomial(segment);
        let step = 1.0 / parts;
        for i in 1..parts as u32 {
            let t = i as f32 * step;
            emit(((c3 * t + c2) * t + c1) * t + c0);
        }
    }
}

/// The key of the joint that is farthest beyond what it may be from a line.
#[inline(always)]
fn farthest(all: &Joints, span: Span) -> u32 {
    let [from, to] = [span.from, span.to].map(|joint| joint as usize);
    let line = Line::new(all.at(from), all.at(to));
    let between = from + 1;
    let (mut first, mut key) = (between, 0);
    while first < to {
        key = key.max(line.greatest_key(all, between, first..to));
        first += LANES;
    }
    key
}

/// A line that joints are compared with. All lengths are times its own, so that nothing is divided.
struct Line {
    start: Point<f32>,
    along: Point<f32>,
    square: f32,
}

/// The bits of a key that say which joint it is for, counted from the first between; those above say how far off that is: 0 if it is near enough.
const NUMBER_BITS: u32 = MOST as u32 - 1;

impl Line {
    #[inline(always)]
    fn new(start: Point<f32>, end: Point<f32>) -> Self {
        /// In place of shorter lines, whose squares may vanish: short beside all units.
        const POINT: Point<f32> = Point::new(1.0 / 1024.0, 0.0);
        let along = end - start;
        let is_point = along.dot(along) < POINT.dot(POINT);
        let along = if is_point { POINT } else { along };
        Self {
            start,
            along,
            square: along.dot(along),
        }
    }

    /// The greatest key of the first [`LANES`] of some joints, whose numbers are counted from `base`.
    #[inline(always)]
    fn greatest_key(&self, all: &Joints, base: usize, joints: Range<usize>) -> u32 {
        let Self {
            start,
            along,
            square,
        } = *self;
        let first = joints.start;
        let (xs, ys) = (&all.x[first..first + LANES], &all.y[first..first + LANES]);
        let rooms = &all.room[first..first + LANES];
        let (mut ahead, mut beside) = ([0.0; LANES], [0.0; LANES]);
        for i in 0..LANES {
            let (x, y) = (xs[i] - start.x, ys[i] - start.y);
            ahead[i] = x * along.x + y * along.y;
            beside[i] = x * along.y - y * along.x;
        }
        let mut over = [0.0; LANES];
        for i in 0..LANES {
            let half = square * 0.5;
            let beyond = greater((ahead[i] - half).abs() - half, 0.0);
            let off = beside[i] * beside[i] + beyond * beyond;
            over[i] = greater(off - rooms[i] * square, 0.0);
        }
        // Floats that are not negative are in the order of their bits; the lowest make room for the number.
        let lanes = &FIRST_LANES[LANES - joints.len().min(LANES)..][..LANES];
        let mut keys = [0; LANES];
        for i in 0..LANES {
            keys[i] = (over[i].to_bits() & !NUMBER_BITS | (first - base + i) as u32) & lanes[i];
        }
        let mut half = LANES / 2;
        while half > 0 {
            for i in 0..half {
                keys[i] = keys[i].max(keys[i + half]);
            }
            half /= 2;
        }
        keys[0]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cpu::joins::Links;
    use crate::cpu::joints::{Joints, Run};

    fn simplified(run: &[Point<f32>], tolerance: f32) -> Vec<Point<f32>> {
        let (mut joints, mut links, mut chains) = (Joints::default(), Links::default(), Vec::new());
        // What lies behind a run does not matter.
        let after = [Point::new(f32::NAN, 1e9); 3];
        let mut points = [run, &after].concat();
        let runs: Vec<_> = Run::new(0, 0..run.len()).into_iter().collect();
        joints.begin(&mut points);
        links.find(&runs, &points, false);
        links.chain((&runs, &points), &mut joints, &mut chains);
        joints.find_room(tolerance);
        let (mut chords, mut vertices) = (Chords::default(), Vec::new());
        chords.find(&joints, &chains);
        for chain in chains {
            let emit = |vertex| vertices.push(vertex);
            chords.vertices(&joints, &chain.joints, &points, tolerance, emit);
        }
        vertices
    }

    fn distance(p: Point<f32>, a: Point<f32>, b: Point<f32>) -> f32 {
        let along = b - a;
        let t = (p - a).dot(along) / along.dot(along).max(1e-30);
        p.distance(a + along * t.clamp(0.0, 1.0))
    }

    #[test]
    fn lines_and_curve_stay_within_the_tolerance_of_each_other() {
        let mut state = 5_u32;
        let mut next = move || {
            state = state.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
            (state >> 8) as f32 / (1 << 24) as f32 - 0.5
        };
        for (points, step) in [
            (4, 40.0),
            (5, 3.0),
            (11, 10.0),
            (18, 9.0),
            (19, 9.0),
            (60, 2.0),
            (60, 200.0),
            (700, 1.0),
        ] {
            let (mut at, mut heading) = (Point::new(0.0, 0.0), 0.0_f32);
            let run: Vec<_> = (0..points)
                .map(|_| {
                    heading += 2.0 * next();
                    at = at + Point::new(heading.cos(), heading.sin()) * step;
                    at
                })
                .collect();
            let vertices = simplified(&run, 1.0);
            let curve: Vec<_> = run
                .array_windows()
                .flat_map(|segment| (0..=50).map(|i| uniform::point(segment, i as f32 / 50.0)))
                .collect();
            for &p in &curve {
                let near = vertices.array_windows().map(|&[a, b]| distance(p, a, b));
                assert!(
                    near.fold(f32::INFINITY, f32::min) <= 1.001,
                    "{points} {step}"
                );
            }
            for vertex in &vertices {
                let near = curve.iter().map(|p| p.distance(*vertex));
                assert!(
                    near.fold(f32::INFINITY, f32::min) <= step * 0.05,
                    "{points} {step}"
                );
            }
            assert!(vertices.len() <= 2 + points * (2.0 + step.sqrt()) as usize);
        }
    }

    #[test]
    fn what_returns_to_where_it_began_is_no_point() {
        for off in [0.0, 1e-30, 1e-20, 1e-6, 1e-3] {
            let [start, end] = [off, 0.0].map(|x| [Point::new(x, 0.0); 3]);
            let there = [[9.0, 0.0], [9.0, 9.0], [0.0, 9.0]].map(|[x, y]| Point::new(x, y));
            let lines = simplified(&[start, there, end].concat(), 0.5);
            let farthest = lines.iter().map(|p| p.distance(start[0]));
            assert!(farthest.fold(0.0, f32::max) > 5.0, "{off}: {lines:?}");
        }
    }

    #[test]
    fn straight_runs_are_few_lines_and_a_point_is_one() {
        let run: Vec<_> = (0..11)
            .map(|i| Point::new(i as f32, 0.5 * i as f32))
            .collect();
        assert_eq!(
            simplified(&run, 0.1),
            [Point::new(1.0, 0.5), Point::new(9.0, 4.5)]
        );
        // Two that are as long as one may be, and the rest.
        let run: Vec<_> = (0..600).map(|i| Point::new(i as f32, 7.0)).collect();
        let ends = [1.0, 257.0, 513.0, 598.0];
        assert_eq!(simplified(&run, 0.1), ends.map(|x| Point::new(x, 7.0)));
        assert_eq!(simplified(&[Point::new(2.0, 3.0); 4], 0.1).len(), 2);
        assert!(simplified(&run[..3], 0.1).is_empty());
    }
}
