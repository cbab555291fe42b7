//! The trajectory of an edge, which LIF and VDA 5050 have in common: a NURBS curve if it is one, else
//! its control polygon.

use guideway_layout::Code;
use guideway_spline::{MAX_DEGREE, Point, Runs, polyline_to_runs};

use serde::de::{IgnoredAny, MapAccess};

use crate::ReadError;
use crate::builder::{Builder, PlaceFn};
use crate::json::{Field, FromJson, Key, items, record, within};
use crate::spline::Spline;

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

/// What a trajectory has once its fields are read.
struct Control {
    points: Vec<Point<f64>>,
    weights: Vec<f64>,
    /// Whether every point of the file is here.
    whole: bool,
}

impl Builder<'_> {
    /// Puts a trajectory into empty `runs`. They stay empty if it has fewer than two points.
    pub(crate) fn append_trajectory(
        &mut self,
        trajectory: &Trajectory,
        at: PlaceFn<'_>,
        runs: &mut Runs,
    ) -> Result<(), ReadError> {
        self.check_repeated(trajectory.repeated, at);
        let control = self.control(trajectory, at)?;
        let degree = self.degree(&trajectory.degree, at);
        let knots = self.knots(trajectory, at);
        match (degree, knots) {
            (Some(degree), Some(knots)) if control.whole => {
                let spline = Spline {
                    degree,
                    knots,
                    points: control.points,
                    weights: control.weights,
                };
                self.append_spline(&spline, at, runs);
            }
            // What is wrong has been said; without it there is no curve.
            _ => {
                polyline_to_runs(&control.points, runs);
            }
        }
        Ok(())
    }

    fn control(&mut self, trajectory: &Trajectory, at: PlaceFn<'_>) -> Result<Control, ReadError> {
        self.check_list(&trajectory.points, at, "controlPoints");
        if trajectory.points.get().is_none() {
            self.report_missing(&|| within(at, "controlPoints"), "a list of control points");
        }
        let knots = trajectory.knots.get().map_or(0, Vec::len);
        let points = trajectory.points.get().map_or(0, Vec::len);
        self.check_curve_points(points.max(knots))?;
        let mut control = Control {
            points: Vec::with_capacity(points),
            weights: Vec::with_capacity(points),
            whole: true,
        };
        for (i, field) in items(&trajectory.points) {
            let at_point: PlaceFn<'_> = &|| within(at, &format!("controlPoints[{i}]"));
            let point = self.record(field, at_point).and_then(|p| {
                self.check_repeated(p.repeated, at_point);
                Some((self.point(&p.x, &p.y, at_point)?, &p.weight))
            });
            match point {
                Some((point, weight)) => {
                    control.points.push(point);
                    control.weights.push(self.weight(weight, at_point));
                }
                None => control.whole = false,
            }
        }
        Ok(control)
    }

    fn weight(&mut self, field: &Field<f64>, at: PlaceFn<'_>) -> f64 {
        self.check_type(field, &|| within(at, "weight"), "a number");
        let weight = field.get().copied().unwrap_or(1.0);
        if weight.is_finite() && weight > 0.0 {
            return weight;
        }
        let message = || format!("the weight is {weight}");
        let remedy = "1 is used; give a number above 0";
        self.report(Code::BadWeight, at, message, remedy);
        1.0
    }

    fn degree(&mut self, field: &Field<f64>, at: PlaceFn<'_>) -> Option<usize> {
        self.check_type(field, &|| within(at, "degree"), "a number");
        // Both versions give 1 as the default.
        let degree = match field {
            Field::Absent => 1.0,
            other => other.get().copied().unwrap_or(f64::NAN),
        };
        let most = MAX_DEGREE.min(self.source.options.limits.degree);
        if degree.fract() == 0.0 && (1.0..=most as f64).contains(&degree) {
            return Some(degree as usize);
        }
        let message =
            || format!("the degree is {degree}, a whole number from 1 to {most} expected");
        let remedy = "The control polygon is drawn; correct the degree";
        self.report(Code::BadDegree, at, message, remedy);
        None
    }

    /// The knots there are; none if one of them is no number.
    fn knots(&mut self, trajectory: &Trajectory, at: PlaceFn<'_>) -> Option<Vec<f64>> {
        self.check_list(&trajectory.knots, at, "knotVector");
        items(&trajectory.knots)
            .map(|(i, knot)| self.number(knot, &|| within(at, &format!("knotVector[{i}]"))))
            .collect()
    }
}
