//! [`Side`]: a curve that leaves a corner, by one parameter along all of its segments.

use super::Parameter;
use crate::bezier::{SAME_M, start_direction, unit};
use crate::{Point, Runs, nearest_on_run, uniform};

/// A curve from a corner, in coordinates relative to the corner.
pub(super) struct Side {
    segments: Vec<[Point<f64>; 4]>,
    /// Run and segment of each one of them.
    numbers: Vec<(usize, usize)>,
}

impl Side {
    pub(super) fn new(runs: &Runs, corner: Point<f64>) -> Self {
        let of_run = |(run, points): (usize, &[Point<f64>])| {
            (0..points.len() - 3).map(move |segment| (run, segment))
        };
        Self {
            segments: runs.segments().map(|s| s.map(|p| p - corner)).collect(),
            numbers: runs.iter().enumerate().flat_map(of_run).collect(),
        }
    }

    /// The greatest parameter: the number of segments.
    pub(super) fn end(&self) -> f64 {
        self.segments.len() as f64
    }

    fn segment(&self, at: f64) -> (&[Point<f64>; 4], f64) {
        let index = (at.max(0.0) as usize).min(self.segments.len() - 1);
        (&self.segments[index], at - index as f64)
    }

    /// Number of the segment and parameter in it.
    pub(super) fn parameter(&self, at: f64) -> Parameter {
        let index = (at.max(0.0) as usize).min(self.segments.len() - 1);
        let (run, segment) = self.numbers[index];
        let t = at - index as f64;
        Parameter { run, segment, t }
    }

    pub(super) fn point(&self, at: f64) -> Point<f64> {
        let (segment, t) = self.segment(at);
        uniform::point(segment, t)
    }

    pub(super) fn derivative(&self, at: f64) -> Point<f64> {
        let (segment, t) = self.segment(at);
        uniform::derivative(segment, t)
    }

    /// Signed curvature; positive where the curve turns left.
    pub(super) fn curvature(&self, at: f64) -> f64 {
        let (segment, t) = self.segment(at);
        uniform::curvature(segment, t)
    }

    /// Unit direction away from the corner; `None` for a curve without length.
    pub(super) fn direction(&self, at: f64) -> Option<Point<f64>> {
        unit(self.derivative(at))
    }

    /// Unit direction in which the curve leaves the corner.
    pub(super) fn first_direction(&self) -> Option<Point<f64>> {
        start_direction(&uniform::to_bezier(self.segments.first()?))
    }

    /// Parameter of the nearest point, and its distance.
    pub(super) fn nearest(&self, to: Point<f64>) -> Option<(f64, f64)> {
        let of_segment = |(index, segment): (usize, &[Point<f64>; 4])| {
            let nearest = nearest_on_run(segment, to, 1e-3 * SAME_M)?;
            Some((index as f64 + nearest.t, nearest.distance))
        };
        let all = self.segments.iter().enumerate().filter_map(of_segment);
        all.min_by(|a, b| a.1.total_cmp(&b.1))
    }
}
