//! [`Geometry`]: the control runs of all paths; builds them, reads them, appends paths.

use std::ops::Range;
use std::sync::OnceLock;

use guideway_spline::mem::prefetch;
use guideway_spline::{Bounds, Point, Runs};

use super::buffers::{Points, consecutive, elements_of, end_index};
use super::hulls::Hulls;
use crate::RunPoints;

/// The control runs of all paths, in two flat buffers.
///
/// A path is a list of runs. A run of n control points (n >= 4) is a uniform cubic B-spline of
/// n - 3 segments. Coordinates are in meters, in the precision of the source: points of an `f32`
/// file take 8 bytes each and stay exact.
///
/// ```text
/// points     p0 p1 p2 p3 | p4 p5 p6 p7 p8 | p9 p10 p11 p12
/// run_ends             4                9               13
/// path_ends            1                                 3     path 0: run 0; path 1: runs 1, 2
/// ```
#[derive(Clone, Debug)]
pub struct Geometry {
    pub(super) points: Points,
    pub(super) run_ends: Vec<u32>,
    /// `None` while every path has exactly one run.
    pub(super) path_ends: Option<Vec<u32>>,
    /// Computed on the first request after a change.
    pub(super) hulls: OnceLock<Hulls>,
}

impl Default for Geometry {
    fn default() -> Self {
        Self {
            points: Points::F64(Vec::new()),
            run_ends: Vec::new(),
            path_ends: None,
            hulls: OnceLock::new(),
        }
    }
}

impl Geometry {
    /// Paths of one run each, from flat buffers: path `i` has the points up to `ends[i]`.
    ///
    /// # Panics
    /// When `ends` decreases, or does not end at the number of points.
    pub fn from_f32(points: Vec<Point<f32>>, ends: Vec<u32>) -> Self {
        Self::from_points(Points::F32(points), ends)
    }

    /// As [`Self::from_f32`], in `f64`.
    ///
    /// # Panics
    /// As [`Self::from_f32`].
    pub fn from_f64(points: Vec<Point<f64>>, ends: Vec<u32>) -> Self {
        Self::from_points(Points::F64(points), ends)
    }

    fn from_points(points: Points, ends: Vec<u32>) -> Self {
        assert!(ends.is_sorted() && ends.last().map_or(0, |&e| e as usize) == points.len());
        Self {
            points,
            run_ends: ends,
            ..Self::default()
        }
    }

    /// The same runs grouped to other paths: path `i` has the runs up to `path_ends[i]`.
    ///
    /// # Panics
    /// When `path_ends` decreases, or does not end at the number of runs.
    #[must_use]
    pub fn with_path_ends(self, path_ends: Vec<u32>) -> Self {
        let runs = path_ends.last().map_or(0, |&e| e as usize);
        assert!(path_ends.is_sorted() && runs == self.run_count());
        Self {
            path_ends: Some(path_ends),
            hulls: OnceLock::new(),
            ..self
        }
    }

    /// The same geometry with hulls that the caller has computed: see
    /// [`append_hulls`](super::append_hulls).
    ///
    /// # Panics
    /// When the numbers of hulls and paths differ.
    #[must_use]
    pub fn with_hulls(self, hulls: Hulls) -> Self {
        assert_eq!(hulls.len(), self.path_count());
        Self {
            hulls: hulls.into(),
            ..self
        }
    }

    /// Number of paths.
    pub fn path_count(&self) -> usize {
        self.path_ends.as_ref().map_or(self.run_count(), Vec::len)
    }

    /// Number of runs of all paths.
    pub fn run_count(&self) -> usize {
        self.run_ends.len()
    }

    /// Number of control points of all paths.
    pub fn point_count(&self) -> usize {
        self.points.len()
    }

    /// Number of cubic segments of all paths.
    pub fn segment_count(&self) -> usize {
        self.point_count() - 3 * self.run_count()
    }

    /// Appends a path. Converts an `f32` buffer to `f64` first, so that no digits get lost.
    pub fn push(&mut self, runs: &Runs) {
        self.hulls.take();
        if runs.len() != 1 {
            self.ensure_path_ends();
        }
        if let Points::F32(narrow) = &self.points {
            self.points = Points::F64(narrow.iter().map(|p| p.to_f64()).collect());
        }
        if let Points::F64(points) = &mut self.points {
            for run in runs.iter() {
                points.extend_from_slice(run);
                self.run_ends.push(end_index(points.len()));
            }
        }
        if let Some(path_ends) = &mut self.path_ends {
            path_ends.push(self.run_ends.len() as u32);
        }
    }

    /// Allows paths with any number of runs.
    pub(super) fn ensure_path_ends(&mut self) {
        let runs = self.run_count() as u32;
        self.path_ends.get_or_insert_with(|| (1..=runs).collect());
    }

    /// The runs of one path.
    ///
    /// # Panics
    /// When `path` is not below [`Self::path_count`].
    #[inline]
    pub fn runs(
        &self,
        path: usize,
    ) -> impl DoubleEndedIterator<Item = RunPoints<'_>> + ExactSizeIterator + Clone {
        self.runs_of(&(path..path + 1)).map(|run| self.run(run))
    }

    #[inline]
    fn run(&self, run: usize) -> RunPoints<'_> {
        self.points_in(self.points_of(&(run..run + 1)))
    }

    #[inline]
    fn points_in(&self, range: Range<usize>) -> RunPoints<'_> {
        match &self.points {
            Points::F64(p) => RunPoints::F64(&p[range]),
            Points::F32(p) => RunPoints::F32(&p[range]),
        }
    }

    /// Range of the runs of consecutive paths.
    #[inline]
    pub(super) fn runs_of(&self, paths: &Range<usize>) -> Range<usize> {
        match &self.path_ends {
            None => paths.clone(),
            Some(ends) => elements_of(ends, paths),
        }
    }

    /// Range of the points of consecutive runs.
    #[inline]
    pub(super) fn points_of(&self, runs: &Range<usize>) -> Range<usize> {
        elements_of(&self.run_ends, runs)
    }

    /// Box of all control points of some paths, which contains their curves; `None` if they have no
    /// points. Fastest for rows in order.
    ///
    /// # Panics
    /// When a path is not below [`Self::path_count`].
    pub fn hull_bounds(&self, paths: impl IntoIterator<Item = usize>) -> Option<Bounds<f64>> {
        let points = |rows| self.points_in(self.points_of(&self.runs_of(&rows)));
        consecutive(paths)
            .filter_map(|rows| points(rows).bounds())
            .reduce(Bounds::union)
    }

    /// Box of all control points; `None` if there are none. Known hulls are fewer numbers to read.
    pub fn bounds(&self) -> Option<Bounds<f64>> {
        match self.known_hulls() {
            Some(hulls) => hulls.all(),
            None => self.hull_bounds(0..self.path_count()),
        }
    }

    /// Hulls of all paths. The first call after a change reads all points once, on all threads;
    /// later calls return the same hulls.
    pub fn hulls(&self) -> &Hulls {
        let points_of = |path| self.points_of(&self.runs_of(&(path..path + 1)));
        self.hulls
            .get_or_init(|| Hulls::new(&self.points, self.path_count(), points_of))
    }

    /// The hulls, if no change has dropped them.
    pub fn known_hulls(&self) -> Option<&Hulls> {
        self.hulls.get()
    }

    /// Prefetches the control points of a path that will be read soon.
    ///
    /// # Panics
    /// When `path` is not below [`Self::path_count`].
    #[inline]
    pub fn prefetch(&self, path: usize) {
        match self.points_in(self.points_of(&self.runs_of(&(path..path + 1)))) {
            RunPoints::F64(points) => prefetch(points),
            RunPoints::F32(points) => prefetch(points),
        }
    }

    /// Heap bytes in use.
    pub fn heap_bytes(&self) -> usize {
        let hulls = self.hulls.get().map_or(0, Hulls::heap_bytes);
        let path_ends = self.path_ends.as_ref().map_or(0, Vec::capacity);
        let ends = self.run_ends.capacity() + path_ends;
        self.points.heap_bytes() + hulls + ends * size_of::<u32>()
    }
}
