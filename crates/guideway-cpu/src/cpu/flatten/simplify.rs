//! Simplifies chains to polylines within a tolerance of the curves, in both directions.
//!
//! Douglas and Peucker 1973: a line from knot to knot stays if all knots between are near enough;
//! otherwise it is split at the farthest one.
//!
//! ```text
//!         x  farthest knot              x
//!      .     .                       .'   '.
//!    *---------*        ->          *       *
//! ```
//!
//! Between two knots a curve leaves its chord by at most max |C''| / 8, and C'' is linear, so its
//! maximum is at a knot. All points within the tolerance of a line form a convex set, so it holds
//! the simplifier of all knots that it holds. A knot may therefore be as far from the line as the
//! tolerance leaves beside the bends of its two segments: its slack.
//!
//! Cost: O(n log n) on average. Lines of all chains are tested side by side, then the halves of
//! those that were split: no test waits for the result of another.

use std::ops::Range;

use guideway_spline::{Point, greater, uniform};

use super::knots::{Chain, Knots};
use crate::cpu::ground::tile::LANES;

/// Bits of a word.
const WORD: usize = u64::BITS as usize;
/// Most knots that one line passes. Derived: the number of a knot fits in the low 8 bits of a key.
const MAX_KNOTS: usize = 1 << 8;

/// A window that starts at `LANES - n` has all bits set in its first `n` lanes.
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

/// Simplifies chains; keeps its buffers.
#[derive(Default)]
pub(crate) struct DouglasPeucker {
    /// One bit per knot at which a line ends; unspecified for the ends of chains and between them.
    ends: Vec<u64>,
    /// Lines to test, and their halves that are tested next.
    spans: Vec<KnotSpan>,
    halves: Vec<KnotSpan>,
    keys: Vec<u32>,
}

/// A line from one knot to another.
#[derive(Clone, Copy, Debug, Default)]
struct KnotSpan {
    from: u32,
    to: u32,
}

impl KnotSpan {
    /// Returns `true` if there is a knot between its ends.
    fn is_long(self) -> bool {
        self.to > self.from + 1
    }
}

impl DouglasPeucker {
    /// Finds the lines of some chains.
    #[inline(always)]
    pub(crate) fn simplify(&mut self, knots: &Knots, chains: &[Chain]) {
        knots.mark_without_slack(&mut self.ends);
        self.spans.clear();
        for chain in chains {
            let (mut from, last) = (chain.knots.start, chain.knots.end - 1);
            for next in (from + 1..=last).step_by(WORD) {
                let ends = self.ends_from(next, last);
                // Lines between neighboring knots need no test.
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
                *key = farthest(knots, span);
            }
            self.divide();
        }
    }

    /// Replaces all lines by the halves of those that are too far from a knot.
    #[inline(always)]
    fn divide(&mut self) {
        let Self {
            ends,
            spans,
            halves,
            keys,
        } = self;
        // No branches: half of all lines are split, unpredictably.
        halves.resize(2 * spans.len(), KnotSpan::default());
        let mut count = 0;
        for (&KnotSpan { from, to }, &key) in spans.iter().zip(&*keys) {
            let is_off = key > NUMBER_BITS;
            let knot = from + 1 + (key & NUMBER_BITS);
            ends[knot as usize / WORD] |= u64::from(is_off) << (knot as usize % WORD);
            for half in [KnotSpan { from, to: knot }, KnotSpan { from: knot, to }] {
                halves[count] = half;
                count += usize::from(is_off & half.is_long());
            }
        }
        halves.truncate(count);
        std::mem::swap(spans, halves);
    }

    /// Adds a line to test, cut where it is too long.
    #[inline(always)]
    fn push(&mut self, mut from: usize, end: usize) {
        while from < end {
            let to = end.min(from + MAX_KNOTS);
            self.ends[to / WORD] |= 1 << (to % WORD);
            let span = KnotSpan {
                from: from as u32,
                to: to as u32,
            };
            if span.is_long() {
                self.spans.push(span);
            }
            from = to;
        }
    }

    /// Ends of lines among the knots from `first` to `last`, one bit each: the next 64 at most. The
    /// last knot always is one.
    #[inline(always)]
    fn ends_from(&self, first: usize, last: usize) -> u64 {
        let (word, bit) = (first / WORD, first % WORD);
        let ends = self.ends[word] >> bit | self.ends[word + 1] << 1 << (WORD - 1 - bit);
        match last - first {
            beyond @ 0..WORD => ends & u64::MAX >> (WORD - 1 - beyond) | 1 << beyond,
            _ => ends,
        }
    }

    /// Calls `emit` with the vertices of a chain, in order.
    #[inline(always)]
    pub(crate) fn vertices(
        &self,
        knots: &Knots,
        chain: &Range<usize>,
        points: &[Point<f32>],
        tolerance: f32,
        mut emit: impl FnMut(Point<f32>),
    ) {
        let (mut from, last) = (chain.start, chain.end - 1);
        emit(knots.at(from));
        for next in (from + 1..=last).step_by(WORD) {
            let mut ends = self.ends_from(next, last);
            while ends != 0 {
                let to = next + ends.trailing_zeros() as usize;
                ends &= ends - 1;
                if to == from + 1 {
                    let segment = uniform::segment(points, knots.segment(from));
                    cut(segment, knots.bend[from], tolerance, &mut emit);
                }
                emit(knots.at(to));
                from = to;
            }
        }
    }

    pub(crate) fn bytes(&self) -> u64 {
        let spans = self.spans.capacity() + self.halves.capacity();
        let bytes = self.ends.capacity() * size_of::<u64>()
            + spans * size_of::<KnotSpan>()
            + self.keys.capacity() * size_of::<u32>();
        bytes as u64
    }
}

/// Emits the inner vertices of a segment that bends too much for one line, at equal steps of its
/// parameter: n steps bend 1 / n^2 as much.
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

/// The key of the knot that exceeds its slack most.
#[inline(always)]
fn farthest(knots: &Knots, span: KnotSpan) -> u32 {
    let [from, to] = [span.from, span.to].map(|knot| knot as usize);
    let line = Line::new(knots.at(from), knots.at(to));
    let between = from + 1;
    let (mut first, mut key) = (between, 0);
    while first < to {
        key = key.max(line.greatest_key(knots, between, first..to));
        first += LANES;
    }
    key
}

/// A line that knots are compared with. Lengths are scaled by its own length: no division.
struct Line {
    start: Point<f32>,
    along: Point<f32>,
    square: f32,
}

/// Bits of a key with the number of the knot, counted from the first one between; the bits above
/// hold its excess, 0 if it is near enough.
const NUMBER_BITS: u32 = MAX_KNOTS as u32 - 1;

impl Line {
    #[inline(always)]
    fn new(start: Point<f32>, end: Point<f32>) -> Self {
        /// Replaces shorter lines, whose squares may vanish. Short compared with a unit.
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

    /// The greatest key of the first [`LANES`] of some knots, numbered from `base`.
    #[inline(always)]
    fn greatest_key(&self, knots: &Knots, base: usize, range: Range<usize>) -> u32 {
        let Self {
            start,
            along,
            square,
        } = *self;
        let first = range.start;
        let (xs, ys) = (
            &knots.x[first..first + LANES],
            &knots.y[first..first + LANES],
        );
        let slacks = &knots.slack[first..first + LANES];
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
            over[i] = greater(off - slacks[i] * square, 0.0);
        }
        // Positive floats compare like their bits; the low bits hold the number.
        let lanes = &FIRST_LANES[LANES - range.len().min(LANES)..][..LANES];
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
    use crate::cpu::flatten::chain_curves::CurveChains;
    use crate::cpu::flatten::knots::CurveRun;

    fn simplified(run: &[Point<f32>], tolerance: f32) -> Vec<Point<f32>> {
        let (mut knots, mut curve_chains, mut chains) =
            (Knots::default(), CurveChains::default(), Vec::new());
        // Points behind a run have no effect.
        let after = [Point::new(f32::NAN, 1e9); 3];
        let mut points = [run, &after].concat();
        let runs: Vec<_> = CurveRun::new(0, 0..run.len()).into_iter().collect();
        knots.reset(&mut points);
        curve_chains.link_runs(&runs, &points, false);
        curve_chains.append_knots((&runs, &points), &mut knots, &mut chains);
        knots.find_slack(tolerance);
        let (mut simplifier, mut vertices) = (DouglasPeucker::default(), Vec::new());
        simplifier.simplify(&knots, &chains);
        for chain in chains {
            let emit = |vertex| vertices.push(vertex);
            simplifier.vertices(&knots, &chain.knots, &points, tolerance, emit);
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
    fn keeps_loops_that_return_to_their_start() {
        for off in [0.0, 1e-30, 1e-20, 1e-6, 1e-3] {
            let [start, end] = [off, 0.0].map(|x| [Point::new(x, 0.0); 3]);
            let there = [[9.0, 0.0], [9.0, 9.0], [0.0, 9.0]].map(|[x, y]| Point::new(x, y));
            let lines = simplified(&[start, there, end].concat(), 0.5);
            let farthest = lines.iter().map(|p| p.distance(start[0]));
            assert!(farthest.fold(0.0, f32::max) > 5.0, "{off}: {lines:?}");
        }
    }

    #[test]
    fn straight_runs_are_few_lines_and_points_are_one() {
        let run: Vec<_> = (0..11)
            .map(|i| Point::new(i as f32, 0.5 * i as f32))
            .collect();
        assert_eq!(
            simplified(&run, 0.1),
            [Point::new(1.0, 0.5), Point::new(9.0, 4.5)]
        );
        // Two lines of the maximum length, and the rest.
        let run: Vec<_> = (0..600).map(|i| Point::new(i as f32, 7.0)).collect();
        let ends = [1.0, 257.0, 513.0, 598.0];
        assert_eq!(simplified(&run, 0.1), ends.map(|x| Point::new(x, 7.0)));
        assert_eq!(simplified(&[Point::new(2.0, 3.0); 4], 0.1).len(), 2);
        assert!(simplified(&run[..3], 0.1).is_empty());
    }
}
