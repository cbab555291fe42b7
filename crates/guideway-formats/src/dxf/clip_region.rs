//! Cuts curves at the boundary that clips a block (XCLIP): runs in meters in, the pieces inside
//! out.

use guideway_spline::bezier::{Bezier, bounds, part, point, split};
use guideway_spline::{Bounds, Point, Runs, uniform};

type P = Point<f64>;

/// Distance from the boundary below which a point is inside, as a share of the boundary's size.
const ON_BOUNDARY: f64 = 1e-9;
/// Parts of a curve that are shorter only touch the boundary, by parameter.
const SHORTEST_PART: f64 = 1e-9;
/// Halvings of a curve to find where it crosses an edge: a parameter to 1e-12.
const HALVINGS: u32 = 40;
/// Work of a comparison of boxes, and of a search for crossings.
const COMPARE: u64 = 1;
const SEARCH: u64 = 64;

/// Comparisons with boundaries in any file, and for each of its bytes. Derived: the first take a
/// second.
const BASE_WORK: u64 = 1 << 26;
const WORK_PER_BYTE: u64 = 256;

/// The comparisons that a file may ask for.
pub(super) fn work(file_bytes: usize) -> u64 {
    BASE_WORK + file_bytes as u64 * WORK_PER_BYTE
}

/// The region that a boundary leaves visible, within those of the blocks around it.
pub(super) struct ClipRegion<'a> {
    /// The corners of the boundary, in meters.
    corners: Vec<P>,
    /// The inside is hidden instead of the outside.
    is_inverted: bool,
    bounds: Bounds<f64>,
    around: Option<&'a Self>,
}

/// The file asks for more comparisons than it may.
pub(super) struct TooMuchWork;

impl<'a> ClipRegion<'a> {
    /// A region inside of a boundary, or outside if it is inverted; `None` without corners. Takes
    /// from `work_left` what that costs.
    ///
    /// # Errors
    /// When no work is left.
    pub(super) fn new(
        corners: impl ExactSizeIterator<Item = P>,
        is_inverted: bool,
        around: Option<&'a Self>,
        work_left: &mut u64,
    ) -> Result<Option<Self>, TooMuchWork> {
        take_work(corners.len(), work_left)?;
        let corners: Vec<P> = corners.collect();
        Ok(Bounds::of_slice(&corners).map(|bounds| Self {
            corners,
            is_inverted,
            bounds,
            around,
        }))
    }

    /// Returns `true` if a point is visible. Takes from `work_left` what that costs.
    ///
    /// # Errors
    /// When no work is left.
    pub(super) fn shows(&self, point: P, work_left: &mut u64) -> Result<bool, TooMuchWork> {
        take_work(self.corners.len(), work_left)?;
        match self.around {
            _ if self.contains(point) == self.is_inverted => Ok(false),
            Some(around) => around.shows(point, work_left),
            None => Ok(true),
        }
    }

    /// The visible pieces of a curve, in its order. Takes from `work_left` what that costs.
    ///
    /// # Errors
    /// When no work is left.
    pub(super) fn cut(&self, runs: &Runs, work_left: &mut u64) -> Result<Vec<Runs>, TooMuchWork> {
        let mut pieces = Vec::new();
        match self.around {
            Some(around) => {
                for runs in around.cut(runs, work_left)? {
                    self.cut_at_own(&runs, work_left, &mut pieces)?;
                }
            }
            None => self.cut_at_own(runs, work_left, &mut pieces)?,
        }
        Ok(pieces)
    }

    fn cut_at_own(
        &self,
        runs: &Runs,
        work_left: &mut u64,
        pieces: &mut Vec<Runs>,
    ) -> Result<(), TooMuchWork> {
        let mut open = Runs::default();
        let mut close = |open: &mut Runs| {
            if !open.is_empty() {
                pieces.push(std::mem::take(open));
            }
        };
        for run in runs.iter() {
            let is_far = Bounds::of_run(run).is_none_or(|run| !run.intersects(self.bounds));
            if is_far && !self.is_inverted {
                close(&mut open);
                continue;
            }
            for segment in run.array_windows() {
                let curve = uniform::to_bezier(segment);
                for (from, to, is_inside) in self.parts(&curve, work_left)? {
                    match is_inside != self.is_inverted {
                        true if to - from == 1.0 => open.push_segment(segment),
                        true => open.push_bezier(&part(&curve, from, to)),
                        false => close(&mut open),
                    }
                }
            }
        }
        close(&mut open);
        Ok(())
    }

    /// The parts of a curve, by parameter, that are inside and outside by turns.
    fn parts(
        &self,
        curve: &Bezier,
        work_left: &mut u64,
    ) -> Result<Vec<(f64, f64, bool)>, TooMuchWork> {
        let mut cuts = vec![0.0, 1.0];
        let of_curve = bounds(curve);
        for (a, b) in self.edges() {
            let of_edge = Bounds::of_points([a, b]);
            let is_near = of_edge.is_some_and(|edge| edge.intersects(of_curve));
            let work = if is_near { SEARCH } else { COMPARE };
            *work_left = work_left.checked_sub(work).ok_or(TooMuchWork)?;
            if is_near {
                let heights = curve.map(|p| (b - a).cross(p - a));
                crossings(heights, (0.0, 1.0), HALVINGS, &mut cuts);
            }
        }
        cuts.sort_unstable_by(f64::total_cmp);
        cuts.dedup_by(|next, cut| *next - *cut < SHORTEST_PART);
        let last = cuts.len() - 1;
        cuts[last] = 1.0;
        let mut parts: Vec<(f64, f64, bool)> = Vec::new();
        for ends in cuts.windows(2) {
            take_work(self.corners.len(), work_left)?;
            let is_inside = self.contains(point(curve, ends[0].midpoint(ends[1])));
            match parts.last_mut() {
                Some((_, to, last)) if *last == is_inside => *to = ends[1],
                _ => parts.push((ends[0], ends[1], is_inside)),
            }
        }
        Ok(parts)
    }

    fn edges(&self) -> impl Iterator<Item = (P, P)> {
        let next = self.corners.iter().cycle().skip(1);
        self.corners.iter().copied().zip(next.copied())
    }

    /// Returns `true` if a point is on the boundary, or a ray from it crosses it an odd number of
    /// times.
    fn contains(&self, p: P) -> bool {
        let size = self.bounds.size();
        let slack = ON_BOUNDARY * size.x.max(size.y);
        if !self.bounds.inflated(slack).contains(p) {
            return false;
        }
        let mut is_inside = false;
        for (a, b) in self.edges() {
            let (edge, to) = (b - a, p - a);
            let along = (to.dot(edge) / edge.dot(edge)).clamp(0.0, 1.0);
            // A corner that is stated twice has no edge: NaN compares as false.
            if p.distance(a.lerp(b, along)) <= slack {
                return true;
            }
            if (a.y > p.y) != (b.y > p.y) && p.x < a.x + edge.x * (to.y / edge.y) {
                is_inside = !is_inside;
            }
        }
        is_inside
    }
}

/// Takes the work of a comparison for each of `count` corners.
fn take_work(count: usize, work_left: &mut u64) -> Result<(), TooMuchWork> {
    *work_left = work_left
        .checked_sub(COMPARE * count as u64)
        .ok_or(TooMuchWork)?;
    Ok(())
}

/// Appends the parameters at which a polynomial in Bernstein form changes its sign, between those
/// of its ends.
///
/// The polynomial has at most as many zeros as its coefficients change their sign.
fn crossings(heights: [f64; 4], (from, to): (f64, f64), halvings: u32, found: &mut Vec<f64>) {
    let is_above = heights.map(|height| height > 0.0);
    if is_above.iter().all(|above| *above == is_above[0]) {
        return;
    }
    let middle = from.midpoint(to);
    let Some(left) = halvings.checked_sub(1) else {
        found.push(middle);
        return;
    };
    let line = heights.map(|height| Point::new(height, 0.0));
    let [first, second] = split(&line, 0.5).map(|half| half.map(|p| p.x));
    crossings(first, (from, middle), left, found);
    crossings(second, (middle, to), left, found);
}

#[cfg(test)]
mod tests {
    use super::*;

    fn polygon(corners: &[(f64, f64)]) -> Vec<P> {
        corners.iter().map(|&(x, y)| Point::new(x, y)).collect()
    }

    fn region<'a>(corners: &[(f64, f64)], around: Option<&'a ClipRegion<'a>>) -> ClipRegion<'a> {
        let corners = polygon(corners).into_iter();
        let region = ClipRegion::new(corners, false, around, &mut 1_000_000);
        region.ok().flatten().expect("a region")
    }

    fn cut(region: &ClipRegion<'_>, runs: &Runs) -> Vec<(P, P)> {
        let Ok(pieces) = region.cut(runs, &mut 1_000_000) else {
            panic!("too much work");
        };
        let ends = pieces.iter().map(|runs| runs.start().zip(runs.end()));
        ends.map(|ends| ends.expect("a piece has runs")).collect()
    }

    fn line(from: (f64, f64), to: (f64, f64)) -> Runs {
        let mut runs = Runs::default();
        runs.push_line(Point::new(from.0, from.1), Point::new(to.0, to.1));
        runs
    }

    fn assert_ends(found: &[(P, P)], expected: &[[(f64, f64); 2]]) {
        assert_eq!(found.len(), expected.len(), "{found:?}");
        for ((start, end), [a, b]) in found.iter().zip(expected) {
            assert!(start.distance(Point::new(a.0, a.1)) < 1e-9, "{found:?}");
            assert!(end.distance(Point::new(b.0, b.1)) < 1e-9, "{found:?}");
        }
    }

    #[test]
    fn lines_are_cut_where_they_cross_a_boundary_that_is_not_convex() {
        // The letter U.
        let corners = [
            (0.0, 0.0),
            (6.0, 0.0),
            (6.0, 4.0),
            (4.0, 4.0),
            (4.0, 2.0),
            (2.0, 2.0),
            (2.0, 4.0),
            (0.0, 4.0),
        ];
        let region = region(&corners, None);
        let found = cut(&region, &line((-1.0, 3.0), (9.0, 3.0)));
        assert_ends(
            &found,
            &[[(0.0, 3.0), (2.0, 3.0)], [(4.0, 3.0), (6.0, 3.0)]],
        );
        assert_ends(
            &cut(&region, &line((1.0, 1.0), (5.0, 1.0))),
            &[[(1.0, 1.0), (5.0, 1.0)]],
        );
        assert_ends(&cut(&region, &line((2.5, 3.0), (3.5, 3.0))), &[]);
        // From the boundary outwards, and on it.
        assert_ends(&cut(&region, &line((6.0, 1.0), (9.0, 1.0))), &[]);
        assert_ends(
            &cut(&region, &line((-1.0, 0.0), (9.0, 0.0))),
            &[[(0.0, 0.0), (6.0, 0.0)]],
        );
        let mut two = line((1.0, 1.0), (1.0, 9.0));
        two.push_line(Point::new(1.0, 9.0), Point::new(5.0, 3.0));
        let expected = [
            [(1.0, 1.0), (1.0, 4.0)],
            [(5.0 - 2.0 / 3.0, 4.0), (5.0, 3.0)],
        ];
        assert_ends(&cut(&region, &two), &expected);
    }

    #[test]
    fn an_inverted_boundary_hides_its_inside() {
        let square = [(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0)];
        let around = region(&[(-5.0, -5.0), (5.0, -5.0), (5.0, 5.0), (-5.0, 5.0)], None);
        let mut hole = region(&square, Some(&around));
        hole.is_inverted = true;
        assert_ends(
            &cut(&hole, &line((-9.0, 1.0), (9.0, 1.0))),
            &[[(-5.0, 1.0), (0.0, 1.0)], [(2.0, 1.0), (5.0, 1.0)]],
        );
        assert_ends(&cut(&hole, &line((0.5, 1.0), (1.5, 1.0))), &[]);
        let apart = [(-1.0, 3.0), (1.0, 3.0)];
        assert_ends(&cut(&hole, &line(apart[0], apart[1])), &[apart]);
        let shows = |x: f64| hole.shows(Point::new(x, 1.0), &mut 100).ok();
        assert_eq!([-9.0, -1.0, 1.0].map(shows), [false, true, false].map(Some));
    }

    #[test]
    fn curves_are_cut_at_nested_boundaries() {
        // An arch that is 3 m high: y = 12 t (1 - t), x = 4 t.
        let mut arch = Runs::default();
        arch.push_quadratic(&[(0.0, 0.0), (2.0, 6.0), (4.0, 0.0)].map(|(x, y)| Point::new(x, y)));
        let square = |min: f64, max: f64| [(min, min), (max, min), (max, max), (min, max)];
        let outer = region(&square(-9.0, 9.0), None);
        assert_ends(&cut(&outer, &arch), &[[(0.0, 0.0), (4.0, 0.0)]]);
        let inner = region(
            &[(-1.0, 2.25), (3.0, 2.25), (3.0, 9.0), (-1.0, 9.0)],
            Some(&outer),
        );
        assert_ends(&cut(&inner, &arch), &[[(1.0, 2.25), (3.0, 2.25)]]);
        let apart = region(&square(20.0, 30.0), Some(&inner));
        assert_ends(&cut(&apart, &arch), &[]);
        let below = [(-9.0, -9.0), (9.0, -9.0), (9.0, 2.5), (-9.0, 2.5)];
        let again = region(&below, Some(&inner));
        let pieces = cut(&again, &arch);
        assert_eq!(pieces.len(), 2, "{pieces:?}");
        assert!((pieces[0].1.y - 2.5).abs() < 1e-9);
        let shows = |y: f64, mut work: u64| again.shows(Point::new(2.0, y), &mut work).ok();
        assert_eq!(
            [2.0, 2.4, 2.6].map(|y| shows(y, 12)),
            [false, true, false].map(Some)
        );
        assert!(shows(2.4, 11).is_none() && again.cut(&arch, &mut 3).is_err());
        let corners = polygon(&square(0.0, 1.0)).into_iter();
        assert!(ClipRegion::new(corners, false, None, &mut 3).is_err());
    }
}
