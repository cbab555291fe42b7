//! Curves that change.

use std::ops::Range;

use guideway_spline::{Affine, Bounds, Point};
use rayon::prelude::*;

use super::{Geometry, Points, index, stretches};
use crate::RunPoints;
use crate::run_points::POINTS_AT_ONCE;

impl Geometry {
    /// Maps the curves of some paths, in the precision in which they are held. It costs least for rows in order.
    ///
    /// # Panics
    /// When one is not below [`Self::path_count`].
    pub fn transform(&mut self, paths: impl IntoIterator<Item = usize>, by: Affine) {
        for rows in stretches(paths) {
            let range = self.points_of(&self.runs_of(&rows));
            match &mut self.points {
                Points::F64(points) => set_each(&mut points[range], |p| by.apply(p)),
                Points::F32(points) => {
                    set_each(&mut points[range], |p| by.apply(p.to_f64()).to_f32());
                }
            }
        }
    }

    /// A box that holds whatever of a box [`Self::transform`] maps, as exactly as its corners: neither a map nor
    /// rounding changes the order of numbers but to turn it round.
    pub fn mapped_bounds(&self, bounds: Bounds<f64>, by: Affine) -> Bounds<f64> {
        let [first, corners @ ..] = bounds.corners().map(|corner| {
            let to = by.apply(corner);
            let as_held = match &self.points {
                Points::F64(_) => to,
                Points::F32(_) => to.to_f32().to_f64(),
            };
            Bounds {
                min: as_held,
                max: as_held,
            }
        });
        corners.into_iter().fold(first, Bounds::union)
    }

    /// Farthest from where a map takes them that points in a box are held, along an axis, in metres.
    pub fn rounding_m(&self, mapped: Bounds<f64>) -> f64 {
        let farthest = mapped.corners().map(|p| p.x.abs().max(p.y.abs()));
        let half_step = match &self.points {
            Points::F64(_) => f64::EPSILON / 2.0,
            Points::F32(_) => f64::from(f32::EPSILON) / 2.0,
        };
        farthest.into_iter().fold(0.0, f64::max) * half_step
    }

    /// Some paths, in this order. It costs least for rows in order.
    ///
    /// # Panics
    /// When one is not below [`Self::path_count`].
    #[must_use]
    pub fn select(&self, paths: impl IntoIterator<Item = usize>) -> Self {
        let mut some = self.none_of_its_kind();
        stretches(paths).for_each(|rows| some.append(self, rows));
        some
    }

    /// No paths, in the precision held here.
    fn none_of_its_kind(&self) -> Self {
        Self {
            points: match &self.points {
                Points::F64(_) => Points::F64(Vec::new()),
                Points::F32(_) => Points::F32(Vec::new()),
            },
            ..Self::default()
        }
    }

    /// Appends paths of another geometry, in the precision held here.
    fn append(&mut self, other: &Self, paths: Range<usize>) {
        let runs = other.runs_of(&paths);
        let range = other.points_of(&runs);
        let (base, first_run) = (self.points.len(), self.run_ends.len());
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
        self.run_ends.extend(ends.map(index));
        let ends = other.path_ends[paths]
            .iter()
            .map(|&end| end as usize - runs.start + first_run);
        self.path_ends.extend(ends.map(index));
    }

    /// Gives paths the curves of another geometry, one after the other, in the precision held here. It costs no
    /// more than their points if the numbers of points are those of before, else as much as all paths at most.
    ///
    /// # Panics
    /// When there are more `paths` than curves, one is not there, or there would be more than 2^32 control points.
    pub fn replace_all(&mut self, paths: &[u32], with: &Self) {
        let has_same_lens = |(&path, from): (&u32, usize)| {
            let old = self.runs(path as usize).map(|run| run.len());
            old.eq(with.runs(from).map(|run| run.len()))
        };
        // Each one of another length moves all that lies behind it.
        if paths.len() == 1 || paths.iter().zip(0..).all(has_same_lens) {
            for (&path, from) in paths.iter().zip(0..) {
                self.replace(path as usize, with, from);
            }
            return;
        }
        let mut sources: Vec<Option<usize>> = vec![None; self.path_count()];
        for (&path, from) in paths.iter().zip(0..) {
            sources[path as usize] = Some(from);
        }
        let mut all = self.none_of_its_kind();
        for (path, source) in sources.into_iter().enumerate() {
            match source {
                Some(from) => all.append(with, from..from + 1),
                None => all.append(self, path..path + 1),
            }
        }
        *self = all;
    }

    /// Gives a path the curve of a path of another geometry, in the precision held here. It costs no more
    /// than its points if the numbers of points are those of before, else as much as all paths behind it.
    ///
    /// # Panics
    /// When either path is not there, or there would be more than 2^32 control points.
    pub(super) fn replace(&mut self, path: usize, with: &Self, from: usize) {
        let runs = self.runs_of(&(path..path + 1));
        let range = self.points_of(&runs);
        let new_points = || with.runs(from).flat_map(RunPoints::iter);
        let new_lens = with.runs(from).map(|run| run.len());
        let is_alike = new_lens
            .clone()
            .eq(runs.clone().map(|run| self.run(run).len()));
        if is_alike {
            match &mut self.points {
                Points::F64(points) => set(&mut points[range], new_points()),
                Points::F32(points) => set(&mut points[range], new_points().map(Point::to_f32)),
            }
            return;
        }
        let old_len = self.points.len();
        match &mut self.points {
            Points::F64(points) => drop(points.splice(range.clone(), new_points())),
            Points::F32(points) => {
                drop(points.splice(range.clone(), new_points().map(Point::to_f32)));
            }
        }
        let new_len = self.points.len();
        let mut end = range.start;
        let new_ends: Vec<u32> = new_lens
            .map(|len| {
                end += len;
                index(end)
            })
            .collect();
        for end in &mut self.run_ends[runs.end..] {
            *end = index(*end as usize + new_len - old_len);
        }
        let new_runs = new_ends.len();
        for end in &mut self.path_ends[path..] {
            *end = index(*end as usize + new_runs - runs.len());
        }
        self.run_ends.splice(runs, new_ends);
    }
}

/// Gives each of some points another value by its own.
fn set_each<T: Copy + Send>(points: &mut [T], value: impl Fn(T) -> T + Sync) {
    let set = |points: &mut [T]| points.iter_mut().for_each(|p| *p = value(*p));
    if points.len() <= POINTS_AT_ONCE {
        set(points);
    } else {
        points.par_chunks_mut(POINTS_AT_ONCE).for_each(set);
    }
}

fn set<T>(old: &mut [T], new: impl Iterator<Item = T>) {
    old.iter_mut().zip(new).for_each(|(old, new)| *old = new);
}
