//! Arcs of circles by start, end and angle.
//!
//! ```text
//!            . - ~ - .
//!         .             .        h: angle between the chord and the tangent at either end,
//!       S ) h             E         half of the arc's angle
//!         ---- chord ---->
//! ```
//!
//! The radius is chord / (2 sin h), and the point that has turned by an angle f lies at the chord
//! turned by f/2 - h and scaled by sin(f/2) / sin h. No center is needed, so an arc may be nearly
//! straight. Source: Euclid, Elements, III.20 (inscribed angles) and III.32 (tangent and chord).

use super::ConstructError;
use crate::arc::pieces_of_arc;
use crate::bezier::{SAME_M, angle_rad};
use crate::{Conversion, Point, Runs};

/// Angle h below which an arc is a line. Derived: the arc's height is chord h / 2, 0.05 um per km.
const STRAIGHT_RAD: f64 = 1e-10;

/// Least difference of h from a half turn, where the radius would be infinite.
const BEHIND_RAD: f64 = 1e-6;

/// Relative rounding error of half a distance, within which a radius gives half a circle.
const ROUNDING: f64 = 1e-12;

/// An arc of a circle, or a straight line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Arc {
    start: Point<f64>,
    end: Point<f64>,
    /// Half of the angle that the arc turns by; positive to the left.
    half_rad: f64,
}

impl Arc {
    /// The arc that begins in a direction (a vector of any length) and ends at a point.
    ///
    /// # Errors
    /// When start and end are the same point, the direction has no length, or the end lies straight
    /// behind the start.
    pub fn from_tangent(
        start: Point<f64>,
        direction: Point<f64>,
        end: Point<f64>,
    ) -> Result<Self, ConstructError> {
        check_distinct(&[start, end])?;
        if !direction.is_finite() {
            return Err(ConstructError::NotFinite);
        }
        if direction.norm() <= 0.0 {
            return Err(ConstructError::NoDirection);
        }
        Self::new(start, end, signed_rad(direction, end - start))
            .ok_or(ConstructError::StraightBehind { end })
    }

    /// The arc from the first through the second to the third point.
    ///
    /// # Errors
    /// When two of the points are the same, or the second one lies on the line of the others but
    /// not between them.
    pub fn through(points: [Point<f64>; 3]) -> Result<Self, ConstructError> {
        let [start, through, end] = points;
        check_distinct(&[start, through, end, start])?;
        // The chords turn by half of each part of the arc, hence by half of the whole.
        Self::new(start, end, signed_rad(through - start, end - through))
            .ok_or(ConstructError::NotBetween { through })
    }

    /// The shorter arc of a radius between two points: to the left for a positive radius, to the
    /// right for a negative one.
    ///
    /// # Errors
    /// When the points are the same, or the radius is too small, zero or not finite.
    pub fn of_radius(
        start: Point<f64>,
        end: Point<f64>,
        radius: f64,
    ) -> Result<Self, ConstructError> {
        check_distinct(&[start, end])?;
        if !radius.is_finite() {
            return Err(ConstructError::NotFinite);
        }
        let smallest = start.distance(end) / 2.0;
        if radius.abs() < smallest * (1.0 - ROUNDING) {
            return Err(ConstructError::TooSmall { radius, smallest });
        }
        let half_rad = (smallest / radius).clamp(-1.0, 1.0).asin();
        Self::new(start, end, half_rad).ok_or(ConstructError::NotFinite)
    }

    /// The arc from `start` to `end` that turns by twice `half_rad`; `None` for a full turn.
    pub(super) fn new(start: Point<f64>, end: Point<f64>, half_rad: f64) -> Option<Self> {
        let half_rad = if half_rad.abs() < STRAIGHT_RAD {
            0.0
        } else {
            half_rad
        };
        (half_rad.abs() < std::f64::consts::PI - BEHIND_RAD).then_some(Self {
            start,
            end,
            half_rad,
        })
    }

    /// Radius; infinite for a line.
    pub fn radius(self) -> f64 {
        self.start.distance(self.end) / (2.0 * self.half_rad.sin().abs())
    }

    /// Angle that the arc turns by, in radians; positive to the left.
    pub fn sweep_rad(self) -> f64 {
        2.0 * self.half_rad
    }

    /// Length of the arc.
    pub fn length(self) -> f64 {
        let chord = self.start.distance(self.end);
        if self.half_rad == 0.0 {
            chord
        } else {
            chord * self.half_rad / self.half_rad.sin()
        }
    }

    /// Appends the arc: a line exactly, all others as equal cubics within `tolerance` of the
    /// circle, in the unit of the points. Source of the bound: see
    /// [`arc_to_runs`](crate::arc_to_runs).
    pub fn push(self, tolerance: f64, out: &mut Runs) -> Conversion {
        let (start, end, half_rad) = (self.start, self.end, self.half_rad);
        if half_rad == 0.0 {
            out.push_line(start, end);
            return Conversion {
                exact: true,
                error_bound_m: 0.0,
                pieces: 1,
            };
        }
        let (pieces, error) = pieces_of_arc(self.radius(), 2.0 * half_rad, tolerance);
        let chord = end - start;
        let turned = |angle_rad: f64| {
            let (sin, cos) = angle_rad.sin_cos();
            Point::new(chord.x * cos - chord.y * sin, chord.x * sin + chord.y * cos)
        };
        let at = |share: f64| {
            let inscribed_rad = half_rad * share;
            let scale = inscribed_rad.sin() / half_rad.sin();
            start + turned(inscribed_rad - half_rad) * scale
        };
        // A handle is 4/3 tan(a/4) radii long, for cubics that turn by a = 2 half_rad / pieces.
        let k = 4.0 / 3.0 * (0.5 * half_rad / f64::from(pieces)).tan();
        let handle =
            |share: f64| turned(half_rad * (2.0 * share - 1.0)) * (0.5 * k / half_rad.sin());
        let mut from = (start, handle(0.0));
        for piece in 1..=pieces {
            let share = f64::from(piece) / f64::from(pieces);
            let to = if piece == pieces { end } else { at(share) };
            let next = handle(share);
            out.push_bezier(&[from.0, from.0 + from.1, to - next, to]);
            from = (to, next);
        }
        Conversion {
            exact: false,
            error_bound_m: error,
            pieces: pieces as usize,
        }
    }
}

/// Angle from one vector to another, in radians, from -pi to pi.
pub(super) fn signed_rad(from: Point<f64>, to: Point<f64>) -> f64 {
    angle_rad(from, to).copysign(from.cross(to))
}

/// Refuses points that are not finite, or equal the next one.
pub(super) fn check_distinct(points: &[Point<f64>]) -> Result<(), ConstructError> {
    if !points.iter().all(|point| point.is_finite()) {
        return Err(ConstructError::NotFinite);
    }
    match points
        .array_windows()
        .position(|[p, q]| p.distance(*q) <= SAME_M)
    {
        Some(i) => Err(ConstructError::EqualPoints {
            index: i + 1,
            at: points[i],
        }),
        None => Ok(()),
    }
}
