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
    let (mut before, mut after) = (Runs::default(), Runs::default());
    for (number, run) in runs.iter().enumerate() {
        if number < at.run {
            before.push(run);
        } else if number > at.run {
            after.push(run);
        } else {
            cut_run(run, at, &mut before, &mut after)?;
        }
    }
    (has_length(before.points()) && has_length(after.points())).then_some([before, after])
}

/// Returns `true` if the points are not all at one place.
fn has_length(points: &[Point<f64>]) -> bool {
    points
        .iter()
        .any(|point| point.distance(points[0]) > SAME_M)
}

fn cut_run(run: &[Point<f64>], at: Parameter, before: &mut Runs, after: &mut Runs) -> Option<()> {
    let segment: &[Point<f64>; 4] = run.get(at.segment..)?.first_chunk()?;
    let halves = split(&uniform::to_bezier(segment), at.t.clamp(0.0, 1.0));
    let [has_first, has_second] = [0, 1].map(|side| has_length(&halves[side]));
    // A part without length leaves its segment whole on the other side.
    let whole_before = at.segment + usize::from(!has_second);
    let whole_after = at.segment + usize::from(has_first || !has_second);
    if whole_before > 0 {
        before.push(&run[..whole_before + 3]);
    }
    if has_first && has_second {
        before.push(&uniform::from_bezier(&halves[0]));
        after.push(&uniform::from_bezier(&halves[1]));
    }
    if run.len() >= whole_after + 4 {
        after.push(&run[whole_after..]);
    }
    Some(())
}
