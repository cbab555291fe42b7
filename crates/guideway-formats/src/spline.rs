//! Spline conversion: converts degree, knots, control points and weights of a file to uniform cubic
//! runs, or to the control polygon if the numbers define no curve.

use guideway_layout::{Code, WrittenCurve};
use guideway_spline::{Nurbs, NurbsError, Point, Runs, knots, nurbs_to_runs, polyline_to_runs};

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
    /// Empty if all are 1; otherwise one per point, all finite and none below zero.
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

/// Degree and knots that a curve probably means, and the mistake that its writer made.
struct Repair {
    degree: usize,
    knots: Vec<f64>,
    mistake: &'static str,
}

impl Repair {
    /// Finds the mistake that explains the number of knots, if there is one only.
    fn of(spline: &Spline) -> Option<Self> {
        let (degree, points, knots) = (spline.degree, spline.points.len(), &spline.knots);
        let (first, last) = (*knots.first()?, *knots.last()?);
        let count = knots.len();
        if count == points + degree + 1 {
            return None;
        }
        let clamped_by = |times: usize| -> Vec<f64> {
            let before = std::iter::repeat_n(first, times);
            let after = std::iter::repeat_n(last, times);
            before.chain(knots.iter().copied()).chain(after).collect()
        };
        let repeats = |knots: &[f64]| knots.iter().take_while(|knot| **knot == knots[0]).count();
        let reversed: Vec<f64> = knots.iter().rev().copied().collect();
        let [leading, trailing] = [knots, &reversed].map(|knots| repeats(knots));
        if count == points + degree + 3 && [leading, trailing] == [degree + 2; 2] {
            return Some(Self {
                degree,
                knots: knots[1..count - 1].to_vec(),
                mistake: "the writer repeats the first and the last knot once too often",
            });
        }
        if leading.max(trailing) > degree {
            return None;
        }
        // Rhino and openNURBS count so.
        if points > degree && count + 1 == points + degree {
            return Some(Self {
                degree,
                knots: clamped_by(1),
                mistake: "the writer leaves out the first and the last knot, which are repeated",
            });
        }
        if degree > 1 && points >= degree && count == points + degree {
            return Some(Self {
                degree: degree - 1,
                knots: knots.clone(),
                mistake: "the degree is the order of the curve, which is degree + 1",
            });
        }
        let is_increasing = knots.windows(2).all(|pair| pair[0] < pair[1]);
        if points > degree && count + degree == points + 1 && is_increasing {
            return Some(Self {
                degree,
                knots: clamped_by(degree),
                mistake: "the writer lists each knot once, and the ends are meant degree + 1 times",
            });
        }
        None
    }
}

/// Returns whether weights change a curve: some differ, or all are 0.
fn is_weighted(weights: &[f64]) -> bool {
    let first = weights.first();
    first.is_some_and(|&first| first == 0.0 || weights.iter().any(|&weight| weight != first))
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
        if self.append_repaired(spline, at, runs) {
            return false;
        }
        if let Some((curve, is_stated)) = self.curve(spline, at) {
            if self.convert(&curve, at, runs) {
                return is_stated;
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
        if !error.is_finite() || !runs.points().iter().all(|p| p.is_finite()) {
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

    /// Appends the curve of knots that follow a known mistake. Returns whether there is one.
    fn append_repaired(&mut self, spline: &Spline, at: PlaceFn<'_>, runs: &mut Runs) -> bool {
        let Some(Repair {
            degree,
            knots,
            mistake,
        }) = Repair::of(spline)
        else {
            return false;
        };
        let weights = is_weighted(&spline.weights).then(|| spline.weights.clone());
        let curve = Nurbs::new(degree, knots, spline.points.clone(), weights);
        let Some(curve) = curve.ok().filter(Self::is_affordable) else {
            return false;
        };
        if !self.convert(&curve, at, runs) {
            return false;
        }
        let (count, points) = (spline.knots.len(), spline.points.len());
        let message = || {
            let stated = spline.degree;
            let expected = points + stated + 1;
            format!(
                "{count} knots; {points} control points of degree {stated} need {expected}: \
                 probably {mistake}"
            )
        };
        let remedy = "The one curve that fits is drawn; correct the knots or the degree";
        self.report(Code::BadKnots, at, message, remedy);
        true
    }

    /// Returns whether the approximation of a curve is not too large.
    fn is_affordable(curve: &Nurbs) -> bool {
        let is_exact = curve.degree() <= 3 && !curve.is_rational();
        is_exact || curve.points().len() <= MAX_APPROXIMATED_POINTS
    }

    /// Returns the curve, and whether it is the stated one: it is not if the weights are wrong.
    fn curve(&mut self, spline: &Spline, at: PlaceFn<'_>) -> Option<(Nurbs, bool)> {
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
        let rational = is_weighted(&spline.weights);
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
        let again = if rational { knots.clone() } else { Vec::new() };
        match Nurbs::new(degree, knots, spline.points.clone(), weights) {
            Ok(curve) => {
                self.check_shape(&curve, at);
                Some((curve, true))
            }
            Err(error @ (NurbsError::Weight { .. } | NurbsError::NoWeight { .. })) => {
                let remedy = "Weight 1 is used for all points; correct the weights";
                self.report(Code::BadWeight, at, || error.to_string(), remedy);
                let plain = Nurbs::new(degree, again, spline.points.clone(), None);
                Some((plain.ok()?, false))
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
            format!("{count} knots; {points} control points of degree {degree} need {expected}")
        });
        None
    }

    /// Reports what is legal but unusual: unclamped ends, ends without a weight, and breaks.
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
        let weights = curve.weights().unwrap_or_default();
        if clamped && [weights.first(), weights.last()].contains(&Some(&0.0)) {
            let message = || {
                "the weight of an outer control point is 0: the curve begins or ends at the next \
                 one with a weight"
                    .to_owned()
            };
            let remedy = "The curve is drawn as stated; give the point a weight if it is its end";
            self.report(Code::BadWeight, at, message, remedy);
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
