//! Cuts of curves, exactly: whole segments keep their control points, and the segment that is cut
//! becomes two by de Casteljau's algorithm.

use crate::bezier::{SAME_M, split};
use crate::{Nearest, Point, Runs, nearest_on_run, segment_length, uniform};

/// A parameter of a curve of runs.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub struct Parameter {
    /// Index of the run.
    pub run: usize,
    /// Index of the segment in the run.
    pub segment: usize,
    /// Parameter in the segment, 0 to 1.
    pub t: f64,
}

/// The point at a parameter; `None` if the curve has no such segment.
pub fn point_at(runs: &Runs, at: Parameter) -> Option<Point<f64>> {
    let segment = runs.iter().nth(at.run)?.array_windows().nth(at.segment)?;
    Some(uniform::point(segment, at.t))
}

/// The parameter of the point nearest to `query` within `tolerance`; `None` without runs.
pub fn nearest_parameter(
    runs: &Runs,
    query: Point<f64>,
    tolerance: f64,
) -> Option<(Parameter, Nearest)> {
    let of_run = |(run, points)| Some((run, nearest_on_run(points, query, tolerance)?));
    let all = runs.iter().enumerate().filter_map(of_run);
    let (run, nearest) = all.min_by(|a, b| a.1.distance.total_cmp(&b.1.distance))?;
    let (segment, t) = (nearest.segment, nearest.t);
    Some((Parameter { run, segment, t }, nearest))
}

/// The parameter at a length from the start, within `tolerance` of it; the end of the curve for a
/// greater length. `None` without runs.
pub fn parameter_at_length(runs: &Runs, length: f64, tolerance: f64) -> Option<Parameter> {
    let mut left = length;
    let mut end = None;
    for (run, points) in runs.iter().enumerate() {
        for (segment, control) in points.array_windows().enumerate() {
            let own = segment_length(control, tolerance);
            if own > left {
                let t = share_at_length(control, left, own, tolerance);
                return Some(Parameter { run, segment, t });
            }
            left -= own;
            end = Some(Parameter {
                run,
                segment,
                t: 1.0,
            });
        }
    }
    end
}

/// The parameter at a length of a segment, by bisection.
fn share_at_length(segment: &[Point<f64>; 4], length: f64, whole: f64, tolerance: f64) -> f64 {
    // Derived: 50 halvings of 1 are below the rounding error of t.
    const HALVINGS: u32 = 50;
    let bezier = uniform::to_bezier(segment);
    let (mut low, mut high) = (0.0, 1.0);
    let mut t = (length / whole).clamp(0.0, 1.0);
    for _ in 0..HALVINGS {
        let [before, _] = split(&bezier, t);
        let over = segment_length(&uniform::from_bezier(&before), tolerance) - length;
        if over.abs() <= tolerance {
            break;
        }
        if over > 0.0 {
            high = t;
        } else {
            low = t;
        }
        t = 0.5 * (low + high);
    }
    t
}

/// The parts of a curve before and after a parameter. `None` if one of them would have no length,
/// or the curve has no such segment.
pub fn cut(runs: &Runs, at: Parameter) -> Option<[Runs; 2]> {
    point_at(runs, at)?;
    let parts: [Runs; 2] = cut_all(runs, &[at]).try_into().ok()?;
    let has_length = |part: &Runs| !is_dot(part.points());
    parts.iter().all(has_length).then_some(parts)
}

/// The parts of a curve between parameters, which are in increasing order: one more part than
/// parameters. A part without length has no runs.
pub fn cut_all(runs: &Runs, at: &[Parameter]) -> Vec<Runs> {
    let mut cuts = at.iter().peekable();
    let mut parts = Vec::with_capacity(at.len() + 1);
    let mut part = Runs::default();
    for (run, points) in runs.iter().enumerate() {
        for (segment, control) in points.array_windows().enumerate() {
            let (mut done, mut is_whole) = (0.0, true);
            let mut rest = uniform::to_bezier(control);
            let is_here = |cut: &&Parameter| (cut.run, cut.segment) == (run, segment);
            while let Some(cut) = cuts.next_if(is_here) {
                // The parameter in the rest of the segment; NaN at its end.
                let t = ((cut.t - done) / (1.0 - done)).clamp(0.0, 1.0);
                let [before, after] = split(&rest, if t.is_nan() { 1.0 } else { t });
                if is_dot(&after) && is_whole {
                    part.push_segment(control);
                    (rest, is_whole, done) = (after, false, cut.t);
                } else if !is_dot(&before) {
                    part.push_bezier(&before);
                    (rest, is_whole, done) = (after, false, cut.t);
                }
                parts.push(std::mem::take(&mut part));
            }
            if is_whole {
                part.push_segment(control);
            } else if !is_dot(&rest) {
                part.push_bezier(&rest);
            }
        }
    }
    parts.push(part);
    parts.resize_with(at.len() + 1, Runs::default);
    parts
}

/// Returns `true` if all points are at one place.
fn is_dot(points: &[Point<f64>]) -> bool {
    points
        .iter()
        .all(|point| point.distance(points[0]) <= SAME_M)
}
