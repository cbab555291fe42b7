use std::f64::consts::TAU;

use guideway_spline::{Bounds, Point};

use crate::{Body, ConvexPolygon};

type P = Point<f64>;

/// The Bezier points of a piece of a curve, and the headings of the vehicle on it, in order of size.
///
/// Headings do not wrap: they go on from step to step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Drive {
    pub(crate) points: [P; 4],
    pub(crate) headings: [f64; 2],
    pub(crate) turns: Turns,
    /// Whether it does not go on from where the step before it ends.
    pub(crate) is_apart: bool,
}

/// How the heading goes with the curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Turns {
    /// By an angle from the tangent; the directions of the Bezier legs are within [`MOST_SPREAD_RAD`].
    WithTangent(f64),
    /// In any way within its headings.
    OnTheSpot,
    /// Not at all.
    Never,
}

/// What the directions of the Bezier legs of one step may differ by: then they are those of the curve.
pub(crate) const MOST_SPREAD_RAD: f64 = std::f64::consts::FRAC_PI_4;

/// The smallest part of an envelope.
#[derive(Clone, Debug)]
pub(crate) enum Step {
    /// What the body covers on a piece of the curve.
    Drive(Drive),
    /// An area that is given.
    Still(ConvexPolygon),
}

impl Drive {
    /// Length of its control polygon.
    pub(crate) fn reach_m(&self) -> f64 {
        polygon_m(&self.points)
    }

    /// Its two halves: of the curve, or of the turn where that is larger.
    pub(crate) fn halves(&self, body: &Body) -> [Self; 2] {
        let [low, high] = self.headings;
        if self.turns == Turns::OnTheSpot && (high - low) * body.reach_m() > self.reach_m() {
            let middle = (low + high) / 2.0;
            return [[low, middle], [middle, high]].map(|headings| Self { headings, ..*self });
        }
        let [first, second] = halves(&self.points);
        let half = |points, is_apart| {
            let mut half = Self {
                points,
                is_apart,
                ..*self
            };
            if let Turns::WithTangent(offset) = self.turns
                && let Some(Directions { range, .. }) = Directions::of(&points)
            {
                let turns = (((low + high) - (range[0] + range[1])) / 2.0 - offset) / TAU;
                let shift = offset + TAU * turns.round();
                half.headings = range.map(|angle| (angle + shift).clamp(low, high));
            }
            half
        };
        [half(first, self.is_apart), half(second, false)]
    }
}

/// Where the legs of a Bezier curve point.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Directions {
    /// Of the first leg that has a direction, in radians.
    pub(crate) first: f64,
    /// Of the last one, within half a turn of the first.
    pub(crate) last: f64,
    /// The least and the greatest.
    pub(crate) range: [f64; 2],
}

impl Directions {
    /// None if no leg is longer than rounding, or two of them are more than [`MOST_SPREAD_RAD`] apart.
    pub(crate) fn of(points: &[P; 4]) -> Option<Self> {
        let far = |m: f64, p: &P| m.max(p.x.abs()).max(p.y.abs());
        let noise_m = 64.0 * f64::EPSILON * points.iter().fold(0.0, far);
        let legs = points.windows(2).map(|ends| ends[1] - ends[0]);
        let mut legs = legs.filter(|leg| leg.norm() > noise_m);
        let base = legs.next()?;
        let first = base.y.atan2(base.x);
        let mut all = Self {
            first,
            last: first,
            range: [first; 2],
        };
        for leg in legs {
            let angle = first + base.cross(leg).atan2(base.dot(leg));
            let [low, high] = all.range;
            all.range = [low.min(angle), high.max(angle)];
            all.last = angle;
        }
        (all.range[1] - all.range[0] <= MOST_SPREAD_RAD).then_some(all)
    }
}

pub(crate) fn polygon_m(points: &[P; 4]) -> f64 {
    points
        .windows(2)
        .map(|ends| ends[0].distance(ends[1]))
        .sum()
}

/// The halves of a Bezier curve (de Casteljau).
pub(crate) fn halves(p: &[P; 4]) -> [[P; 4]; 2] {
    let middle = |a: P, b: P| (a + b) * 0.5;
    let (a, b, c) = (middle(p[0], p[1]), middle(p[1], p[2]), middle(p[2], p[3]));
    let (d, e) = (middle(a, b), middle(b, c));
    let m = middle(d, e);
    [[p[0], a, d, m], [m, e, c, p[3]]]
}

/// A stretch of successive steps as one polygon that holds what they cover.
#[derive(Clone, Debug)]
pub(crate) struct Hull {
    pub(crate) outer: ConvexPolygon,
    pub(crate) bounds: Bounds<f64>,
    /// Where the reference point is.
    pub(crate) places: Bounds<f64>,
    /// No point of the polygon is farther than this from what is covered.
    pub(crate) error_m: f64,
}

impl Hull {
    /// Of each part, the hull of the curve, and at each of its points the hull of the body at all headings.
    ///
    /// Let the Bezier points be within f of the chord. Then so is all of their hull, and every point of the
    /// chord is within f of the curve (see [`guideway_spline::flatten_run`]); so a point of the hull of the curve
    /// is within 2 f of the curve. With the body at the heading there, see [`Body::turned`].
    pub(crate) fn of_drives(body: &Body, drives: &[Drive]) -> Option<Self> {
        let mut parts = drives.chunk_by(|_, next| !next.is_apart);
        let (mut outer, error_m) = Self::of_part(body, parts.next()?)?;
        let mut hull = Self {
            bounds: outer.bounds(),
            places: Bounds::of_points(drives.iter().flat_map(|drive| drive.points))?,
            error_m,
            outer,
        };
        for part in parts {
            (outer, _) = Self::of_part(body, part)?;
            let both = [&hull.outer, &outer].map(ConvexPolygon::points);
            hull.outer = ConvexPolygon::hull(both.into_iter().flatten().copied())?;
            hull.bounds = hull.bounds.union(outer.bounds());
            hull.error_m = f64::INFINITY;
        }
        Some(hull)
    }

    /// Of drives that go on from each other, with the error.
    fn of_part(body: &Body, drives: &[Drive]) -> Option<(ConvexPolygon, f64)> {
        let headings = drives.iter().map(|drive| drive.headings);
        let headings = headings.reduce(|[a, b], [low, high]| [a.min(low), b.max(high)])?;
        let points = || drives.iter().flat_map(|drive| drive.points);
        let outer = ConvexPolygon::hull(points())?.sum(&body.turned(headings));
        let ends = [drives.first()?.points[0], drives.last()?.points[3]];
        let flatness_m = points().map(|p| distance_from(ends, p)).fold(0.0, f64::max);
        let error_m = 2.0 * flatness_m + body.turning_error_m(headings[1] - headings[0]);
        Some((outer, error_m))
    }

    /// The hull of several areas; of one, the area itself.
    pub(crate) fn of_areas(areas: &[&ConvexPolygon]) -> Option<Self> {
        if let [one] = areas {
            return Some(Self::of_area((*one).clone()));
        }
        let corners = areas.iter().flat_map(|area| area.points());
        let mut hull = Self::of_area(ConvexPolygon::hull(corners.copied())?);
        hull.error_m = f64::INFINITY;
        Some(hull)
    }

    /// An area that is given, wherever the reference point is in it.
    pub(crate) fn of_area(area: ConvexPolygon) -> Self {
        let bounds = area.bounds();
        Self {
            outer: area,
            bounds,
            places: bounds,
            error_m: 0.0,
        }
    }
}

/// How far a point is from a line that may have no length.
fn distance_from([start, end]: [P; 2], p: P) -> f64 {
    let way = end - start;
    let t = ((p - start).dot(way) / way.dot(way)).clamp(0.0, 1.0);
    p.distance(if t.is_nan() { start } else { start + way * t })
}
