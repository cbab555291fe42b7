//! From control points, knots and weights to runs: a NURBS curve if they make one, else their polygon.

use guideway_layout::Code;
use guideway_spline::{Nurbs, Point, Runs, knots, nurbs_to_runs, polyline_to_runs};

use crate::builder::{Builder, POINT_BUDGET_EXCEEDED, PlaceFn};

/// Most control points of a curve that is approximated rather than converted exactly: each span can
/// become a thousand cubics, so a small file could ask for more than any machine has.
const MOST_APPROXIMATED: usize = 1_000;

/// The numbers of a curve, as a file has them.
pub(crate) struct Spline {
    pub(crate) degree: usize,
    /// Empty for evenly spaced clamped ones.
    pub(crate) knots: Vec<f64>,
    /// In meters, all finite.
    pub(crate) points: Vec<Point<f64>>,
    /// Empty for 1 each; otherwise as many as points, all finite and above zero.
    pub(crate) weights: Vec<f64>,
}

impl Builder<'_> {
    /// Puts a curve into empty `runs`, or its control polygon if the numbers make no curve. They stay empty
    /// if there are fewer than two points.
    pub(crate) fn append_spline(&mut self, spline: &Spline, at: PlaceFn<'_>, runs: &mut Runs) {
        if let Some(curve) = self.curve(spline, at) {
            if self.convert(&curve, at, runs) {
                return;
            }
            if curve.is_rational() {
                let message = || "the weights differ too much to compute with".to_owned();
                let remedy = "1 is used for all; give weights that are more alike";
                self.report(Code::BadWeight, at, message, remedy);
                let (degree, knots) = (curve.degree(), curve.knots().to_vec());
                let plain = Nurbs::new(degree, knots, spline.points.clone(), None);
                if plain.is_ok_and(|plain| self.convert(&plain, at, runs)) {
                    return;
                }
            }
            self.report_knots(at, || {
                "the knots are too close together to compute with".into()
            });
        }
        polyline_to_runs(&spline.points, runs);
    }

    /// Converts a curve; fails if numbers overflow on the way, and then leaves nothing.
    fn convert(&mut self, curve: &Nurbs, at: PlaceFn<'_>, runs: &mut Runs) -> bool {
        let tolerance = self.source.options.limits.conversion_tolerance_m;
        let done = nurbs_to_runs(curve, tolerance, runs);
        // What is exact is as large as in the file; what is not can be a thousand times as large.
        if !done.exact && !self.within_point_budget(runs) {
            let remedy = "The control polygon is drawn; split the file, or lower the degree";
            self.report(
                Code::ApproximateShape,
                at,
                || POINT_BUDGET_EXCEEDED.to_owned(),
                remedy,
            );
            runs.clear();
            polyline_to_runs(curve.points(), runs);
            return true;
        }
        let error = done.error_bound_m;
        if !runs.points().iter().all(|p| p.is_finite()) {
            runs.clear();
            return false;
        }
        if error > tolerance {
            let message =
                || format!("the curve is drawn within {error} m, not within {tolerance} m");
            let remedy = "Split the curve, or give weights that are more alike";
            self.report(Code::ApproximateShape, at, message, remedy);
        }
        true
    }

    fn curve(&mut self, spline: &Spline, at: PlaceFn<'_>) -> Option<Nurbs> {
        let (degree, count) = (spline.degree, spline.points.len());
        if count <= degree {
            let least = degree + 1;
            let message =
                || format!("{count} control points, a curve of degree {degree} needs {least}");
            let remedy = "Straight lines are drawn between those there are; lower the degree";
            self.report(Code::TooFewPoints, at, message, remedy);
            return None;
        }
        let knots = self.knots_of(spline, at)?;
        let rational = spline.weights.iter().any(|&w| w != spline.weights[0]);
        if count > MOST_APPROXIMATED && (rational || degree > 3) {
            let message = || {
                format!(
                    "{count} control points with weights or a degree above 3; {MOST_APPROXIMATED} at most"
                )
            };
            let remedy = "The control polygon is drawn; split the curve, or lower its degree";
            self.report(Code::ApproximateShape, at, message, remedy);
            return None;
        }
        let weights = rational.then(|| spline.weights.clone());
        match Nurbs::new(degree, knots, spline.points.clone(), weights) {
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

    /// The knots to compute with; none if there are too many or too few.
    fn knots_of(&mut self, spline: &Spline, at: PlaceFn<'_>) -> Option<Vec<f64>> {
        let (degree, points, values) = (spline.degree, spline.points.len(), &spline.knots);
        if values.is_empty() {
            let message = || "there are no knots".to_owned();
            let remedy = "Evenly spaced clamped knots are used";
            self.report(Code::MissingKnots, at, message, remedy);
            return Some(knots::uniform_clamped(degree, points));
        }
        let (count, expected) = (values.len(), points + degree + 1);
        if count == expected {
            return Some(values.clone());
        }
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
        None
    }

    /// Reports knots that are legal, and yet not what most curves have.
    fn check_shape(&mut self, curve: &Nurbs, at: PlaceFn<'_>) {
        let (degree, knots, points) = (curve.degree(), curve.knots(), curve.points().len());
        let clamped = knots[0] == knots[degree] && knots[points] == knots[points + degree];
        if !clamped {
            let message = || {
                "the first or last knots differ, so the curve does not begin and end at its outer points"
                    .to_owned()
            };
            let remedy = "It is drawn as written";
            self.report(Code::UnclampedKnots, at, message, remedy);
        }
        let inner = knots.get(degree + 1..points).unwrap_or_default();
        let broken = inner.windows(degree + 1).find(|w| w[0] == w[degree]);
        if let Some(window) = broken {
            let message = || format!("the knot {} is there more than {degree} times", window[0]);
            let remedy = "The curve is broken there; remove the knots that are too many";
            self.report(Code::KnotMultiplicity, at, message, remedy);
        }
    }

    fn report_knots(&mut self, at: PlaceFn<'_>, message: impl FnOnce() -> String) {
        let remedy = "The control polygon is drawn; correct the knots";
        self.report(Code::BadKnots, at, message, remedy);
    }
}
