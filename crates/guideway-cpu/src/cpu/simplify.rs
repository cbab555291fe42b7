use std::ops::Range;

use guideway_spline::{Point, greater, uniform};

use super::LANES;
use super::joints::Joints;

/// Joints of a stretch that is simplified at once.
const MOST: usize = u64::BITS as usize;

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
    all: &Joints,
    joints: Range<usize>,
    points: &[Point<f32>],
    tolerance: f32,
    vertices: &mut Vec<Point<f32>>,
) {
    vertices.clear();
    vertices.push(all.at(joints.start));
    let mut first = joints.start;
    while joints.end - first >= 2 {
        let end = joints.end.min(first + MOST);
        let mut kept = kept(all, first..end);
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
                let segment = uniform::segment(points, all.segment(last));
                cut(segment, all.bend[last], tolerance, vertices);
            }
            vertices.push(all.at(joint));
            last = joint;
        }
        first = last;
    }
}

/// Adds the inner vertices of a segment that is bent too much for one line, at equal parts of its
/// parameter: n parts are n^2 times as straight.
#[inline(always)]
fn cut(segment: &[Point<f32>; 4], bend: f32, tolerance: f32, vertices: &mut Vec<Point<f32>>) {
    if bend > tolerance {
        let parts = (bend / tolerance).sqrt().ceil();
        for i in 1..parts as u32 {
            vertices.push(uniform::point(segment, i as f32 / parts));
        }
    }
}

/// Which joints to keep, a bit each: the first, the last, those that have no room, and where a line would be too far off, that
/// farthest from it (Douglas and Peucker 1973).
#[inline(always)]
fn kept(all: &Joints, joints: Range<usize>) -> u64 {
    let first = joints.start;
    let last = joints.len() - 1;
    let between = u64::MAX >> (u64::BITS as usize - joints.len()) >> 1 & !1;
    let mut kept: u64 = 1 | 1 << last | without_room(all, joints) & between;
    // Between two that follow each other there is nothing to look at.
    let mut ends = kept & !(kept << 1) & !1;
    while ends != 0 {
        let end = ends.trailing_zeros() as usize;
        ends &= ends - 1;
        let mut from = u64::BITS as usize - 1 - (kept & ((1 << end) - 1)).leading_zeros() as usize;
        while from < end {
            let to = from + 1 + (kept >> (from + 1) as u32).trailing_zeros() as usize;
            match farthest(all, first + from, first + to) {
                Some(joint) => kept |= 1 << (joint - first),
                None => from = to,
            }
        }
    }
    kept
}

/// Which joints are on segments that bend too much for any line over several, a bit each, and some behind them.
#[inline(always)]
fn without_room(all: &Joints, joints: Range<usize>) -> u64 {
    let mut found = 0;
    for (chunk, first) in joints.step_by(LANES).enumerate() {
        let Some(rooms) = all.room[first..].first_chunk::<LANES>() else {
            break;
        };
        let mut bits = [0; LANES];
        for i in 0..LANES {
            bits[i] = if rooms[i] < 0.0 { 1_u32 << i } else { 0 };
        }
        found |= u64::from(bits.iter().fold(0, |all, bit| all | bit)) << (chunk * LANES);
    }
    found
}

/// The joint between two that is farthest beyond what it may be from the line between them; none if there is no such.
#[inline(always)]
fn farthest(all: &Joints, from: usize, to: usize) -> Option<usize> {
    let line = Line::new(all.at(from), all.at(to));
    let between = from + 1;
    let (mut first, mut key) = (between, 0);
    while first < to {
        key = key.max(line.greatest_key(all, between, first..to));
        first += LANES;
    }
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
            keys[i] = (over[i].to_bits() & !LANE_BITS | (first - base + i) as u32) & lanes[i];
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
        joints.find(&mut points, tolerance);
        links.find(&runs, &joints, false);
        links.chain(&runs, &mut joints, &mut chains);
        let mut vertices = Vec::new();
        for chain in chains {
            simplify(&joints, chain.joints, &points, tolerance, &mut vertices);
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
