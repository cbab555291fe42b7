//! Curves that change.

use std::ops::Range;

use guideway_spline::mem::{CHUNK_LEN, prefetch_ahead, prefetched_chunks};
use guideway_spline::{Affine, Bounds, Point};
use rayon::prelude::*;

use super::{Geometry, Points, between, index, stretches};
use crate::RunPoints;
use crate::run_points::POINTS_AT_ONCE;

impl Geometry {
    /// Maps the curves of some paths, in the precision in which they are held. It costs least for rows in order.
    ///
    /// # Panics
    /// When one is not below [`Self::path_count`].
    pub fn transform(&mut self, paths: impl IntoIterator<Item = usize>, by: Affine) {
        self.hulls.take();
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

    /// The first path that has no curve, or a control point that is not finite or farther than so much from the origin along an
    /// axis.
    pub fn first_beyond(&self, reach_m: f64) -> Option<usize> {
        let is_within = |p: Point<f64>| (p.x.abs() <= reach_m) & (p.y.abs() <= reach_m);
        let is_placed = |run: RunPoints<'_>| match run {
            RunPoints::F64(points) => prefetched_chunks(points).flatten().all(|&p| is_within(p)),
            RunPoints::F32(points) => prefetched_chunks(points)
                .flatten()
                .all(|p| is_within(p.to_f64())),
        };
        let is_misplaced = |&path: &usize| {
            let mut runs = self.runs(path);
            runs.len() == 0 || !runs.all(is_placed)
        };
        (0..self.path_count())
            .into_par_iter()
            .find_first(is_misplaced)
    }

    /// Farthest from where a map takes them that points in a box are held, along an axis, in meters.
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
        if other.path_ends.is_some() {
            self.tell_path_ends();
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
        self.run_ends.extend(ends.map(index));
        if let Some(path_ends) = &mut self.path_ends {
            let ends = paths.map(|path| other.runs_of(&(path..path + 1)).end);
            path_ends.extend(ends.map(|end| index(end - runs.start + first_run)));
        }
    }

    /// Gives paths the curves of another geometry, one after the other, in the precision held here. It costs no
    /// more than their points if the numbers of points are those of before, least for rows in order; else as much as all
    /// paths at most.
    ///
    /// # Panics
    /// When there are more `paths` than curves, one is not there, or there would be more than 2^32 control points.
    pub fn replace_all(&mut self, paths: &[u32], with: &Self) {
        self.hulls.take();
        let mut done = 0;
        let pairs = stretches(paths.iter().map(|&path| path as usize)).map(|rows| {
            let from = done..done + rows.len();
            done = from.end;
            (rows, from)
        });
        let pairs: Vec<_> = pairs.collect();
        if pairs
            .iter()
            .all(|(rows, from)| self.is_alike(rows, with, from))
        {
            for (rows, from) in pairs {
                self.set_points(&rows, with, &from);
            }
            return;
        }
        if let [path] = *paths {
            return self.splice(path as usize, with);
        }
        // Each one of another length moves all that lies behind it.
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

    /// Whether some paths have runs of as many points as others.
    fn is_alike(&self, paths: &Range<usize>, with: &Self, others: &Range<usize>) -> bool {
        let (own, other) = (self.runs_of(paths), with.runs_of(others));
        let is_alike = match (&self.path_ends, &with.path_ends) {
            (None, None) => paths.len() == others.len(),
            _ => {
                let runs = |geometry: &Self, path| geometry.runs_of(&(path..path + 1)).len();
                let mut pairs = paths.clone().zip(others.clone());
                paths.len() == others.len() && pairs.all(|(a, b)| runs(self, a) == runs(with, b))
            }
        };
        is_alike && has_same_lens((&self.run_ends, &own), (&with.run_ends, &other))
    }

    /// Gives paths the points of others of as many.
    fn set_points(&mut self, paths: &Range<usize>, with: &Self, others: &Range<usize>) {
        let to = self.points_of(&self.runs_of(paths));
        let from = with.points_of(&with.runs_of(others));
        match (&mut self.points, &with.points) {
            (Points::F64(to_all), Points::F64(all)) => copy(&mut to_all[to], &all[from], |p| p),
            (Points::F32(to_all), Points::F32(all)) => copy(&mut to_all[to], &all[from], |p| p),
            (Points::F64(to_all), Points::F32(all)) => {
                copy(&mut to_all[to], &all[from], Point::to_f64);
            }
            (Points::F32(to_all), Points::F64(all)) => {
                copy(&mut to_all[to], &all[from], Point::to_f32);
            }
        }
    }

    /// Gives a path the first curve of another geometry, which moves all paths behind it.
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
            self.tell_path_ends();
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
        let behind = self.path_ends.iter_mut().flat_map(|ends| &mut ends[path..]);
        for end in behind {
            *end = index(*end as usize + new_runs - runs.len());
        }
        self.run_ends.splice(runs, new_ends);
    }
}

/// Gives each of some points another value by its own.
fn set_each<T: Copy + Send>(points: &mut [T], value: impl Fn(T) -> T + Sync) {
    let set = |points: &mut [T]| {
        for chunk in points.chunks_mut(CHUNK_LEN) {
            prefetch_ahead(chunk);
            chunk.iter_mut().for_each(|p| *p = value(*p));
        }
    };
    if points.len() <= POINTS_AT_ONCE {
        set(points);
    } else {
        points.par_chunks_mut(POINTS_AT_ONCE).for_each(set);
    }
}

/// Gives each of some points a value by one of as many others.
fn copy<A: Copy + Sync, B: Send>(to: &mut [B], from: &[A], value: impl Fn(A) -> B + Sync) {
    let set = |(to, from): (&mut [B], &[A])| {
        for (to, from) in to.chunks_mut(CHUNK_LEN).zip(from.chunks(CHUNK_LEN)) {
            prefetch_ahead(to);
            prefetch_ahead(from);
            let pairs = to.iter_mut().zip(from);
            pairs.for_each(|(to, from)| *to = value(*from));
        }
    };
    if from.len() <= POINTS_AT_ONCE {
        set((to, from));
    } else {
        let chunks = to.par_chunks_mut(POINTS_AT_ONCE);
        chunks.zip(from.par_chunks(POINTS_AT_ONCE)).for_each(set);
    }
}

/// Whether some neighbors in a list of ends are as long as others in another, each.
fn has_same_lens(
    (ends, own): (&[u32], &Range<usize>),
    (other_ends, others): (&[u32], &Range<usize>),
) -> bool {
    let [first, other_first] =
        [(ends, own), (other_ends, others)].map(|(ends, of)| between(ends, of).start as u32);
    let mut pairs = ends[own.clone()].iter().zip(&other_ends[others.clone()]);
    own.len() == others.len() && pairs.all(|(end, other)| end - first == other - other_first)
}
