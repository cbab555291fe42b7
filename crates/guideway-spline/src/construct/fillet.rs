//! Fillets: arcs of a given radius that touch two curves which meet in a corner.
//!
//! ```text
//!    first            c: center, one radius from both curves, so it lies on both offset curves:
//!   ------ P . _            P + r n(P) = Q + r n(Q), n being the normals toward the inside
//!                ` .
//!          c       Q
//!                  | second
//! ```
//!
//! The search walks from the corner along the first curve, until the center that belongs to its
//! point P is a radius away from the second curve; Newton's method then solves the equation.
//! Source: Patrikalakis & Maekawa, Shape Interrogation for Computer Aided Design and Manufacturing,
//! chapter 11 (offset curves).

use std::f64::consts::{PI, TAU};

use super::arc::signed_rad;
use super::side::Side;
use super::{Arc, ConstructError, cut};
use crate::{Point, Runs};

/// Least turn of a corner, and least difference from a full turn back.
const LEAST_TURN_RAD: f64 = 1e-3;

/// Steps of the walk per segment.
const STEPS: usize = 32;

/// Most steps of the walk.
const MAX_STEPS: usize = 4096;

/// Halvings of a step before Newton's method takes over.
const HALVINGS: u32 = 24;

/// Steps of Newton's method.
const NEWTON_STEPS: u32 = 12;

/// Halvings on the way to the largest radius that fits.
const RADIUS_HALVINGS: u32 = 24;

/// A rounded corner: the rest of the first curve, the arc, the rest of the second curve. Each
/// begins where the one before ends, in the same direction. A curve that the arc uses up has an
/// empty rest.
#[derive(Clone, Debug, PartialEq)]
pub struct Fillet {
    /// The first curve up to the arc.
    pub before: Runs,
    /// The arc.
    pub arc: Arc,
    /// The second curve from the arc on.
    pub after: Runs,
}

/// Rounds the corner between the end of the first and the start of the second curve by an arc. Both
/// may bend. They must meet: the first curve's end counts as the corner.
///
/// # Errors
/// When there is no corner, the second curve turns straight back, the radius is not positive, or it
/// does not fit: then the error names the largest radius that does.
pub fn fillet(first: &Runs, second: &Runs, radius: f64) -> Result<Fillet, ConstructError> {
    if !radius.is_finite()
        || !first
            .points()
            .iter()
            .chain(second.points())
            .all(|p| p.is_finite())
    {
        return Err(ConstructError::NotFinite);
    }
    if radius <= 0.0 {
        return Err(ConstructError::Radius { radius });
    }
    let corner = first
        .end()
        .ok_or(ConstructError::TooFewPoints { actual: 0 })?;
    let search = Search::new(first, second, corner)?;
    let Some([at_first, at_second]) = search.touches(radius) else {
        let largest = search.largest(radius);
        return Err(ConstructError::TooLarge { radius, largest });
    };
    let [a, b] = &search.sides;
    let (start, end) = (a.point(at_first), b.point(at_second));
    let center = start + search.normal(0, at_first) * radius;
    // The arc turns the way the corner does.
    let turn_rad = signed_rad(start - center, end - center);
    let sweep_rad = if turn_rad * search.turn < 0.0 {
        turn_rad + TAU * search.turn
    } else {
        turn_rad
    };
    let rest = |runs: &Runs, side: &Side, at| cut(runs, side.parameter(at)).map(|[_, rest]| rest);
    let before = rest(&first.reversed(), a, at_first).map(|rest| rest.reversed());
    let after = rest(second, b, at_second);
    let ends = [
        before
            .as_ref()
            .and_then(Runs::end)
            .unwrap_or(start + corner),
        after.as_ref().and_then(Runs::start).unwrap_or(end + corner),
    ];
    let arc = Arc::new(ends[0], ends[1], 0.5 * sweep_rad);
    Ok(Fillet {
        before: before.unwrap_or_default(),
        arc: arc.ok_or(ConstructError::TurnsBack)?,
        after: after.unwrap_or_default(),
    })
}

struct Search {
    /// Both curves, away from the corner.
    sides: [Side; 2],
    /// 1 if the corner turns left, -1 if right.
    turn: f64,
}

impl Search {
    fn new(first: &Runs, second: &Runs, corner: Point<f64>) -> Result<Self, ConstructError> {
        let sides = [
            Side::new(&first.reversed(), corner),
            Side::new(second, corner),
        ];
        let direction = |side: &Side| side.first_direction().ok_or(ConstructError::NoDirection);
        let turn_rad = signed_rad(-direction(&sides[0])?, direction(&sides[1])?);
        if turn_rad.abs() < LEAST_TURN_RAD {
            return Err(ConstructError::NoCorner);
        }
        if turn_rad.abs() > PI - LEAST_TURN_RAD {
            return Err(ConstructError::TurnsBack);
        }
        let turn = turn_rad.signum();
        Ok(Self { sides, turn })
    }

    /// Unit normal of a side toward the inside of the corner.
    fn normal(&self, side: usize, at: f64) -> Point<f64> {
        let direction = self.sides[side].direction(at).unwrap_or_default();
        Point::new(-direction.y, direction.x) * self.inward(side)
    }

    /// 1 if the inside is to the left of a side, which leads away from the corner; else -1.
    fn inward(&self, side: usize) -> f64 {
        if side == 0 { -self.turn } else { self.turn }
    }

    /// The point of the offset curve of a side.
    fn center(&self, side: usize, at: f64, radius: f64) -> Point<f64> {
        self.sides[side].point(at) + self.normal(side, at) * radius
    }

    /// Parameters of both curves where an arc of the radius touches them.
    fn touches(&self, radius: f64) -> Option<[f64; 2]> {
        let [first, second] = &self.sides;
        let over = |at: f64| {
            let nearest = second.nearest(self.center(0, at, radius));
            nearest.map_or(f64::NAN, |(_, distance)| distance - radius)
        };
        let steps = (STEPS * first.end() as usize).min(MAX_STEPS);
        let (mut low, mut over_low) = (0.0, over(0.0));
        for step in 1..=steps {
            let high = first.end() * step as f64 / steps as f64;
            let over_high = over(high);
            // An arc may touch at the very end of the first curve.
            let is_last = step == steps && over_high > -1e-9 * radius;
            if over_low < 0.0 && (over_high >= 0.0 || is_last) {
                let (mut a, mut b) = (low, high);
                for _ in 0..HALVINGS {
                    let middle = 0.5 * (a + b);
                    if over(middle) < 0.0 {
                        a = middle;
                    } else {
                        b = middle;
                    }
                }
                let (other, _) = second.nearest(self.center(0, b, radius))?;
                if let Some(found) = self.solve([b, other], radius) {
                    return Some(found);
                }
            }
            (low, over_low) = (high, over_high);
        }
        None
    }

    /// Newton's method for P + r n(P) = Q + r n(Q). `None` if it ends beside the curves.
    fn solve(&self, mut at: [f64; 2], radius: f64) -> Option<[f64; 2]> {
        let gap = |at: [f64; 2]| self.center(0, at[0], radius) - self.center(1, at[1], radius);
        for _ in 0..NEWTON_STEPS {
            // The normal turns against the direction by the curvature.
            let [p, q] = [0, 1].map(|i| {
                let bend = 1.0 - self.inward(i) * radius * self.sides[i].curvature(at[i]);
                self.sides[i].derivative(at[i]) * bend
            });
            let (offset, turn) = (-gap(at), q.cross(p));
            let step = [-offset.cross(q) / turn, -offset.cross(p) / turn];
            if !step.iter().all(|step| step.is_finite()) {
                break;
            }
            at = [0, 1].map(|i| (at[i] + step[i]).clamp(0.0, self.sides[i].end()));
        }
        let is_inside = at.iter().all(|&at| at > 0.0);
        let size = radius + self.sides[0].point(at[0]).norm();
        (is_inside && gap(at).norm() <= 1e-9 * size).then_some(at)
    }

    /// The largest radius below `too_large` that fits, by halving: it never exceeds the true one.
    fn largest(&self, too_large: f64) -> f64 {
        let (mut low, mut high) = (0.0, too_large);
        for _ in 0..RADIUS_HALVINGS {
            let middle = 0.5 * (low + high);
            if self.touches(middle).is_some() {
                low = middle;
            } else {
                high = middle;
            }
        }
        low
    }
}
