use std::f64::consts::{FRAC_PI_2, FRAC_PI_8};

use guideway_spline::Point;

use crate::ConvexPolygon;

/// A rectangle that moves: how far it reaches from its reference point, in meters, zero or more.
///
/// The reference point is what follows the path: the middle between the driven wheels, say.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Body {
    /// Forwards.
    pub front_m: f64,
    /// Backwards.
    pub rear_m: f64,
    /// To the left.
    pub left_m: f64,
    /// To the right.
    pub right_m: f64,
}

impl Body {
    /// A vehicle whose reference point is on its middle line, `rear_m` from its rear end.
    pub fn vehicle(length_m: f64, width_m: f64, rear_m: f64) -> Self {
        Self {
            front_m: length_m - rear_m,
            rear_m,
            left_m: width_m / 2.0,
            right_m: width_m / 2.0,
        }
    }

    /// From end to end.
    pub fn length_m(&self) -> f64 {
        self.front_m + self.rear_m
    }

    /// From side to side.
    pub fn width_m(&self) -> f64 {
        self.left_m + self.right_m
    }

    /// Distance of the farthest corner from the reference point.
    pub fn reach_m(&self) -> f64 {
        let (x, y) = (self.front_m.max(self.rear_m), self.left_m.max(self.right_m));
        x.hypot(y)
    }

    /// Whether it is the same when it has turned by half a turn.
    pub fn is_symmetric(&self) -> bool {
        self.front_m == self.rear_m && self.left_m == self.right_m
    }

    fn corners(&self) -> [Point<f64>; 4] {
        let (front, rear, left, right) = (self.front_m, -self.rear_m, self.left_m, -self.right_m);
        [(rear, right), (front, right), (front, left), (rear, left)].map(|(x, y)| Point::new(x, y))
    }

    /// Where it is at a heading, counter-clockwise from the x axis, with its reference point at the origin.
    pub fn at_heading(&self, heading_rad: f64) -> ConvexPolygon {
        let corners = self.corners().map(|corner| turn(corner, heading_rad));
        ConvexPolygon::hull(corners).expect("four corners")
    }

    /// A polygon that holds it at all headings of a range. Apart from rounding, none of its points is farther
    /// than [`Self::turning_error_m`] from the body at any one of them.
    ///
    /// Up to a quarter turn, each corner moves on an arc, which lies in the triangle of its ends and of where the
    /// tangents there meet: in the middle direction, at the radius over the cosine of half the angle.
    pub(crate) fn turned(&self, [low, high]: [f64; 2]) -> ConvexPolygon {
        let angle_rad = high - low;
        if angle_rad == 0.0 {
            return self.at_heading(low);
        }
        let points = if angle_rad <= MOST_TURN_RAD {
            let outwards = (angle_rad / 2.0).cos().recip();
            let middle = (low + high) / 2.0;
            let of_corner = |corner| {
                let outer = turn(corner, middle) * outwards;
                [turn(corner, low), outer, turn(corner, high)]
            };
            self.corners().map(of_corner).as_flattened().to_vec()
        } else {
            // Around the circle of the farthest corner.
            let corner = Point::new(self.reach_m() / FRAC_PI_8.cos(), 0.0);
            let directions = (0..8).map(|i| f64::from(2 * i + 1) * FRAC_PI_8);
            directions
                .map(|direction| turn(corner, direction))
                .collect()
        };
        ConvexPolygon::hull(points).expect("there are corners")
    }

    /// See [`Self::turned`]: both the ends of the arcs and where their tangents meet are within the chord.
    pub(crate) fn turning_error_m(&self, angle_rad: f64) -> f64 {
        if angle_rad <= MOST_TURN_RAD {
            2.0 * self.reach_m() * (angle_rad / 2.0).sin()
        } else {
            self.reach_m() * (1.0 + FRAC_PI_8.cos().recip())
        }
    }
}

const MOST_TURN_RAD: f64 = FRAC_PI_2;

fn turn(p: Point<f64>, angle_rad: f64) -> Point<f64> {
    let (sin, cos) = angle_rad.sin_cos();
    Point::new(p.x * cos - p.y * sin, p.x * sin + p.y * cos)
}
