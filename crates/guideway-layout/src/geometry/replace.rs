//! Copies of some paths, and replacement of their curves by those of another geometry.

use std::ops::Range;

use guideway_spline::Point;
use rayon::prelude::*;

use super::buffers::{Points, elements_of, end_index};
use super::store::Geometry;
use crate::RunPoints;

/// Pairs of consecutive paths that one task compares.
const TASK_PAIRS: usize = 1 << 12;

impl Geometry {
    /// A copy of some paths, in the given order. All threads share the work.
    ///
    /// # Panics
    /// When a path is not below [`Self::path_count`].
    #[must_use]
    pub fn select(&self, paths: impl IntoIterator<Item = usize>) -> Self {
        let paths: Vec<usize> = paths.into_iter().collect();
        let mut selected = Self {
            path_ends: self.path_ends.as_ref().map(|_| Vec::new()),
            ..Self::default()
        };
        let mut end = 0;
        for &path in &paths {
            let runs = self.runs_of(&(path..path + 1));
            let lengths = runs.map(|run| self.points_of(&(run..run + 1)).len());
            selected.run_ends.extend(lengths.map(|len| {
                end += len;
                end_index(end)
            }));
            if let Some(path_ends) = &mut selected.path_ends {
                path_ends.push(selected.run_ends.len() as u32);
            }
        }
        selected.points = self.points.zeros_like(end);
        let all: Vec<u32> = (0..paths.len() as u32).collect();
        selected.copy_points(&all, self, &|path| paths[path]);
        selected
    }

    /// No paths, in the same precision.
    fn empty_like(&self) -> Self {
        Self {
            points: self.points.empty_like(),
            ..Self::default()
        }
    }

    /// Appends consecutive paths of another geometry, in the precision of this one.
    fn append(&mut self, other: &Self, paths: Range<usize>) {
        let runs = other.runs_of(&paths);
        let range = other.points_of(&runs);
        let (base, first_run) = (self.points.len(), self.run_ends.len());
        if other.path_ends.is_some() {
            self.ensure_path_ends();
        }
        match (&mut self.points, &other.points) {
            (Points::F64(to), Points::F64(from)) => to.extend_from_slice(&from[range.clone()]),
            (Points::F32(to), Points::F32(from)) => to.extend_from_slice(&from[range.clone()]),
            (Points::F64(to), Points::F32(from)) => {
                to.extend(from[range.clone()].iter().map(|p| p.to_f64()));
            }
            (Points::F32(to), Points::F64(from)) => {
                to.extend(from[range.clone()].iter().map(|p| p.to_f32()));
            }
        }
        let ends = other.run_ends[runs.clone()]
            .iter()
            .map(|&end| end as usize - range.start + base);
        self.run_ends.extend(ends.map(end_index));
        if let Some(path_ends) = &mut self.path_ends {
            let ends = paths.map(|path| other.runs_of(&(path..path + 1)).end);
            path_ends.extend(ends.map(|end| end_index(end - runs.start + first_run)));
        }
    }

    /// Replaces the curve of `paths[i]` by curve `i` of `with`, in the precision of this geometry.
    /// If a path occurs twice, its last curve counts.
    ///
    /// Cost: O(points of `paths`) if no run changes its length, by all threads where rows ascend;
    /// otherwise O(points of all paths).
    ///
    /// # Panics
    /// When `with` has fewer curves than `paths` has elements, a path is not below
    /// [`Self::path_count`], or the result exceeds 2^32 control points.
    pub fn replace_all(&mut self, paths: &[u32], with: &Self) {
        let fits =
            |(from, &path): (usize, &u32)| self.has_run_lengths_of(path as usize, with, from);
        let all_fit = match paths.len() {
            0..=TASK_PAIRS => paths.iter().enumerate().all(fits),
            _ => {
                let pairs = paths.par_iter().enumerate();
                pairs.with_min_len(TASK_PAIRS).all(fits)
            }
        };
        if all_fit {
            return self.copy_points(paths, with, &|path| path);
        }
        self.hulls.take();
        if let [path] = *paths {
            return self.splice(path as usize, with);
        }
        // A curve of another length shifts all points behind it, so rebuild the buffers once.
        let mut sources: Vec<Option<usize>> = vec![None; self.path_count()];
        for (&path, from) in paths.iter().zip(0..) {
            sources[path as usize] = Some(from);
        }
        let mut all = self.empty_like();
        for (path, source) in sources.into_iter().enumerate() {
            match source {
                Some(from) => all.append(with, from..from + 1),
                None => all.append(self, path..path + 1),
            }
        }
        *self = all;
    }

    /// Returns `true` if a path has the same numbers of runs and points as one of another geometry.
    fn has_run_lengths_of(&self, path: usize, with: &Self, other: usize) -> bool {
        let own = self.runs_of(&(path..path + 1));
        let others = with.runs_of(&(other..other + 1));
        has_lengths_of((&self.run_ends, &own), (&with.run_ends, &others))
    }

    /// Overwrites the points of `paths[i]` by those of curve `curve_of(i)` of `with`, whose runs
    /// have the same lengths.
    fn copy_points(
        &mut self,
        paths: &[u32],
        with: &Self,
        curve_of: &(impl Fn(usize) -> usize + Sync),
    ) {
        let from = |index: usize| {
            let curve = curve_of(index);
            with.points_of(&with.runs_of(&(curve..curve + 1)))
        };
        match &with.points {
            Points::F64(points) => self.visit_paths(
                paths,
                &|to, index| copy(to, &points[from(index)], |p| p),
                &|to, index| copy(to, &points[from(index)], Point::to_f32),
            ),
            Points::F32(points) => self.visit_paths(
                paths,
                &|to, index| copy(to, &points[from(index)], Point::to_f64),
                &|to, index| copy(to, &points[from(index)], |p| p),
            ),
        }
    }

    /// Replaces the curve of a path by the first one of `with`, and shifts the paths behind it.
    fn splice(&mut self, path: usize, with: &Self) {
        let runs = self.runs_of(&(path..path + 1));
        let range = self.points_of(&runs);
        let new_points = || with.runs(0).flat_map(RunPoints::iter);
        let new_lens = with.runs(0).map(|run| run.len());
        let old_len = self.points.len();
        match &mut self.points {
            Points::F64(points) => drop(points.splice(range.clone(), new_points())),
            Points::F32(points) => {
                drop(points.splice(range.clone(), new_points().map(Point::to_f32)));
            }
        }
        if new_lens.len() != runs.len() {
            self.ensure_path_ends();
        }
        let new_len = self.points.len();
        let mut end = range.start;
        let new_ends: Vec<u32> = new_lens
            .map(|len| {
                end += len;
                end_index(end)
            })
            .collect();
        for end in &mut self.run_ends[runs.end..] {
            *end = end_index(*end as usize + new_len - old_len);
        }
        let new_runs = new_ends.len();
        let shifted = self.path_ends.iter_mut().flat_map(|ends| &mut ends[path..]);
        for end in shifted {
            *end = end_index(*end as usize + new_runs - runs.len());
        }
        self.run_ends.splice(runs, new_ends);
    }
}

/// Copies converted points to a slice of the same length.
fn copy<A: Copy, B>(to: &mut [B], from: &[A], convert: impl Fn(A) -> B) {
    let pairs = to.iter_mut().zip(from);
    pairs.for_each(|(to, from)| *to = convert(*from));
}

/// Returns `true` if consecutive groups of one list of ends have the same lengths as groups of
/// another.
fn has_lengths_of(
    (ends, own): (&[u32], &Range<usize>),
    (other_ends, others): (&[u32], &Range<usize>),
) -> bool {
    let [first, other_first] =
        [(ends, own), (other_ends, others)].map(|(ends, of)| elements_of(ends, of).start as u32);
    let mut pairs = ends[own.clone()].iter().zip(&other_ends[others.clone()]);
    own.len() == others.len() && pairs.all(|(end, other)| end - first == other - other_first)
}
