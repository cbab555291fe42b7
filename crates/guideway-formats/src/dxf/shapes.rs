//! From shapes to runs, in meters and as seen from above.

use guideway_layout::Code;
use guideway_spline::{MAX_DEGREE, Point, Runs};

use super::entity::{Arc, Polyline, Spline, Vertex};
use super::space::{Affine, Vector};
use crate::builder::{Builder, PlaceFn};
use crate::{ReadError, ellipse, spline};

/// Bulges below this are straight: on 100 m of way, such an arc is 5 micrometers high.
const LEAST_BULGE: f64 = 1e-7;

/// Why a shape is not drawn, although its numbers are sound.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Excess {
    /// It goes beyond the largest coordinate.
    Far,
    /// It becomes more control points than there is room for.
    Points,
}

/// What holds for every shape.
#[derive(Clone, Copy)]
pub(super) struct Bounds {
    /// How far a curve may be from its shape, in meters.
    pub(super) tolerance_m: f64,
    /// Largest absolute coordinate, in meters.
    pub(super) coordinate_m: f64,
    /// Most control points.
    pub(super) points: u64,
}

impl Bounds {
    pub(super) fn check(&self, runs: &Runs) -> Result<(), Excess> {
        let inside = |v: f64| v.abs() <= self.coordinate_m;
        if runs.points().len() as u64 > self.points {
            return Err(Excess::Points);
        }
        match runs.points().iter().all(|p| inside(p.x) && inside(p.y)) {
            true => Ok(()),
            false => Err(Excess::Far),
        }
    }
}

/// Appends an arc that a map puts into place.
pub(super) fn append_arc(
    arc: &Arc,
    map: &Affine,
    bounds: &Bounds,
    runs: &mut Runs,
) -> Result<(), Excess> {
    let [x, y] = [arc.u, arc.v].map(|axis| map.direction(axis).flat());
    let origin = map.point(arc.center).flat();
    let ellipse = guideway_spline::Affine { x, y, origin };
    let (tolerance_m, most_m) = (bounds.tolerance_m, bounds.coordinate_m);
    match ellipse::append_arc(ellipse, arc.start, arc.sweep, tolerance_m, most_m, runs) {
        true => Ok(()),
        false => Err(Excess::Far),
    }
}

/// Appends a polyline, its bulges as arcs.
pub(super) fn append_polyline(
    polyline: &Polyline,
    map: &Affine,
    bounds: &Bounds,
    runs: &mut Runs,
) -> Result<(), Excess> {
    let map = map.after(&polyline.plane);
    let vertices = &polyline.vertices;
    let first = vertices
        .first()
        .filter(|_| polyline.is_closed && vertices.len() > 1);
    let next = vertices.iter().skip(1).chain(first);
    for (from, to) in vertices.iter().zip(next) {
        match bent(from, to) {
            Some(arc) => append_arc(&arc, &map, bounds, runs)?,
            None => {
                let ends = [from, to].map(|vertex| map.point(vertex.position).flat());
                runs.push_line(ends[0], ends[1]);
            }
        }
        if runs.points().len() as u64 > bounds.points {
            return Err(Excess::Points);
        }
    }
    Ok(())
}

/// The arc from a vertex to the next, if its bulge b makes one: it turns by 4 atan b, and its center lies
/// (1 - b^2) / (4 b) of the chord to the left of the chord's middle.
fn bent(from: &Vertex, to: &Vertex) -> Option<Arc> {
    let (bulge, start, end) = (from.bulge, from.position, to.position);
    if bulge.abs() < LEAST_BULGE || start == end {
        return None;
    }
    let chord = end - start;
    let left = Vector::new(-chord.y, chord.x, 0.0);
    let center = (start + end) * 0.5 + left * ((1.0 - bulge * bulge) / (4.0 * bulge));
    let arm = start - center;
    let radius = arm.x.hypot(arm.y);
    Some(Arc {
        center,
        u: Vector::new(radius, 0.0, 0.0),
        v: Vector::new(0.0, radius, 0.0),
        start: arm.y.atan2(arm.x),
        sweep: 4.0 * bulge.atan(),
    })
}

/// Appends a spline: a NURBS curve, or the curve through its fit points if that is all there is.
pub(super) fn append_spline(
    builder: &mut Builder<'_>,
    shape: &Spline,
    map: &Affine,
    at: PlaceFn<'_>,
    runs: &mut Runs,
) -> Result<(), ReadError> {
    let count = shape
        .points
        .len()
        .max(shape.knots.len())
        .max(shape.fit.len());
    builder.check_curve_points(count)?;
    let flat = |points: &[Vector]| {
        points
            .iter()
            .map(|&p| map.point(p).flat())
            .collect::<Vec<_>>()
    };
    if shape.points.is_empty() && shape.fit.len() > 1 {
        let message = || {
            format!(
                "there are {} points that the curve passes through, and no control points",
                shape.fit.len()
            )
        };
        let remedy =
            "A smooth curve through them is drawn, which may differ a little between programs";
        builder.report(Code::ApproximateShape, at, message, remedy);
        let tangents = shape.tangents.map(|t| Some(map.direction(t?).flat()));
        append_interpolation(&flat(&shape.fit), tangents, shape.is_closed, runs);
        return Ok(());
    }
    let most = MAX_DEGREE.min(builder.source.options.limits.degree);
    let points = flat(&shape.points);
    let Some(degree) = usize::try_from(shape.degree)
        .ok()
        .filter(|d| (1..=most).contains(d))
    else {
        let message = || format!("the degree is {}, 1 to {most} expected", shape.degree);
        let remedy = "The control polygon is drawn; correct the degree";
        builder.report(Code::BadDegree, at, message, remedy);
        guideway_spline::polyline_to_runs(&points, runs);
        return Ok(());
    };
    let spline = spline::Spline {
        degree,
        knots: shape.knots.clone(),
        weights: weights(builder, shape, at),
        points,
    };
    builder.append_spline(&spline, at, runs);
    Ok(())
}

fn weights(builder: &mut Builder<'_>, shape: &Spline, at: PlaceFn<'_>) -> Vec<f64> {
    let (weights, points) = (&shape.weights, shape.points.len());
    let bad = weights.iter().find(|&&w| w <= 0.0);
    let message = match bad {
        _ if weights.is_empty() => return Vec::new(),
        _ if weights.len() != points => {
            format!("{} weights, {points} control points", weights.len())
        }
        Some(weight) => format!("a weight is {weight:?}"),
        None => return weights.clone(),
    };
    let remedy = "1 is used for all; give each control point a weight above 0";
    builder.report(Code::BadWeight, at, || message, remedy);
    Vec::new()
}

/// Appends the cubic spline through points, smooth to the second derivative, its parameter the length of the
/// chords. Where there is no tangent its ends are not bent; a closed one has the same tangent at both.
///
/// With derivatives m_i at the points p_i and chords of length h_i, smoothness asks that
/// m_(i-1) h_i + 2 m_i (h_(i-1) + h_i) + m_(i+1) h_(i-1) = 3 (h_i d_(i-1) + h_(i-1) d_i), d_i being the slope
/// of chord i (de Boor, A Practical Guide to Splines, chapter IV).
fn append_interpolation(
    points: &[Point<f64>],
    tangents: [Option<Point<f64>>; 2],
    is_closed: bool,
    runs: &mut Runs,
) {
    let mut points = points.to_vec();
    if is_closed && points.len() > 2 {
        points.push(points[0]);
    }
    points.dedup();
    let Some(last) = points.len().checked_sub(2) else {
        return;
    };
    let chords: Vec<Point<f64>> = points.windows(2).map(|p| p[1] - p[0]).collect();
    let lengths: Vec<f64> = chords.iter().map(|chord| chord.norm()).collect();
    let slopes: Vec<Point<f64>> = chords
        .iter()
        .zip(&lengths)
        .map(|(&chord, &length)| chord * (1.0 / length))
        .collect();
    let unit = |t: Point<f64>| (t.norm() > 0.0).then(|| t * (1.0 / t.norm()));
    let around = is_closed.then(|| slopes[last] + slopes[0]);
    let given = tangents.map(|tangent| tangent.or(around).and_then(unit));

    // Elimination downwards: m_i + upper_i m_(i+1) = right_i.
    let (mut upper, mut right) = (Vec::new(), Vec::new());
    let (first_upper, first_right) = match given[0] {
        Some(tangent) => (0.0, tangent),
        None => (0.5, slopes[0] * 1.5),
    };
    upper.push(first_upper);
    right.push(first_right);
    for i in 1..=last {
        let (before, after) = (lengths[i - 1], lengths[i]);
        let pivot = 2.0 * (before + after) - after * upper[i - 1];
        let sum = (slopes[i - 1] * after + slopes[i] * before) * 3.0;
        upper.push(before / pivot);
        right.push((sum - right[i - 1] * after) * (1.0 / pivot));
    }
    let end = match given[1] {
        Some(tangent) => tangent,
        None => (slopes[last] * 3.0 - right[last]) * (1.0 / (2.0 - upper[last])),
    };
    let mut slopes_at = vec![end];
    for i in (0..=last).rev() {
        let next = slopes_at[slopes_at.len() - 1];
        slopes_at.push(right[i] - next * upper[i]);
    }
    slopes_at.reverse();
    for i in 0..=last {
        let third = lengths[i] / 3.0;
        let (from, to) = (points[i], points[i + 1]);
        runs.push_bezier(&[
            from,
            from + slopes_at[i] * third,
            to - slopes_at[i + 1] * third,
            to,
        ]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn vertex(x: f64, y: f64, bulge: f64) -> Vertex {
        Vertex {
            position: Vector::new(x, y, 0.0),
            bulge,
        }
    }

    #[test]
    fn a_bulge_turns_by_four_times_its_arc_tangent() {
        // A quarter turn to the left from (1, 0) to (0, 1) about the origin, and back to the right.
        let quarter = (std::f64::consts::PI / 8.0).tan();
        let arc = bent(&vertex(1.0, 0.0, quarter), &vertex(0.0, 1.0, 0.0)).unwrap();
        assert!(arc.center.norm() < 1e-12 && arc.start.abs() < 1e-12);
        assert!((arc.sweep - std::f64::consts::FRAC_PI_2).abs() < 1e-12);
        let arc = bent(&vertex(0.0, 1.0, -quarter), &vertex(1.0, 0.0, 0.0)).unwrap();
        assert!(arc.center.norm() < 1e-12);
        assert!((arc.sweep + std::f64::consts::FRAC_PI_2).abs() < 1e-12);
        assert!(bent(&vertex(0.0, 1.0, 0.0), &vertex(1.0, 0.0, 1.0)).is_none());
    }

    #[test]
    fn an_interpolation_passes_through_its_points_and_is_smooth() {
        let points = [(0.0, 0.0), (1.0, 2.0), (4.0, 2.5), (5.0, 0.0), (9.0, 1.0)];
        let points = points.map(|(x, y)| Point::new(x, y));
        for (tangents, is_closed) in [
            ([None, None], false),
            ([Some(Point::new(0.0, 2.0)), None], false),
            ([None, None], true),
        ] {
            let mut runs = Runs::default();
            append_interpolation(&points, tangents, is_closed, &mut runs);
            let segments: Vec<[Point<f64>; 4]> = runs
                .iter()
                .map(|run| [run[0], run[1], run[2], run[3]])
                .collect();
            assert_eq!(segments.len(), if is_closed { 5 } else { 4 });
            for (segment, point) in segments.iter().zip(&points) {
                assert!(guideway_spline::uniform::start(segment).distance(*point) < 1e-9);
            }
            // The curvature of one is that of the next where they meet.
            let curvature = |segment: &[Point<f64>; 4], t: f64| {
                let at = |t| guideway_spline::uniform::point(segment, t);
                let h = 1e-3;
                let first = (at(t + h) - at(t - h)) * (0.5 / h);
                let second = (at(t + h) + at(t - h) - at(t) * 2.0) * (1.0 / (h * h));
                first.cross(second) / first.norm().powi(3)
            };
            for pair in segments.windows(2) {
                let (before, after) = (curvature(&pair[0], 1.0), curvature(&pair[1], 0.0));
                assert!((before - after).abs() < 1e-3, "{before} {after}");
            }
        }
    }
}
