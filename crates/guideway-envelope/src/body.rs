//! A vehicle body: a rectangle around a reference point. Computes convex polygons that contain it
//! at one heading or at a range of headings.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_8};

use guideway_spline::Point;

use crate::ConvexPolygon;

/// A rectangular vehicle, by its extents from the reference point, in meters, 0 or more.
///
/// The reference point follows the path; often it is the center of the driven axle.
///
/// ```text
///          +---------------------+
///   left_m |                     |
///          |      x (reference)  |> heading
///  right_m |                     |
///          +---------------------+
///           rear_m     front_m
/// ```
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
    /// A vehicle with its reference point on the center line, `rear_m` from its rear end.
    pub fn vehicle(length_m: f64, width_m: f64, rear_m: f64) -> Self {
        Self {
            front_m: length_m - rear_m,
            rear_m,
            left_m: width_m / 2.0,
            right_m: width_m / 2.0,
        }
    }

    /// Length from rear to front, in meters.
    pub fn length_m(&self) -> f64 {
        self.front_m + self.rear_m
    }

    /// Width from side to side, in meters.
    pub fn width_m(&self) -> f64 {
        self.left_m + self.right_m
    }

    /// Distance of the farthest corner from the reference point, in meters.
    pub fn reach_m(&self) -> f64 {
        let (x, y) = (self.front_m.max(self.rear_m), self.left_m.max(self.right_m));
        Point::new(x, y).norm()
    }

    /// Returns `true` if a rotation by 180 degrees maps it to itself.
    pub fn is_symmetric(&self) -> bool {
        self.front_m == self.rear_m && self.left_m == self.right_m
    }

    fn corners(&self) -> [Point<f64>; 4] {
        let (front, rear, left, right) = (self.front_m, -self.rear_m, self.left_m, -self.right_m);
        [(rear, right), (front, right), (front, left), (rear, left)].map(|(x, y)| Point::new(x, y))
    }

    /// The body at a heading, counter-clockwise from the x axis, with its reference point at the
    /// origin.
    pub fn at_heading(&self, heading_rad: f64) -> ConvexPolygon {
        let corners = self.corners().map(|corner| rotate(corner, heading_rad));
        ConvexPolygon::hull(corners).expect("four corners")
    }

    /// A polygon that contains the body at all headings of a range. Except for rounding, each of
    /// its points is within [`Self::turning_error_m`] of the body at every heading of the range.
    ///
    /// ```text
    ///        apex           each corner moves on an arc of the angle a; up to a quarter turn,
    ///        /  \           the arc lies in the triangle of its ends and the intersection of
    ///   low .-""-. high     its end tangents (apex), at the distance r / cos(a / 2)
    /// ```
    pub(crate) fn hull_at_headings(&self, [low, high]: [f64; 2]) -> ConvexPolygon {
        let angle_rad = high - low;
        if angle_rad == 0.0 {
            return self.at_heading(low);
        }
        let points = if angle_rad <= MAX_ARC_RAD {
            let apex_scale = libm::cos(angle_rad / 2.0).recip();
            let middle = (low + high) / 2.0;
            let of_corner = |corner| {
                let apex = rotate(corner, middle) * apex_scale;
                [rotate(corner, low), apex, rotate(corner, high)]
            };
            self.corners().map(of_corner).as_flattened().to_vec()
        } else {
            // An octagon around the circle of the farthest corner.
            let corner = Point::new(self.reach_m() / libm::cos(FRAC_PI_8), 0.0);
            let directions = (0..8).map(|i| f64::from(2 * i + 1) * FRAC_PI_8);
            directions
                .map(|direction| rotate(corner, direction))
                .collect()
        };
        ConvexPolygon::hull(points).expect("there are corners")
    }

    /// Error bound of [`Self::hull_at_headings`] for a range of headings: the chord of the arc of
    /// the farthest corner.
    pub(crate) fn turning_error_m(&self, angle_rad: f64) -> f64 {
        if angle_rad <= MAX_ARC_RAD {
            2.0 * self.reach_m() * libm::sin(angle_rad / 2.0)
        } else {
            self.reach_m() * (1.0 + libm::cos(FRAC_PI_8).recip())
        }
    }
}

/// Largest range of headings that [`Body::hull_at_headings`] bounds by arcs. Beyond it, an octagon
/// around the circle is used, because the apexes recede as 1 / cos(angle / 2).
const MAX_ARC_RAD: f64 = FRAC_PI_2;

fn rotate(p: Point<f64>, angle_rad: f64) -> Point<f64> {
    let (sin, cos) = libm::sincos(angle_rad);
    Point::new(p.x * cos - p.y * sin, p.x * sin + p.y * cos)
}
