//! Visits the points of some paths, and their hulls, by all threads.

use std::ops::Range;

use guideway_spline::mem::prefetch;
use guideway_spline::{Bounds, Point, Real};

use super::hulls::hull_of;
use crate::row_visits::rows_ascend;

/// Paths that one task visits: some 100 kB of points.
const TASK_PATHS: usize = 1 << 10;
/// Paths that a task prefetches ahead: rows of an edit may be far apart in memory.
const AHEAD: usize = 8;

/// Points of consecutive paths, with their hulls if these are known.
pub(super) struct PathPoints<'a, T> {
    pub(super) first_path: usize,
    pub(super) first_point: usize,
    pub(super) points: &'a mut [Point<T>],
    pub(super) hulls: Option<&'a mut [Bounds<T>]>,
}

impl<'a, T> PathPoints<'a, T> {
    /// Those of all paths.
    pub(super) fn all(points: &'a mut [Point<T>], hulls: Option<&'a mut [Bounds<T>]>) -> Self {
        Self {
            first_path: 0,
            first_point: 0,
            points,
            hulls,
        }
    }
}

/// Calls a function for the points of each path: in parallel if there are many paths and they
/// ascend. `points_of` returns the range of the points of a path, `visit` receives the index of the
/// path in `paths`. Updates the hulls.
pub(super) fn for_each_path<T: Real>(
    of: PathPoints<'_, T>,
    paths: &[u32],
    points_of: &(impl Fn(usize) -> Range<usize> + Sync),
    visit: &(impl Fn(&mut [Point<T>], usize) + Sync),
) {
    let ascend = paths.len() > TASK_PATHS && rows_ascend(paths, &|path| *path);
    let task_paths = if ascend { TASK_PATHS } else { usize::MAX };
    let visitor = Visitor {
        task_paths,
        points_of,
        visit,
    };
    visitor.run(of, paths, 0);
}

struct Visitor<'a, P, V> {
    task_paths: usize,
    points_of: &'a P,
    visit: &'a V,
}

impl<P: Fn(usize) -> Range<usize> + Sync, V> Visitor<'_, P, V> {
    /// Visits paths, of which the first has the index `first`.
    fn run<T: Real>(&self, of: PathPoints<'_, T>, paths: &[u32], first: usize)
    where
        V: Fn(&mut [Point<T>], usize) + Sync,
    {
        if paths.len() <= self.task_paths {
            return self.visit_each(of, paths, first);
        }
        let (left, right) = paths.split_at(paths.len() / 2);
        let path = right[0] as usize;
        let point = (self.points_of)(path).start;
        let (left_points, right_points) = of.points.split_at_mut(point - of.first_point);
        let (left_hulls, right_hulls) = match of.hulls {
            Some(hulls) => {
                let (left, right) = hulls.split_at_mut(path - of.first_path);
                (Some(left), Some(right))
            }
            None => (None, None),
        };
        let left_of = PathPoints {
            points: left_points,
            hulls: left_hulls,
            ..of
        };
        let right_of = PathPoints {
            first_path: path,
            first_point: point,
            points: right_points,
            hulls: right_hulls,
        };
        let second = first + left.len();
        rayon::join(
            || self.run(left_of, left, first),
            || self.run(right_of, right, second),
        );
    }

    fn visit_each<T: Real>(&self, mut of: PathPoints<'_, T>, paths: &[u32], first: usize)
    where
        V: Fn(&mut [Point<T>], usize) + Sync,
    {
        let range_of = |path: u32| {
            let Range { start, end } = (self.points_of)(path as usize);
            start - of.first_point..end - of.first_point
        };
        for (number, &path) in paths.iter().enumerate() {
            if let Some(&ahead) = paths.get(number + AHEAD) {
                prefetch(&of.points[range_of(ahead)]);
            }
            let points = &mut of.points[range_of(path)];
            (self.visit)(points, first + number);
            if let Some(hulls) = &mut of.hulls {
                hulls[path as usize - of.first_path] = hull_of(points);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Visits paths of three points each, and returns all points.
    fn visited(paths: &[u32], count: usize) -> (Vec<Point<f64>>, Vec<Bounds<f64>>) {
        let mut points = vec![Point::new(-1.0, -1.0); 3 * count];
        let mut hulls = vec![hull_of(&[]); count];
        let of = PathPoints::all(&mut points, Some(&mut hulls));
        let points_of = |path: usize| 3 * path..3 * path + 3;
        for_each_path(of, paths, &points_of, &|points, index| {
            points.fill(Point::new(index as f64, 0.0));
        });
        (points, hulls)
    }

    #[test]
    fn visits_many_paths_in_order_and_few_in_any_order() {
        let count = 3 * 5 * TASK_PATHS;
        let every_third: Vec<u32> = (0..count as u32).step_by(3).collect();
        let (points, hulls) = visited(&every_third, count);
        for (path, points) in points.chunks(3).enumerate() {
            let at = match path % 3 {
                0 => Point::new((path / 3) as f64, 0.0),
                _ => Point::new(-1.0, -1.0),
            };
            assert_eq!(points, [at; 3], "{path}");
            let is_known = hulls[path] == Bounds { min: at, max: at };
            assert_eq!(is_known, path % 3 == 0, "{path}");
        }
        // The last visit of a path counts.
        let (points, _) = visited(&[4, 0, 4], 5);
        let at = [0, 4].map(|path| points[3 * path].x);
        assert_eq!(at, [1.0, 2.0]);
    }
}
