//! Trajectories of edges in LIF and VDA 5050: converts the NURBS record of either format to runs,
//! or to the control polygon if it defines no curve.

use guideway_layout::{Code, Place, Value, WrittenCurve};
use guideway_spline::{MAX_DEGREE, Point, Runs, polyline_to_runs};

use serde::de::{IgnoredAny, MapAccess};

use crate::ReadError;
use crate::builder::{Builder, PlaceFn, Table};
use crate::clamped::is_rewritten_as;
use crate::json::{Field, FromJson, Key, field_place, items, push_compact, record};
use crate::source::{ReadOptions, Source};
use crate::spline::Spline;

/// Column of a trajectory that defines no curve, or that holds more than a curve, as written.
pub(crate) const TRAJECTORY_COLUMN: &str = "trajectory";

record! { Trajectory {
    degree: f64 = "degree",
    knots: Vec<Field<f64>> = "knotVector",
    points: Vec<Field<ControlPoint>> = "controlPoints",
} }

record! { ControlPoint {
    x: f64 = "x",
    y: f64 = "y",
    weight: f64 = "weight",
} }

/// A trajectory as read, beside the runs that draw it.
pub(crate) struct ReadCurve {
    /// The curve that the file states; `None` if its numbers define none.
    pub(crate) written: Option<WrittenCurve>,
    /// True if the trajectory has more than the numbers of a curve, or wrong ones.
    pub(crate) is_odd: bool,
}

/// Checked control points and weights of a trajectory.
struct ControlPolygon {
    points: Vec<Point<f64>>,
    weights: Vec<f64>,
    /// True if all points of the file are valid.
    is_complete: bool,
}

impl Trajectory {
    /// Returns whether it has members or types that the format does not define, or a weight that
    /// is none.
    pub(crate) fn is_odd(&self) -> bool {
        let is_plain = |field: &Field<f64>| field.wrong_type().is_none();
        let is_weight = |field: &Field<f64>| field.get().is_none_or(|&w| w.is_finite() && w >= 0.0);
        let mut knots = items(&self.knots).map(|(_, knot)| knot);
        let mut points = items(&self.points).filter_map(|(_, point)| point.get());
        self.has_other
            || self.repeated.is_some()
            || self.knots.wrong_type().is_some()
            || !is_plain(&self.degree)
            || !knots.all(is_plain)
            || !points.all(|p| {
                let is_known = !p.has_other && p.repeated.is_none();
                is_known
                    && [&p.x, &p.y, &p.weight].into_iter().all(is_plain)
                    && is_weight(&p.weight)
            })
    }
}

/// Returns the runs that draw a trajectory, as a read of it does.
pub(crate) fn runs_of(trajectory: &Trajectory) -> Runs {
    let options = ReadOptions::default();
    let source = Source {
        name: "",
        options: &options,
    };
    let mut runs = Runs::default();
    let at: PlaceFn<'_> = &|| Place::element("trajectory");
    let read = Builder::new(source, usize::MAX >> 8).append_trajectory(trajectory, at, &mut runs);
    if read.is_err() {
        runs.clear();
    }
    runs
}

impl Builder<'_> {
    /// Appends a trajectory to empty `runs`. They stay empty for fewer than two points.
    pub(crate) fn append_trajectory(
        &mut self,
        trajectory: &Trajectory,
        at: PlaceFn<'_>,
        runs: &mut Runs,
    ) -> Result<ReadCurve, ReadError> {
        self.check_repeated(trajectory.repeated, at);
        let control = self.control_polygon(trajectory, at)?;
        let degree = self.degree(&trajectory.degree, at);
        let knots = self.knots(trajectory, at);
        let mut curve = ReadCurve {
            written: None,
            is_odd: trajectory.is_odd(),
        };
        match (degree, knots) {
            (Some(degree), Some(knots)) if control.is_complete => {
                let spline = Spline {
                    degree,
                    knots,
                    points: control.points,
                    weights: control.weights,
                };
                if self.append_spline(&spline, at, runs) {
                    curve.written = Some(spline.into_written());
                }
            }
            // A diagnostic reports the invalid part; without it there is no curve.
            _ => {
                polyline_to_runs(&control.points, runs);
            }
        }
        curve.is_odd |= curve.written.is_none();
        Ok(curve)
    }

    /// Keeps the curve of the file where the writer would write another one, and the text of a
    /// trajectory that is more or less than a curve. `ends` are the positions of the nodes.
    pub(crate) fn keep_written_curve<'t>(
        &mut self,
        row: usize,
        read: ReadCurve,
        ends: Option<[Point<f64>; 2]>,
        text: impl FnOnce() -> Option<&'t str>,
    ) -> Result<(), ReadError> {
        if let Some(written) = read.written {
            let paths = &mut self.layout.paths;
            if !is_rewritten_as(paths.get(row), ends, &written) {
                paths.set_written_curve(row, written);
            }
        }
        let text = if read.is_odd { text() } else { None };
        let Some(text) = text else {
            return Ok(());
        };
        let mut compact = String::new();
        push_compact(text, &mut compact);
        let value = Value::Json(&compact);
        self.set(Table::Paths, row, TRAJECTORY_COLUMN, value)
    }

    fn control_polygon(
        &mut self,
        trajectory: &Trajectory,
        at: PlaceFn<'_>,
    ) -> Result<ControlPolygon, ReadError> {
        self.check_array(&trajectory.points, at, "controlPoints");
        if trajectory.points.get().is_none() {
            self.report_missing(
                &|| field_place(at, "controlPoints"),
                "an array of control points",
            );
        }
        let knots = trajectory.knots.get().map_or(0, Vec::len);
        let points = trajectory.points.get().map_or(0, Vec::len);
        self.check_curve_points(points.max(knots))?;
        let mut control = ControlPolygon {
            points: Vec::with_capacity(points),
            weights: Vec::with_capacity(points),
            is_complete: true,
        };
        for (i, field) in items(&trajectory.points) {
            let at_point: PlaceFn<'_> = &|| field_place(at, &format!("controlPoints[{i}]"));
            let point = self.record(field, at_point).and_then(|p| {
                self.check_repeated(p.repeated, at_point);
                Some((self.point(&p.x, &p.y, at_point)?, &p.weight))
            });
            match point {
                Some((point, weight)) => {
                    control.points.push(point);
                    control.weights.push(self.weight(weight, at_point));
                }
                None => control.is_complete = false,
            }
        }
        Ok(control)
    }

    fn weight(&mut self, field: &Field<f64>, at: PlaceFn<'_>) -> f64 {
        self.check_type(field, &|| field_place(at, "weight"), "a number");
        let weight = field.get().copied().unwrap_or(1.0);
        if weight.is_finite() && weight >= 0.0 {
            return weight;
        }
        let message = || format!("the weight is {weight}");
        let remedy = "Weight 1 is used; give a number from 0 on";
        self.report(Code::BadWeight, at, message, remedy);
        1.0
    }

    fn degree(&mut self, field: &Field<f64>, at: PlaceFn<'_>) -> Option<usize> {
        self.check_type(field, &|| field_place(at, "degree"), "a number");
        // The default of both formats.
        let degree = match field {
            Field::Absent => 1.0,
            other => other.get().copied().unwrap_or(f64::NAN),
        };
        let max_degree = MAX_DEGREE.min(self.source.options.limits.degree);
        if degree.fract() == 0.0 && (1.0..=max_degree as f64).contains(&degree) {
            return Some(degree as usize);
        }
        let message =
            || format!("the degree is {degree}; expected an integer from 1 to {max_degree}");
        let remedy = "The control polygon is drawn; correct the degree";
        self.report(Code::BadDegree, at, message, remedy);
        None
    }

    /// Returns the knots, or `None` if one of them is not a number.
    fn knots(&mut self, trajectory: &Trajectory, at: PlaceFn<'_>) -> Option<Vec<f64>> {
        self.check_array(&trajectory.knots, at, "knotVector");
        items(&trajectory.knots)
            .map(|(i, knot)| self.number(knot, &|| field_place(at, &format!("knotVector[{i}]"))))
            .collect()
    }
}
