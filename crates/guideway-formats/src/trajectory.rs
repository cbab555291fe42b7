//! The trajectory of an edge, which LIF and VDA 5050 have in common: a NURBS curve if it is one, else
//! its control polygon.

use guideway_layout::Code;
use guideway_spline::{MAX_DEGREE, Nurbs, Point, Runs, knots, nurbs_to_runs, polyline_to_runs};

use serde::de::{IgnoredAny, MapAccess};

use crate::ReadError;
use crate::builder::{At, Builder};
use crate::json::{Field, FromJson, Key, items, record, within};

/// Most control points of a curve that is approximated rather than converted exactly: each span can
/// become a thousand cubics, so a small file could ask for more than any machine has.
const MOST_APPROXIMATED: usize = 1_000;

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
        at: At<'_>,
        runs: &mut Runs,
    ) -> Result<(), ReadError> {
        self.check_repeated(trajectory.repeated, at);
        let control = self.control(trajectory, at)?;
        let degree = self.degree(&trajectory.degree, at);
        let curve = degree.and_then(|degree| self.curve(degree, trajectory, &control, at));
        if let Some(curve) = curve {
            if self.convert(&curve, at, runs) {
                return Ok(());
            }
            if curve.is_rational() {
                let message = || "the weights differ too much to compute with".to_owned();
                let remedy = "1 is used for all; give weights that are more alike";
                self.find(Code::BadWeight, at, message, remedy);
                let (degree, knots) = (curve.degree(), curve.knots().to_vec());
                let plain = Nurbs::new(degree, knots, control.points.clone(), None);
                if plain.is_ok_and(|plain| self.convert(&plain, at, runs)) {
                    return Ok(());
                }
            }
            self.report_knots(at, || {
                "the knots are too close together to compute with".into()
            });
        }
        polyline_to_runs(&control.points, runs);
        Ok(())
    }

    /// Converts a curve; fails if numbers overflow on the way, and then leaves nothing.
    fn convert(&mut self, curve: &Nurbs, at: At<'_>, runs: &mut Runs) -> bool {
        let tolerance = self.source.options.limits.conversion_tolerance_m;
        let error = nurbs_to_runs(curve, tolerance, runs).error_bound_m;
        if !runs.points().iter().all(|p| p.is_finite()) {
            runs.clear();
            return false;
        }
        if error > tolerance {
            let message =
                || format!("the curve is drawn within {error} m, not within {tolerance} m");
            let remedy = "Split the curve, or give weights that are more alike";
            self.find(Code::ApproximateShape, at, message, remedy);
        }
        true
    }

    fn control(&mut self, trajectory: &Trajectory, at: At<'_>) -> Result<Control, ReadError> {
        let mut control = Control {
            points: Vec::new(),
            weights: Vec::new(),
            whole: true,
        };
        self.check_list(&trajectory.points, at, "controlPoints");
        if trajectory.points.get().is_none() {
            self.report_missing(&|| within(at, "controlPoints"), "a list of control points");
        }
        let knots = trajectory.knots.get().map_or(0, Vec::len);
        let points = trajectory.points.get().map_or(0, Vec::len);
        self.check_curve_points(points.max(knots))?;
        for (i, field) in items(&trajectory.points) {
            let at_point: At<'_> = &|| within(at, &format!("controlPoints[{i}]"));
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

    fn weight(&mut self, field: &Field<f64>, at: At<'_>) -> f64 {
        self.check_type(field, &|| within(at, "weight"), "a number");
        let weight = field.get().copied().unwrap_or(1.0);
        if weight.is_finite() && weight > 0.0 {
            return weight;
        }
        let message = || format!("the weight is {weight}");
        let remedy = "1 is used; give a number above 0";
        self.find(Code::BadWeight, at, message, remedy);
        1.0
    }

    fn degree(&mut self, field: &Field<f64>, at: At<'_>) -> Option<usize> {
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
        self.find(Code::BadDegree, at, message, remedy);
        None
    }

    fn curve(
        &mut self,
        degree: usize,
        trajectory: &Trajectory,
        control: &Control,
        at: At<'_>,
    ) -> Option<Nurbs> {
        let count = control.points.len();
        if !control.whole {
            // What is wrong with a point has been said; without it there is no curve.
            return None;
        }
        if count <= degree {
            let least = degree + 1;
            let message =
                || format!("{count} control points, a curve of degree {degree} needs {least}");
            let remedy = "Straight lines are drawn between those there are; lower the degree";
            self.find(Code::TooFewPoints, at, message, remedy);
            return None;
        }
        let knots = self.knots(degree, count, trajectory, at)?;
        let first = control.weights[0];
        let rational = control.weights.iter().any(|&w| w != first);
        if count > MOST_APPROXIMATED && (rational || degree > 3) {
            let message = || {
                format!(
                    "{count} control points with weights or a degree above 3; {MOST_APPROXIMATED} at most"
                )
            };
            let remedy = "The control polygon is drawn; split the curve, or lower its degree";
            self.find(Code::ApproximateShape, at, message, remedy);
            return None;
        }
        let weights = rational.then(|| control.weights.clone());
        match Nurbs::new(degree, knots, control.points.clone(), weights) {
            Ok(curve) => {
                self.check_shape(&curve, at);
                Some(curve)
            }
            Err(error) => {
                self.report_knots(at, || error.to_string());
                None
            }
        }
    }

    fn knots(
        &mut self,
        degree: usize,
        points: usize,
        trajectory: &Trajectory,
        at: At<'_>,
    ) -> Option<Vec<f64>> {
        self.check_list(&trajectory.knots, at, "knotVector");
        let mut values = Vec::new();
        for (i, knot) in items(&trajectory.knots) {
            values.push(self.number(knot, &|| within(at, &format!("knotVector[{i}]")))?);
        }
        if values.is_empty() {
            let message = || "there are no knots".to_owned();
            let remedy = "Evenly spaced clamped knots are used";
            self.find(Code::MissingKnots, at, message, remedy);
            return Some(knots::uniform_clamped(degree, points));
        }
        let (count, expected) = (values.len(), points + degree + 1);
        if count != expected {
            self.report_knots(at, || {
                let hint = match expected - count.min(expected) {
                    1 => "; perhaps `degree` holds the order, which is one more",
                    2 => "; perhaps the writer leaves out the first and the last knot",
                    _ => "",
                };
                format!(
                    "{count} knots; {points} control points of degree {degree} need {expected}{hint}"
                )
            });
            return None;
        }
        Some(values)
    }

    /// Reports knots that are legal, and yet not what most curves have.
    fn check_shape(&mut self, curve: &Nurbs, at: At<'_>) {
        let (degree, knots, points) = (curve.degree(), curve.knots(), curve.points().len());
        let clamped = knots[0] == knots[degree] && knots[points] == knots[points + degree];
        if !clamped {
            let message = || {
                "the first or last knots differ, so the curve does not begin and end at its outer points"
                    .to_owned()
            };
            let remedy = "It is drawn as written";
            self.find(Code::UnclampedKnots, at, message, remedy);
        }
        let inner = knots.get(degree + 1..points).unwrap_or_default();
        let broken = inner.windows(degree + 1).find(|w| w[0] == w[degree]);
        if let Some(window) = broken {
            let message = || format!("the knot {} is there more than {degree} times", window[0]);
            let remedy = "The curve is broken there; remove the knots that are too many";
            self.find(Code::KnotMultiplicity, at, message, remedy);
        }
    }

    fn report_knots(&mut self, at: At<'_>, message: impl FnOnce() -> String) {
        let remedy = "The control polygon is drawn; correct the knots";
        self.find(Code::BadKnots, at, message, remedy);
    }
}
