//! Bounds a part of a sweep by one convex polygon, with an error bound.

use guideway_spline::{Bounds, Point};

use crate::body::Body;
use crate::convex::ConvexPolygon;
use crate::curve_piece::CurvePiece;

type P = Point<f64>;

/// A convex polygon that contains a part of a sweep.
#[derive(Clone, Debug)]
pub(crate) struct Hull {
    pub(crate) outer: ConvexPolygon,
    pub(crate) bounds: Bounds<f64>,
    /// Bounds of the reference point.
    pub(crate) reference_bounds: Bounds<f64>,
    /// Largest distance of a point of the polygon from the swept area, in meters; infinite if
    /// unknown.
    pub(crate) error_m: f64,
}

impl Hull {
    /// The hull of moving pieces: per connected part, the Minkowski sum of the hull of the curve
    /// and of the body at all headings. `None` without pieces.
    ///
    /// Error bound: let all Bezier points be within f of the chord. Then their hull is too, and
    /// every point of the chord is within f of the curve (see [`guideway_spline::flatten_run`]). So
    /// every point of the hull is within 2 f of the curve. [`Body::hull_at_headings`] adds the
    /// error of the headings.
    pub(crate) fn of_pieces(body: &Body, pieces: &[CurvePiece]) -> Option<Self> {
        let mut parts = pieces.chunk_by(|_, next| !next.starts_part);
        let (mut outer, error_m) = Self::of_connected(body, parts.next()?)?;
        let mut hull = Self {
            bounds: outer.bounds(),
            reference_bounds: Bounds::of_points(pieces.iter().flat_map(|piece| piece.points))?,
            error_m,
            outer,
        };
        for part in parts {
            (outer, _) = Self::of_connected(body, part)?;
            let both = [&hull.outer, &outer].map(ConvexPolygon::points);
            hull.outer = ConvexPolygon::hull(both.into_iter().flatten().copied())?;
            hull.bounds = hull.bounds.union(outer.bounds());
            hull.error_m = f64::INFINITY;
        }
        Some(hull)
    }

    /// The polygon of one connected part, with its error.
    fn of_connected(body: &Body, pieces: &[CurvePiece]) -> Option<(ConvexPolygon, f64)> {
        let headings = pieces.iter().map(|piece| piece.headings);
        let headings = headings.reduce(|[a, b], [low, high]| [a.min(low), b.max(high)])?;
        let points = || pieces.iter().flat_map(|piece| piece.points);
        let outer = ConvexPolygon::hull(points())?.sum(&body.hull_at_headings(headings));
        let ends = [pieces.first()?.points[0], pieces.last()?.points[3]];
        let flatness_m = points().map(|p| distance_from(ends, p)).fold(0.0, f64::max);
        let error_m = 2.0 * flatness_m + body.turning_error_m(headings[1] - headings[0]);
        Some((outer, error_m))
    }

    /// The hull of given areas; exact for a single one.
    pub(crate) fn of_areas(areas: &[&ConvexPolygon]) -> Option<Self> {
        if let [one] = areas {
            return Some(Self::of_area((*one).clone()));
        }
        let corners = areas.iter().flat_map(|area| area.points());
        let mut hull = Self::of_area(ConvexPolygon::hull(corners.copied())?);
        hull.error_m = f64::INFINITY;
        Some(hull)
    }

    /// A given area. The reference point may be anywhere in it.
    pub(crate) fn of_area(area: ConvexPolygon) -> Self {
        let bounds = area.bounds();
        Self {
            outer: area,
            bounds,
            reference_bounds: bounds,
            error_m: 0.0,
        }
    }
}

/// Distance of a point from a line segment, which may have length 0.
fn distance_from([start, end]: [P; 2], p: P) -> f64 {
    let way = end - start;
    let t = ((p - start).dot(way) / way.dot(way)).clamp(0.0, 1.0);
    p.distance(if t.is_nan() { start } else { start + way * t })
}
