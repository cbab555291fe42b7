use std::ops::Range;

use guideway_spline::{Point, greater, uniform};

use super::LANES;

/// Joints of a stretch that is simplified at once.
const MOST: usize = LANES;
/// Points of such a stretch: what has to lie behind the first point of a run.
pub(super) const MOST_POINTS: usize = MOST + 2;
/// Joints between two that are looked at as one vector.
const FEW: usize = 8;

/// Some joints between the segments of a run, how far the segments there may bend away from straight lines between them, and
/// how far that lets a joint be from a line that passes it: its square, with the sign. Behind them lie others, or nothing.
pub(super) struct Joints {
    count: usize,
    x: [f32; 2 * MOST],
    y: [f32; 2 * MOST],
    bend: [f32; MOST + 1],
    room: [f32; 2 * MOST],
}

/// From number `MOST - n` on, the first n bits of lanes are set.
static FIRST_LANES: [u32; 2 * MOST] = {
    let mut lanes = [0; 2 * MOST];
    let (set, _) = lanes.split_at_mut(MOST);
    let mut i = 0;
    while i < MOST {
        set[i] = u32::MAX;
        i += 1;
    }
    lanes
};

/// Runs whose first joints are found together.
pub(super) const HEADS: usize = 16;

/// The first joints of some runs. They are found long before they are looked at: processors wait for numbers that were just
/// written as one vector and are read from its middle on.
pub(super) struct Heads([Joints; HEADS]);

impl Default for Heads {
    fn default() -> Self {
        Self([const { Joints::NONE }; HEADS])
    }
}

impl Heads {
    /// Finds those of some runs of control points, of which there are [`HEADS`] or fewer, and [`MOST_POINTS`] from each of
    /// their first points on.
    ///
    /// # Panics
    /// Where there are not.
    #[inline(always)]
    pub(super) fn find(
        &mut self,
        points: &[Point<f32>],
        runs: impl Iterator<Item = Range<usize>>,
        tolerance: f32,
    ) {
        let mut count = 0;
        for (joints, run) in self.0.iter_mut().zip(runs) {
            if !run.is_empty() {
                joints.place(&points[run.start..], run.len());
            }
            count += 1;
        }
        let found = self.0[..count].iter_mut();
        found.for_each(|joints| joints.leave_room(tolerance));
    }

    /// Those of one of the runs.
    #[inline(always)]
    pub(super) fn of(&mut self, run: usize) -> &mut Joints {
        &mut self.0[run]
    }
}

/// Draws a run of control points, the first `len` of some, as straight lines, no point of either farther than `tolerance`
/// from the other: gives the vertices in order. There are [`MOST_POINTS`] from each point of the run on: its own, or any.
/// Its first joints are found: see [`Heads`].
///
/// # Panics
/// Where there are not.
///
/// A line from joint to joint is taken if all joints between are near enough. Between two joints, a curve
/// leaves their chord by at most max |C''| / 8, and C'' is linear, so its greatest length is at a joint. The
/// points that near to a line form a convex set, so it holds all chords of joints that it holds: a joint may be as far
/// off as the tolerance leaves beside what the curve may bend on either side of it.
#[inline(always)]
pub(super) fn simplify(
    mut points: &[Point<f32>],
    len: usize,
    joints: &mut Joints,
    tolerance: f32,
    vertices: &mut Vec<Point<f32>>,
) {
    vertices.clear();
    let mut left = len;
    while left >= 4 {
        if left == len {
            vertices.push(joints.at(0));
        } else {
            joints.place(points, left);
            joints.leave_room(tolerance);
        }
        let mut kept = joints.kept();
        let mut last = 0;
        // What ends with a part may go on behind it: then all but the first line waits for the next part.
        if left > MOST_POINTS && kept.count_ones() > 2 {
            kept &= !(1 << (joints.count - 1));
        }
        kept &= !1;
        while kept != 0 {
            let joint = kept.trailing_zeros() as usize;
            kept &= kept - 1;
            if joint == last + 1 {
                let bend = joints.bend_between(last, joint);
                cut(uniform::segment(points, last), bend, tolerance, vertices);
            }
            vertices.push(joints.at(joint));
            last = joint;
        }
        points = &points[last..];
        left -= last;
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

impl Joints {
    const NONE: Self = Self {
        count: 0,
        x: [0.0; 2 * MOST],
        y: [0.0; 2 * MOST],
        bend: [0.0; MOST + 1],
        room: [0.0; 2 * MOST],
    };

    /// The first joints of a run of so many points.
    #[inline(always)]
    fn place(&mut self, points: &[Point<f32>], len: usize) {
        let points: &[Point<f32>; MOST_POINTS] =
            points.first_chunk().expect("points behind the run");
        self.count = len.min(MOST_POINTS).saturating_sub(2);
        for i in 0..MOST {
            let [a, b, c] = [points[i], points[i + 1], points[i + 2]];
            self.x[i] = (a.x + b.x * 4.0 + c.x) * (1.0 / 6.0);
            self.y[i] = (a.y + b.y * 4.0 + c.y) * (1.0 / 6.0);
            let x = a.x - b.x * 2.0 + c.x;
            let y = a.y - b.y * 2.0 + c.y;
            self.bend[i] = (x * x + y * y).sqrt() * 0.125;
        }
    }

    /// How far each may be off. What lies behind the last does not matter to those between others.
    #[inline(always)]
    fn leave_room(&mut self, tolerance: f32) {
        for i in 1..MOST {
            let bend = greater(greater(self.bend[i - 1], self.bend[i]), self.bend[i + 1]);
            let room = tolerance - bend;
            self.room[i] = room * room.abs();
        }
    }

    fn at(&self, joint: usize) -> Point<f32> {
        Point::new(self.x[joint], self.y[joint])
    }

    /// How far a segment may bend away from its chord.
    fn bend_between(&self, first: usize, last: usize) -> f32 {
        greater(self.bend[first], self.bend[last])
    }

    /// Which joints to keep, a bit each: the first, the last, and where a line would be too far off, that
    /// farthest from it (Douglas and Peucker 1973).
    #[inline(always)]
    fn kept(&self) -> u32 {
        let last = self.count - 1;
        let mut kept: u32 = 1 | 1 << last;
        let mut from = 0;
        while from < last {
            let to = from + 1 + (kept >> (from + 1) as u32).trailing_zeros() as usize;
            let farthest = match to - from {
                1 => None,
                2..=FEW => self.farthest::<FEW>(from, to),
                _ => self.farthest::<MOST>(from, to),
            };
            match farthest {
                Some(joint) => kept |= 1 << joint,
                None => from = to,
            }
        }
        kept
    }

    /// The joint between two that is farthest beyond what it may be from the line between them; none if there is no such.
    /// There are fewer than `N` between them.
    #[inline(always)]
    fn farthest<const N: usize>(&self, from: usize, to: usize) -> Option<usize> {
        const LANE_BITS: u32 = MOST as u32 - 1;
        /// In place of shorter lines, whose squares may vanish: short beside all units.
        const POINT: Point<f32> = Point::new(1.0 / 1024.0, 0.0);
        let start = self.at(from);
        let along = self.at(to) - start;
        let is_point = along.dot(along) < POINT.dot(POINT);
        let along = if is_point { POINT } else { along };
        let square = along.dot(along);
        let between = from + 1;
        let [xs, ys, rooms] = [&self.x, &self.y, &self.room].map(|all| &all[between..between + N]);
        // All lengths are times that of the line, so that nothing is divided.
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
        // Floats that are not negative are in the order of their bits; the lowest make room for the lane.
        let lanes = &FIRST_LANES[MOST + between - to..][..N];
        let mut keys = [0; N];
        for i in 0..N {
            keys[i] = (over[i].to_bits() & !LANE_BITS | i as u32) & lanes[i];
        }
        let mut half = N / 2;
        while half > 0 {
            for i in 0..half {
                keys[i] = keys[i].max(keys[i + half]);
            }
            half /= 2;
        }
        let lane = (keys[0] & LANE_BITS) as usize;
        (keys[0] > LANE_BITS).then_some(between + lane)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn simplified(run: &[Point<f32>], tolerance: f32) -> Vec<Point<f32>> {
        let mut vertices = Vec::new();
        // What lies behind a run does not matter.
        let after = [Point::new(f32::NAN, 1e9); MOST_POINTS];
        let (points, mut heads) = ([run, &after].concat(), Heads::default());
        heads.find(&points, [0..3, 0..run.len()].into_iter(), tolerance);
        simplify(&points, run.len(), heads.of(1), tolerance, &mut vertices);
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
