use std::ops::Range;

use guideway_spline::{Point, greater, uniform};

use super::LANES;
use super::joints::Chains;

/// Joints of a stretch that is simplified at once.
const MOST: usize = u64::BITS as usize;
/// Joints between two that are looked at as one vector; of more, [`LANES`] are.
const FEW: usize = 8;

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

/// Draws a chain as straight lines, no point of either farther than `tolerance` from the other: gives the vertices in order.
///
/// A line from joint to joint is taken if all joints between are near enough. Between two joints, a curve
/// leaves their chord by at most max |C''| / 8, and C'' is linear, so its greatest length is at a joint. The
/// points that near to a line form a convex set, so it holds all chords of joints that it holds: a joint may be as far
/// off as the tolerance leaves beside what the curve may bend on either side of it.
#[inline(always)]
pub(super) fn simplify(
    chains: &Chains,
    joints: Range<usize>,
    points: &[Point<f32>],
    tolerance: f32,
    vertices: &mut Vec<Point<f32>>,
) {
    vertices.clear();
    vertices.push(chains.at(joints.start));
    let mut first = joints.start;
    while joints.end - first >= 2 {
        let end = joints.end.min(first + MOST);
        let mut kept = kept(chains, first..end);
        // What ends with a stretch may go on behind it: then all but the first line waits for the next one.
        if end < joints.end && kept.count_ones() > 2 {
            kept &= !(1 << (end - 1 - first));
        }
        kept &= !1;
        let mut last = first;
        while kept != 0 {
            let joint = first + kept.trailing_zeros() as usize;
            kept &= kept - 1;
            if joint == last + 1 {
                let segment = uniform::segment(points, chains.segment[last] as usize);
                cut(segment, chains.bend[last], tolerance, vertices);
            }
            vertices.push(chains.at(joint));
            last = joint;
        }
        first = last;
    }
}

/// Adds the inner vertices of a segment that is bent too much for one line, at equal parts of its
/// parameter: n parts are n^2 times as straight.
fn cut(segment: &[Point<f32>; 4], bend: f32, tolerance: f32, vertices: &mut Vec<Point<f32>>) {
    if bend > tolerance {
        let parts = (bend / tolerance).sqrt().ceil();
        for i in 1..parts as u32 {
            vertices.push(uniform::point(segment, i as f32 / parts));
        }
    }
}

/// Which joints to keep, a bit each: the first, the last, and where a line would be too far off, that
/// farthest from it (Douglas and Peucker 1973).
#[inline(always)]
fn kept(chains: &Chains, joints: Range<usize>) -> u64 {
    let first = joints.start;
    let last = joints.len() - 1;
    let mut kept: u64 = 1 | 1 << last;
    let mut from = 0;
    while from < last {
        let to = from + 1 + (kept >> (from + 1) as u32).trailing_zeros() as usize;
        match farthest(chains, first + from, first + to) {
            Some(joint) => kept |= 1 << (joint - first),
            None => from = to,
        }
    }
    kept
}

/// The joint between two that is farthest beyond what it may be from the line between them; none if there is no such.
#[inline(always)]
fn farthest(chains: &Chains, from: usize, to: usize) -> Option<usize> {
    let line = Line::new(chains.at(from), chains.at(to));
    let between = from + 1;
    let key = match to - between {
        0 => return None,
        1..=FEW => line.farthest::<FEW>(chains, between, between..to),
        _ => {
            let (mut first, mut key) = (between, 0);
            while first < to {
                key = key.max(line.farthest::<LANES>(chains, between, first..to));
                first += LANES;
            }
            key
        }
    };
    (key > LANE_BITS).then_some(between + (key & LANE_BITS) as usize)
}

/// A line that joints are compared with. All lengths are times its own, so that nothing is divided.
struct Line {
    start: Point<f32>,
    along: Point<f32>,
    square: f32,
}

/// The bits of a key that say which joint it is for; those above say how far off that is.
const LANE_BITS: u32 = MOST as u32 - 1;

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

    /// The greatest key of the first `N` of some joints, whose numbers are counted from `base`.
    #[inline(always)]
    fn farthest<const N: usize>(&self, chains: &Chains, base: usize, joints: Range<usize>) -> u32 {
        let Self {
            start,
            along,
            square,
        } = *self;
        let first = joints.start;
        let (xs, ys) = (&chains.x[first..first + N], &chains.y[first..first + N]);
        let rooms = &chains.room[first..first + N];
        let (mut ahead, mut beside) = ([0.0; N], [0.0; N]);
        for i in 0..N {
            let (x, y) = (xs[i] - start.x, ys[i] - start.y);
            ahead[i] = x * along.x + y * along.y;
            beside[i] = x * along.y - y * along.x;
        }
        let mut over = [0.0; N];
        for i in 0..N {
            let half = square * 0.5;
            let beyond = greater((ahead[i] - half).abs() - half, 0.0);
            let off = beside[i] * beside[i] + beyond * beyond;
            over[i] = greater(off - rooms[i] * square, 0.0);
        }
        // Floats that are not negative are in the order of their bits; the lowest make room for the number.
        let lanes = &FIRST_LANES[LANES - joints.len().min(LANES)..][..N];
        let mut keys = [0; N];
        for i in 0..N {
            keys[i] = (over[i].to_bits() & !LANE_BITS | (first - base + i) as u32) & lanes[i];
        }
        let mut half = N / 2;
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
        let (mut joints, mut chains) = (Joints::default(), Chains::default());
        let mut links = Links::default();
        // What lies behind a run does not matter.
        let after = [Point::new(f32::NAN, 1e9); 3];
        let mut points = [run, &after].concat();
        let runs: Vec<_> = Run::new(0, 0..run.len()).into_iter().collect();
        joints.find(&mut points);
        links.find(&runs, &joints, false);
        links.chain(&runs, &joints, &mut chains);
        chains.leave_room(tolerance);
        let mut vertices = Vec::new();
        for (_, joints) in chains.iter() {
            simplify(&chains, joints, &points, tolerance, &mut vertices);
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
        let run: Vec<_> = (0..100).map(|i| Point::new(i as f32, 7.0)).collect();
        assert!(simplified(&run, 0.1).len() < 10);
        assert_eq!(simplified(&[Point::new(2.0, 3.0); 4], 0.1).len(), 2);
        assert!(simplified(&run[..3], 0.1).is_empty());
    }
}
