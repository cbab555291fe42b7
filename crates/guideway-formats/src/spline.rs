//! Spline conversion: converts degree, knots, control points and weights of a file to uniform cubic
//! runs, or to the control polygon if the numbers define no curve.

use guideway_layout::{Code, WrittenCurve};
use guideway_spline::{Nurbs, Point, Runs, knots, nurbs_to_runs, polyline_to_runs};

use crate::builder::{Builder, PlaceFn};

/// Largest number of control points of a curve that is approximated instead of converted exactly.
///
/// Derived: a span expands to at most a thousand cubics, so a curve to at most a million.
const MAX_APPROXIMATED_POINTS: usize = 1_000;

/// Definition of a curve, as stated in a file.
pub(crate) struct Spline {
    pub(crate) degree: usize,
    /// Empty for uniform clamped knots.
    pub(crate) knots: Vec<f64>,
    /// In meters, all finite.
    pub(crate) points: Vec<Point<f64>>,
    /// Empty if all are 1; otherwise one per point, all finite and above zero.
    pub(crate) weights: Vec<f64>,
}

impl Spline {
    /// The curve as its file wrote it; weights of 1 are the same as none.
    pub(crate) fn into_written(self) -> WrittenCurve {
        let is_weighted = self.weights.iter().any(|&weight| weight != 1.0);
        WrittenCurve {
            degree: self.degree as u32,
            knots: self.knots,
            points_m: self.points,
            weights: is_weighted.then_some(self.weights),
        }
    }
}

impl Builder<'_> {
    /// Appends a curve to empty `runs`, or its control polygon if the numbers define no curve. They
    /// stay empty for fewer than two points. Returns whether the numbers define the curve.
    pub(crate) fn append_spline(
        &mut self,
        spline: &Spline,
        at: PlaceFn<'_>,
        runs: &mut Runs,
    ) -> bool {
        if let Some(curve) = self.curve(spline, at) {
            if self.convert(&curve, at, runs) {
                return true;
            }
            if curve.is_rational() {
                let message = || "the weights differ too much for double precision".to_owned();
                let remedy = "Weight 1 is used for all points; use weights of similar size";
                self.report(Code::BadWeight, at, message, remedy);
                let (degree, knots) = (curve.degree(), curve.knots().to_vec());
                let plain = Nurbs::new(degree, knots, spline.points.clone(), None);
                if plain.is_ok_and(|plain| self.convert(&plain, at, runs)) {
                    return false;
                }
            }
            self.report_knots(at, || {
                "the knots are too close together for double precision".into()
            });
        }
        polyline_to_runs(&spline.points, runs);
        false
    }

    /// Converts a curve. Returns false, and leaves `runs` empty, if numbers overflow.
    fn convert(&mut self, curve: &Nurbs, at: PlaceFn<'_>, runs: &mut Runs) -> bool {
        let tolerance = self.source.options.limits.conversion_tolerance_m;
        let done = nurbs_to_runs(curve, tolerance, runs);
        // An exact conversion is as large as the curve in the file, an approximation up to 1,000
        // times.
        if !done.exact && !self.within_point_budget(runs) {
            let remedy = "The control polygon is drawn; split the file, or lower the degree";
            let detail = self.point_budget_exceeded();
            self.report(Code::ApproximateShape, at, || detail, remedy);
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
            let message = || {
                format!("the curve has an error of {error} m, above the tolerance of {tolerance} m")
            };
            let remedy = "Split the curve, or use weights of similar size";
            self.report(Code::ApproximateShape, at, message, remedy);
        }
        true
    }

    fn curve(&mut self, spline: &Spline, at: PlaceFn<'_>) -> Option<Nurbs> {
        let (degree, count) = (spline.degree, spline.points.len());
        if count <= degree {
            let needed = degree + 1;
            let message =
                || format!("{count} control points; a curve of degree {degree} needs {needed}");
            let remedy = "The control polygon is drawn; add control points, or lower the degree";
            self.report(Code::TooFewPoints, at, message, remedy);
            return None;
        }
        let knots = self.knots_of(spline, at)?;
        let rational = spline.weights.iter().any(|&w| w != spline.weights[0]);
        if count > MAX_APPROXIMATED_POINTS && (rational || degree > 3) {
            let message = || {
                format!(
                    "{count} control points with weights or a degree above 3; the limit is \
                     {MAX_APPROXIMATED_POINTS}"
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

    /// Returns the knots of a curve, or `None` if their number is wrong.
    fn knots_of(&mut self, spline: &Spline, at: PlaceFn<'_>) -> Option<Vec<f64>> {
        let (degree, points, values) = (spline.degree, spline.points.len(), &spline.knots);
        if values.is_empty() {
            let message = || "the knots are missing".to_owned();
            let remedy = "Uniform clamped knots are used";
            self.report(Code::MissingKnots, at, message, remedy);
            return Some(knots::uniform_clamped(degree, points));
        }
        let (count, expected) = (values.len(), points + degree + 1);
        if count == expected {
            return Some(values.clone());
        }
        self.report_knots(at, || {
            let hint = match expected - count.min(expected) {
                1 => "; perhaps `degree` is the order, which is degree + 1",
                2 => "; perhaps the writer leaves out the first and last knot",
                _ => "",
            };
            format!(
                "{count} knots; {points} control points of degree {degree} need {expected}{hint}"
            )
        });
        None
    }

    /// Reports knots that are legal but unusual: unclamped ends and breaks.
    fn check_shape(&mut self, curve: &Nurbs, at: PlaceFn<'_>) {
        let (degree, knots, points) = (curve.degree(), curve.knots(), curve.points().len());
        let clamped = knots[0] == knots[degree] && knots[points] == knots[points + degree];
        if !clamped {
            let message = || {
                "the knots are not clamped: the curve does not begin and end at its outer control \
                 points"
                    .to_owned()
            };
            let remedy = "The curve is drawn as stated; clamp the knots if this is not intended";
            self.report(Code::UnclampedKnots, at, message, remedy);
        }
        let inner = knots.get(degree + 1..points).unwrap_or_default();
        let broken = inner.windows(degree + 1).find(|w| w[0] == w[degree]);
        if let Some(window) = broken {
            let message = || format!("the knot {} occurs more than {degree} times", window[0]);
            let remedy = "The curve has a gap there; remove the surplus knots";
            self.report(Code::KnotMultiplicity, at, message, remedy);
        }
    }

    fn report_knots(&mut self, at: PlaceFn<'_>, message: impl FnOnce() -> String) {
        let remedy = "The control polygon is drawn; correct the knots";
        self.report(Code::BadKnots, at, message, remedy);
    }
}
