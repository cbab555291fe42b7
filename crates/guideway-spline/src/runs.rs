//! [`Runs`]: a curve as a list of uniform cubic B-spline runs, built from lines, segments or
//! Beziers.

use crate::{Point, uniform};

/// The curve of one path: a list of runs of uniform cubic control points.
///
/// Each run has at least four points. Consecutive runs usually meet end to end, but need not.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Runs {
    points: Vec<Point<f64>>,
    ends: Vec<usize>,
}

impl Runs {
    /// No runs.
    pub const EMPTY: Self = Self {
        points: Vec::new(),
        ends: Vec::new(),
    };

    /// Appends a run.
    ///
    /// # Panics
    /// When the run has fewer than four points.
    pub fn push(&mut self, run: &[Point<f64>]) {
        assert!(
            run.len() >= 4,
            "a run has at least four control points, not {}",
            run.len()
        );
        self.points.extend_from_slice(run);
        self.ends.push(self.points.len());
    }

    /// Appends a straight line, exactly, as four evenly spaced control points.
    pub fn push_line(&mut self, start: Point<f64>, end: Point<f64>) {
        let step = end - start;
        self.push(&[start - step, start, end, end + step]);
    }

    /// Appends the straight lines between points, exactly.
    pub fn push_polyline(&mut self, points: &[Point<f64>]) {
        for &[start, end] in points.array_windows() {
            let step = end - start;
            self.push_segment(&[start - step, start, end, end + step]);
        }
    }

    /// Appends one segment. If its first three points equal the last three of the last run, it
    /// extends that run by one point, which draws the same with a quarter of the memory.
    pub fn push_segment(&mut self, segment: &[Point<f64>; 4]) {
        match self.ends.last_mut() {
            Some(end) if self.points.ends_with(&segment[..3]) => {
                self.points.push(segment[3]);
                *end += 1;
            }
            _ => self.push(segment),
        }
    }

    /// Appends a cubic Bezier curve, exactly.
    pub fn push_bezier(&mut self, bezier: &[Point<f64>; 4]) {
        self.push_segment(&uniform::from_bezier(bezier));
    }

    /// Appends a quadratic Bezier curve, exactly.
    pub fn push_quadratic(&mut self, bezier: &[Point<f64>; 3]) {
        // Degree elevation: Piegl & Tiller, The NURBS Book, section 5.5.
        let [start, middle, end] = *bezier;
        let two_thirds = 2.0 / 3.0;
        self.push_bezier(&[
            start,
            start.lerp(middle, two_thirds),
            end.lerp(middle, two_thirds),
            end,
        ]);
    }

    /// The control points of each run, in order.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = &[Point<f64>]> {
        (0..self.ends.len()).map(|i| {
            let start = if i == 0 { 0 } else { self.ends[i - 1] };
            &self.points[start..self.ends[i]]
        })
    }

    /// All segments of all runs, in order.
    pub fn segments(&self) -> impl Iterator<Item = &[Point<f64>; 4]> {
        self.iter().flat_map(<[_]>::array_windows)
    }

    /// Start of the curve; `None` without runs.
    pub fn start(&self) -> Option<Point<f64>> {
        self.segments().next().map(uniform::start)
    }

    /// End of the curve; `None` without runs.
    pub fn end(&self) -> Option<Point<f64>> {
        self.points.last_chunk().map(uniform::end)
    }

    /// The same curve from its end to its start.
    #[must_use]
    pub fn reversed(&self) -> Self {
        let points: Vec<_> = self.points.iter().rev().copied().collect();
        let starts = std::iter::once(0).chain(self.ends.iter().copied());
        // A run ends where it started before.
        let ends = starts
            .take(self.ends.len())
            .map(|start| points.len() - start);
        let mut ends: Vec<_> = ends.collect();
        ends.reverse();
        Self { points, ends }
    }

    /// Number of runs.
    pub fn len(&self) -> usize {
        self.ends.len()
    }

    /// Returns `true` if there are no runs.
    pub fn is_empty(&self) -> bool {
        self.ends.is_empty()
    }

    /// All control points of all runs.
    pub fn points(&self) -> &[Point<f64>] {
        &self.points
    }

    /// Removes all runs and keeps the buffers for the next curve.
    pub fn clear(&mut self) {
        self.points.clear();
        self.ends.clear();
    }
}
