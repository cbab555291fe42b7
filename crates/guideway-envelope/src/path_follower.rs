//! Follows a path with a vehicle: converts Bezier segments and a heading into curve pieces with
//! heading ranges. Detects kinks (the vehicle pivots) and cusps (it reverses).

use std::f64::consts::{PI, TAU};

use guideway_spline::Point;

use crate::Heading;
use crate::curve_piece::{CurvePiece, Directions, HeadingMode, control_polygon_m, halves};

type P = Point<f64>;

/// Pieces up to this length are points: a turn there is a kink or a cusp, not a curve.
const POINT_LENGTH_M: f64 = 1e-5;

/// Larger gaps separate parts of a path.
const GAP_M: f64 = 0.01;

/// A turn within this of 180 degrees is a cusp (docs/envelopes.md).
const CUSP_RAD: f64 = 1.0 * PI / 180.0;

/// Rounding error of a gap, in meters.
const GAP_ERROR_M: f64 = 1e-8;

/// Rounding error of a heading, in radians.
const HEADING_ERROR_RAD: f64 = 1e-9;

/// Halvings of a segment to isolate its cusps. Derived: 40 reduce a segment of 1e7 m to
/// [`POINT_LENGTH_M`].
const MAX_HALVINGS: u32 = 40;

/// Follows a curve and appends its pieces with their headings.
pub(crate) struct PathFollower<'s> {
    heading: Heading,
    pieces: &'s mut Vec<CurvePiece>,
    end: Option<P>,
    /// Heading of the vehicle at `end`.
    last_heading: Option<f64>,
    /// Angle from the tangent to the heading; grows by pi at a cusp.
    offset: f64,
    /// First of the trailing pieces of point size, whose headings the next direction determines.
    pending: usize,
    starts_part: bool,
}

impl<'s> PathFollower<'s> {
    pub(crate) fn new(heading: Heading, pieces: &'s mut Vec<CurvePiece>) -> Self {
        Self {
            heading,
            end: None,
            last_heading: None,
            offset: 0.0,
            pending: pieces.len(),
            starts_part: true,
            pieces,
        }
    }

    /// Appends a Bezier curve. `rounding` is the relative rounding error of its coordinates. A
    /// curve that is not finite is a gap.
    pub(crate) fn segment(&mut self, points: &[P; 4], rounding: f64) {
        if !points.iter().all(|p| p.is_finite()) {
            self.end();
            (self.end, self.starts_part) = (None, true);
            return;
        }
        let start = points[0];
        match self.end {
            Some(end) if end.distance(start) > GAP_M => {
                self.end();
                self.starts_part = true;
            }
            // The vehicle crosses a small gap.
            Some(end) if end.distance(start) > GAP_ERROR_M => {
                self.push_pending(&[end, end, start, start]);
            }
            _ => {}
        }
        self.end = Some(points[3]);
        match self.heading {
            Heading::Fixed(heading) => self.push(*points, [heading; 2], HeadingMode::Fixed),
            Heading::Tangential(_) => {
                let far = points
                    .iter()
                    .fold(0.0, |m: f64, p| m.max(p.x.abs()).max(p.y.abs()));
                self.piece(points, POINT_LENGTH_M.max(rounding * far), MAX_HALVINGS);
            }
        }
    }

    /// Ends a connected part of the path.
    pub(crate) fn end(&mut self) {
        match self.last_heading {
            Some(heading) => self.set_pending_headings([heading; 2]),
            // The part has no direction, so a tangential vehicle has no heading.
            None if self.heading.is_tangential() => self.pieces.truncate(self.pending),
            None => {}
        }
        self.last_heading = None;
        self.pending = self.pieces.len();
    }

    /// Appends a curve, halved until each piece has a direction or is a point.
    fn piece(&mut self, points: &[P; 4], point_length_m: f64, halvings_left: u32) {
        if control_polygon_m(points) <= point_length_m {
            return self.push_pending(points);
        }
        match Directions::of(points) {
            Some(directions) => self.push_directed(points, directions),
            None if halvings_left > 0 => {
                for half in halves(points) {
                    self.piece(&half, point_length_m, halvings_left - 1);
                }
            }
            None => self.push_pending(points),
        }
    }

    /// Appends a piece with a direction, after a pivot to it.
    fn push_directed(&mut self, points: &[P; 4], directions: Directions) {
        let Heading::Tangential(own) = self.heading else {
            return;
        };
        let first = match self.last_heading {
            None => {
                self.offset = own;
                directions.first + own
            }
            Some(last) => {
                let mut jump = wrapped(directions.first + self.offset - last);
                if jump.abs() > PI - CUSP_RAD {
                    self.offset += PI;
                    jump = wrapped(jump + PI);
                }
                last + jump
            }
        };
        let last = self.last_heading.unwrap_or(first);
        if (last - first).abs() > HEADING_ERROR_RAD && self.pending == self.pieces.len() {
            self.push_pending(&[points[0]; 4]);
        }
        self.set_pending_headings([last.min(first), last.max(first)]);
        let shift = first - directions.first;
        let headings = directions.range.map(|angle| angle + shift);
        self.push(*points, headings, HeadingMode::FollowsTangent(self.offset));
        self.pending = self.pieces.len();
        self.last_heading = Some(directions.last + shift);
    }

    /// Appends a piece of point size. Its headings follow from the next direction.
    fn push_pending(&mut self, points: &[P; 4]) {
        let (headings, mode) = match self.heading {
            Heading::Fixed(heading) => ([heading; 2], HeadingMode::Fixed),
            Heading::Tangential(_) => ([0.0; 2], HeadingMode::Pivots),
        };
        self.push(*points, headings, mode);
    }

    /// Sets the headings of the trailing pieces of point size.
    fn set_pending_headings(&mut self, headings: [f64; 2]) {
        let pending = self.pieces[self.pending..].iter_mut();
        pending
            .filter(|step| step.mode == HeadingMode::Pivots)
            .for_each(|step| step.headings = headings);
    }

    fn push(&mut self, points: [P; 4], headings: [f64; 2], mode: HeadingMode) {
        let starts_part = std::mem::take(&mut self.starts_part);
        self.pieces.push(CurvePiece {
            points,
            headings,
            mode,
            starts_part,
        });
    }
}

/// The angle normalized to -pi..=pi.
fn wrapped(angle: f64) -> f64 {
    angle - TAU * (angle / TAU).round()
}
