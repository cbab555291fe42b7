//! A piece of a curve with the range of headings of the vehicle on it, and its subdivision.

use std::f64::consts::TAU;

use guideway_spline::Point;

use crate::{Body, ConvexPolygon};

type P = Point<f64>;

/// A Bezier curve, and the range of headings of the vehicle on it.
///
/// Headings do not wrap: they are continuous from piece to piece.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CurvePiece {
    pub(crate) points: [P; 4],
    /// Smallest and largest heading, in radians.
    pub(crate) headings: [f64; 2],
    pub(crate) mode: HeadingMode,
    /// True if there is a gap between the piece before it and this one.
    pub(crate) starts_part: bool,
}

/// The relation of the heading to the curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum HeadingMode {
    /// A constant angle to the tangent; the directions of the control polygon are within
    /// [`MAX_SPREAD_RAD`].
    FollowsTangent(f64),
    /// The vehicle pivots: any heading of the range at any point.
    Pivots,
    /// A constant heading.
    Fixed,
}

/// Largest difference of the directions of the control polygon of a piece. Derived: below pi, the
/// directions of the curve are within those of its control polygon; pi/4 also keeps polygons small.
const MAX_SPREAD_RAD: f64 = std::f64::consts::FRAC_PI_4;

/// An element of a sweep.
#[derive(Clone, Debug)]
pub(crate) enum SweepElement {
    /// The body on a piece of a curve.
    Moving(CurvePiece),
    /// A given area.
    Area(ConvexPolygon),
}

impl CurvePiece {
    /// Length of its control polygon, in meters.
    pub(crate) fn reach_m(&self) -> f64 {
        control_polygon_m(&self.points)
    }

    /// Its two halves: of the heading range if a pivot moves the body more than the curve does,
    /// else of the curve.
    pub(crate) fn halves(&self, body: &Body) -> [Self; 2] {
        let [low, high] = self.headings;
        if self.mode == HeadingMode::Pivots && (high - low) * body.reach_m() > self.reach_m() {
            let middle = (low + high) / 2.0;
            return [[low, middle], [middle, high]].map(|headings| Self { headings, ..*self });
        }
        let [first, second] = halves(&self.points);
        let half = |points, starts_part| {
            let mut half = Self {
                points,
                starts_part,
                ..*self
            };
            if let HeadingMode::FollowsTangent(offset) = self.mode
                && let Some(Directions { range, .. }) = Directions::of(&points)
            {
                let turns = (((low + high) - (range[0] + range[1])) / 2.0 - offset) / TAU;
                let shift = offset + TAU * turns.round();
                half.headings = range.map(|angle| (angle + shift).clamp(low, high));
            }
            half
        };
        [half(first, self.starts_part), half(second, false)]
    }
}

/// The directions of the control polygon of a Bezier curve, in radians.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Directions {
    /// Direction of the first leg with a length.
    pub(crate) first: f64,
    /// Direction of the last leg with a length, within pi of the first.
    pub(crate) last: f64,
    /// Smallest and largest direction.
    pub(crate) range: [f64; 2],
}

impl Directions {
    /// `None` if no leg is longer than rounding errors, or if directions differ by more than
    /// [`MAX_SPREAD_RAD`].
    pub(crate) fn of(points: &[P; 4]) -> Option<Self> {
        let far = |m: f64, p: &P| m.max(p.x.abs()).max(p.y.abs());
        let noise_m = 64.0 * f64::EPSILON * points.iter().fold(0.0, far);
        let legs = points.windows(2).map(|ends| ends[1] - ends[0]);
        let mut legs = legs.filter(|leg| leg.norm() > noise_m);
        let base = legs.next()?;
        let first = libm::atan2(base.y, base.x);
        let mut all = Self {
            first,
            last: first,
            range: [first; 2],
        };
        for leg in legs {
            let angle = first + libm::atan2(base.cross(leg), base.dot(leg));
            let [low, high] = all.range;
            all.range = [low.min(angle), high.max(angle)];
            all.last = angle;
        }
        (all.range[1] - all.range[0] <= MAX_SPREAD_RAD).then_some(all)
    }
}

/// Length of the control polygon, in meters.
pub(crate) fn control_polygon_m(points: &[P; 4]) -> f64 {
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
