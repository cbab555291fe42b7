use std::ops::Range;
use std::sync::OnceLock;

use guideway_spline::mem::prefetch;
use guideway_spline::{Bounds, Point, Runs};

use crate::RunPoints;

mod edit;
mod hulls;
#[cfg(test)]
mod tests;

pub use hulls::{Hulls, add_boxes};

/// The control runs of all paths, in two flat buffers.
///
/// A path is a list of runs; a run of n control points (n >= 4) is a uniform cubic B-spline of n - 3
/// segments. Coordinates are meters. They are kept in the precision of the source: a file of `f32`
/// costs 8 bytes a point, and nothing is lost either way.
#[derive(Clone, Debug)]
pub struct Geometry {
    points: Points,
    run_ends: Vec<u32>,
    /// None while each run is a path.
    path_ends: Option<Vec<u32>>,
    /// Found when it is first asked for after a change.
    hulls: OnceLock<Hulls>,
}

#[derive(Clone, Debug)]
enum Points {
    F64(Vec<Point<f64>>),
    F32(Vec<Point<f32>>),
}

impl Points {
    fn len(&self) -> usize {
        match self {
            Self::F64(p) => p.len(),
            Self::F32(p) => p.len(),
        }
    }
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
    /// When `ends` falls, or does not end at the number of points.
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

    /// The same runs as other paths: path `i` has the runs up to `path_ends[i]`.
    ///
    /// # Panics
    /// When `path_ends` falls, or does not end at the number of runs.
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

    /// The same with boxes of its paths that whoever made it has found: see [`add_boxes`].
    ///
    /// # Panics
    /// When there are not as many as paths.
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

    /// Number of runs of all paths together.
    pub fn run_count(&self) -> usize {
        self.run_ends.len()
    }

    /// Number of control points of all paths together.
    pub fn point_count(&self) -> usize {
        self.points.len()
    }

    /// Number of cubic segments of all paths together.
    pub fn segment_count(&self) -> usize {
        self.point_count() - 3 * self.run_count()
    }

    /// Appends a path. Buffers of `f32` become `f64` first, so that nothing is lost.
    pub fn push(&mut self, runs: &Runs) {
        self.hulls.take();
        if runs.len() != 1 {
            self.tell_path_ends();
        }
        if let Points::F32(narrow) = &self.points {
            self.points = Points::F64(narrow.iter().map(|p| p.to_f64()).collect());
        }
        if let Points::F64(points) = &mut self.points {
            for run in runs.iter() {
                points.extend_from_slice(run);
                self.run_ends.push(index(points.len()));
            }
        }
        if let Some(path_ends) = &mut self.path_ends {
            path_ends.push(self.run_ends.len() as u32);
        }
    }

    /// From now on a path may have any number of runs.
    fn tell_path_ends(&mut self) {
        let runs = self.run_count() as u32;
        self.path_ends.get_or_insert_with(|| (1..=runs).collect());
    }

    /// The runs of one path.
    ///
    /// # Panics
    /// When `path` is not below [`Self::path_count`].
    #[inline]
    pub fn runs(&self, path: usize) -> impl ExactSizeIterator<Item = RunPoints<'_>> + Clone {
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

    #[inline]
    fn runs_of(&self, paths: &Range<usize>) -> Range<usize> {
        match &self.path_ends {
            None => paths.clone(),
            Some(ends) => between(ends, paths),
        }
    }

    #[inline]
    fn points_of(&self, runs: &Range<usize>) -> Range<usize> {
        between(&self.run_ends, runs)
    }

    /// Box of all control points of some paths, which holds their curves; none if there are none. It costs least for
    /// rows in order.
    ///
    /// # Panics
    /// When one is not below [`Self::path_count`].
    pub fn hull_bounds(&self, paths: impl IntoIterator<Item = usize>) -> Option<Bounds<f64>> {
        let points = |rows| self.points_in(self.points_of(&self.runs_of(&rows)));
        stretches(paths)
            .filter_map(|rows| points(rows).bounds())
            .reduce(Bounds::union)
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

    /// Heap bytes held.
    pub fn heap_bytes(&self) -> usize {
        let points = match &self.points {
            Points::F64(p) => p.capacity() * size_of::<Point<f64>>(),
            Points::F32(p) => p.capacity() * size_of::<Point<f32>>(),
        };
        let hulls = self.hulls.get().map_or(0, Hulls::heap_bytes);
        let path_ends = self.path_ends.as_ref().map_or(0, Vec::capacity);
        points + hulls + (self.run_ends.capacity() + path_ends) * size_of::<u32>()
    }
}

/// What lies between the ends of some neighbors in a list that begins at 0.
#[inline]
fn between(ends: &[u32], neighbors: &Range<usize>) -> Range<usize> {
    let end = |count: usize| count.checked_sub(1).map_or(0, |last| ends[last] as usize);
    end(neighbors.start)..end(neighbors.end)
}

/// Rows that follow each other, a stretch at a time.
fn stretches(rows: impl IntoIterator<Item = usize>) -> impl Iterator<Item = Range<usize>> {
    let mut rows = rows.into_iter().peekable();
    std::iter::from_fn(move || {
        let first = rows.next()?;
        let mut end = first + 1;
        while rows.next_if_eq(&end).is_some() {
            end += 1;
        }
        Some(first..end)
    })
}

fn index(at: usize) -> u32 {
    u32::try_from(at).expect("at most 2^32 control points")
}
