//! Trajectories of edges in LIF and VDA 5050 as text: the curve of the file where it is still that
//! of the path, else a clamped B-spline.

use guideway_layout::{Layout, PathRef, Value, WrittenCurve};
use guideway_spline::{Point, Runs, knots};

use crate::clamped::ClampedCurve;
use crate::json::{Field, Tree, push_number};
use crate::trajectory::{TRAJECTORY_COLUMN, Trajectory, runs_of};

/// Writes the trajectories of the paths of a layout.
#[derive(Clone, Copy)]
pub(crate) struct TrajectoryWriter<'a> {
    pub(crate) layout: &'a Layout,
    /// True if the format requires weights from 1 on.
    pub(crate) has_weights_from_1: bool,
    /// True for a layout read from the same format: its curves are written as they are, even where
    /// the schema forbids their knots or weights.
    pub(crate) is_as_written: bool,
}

impl<'a> TrajectoryWriter<'a> {
    /// Returns the trajectory of a path between two positions, or `None` for the straight line,
    /// which LIF implies.
    pub(crate) fn trajectory(
        self,
        path: PathRef<'a>,
        ends: [Point<f64>; 2],
        is_reverse: bool,
    ) -> Option<Tree<'a>> {
        if !is_reverse && let Some(text) = self.unchanged_text(path, ends) {
            return Some(Tree::Raw(text.into()));
        }
        let written = self.layout.paths.written_curve(path.row());
        let mut curve = match written.and_then(|written| self.for_format(written.clone())) {
            Some(written) => written,
            None => {
                let curve = ClampedCurve::from_path(path)?;
                let mut line = ends;
                if is_reverse {
                    line.reverse();
                }
                if curve.is_line_between(line) {
                    return None;
                }
                curve.into_written()
            }
        };
        if is_reverse {
            reverse(&mut curve);
        }
        Some(Tree::Raw(text(&curve).into()))
    }

    /// Returns the trajectory of the file that is more or less than a curve, if the path was not
    /// edited since.
    fn unchanged_text(self, path: PathRef<'a>, ends: [Point<f64>; 2]) -> Option<&'a str> {
        let column = self.layout.paths.attributes.get(TRAJECTORY_COLUMN)?;
        let (Value::Json(text), true) = (column.values.get(path.row())?, self.is_as_written) else {
            return None;
        };
        let Ok(Field::Value(trajectory)) = serde_json::from_str::<Field<Trajectory>>(text) else {
            return None;
        };
        let mut runs = runs_of(&trajectory);
        if runs.is_empty() {
            runs.push_line(ends[0], ends[1]);
        }
        let mut own = Runs::default();
        path.copy_runs(&mut own);
        (own == runs).then_some(text)
    }

    /// Returns a curve that the format can hold, with knots from 0 to 1 and, where it requires
    /// them, weights from 1 on. Scaled knots and weights define the same curve; `None` if no scale
    /// does, because a weight is 0.
    fn for_format(self, mut curve: WrittenCurve) -> Option<WrittenCurve> {
        if self.is_as_written {
            return Some(curve);
        }
        if curve.knots.is_empty() {
            curve.knots = knots::uniform_clamped(curve.degree as usize, curve.points_m.len());
        }
        if let (Some(&first), Some(&last)) = (curve.knots.first(), curve.knots.last())
            && (first, last) != (0.0, 1.0)
            && last > first
        {
            let knots = curve.knots.iter_mut();
            knots.for_each(|knot| *knot = (*knot - first) / (last - first));
        }
        if let (true, Some(weights)) = (self.has_weights_from_1, &mut curve.weights) {
            let least = weights.iter().copied().fold(f64::INFINITY, f64::min);
            if least < 1.0 {
                let raised = weights.iter_mut();
                raised.for_each(|weight| *weight = (*weight / least).max(1.0));
            }
            // That of a weight of 0, or of one that others exceed by far.
            if !weights.iter().all(|weight| weight.is_finite()) {
                return None;
            }
        }
        Some(curve)
    }

    /// Returns whether the format holds the curve of a path with other knots or weights.
    pub(crate) fn is_rewritten(self, path: usize) -> bool {
        let curve = self.layout.paths.written_curve(path);
        curve.is_some_and(|curve| self.for_format(curve.clone()).as_ref() != Some(curve))
    }
}

/// Reverses the direction of a curve.
fn reverse(curve: &mut WrittenCurve) {
    curve.points_m.reverse();
    curve.knots.reverse();
    if let (Some(&last), Some(&first)) = (curve.knots.first(), curve.knots.last()) {
        let knots = curve.knots.iter_mut();
        knots.for_each(|knot| *knot = first + (last - *knot));
    }
    if let Some(weights) = &mut curve.weights {
        weights.reverse();
    }
}

fn text(curve: &WrittenCurve) -> String {
    let mut out = Vec::with_capacity(40 + 24 * curve.knots.len() + 48 * curve.points_m.len());
    out.extend_from_slice(format!("{{\"degree\":{}", curve.degree).as_bytes());
    if !curve.knots.is_empty() {
        out.extend_from_slice(b",\"knotVector\":[");
        for (i, &knot) in curve.knots.iter().enumerate() {
            if i > 0 {
                out.push(b',');
            }
            push_number(knot, &mut out);
        }
        out.push(b']');
    }
    out.extend_from_slice(b",\"controlPoints\":[");
    for (i, point) in curve.points_m.iter().enumerate() {
        out.extend_from_slice(if i > 0 { b",{\"x\":" } else { b"{\"x\":" });
        push_number(point.x, &mut out);
        out.extend_from_slice(b",\"y\":");
        push_number(point.y, &mut out);
        if let Some(weights) = &curve.weights {
            out.extend_from_slice(b",\"weight\":");
            push_number(weights[i], &mut out);
        }
        out.push(b'}');
    }
    out.extend_from_slice(b"]}");
    String::from_utf8(out).unwrap_or_default()
}
