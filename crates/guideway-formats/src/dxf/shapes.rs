//! Converts shapes to runs: applies a 3D transform, projects to x and y, and outputs control points
//! in meters.

use guideway_layout::{Code, WrittenCurve};
use guideway_spline::{Affine as Affine2, MAX_DEGREE, Runs};

use super::affine3::{Affine3, Vector3};
use super::closed_spline::{close, report_open};
use super::fit_spline::append_fit_spline;
use super::shape::{Arc, Polyline, Spline, Vertex};
use crate::builder::{Builder, PlaceFn};
use crate::{ReadError, ellipse, spline};

/// Smaller bulges are straight. Derived: over a chord of 100 m, such an arc is 5 micrometers high.
const MIN_BULGE: f64 = 1e-7;

/// A limit that a shape with valid numbers exceeds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum ExceededLimit {
    /// The largest absolute coordinate.
    Coordinate,
    /// The control points left for the file.
    Points,
}

/// Limits of every shape.
#[derive(Clone, Copy)]
pub(super) struct ShapeLimits {
    /// Largest distance of a curve from its shape, in meters.
    pub(super) tolerance_m: f64,
    /// Largest absolute coordinate, in meters.
    pub(super) coordinate_m: f64,
    /// Largest number of control points.
    pub(super) points: u64,
}

impl ShapeLimits {
    /// Checks the number and the coordinates of control points.
    pub(super) fn check(&self, runs: &Runs) -> Result<(), ExceededLimit> {
        let inside = |v: f64| v.abs() <= self.coordinate_m;
        if runs.points().len() as u64 > self.points {
            return Err(ExceededLimit::Points);
        }
        match runs.points().iter().all(|p| inside(p.x) && inside(p.y)) {
            true => Ok(()),
            false => Err(ExceededLimit::Coordinate),
        }
    }
}

/// Appends a transformed arc.
pub(super) fn append_arc(
    arc: &Arc,
    transform: &Affine3,
    limits: &ShapeLimits,
    runs: &mut Runs,
) -> Result<(), ExceededLimit> {
    let [x, y] = [arc.u, arc.v].map(|axis| transform.direction(axis).xy());
    let origin = transform.point(arc.center).xy();
    let ellipse = Affine2 { x, y, origin };
    let (tolerance_m, max_m) = (limits.tolerance_m, limits.coordinate_m);
    match ellipse::append_arc(ellipse, arc.start, arc.sweep, tolerance_m, max_m, runs) {
        true => Ok(()),
        false => Err(ExceededLimit::Coordinate),
    }
}

/// Appends a transformed polyline; bulges become arcs.
pub(super) fn append_polyline(
    polyline: &Polyline,
    transform: &Affine3,
    limits: &ShapeLimits,
    runs: &mut Runs,
) -> Result<(), ExceededLimit> {
    let transform = transform.after(&polyline.plane);
    let vertices = &polyline.vertices;
    let first = vertices
        .first()
        .filter(|_| polyline.is_closed && vertices.len() > 1);
    let next = vertices.iter().skip(1).chain(first);
    for (from, to) in vertices.iter().zip(next) {
        match bulge_arc(from, to) {
            Some(arc) => append_arc(&arc, &transform, limits, runs)?,
            None => {
                let ends = [from, to].map(|vertex| transform.point(vertex.position).xy());
                runs.push_line(ends[0], ends[1]);
            }
        }
        if runs.points().len() as u64 > limits.points {
            return Err(ExceededLimit::Points);
        }
    }
    Ok(())
}

/// The arc of a bulge b; `None` if the segment is straight.
///
/// ```text
///        center            the arc sweeps 4 atan b, counter-clockwise for b > 0;
///          |               the center is (1 - b^2) / (4 b) chord lengths to the left
///          | left          of the chord's midpoint
/// from ----+----> to
///       `.___.'            b = 2 * sagitta / chord
/// ```
fn bulge_arc(from: &Vertex, to: &Vertex) -> Option<Arc> {
    let (bulge, start, end) = (from.bulge, from.position, to.position);
    if bulge.abs() < MIN_BULGE || start == end {
        return None;
    }
    let chord = end - start;
    let left = Vector3::new(-chord.y, chord.x, 0.0);
    let center = (start + end) * 0.5 + left * ((1.0 - bulge * bulge) / (4.0 * bulge));
    let to_start = start - center;
    let radius = to_start.x.hypot(to_start.y);
    Some(Arc {
        center,
        u: Vector3::new(radius, 0.0, 0.0),
        v: Vector3::new(0.0, radius, 0.0),
        start: to_start.y.atan2(to_start.x),
        sweep: 4.0 * bulge.atan(),
    })
}

/// Appends a transformed spline: as a NURBS curve if it has control points, else through its fit
/// points. Reports findings for a degree or weights that are invalid. Returns the NURBS curve.
///
/// # Errors
/// When the spline has more points or knots than the limit.
pub(super) fn append_spline(
    builder: &mut Builder<'_>,
    shape: &Spline,
    transform: &Affine3,
    at: PlaceFn<'_>,
    runs: &mut Runs,
) -> Result<Option<WrittenCurve>, ReadError> {
    let count = shape
        .points
        .len()
        .max(shape.knots.len())
        .max(shape.fit_points.len());
    builder.check_curve_points(count)?;
    let project = |points: &[Vector3]| -> Vec<_> {
        points.iter().map(|&p| transform.point(p).xy()).collect()
    };
    if shape.points.is_empty() && shape.fit_points.len() > 1 {
        let message = || {
            format!(
                "the spline has {} fit points and no control points",
                shape.fit_points.len()
            )
        };
        let remedy =
            "A smooth curve through them is drawn, which may differ slightly between programs";
        builder.report(Code::ApproximateShape, at, message, remedy);
        let tangents = shape.tangents.map(|t| Some(transform.direction(t?).xy()));
        append_fit_spline(&project(&shape.fit_points), tangents, shape.is_closed, runs);
        return Ok(None);
    }
    let max = MAX_DEGREE.min(builder.source.options.limits.degree);
    let points = project(&shape.points);
    let Some(degree) = usize::try_from(shape.degree)
        .ok()
        .filter(|d| (1..=max).contains(d))
    else {
        let message = || format!("the degree is {}, expected 1 to {max}", shape.degree);
        let remedy = "The control polygon is drawn; correct the degree";
        builder.report(Code::BadDegree, at, message, remedy);
        guideway_spline::polyline_to_runs(&points, runs);
        return Ok(None);
    };
    let mut spline = spline::Spline {
        degree,
        knots: shape.knots.clone(),
        weights: valid_weights(builder, shape, at),
        points,
    };
    close(builder, shape.is_closed, &mut spline, at);
    let is_drawn = builder.append_spline(&spline, at, runs);
    if shape.is_closed {
        report_open(builder, runs, at);
    }
    Ok(is_drawn.then(|| spline.into_written()))
}

/// The weights; empty (1 for each point) if absent or invalid, the latter with a finding.
fn valid_weights(builder: &mut Builder<'_>, shape: &Spline, at: PlaceFn<'_>) -> Vec<f64> {
    let (weights, points) = (&shape.weights, shape.points.len());
    let bad = weights.iter().find(|&&w| w < 0.0);
    let message = match bad {
        _ if weights.is_empty() => return Vec::new(),
        _ if weights.len() != points => {
            format!("{} weights for {points} control points", weights.len())
        }
        Some(weight) => format!("the weight {weight:?} is below 0"),
        None => return weights.clone(),
    };
    let remedy = "1 is used for all; give each control point a weight from 0 on";
    builder.report(Code::BadWeight, at, || message, remedy);
    Vec::new()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn vertex(x: f64, y: f64, bulge: f64) -> Vertex {
        Vertex {
            position: Vector3::new(x, y, 0.0),
            bulge,
        }
    }

    #[test]
    fn bulge_arc_sweeps_four_times_the_arc_tangent_of_its_bulge() {
        // A left quarter turn from (1, 0) to (0, 1) about the origin, then a right one back.
        let quarter = (std::f64::consts::PI / 8.0).tan();
        let arc = bulge_arc(&vertex(1.0, 0.0, quarter), &vertex(0.0, 1.0, 0.0)).unwrap();
        assert!(arc.center.norm() < 1e-12 && arc.start.abs() < 1e-12);
        assert!((arc.sweep - std::f64::consts::FRAC_PI_2).abs() < 1e-12);
        let arc = bulge_arc(&vertex(0.0, 1.0, -quarter), &vertex(1.0, 0.0, 0.0)).unwrap();
        assert!(arc.center.norm() < 1e-12);
        assert!((arc.sweep + std::f64::consts::FRAC_PI_2).abs() < 1e-12);
        assert!(bulge_arc(&vertex(0.0, 1.0, 0.0), &vertex(1.0, 0.0, 1.0)).is_none());
    }
}
