//! Evaluates the geometry line of a road: position, derivative and derivative bounds by distance.

use guideway_spline::Point;

use super::arc_length::ArcLength;
use super::polynomial::Cubic;
use super::quadrature::gauss;

/// Largest turning angle per quadrature panel, in radians. Derived: eight Gauss nodes are then
/// exact to rounding.
const PANEL_RAD: f64 = 0.5;

/// One segment of a geometry line: a `geometry` element of the plan view.
#[derive(Clone, Debug)]
pub(super) struct Geometry {
    /// Start along the road, in meters.
    pub(super) start_m: f64,
    pub(super) length_m: f64,
    pub(super) origin: Point<f64>,
    /// From the x axis, counter-clockwise, in radians.
    pub(super) heading: f64,
    pub(super) shape: Shape,
}

/// The shape of a segment, by the distance s from its start.
#[derive(Clone, Debug)]
pub(super) enum Shape {
    /// A line, an arc or a spiral: its curvature is `curvature + rate s`, in 1/m and 1/m^2.
    Clothoid {
        curvature: f64,
        rate: f64,
        /// Start of every quadrature panel, relative to the origin.
        panels: Vec<Point<f64>>,
    },
    /// A parametric cubic: u along the start heading, v to its left.
    Cubic {
        arc: ArcLength,
        /// Arc length per s: 1 unless the stated length is not that of the curve.
        scale: f64,
    },
}

/// A segment evaluated at one distance.
#[derive(Clone, Copy, Debug)]
pub(super) struct CurvePoint {
    pub(super) position: Point<f64>,
    /// Derivative of the position; of length 1, as s is the arc length, unless the file states
    /// another length.
    pub(super) derivative: Point<f64>,
    /// Derivative of the heading, in 1/m.
    pub(super) heading_rate: f64,
}

/// Bounds of derivatives over a part of a segment.
#[derive(Clone, Copy, Debug)]
pub(super) struct DerivativeBounds {
    /// Bound of the fourth derivative of the position.
    pub(super) position: f64,
    /// Bounds of the first four derivatives of the heading.
    pub(super) heading: [f64; 4],
}

impl Shape {
    /// A clothoid: linearly changing curvature. `None` if it needs more than `max_panels` panels.
    pub(super) fn clothoid(
        [curvature, rate]: [f64; 2],
        heading: f64,
        length_m: f64,
        max_panels: u64,
    ) -> Option<Self> {
        let max_curvature = curvature.abs().max((curvature + rate * length_m).abs());
        let count = (max_curvature * length_m / PANEL_RAD).ceil().max(1.0);
        if count.is_nan() || count > max_panels as f64 {
            return None;
        }
        let step = length_m / count;
        let mut panels = vec![Point::new(0.0, 0.0)];
        for i in 1..count as u64 {
            let from = step * (i - 1) as f64;
            let chord = integrate(from, step, |s| heading + s * (curvature + 0.5 * rate * s));
            panels.push(panels[panels.len() - 1] + chord);
        }
        Some(Self::Clothoid {
            curvature,
            rate,
            panels,
        })
    }
}

impl Geometry {
    /// End along the road, in meters.
    pub(super) fn end_m(&self) -> f64 {
        self.start_m + self.length_m
    }

    /// Evaluates the segment at a distance from its start, which may slightly exceed its length.
    pub(super) fn at(&self, s: f64) -> CurvePoint {
        match &self.shape {
            Shape::Clothoid {
                curvature,
                rate,
                panels,
            } => {
                let heading = |s: f64| self.heading + s * (curvature + 0.5 * rate * s);
                let step = self.length_m / panels.len() as f64;
                let panel = ((s / step) as usize).min(panels.len() - 1);
                let from = step * panel as f64;
                let offset = panels[panel] + integrate(from, s - from, heading);
                CurvePoint {
                    position: self.origin + offset,
                    derivative: unit(heading(s)),
                    heading_rate: curvature + rate * s,
                }
            }
            Shape::Cubic { arc, scale } => {
                let p = arc.parameter(s * scale);
                let first = match arc.is_still(p) {
                    true => Point::new(0.0, 0.0),
                    false => arc.first(p),
                };
                let speed = first.norm();
                CurvePoint {
                    position: self.cubic_position(arc, p),
                    derivative: self.rotated(first * (scale / speed)),
                    heading_rate: first.cross(arc.second(p)) / speed.powi(3) * scale,
                }
            }
        }
    }

    /// The exact control points of the part `s..=s + length` of a parametric cubic; `None` for
    /// other shapes.
    pub(super) fn bezier(&self, s: f64, length: f64) -> Option<[Point<f64>; 4]> {
        let Shape::Cubic { arc, scale } = &self.shape else {
            return None;
        };
        let [from, to] = [s, s + length].map(|s| arc.parameter(s * scale));
        let [start, end] = [from, to].map(|p| self.cubic_position(arc, p));
        let third = (to - from) / 3.0;
        let [a, b] = [from, to].map(|p| self.rotated(arc.first(p)) * third);
        Some([start, start + a, end - b, end])
    }

    fn cubic_position(&self, arc: &ArcLength, p: f64) -> Point<f64> {
        self.origin + self.rotated(Point::new(arc.u.at(p)[0], arc.v.at(p)[0]))
    }

    /// A vector of the axes u and v in the axes of the layout.
    fn rotated(&self, vector: Point<f64>) -> Point<f64> {
        let u_axis = unit(self.heading);
        u_axis * vector.x + left_normal(u_axis) * vector.y
    }

    /// Bounds of the derivatives on `s..=s + length`. Infinite if the derivative of the position
    /// may vanish, where the curve has no heading.
    ///
    /// For a cubic with the derivative w by its parameter, read as a complex number, log w is the
    /// logarithm of the speed plus i times the heading. The derivatives of both follow from those
    /// of w, whose third is 0. With a = |w'| / |w| and b = |w''| / |w|, they are at most a, b +
    /// a^2, 3 a b + 2 a^3 and 3 b^2 + 12 a^2 b + 6 a^4. Dividing each derivative by the speed gives
    /// those of the heading by arc length.
    pub(super) fn derivative_bounds(&self, s: f64, length: f64) -> DerivativeBounds {
        match &self.shape {
            Shape::Clothoid {
                curvature, rate, ..
            } => {
                let [start, end] = [s, s + length].map(|s| (curvature + rate * s).abs());
                let heading = [start.max(end), rate.abs(), 0.0, 0.0];
                DerivativeBounds {
                    // The position is the integral of the direction.
                    position: direction_bounds(heading)[3],
                    heading,
                }
            }
            Shape::Cubic { arc, scale } => {
                let range = [s, s + length].map(|s| arc.parameter(s * scale));
                let [least, max_second] = arc.speed_bounds(range);
                let third = 6.0 * Point::new(arc.u.d, arc.v.d).norm();
                let heading = match least > 0.0 {
                    true => {
                        let (a, b) = (max_second / least, third / least);
                        let by_parameter = [
                            a,
                            b + a * a,
                            3.0 * a * b + 2.0 * a.powi(3),
                            3.0 * b * b + 12.0 * a * a * b + 6.0 * a.powi(4),
                        ];
                        by_arc_length(by_parameter, scale / least)
                    }
                    false => [f64::INFINITY; 4],
                };
                DerivativeBounds {
                    position: scale * direction_bounds(heading)[3],
                    heading,
                }
            }
        }
    }
}

/// Bounds of the first four derivatives of the heading by s, from bounds of those of the heading
/// and of the logarithm of the speed by the parameter. `rate` bounds the parameter per s.
///
/// With r the parameter per s, the operator d/ds is r d/dp, and r' = -r times the derivative of the
/// logarithm of the speed. Applying it four times to the heading gives the terms.
fn by_arc_length([l1, l2, l3, l4]: [f64; 4], rate: f64) -> [f64; 4] {
    [
        rate * l1,
        rate.powi(2) * (l2 + l1 * l1),
        rate.powi(3) * (l3 + 4.0 * l1 * l2 + 2.0 * l1.powi(3)),
        rate.powi(4)
            * (l4 + 4.0 * l2 * l2 + 7.0 * l1 * l3 + 18.0 * l1 * l1 * l2 + 6.0 * l1.powi(4)),
    ]
}

/// Bounds of the direction e^(i heading) and its first four derivatives, from bounds of the first
/// four derivatives of the heading: the complete Bell polynomials.
pub(super) fn direction_bounds([h1, h2, h3, h4]: [f64; 4]) -> [f64; 5] {
    [
        1.0,
        h1,
        h2 + h1 * h1,
        h3 + 3.0 * h1 * h2 + h1.powi(3),
        h4 + 4.0 * h1 * h3 + 3.0 * h2 * h2 + 6.0 * h1 * h1 * h2 + h1.powi(4),
    ]
}

/// The u at which the curve (u, v(u)) has the arc length `length_m`, by bisection.
pub(super) fn parameter_at_length(v: Cubic, length_m: f64) -> f64 {
    const PANELS: u32 = 8;
    let length = |end: f64| {
        let step = end / f64::from(PANELS);
        let panel = |i| gauss(step * f64::from(i), step, |u| 1_f64.hypot(v.at(u)[1]));
        (0..PANELS).map(panel).sum::<f64>()
    };
    // The arc length is at least u. 52 halvings reach the precision of f64.
    let (mut low, mut high) = (0.0, length_m);
    for _ in 0..52 {
        let middle = 0.5 * (low + high);
        match length(middle) < length_m {
            true => low = middle,
            false => high = middle,
        }
    }
    high
}

/// The left normal of a direction.
pub(super) fn left_normal(direction: Point<f64>) -> Point<f64> {
    Point::new(-direction.y, direction.x)
}

fn unit(heading: f64) -> Point<f64> {
    let (sin, cos) = heading.sin_cos();
    Point::new(cos, sin)
}

/// The integral of the direction over `from..=from + length`.
fn integrate(from: f64, length: f64, heading: impl Fn(f64) -> f64) -> Point<f64> {
    Point::new(
        gauss(from, length, |s| heading(s).cos()),
        gauss(from, length, |s| heading(s).sin()),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line(shape: Shape, length_m: f64) -> Geometry {
        Geometry {
            start_m: 0.0,
            length_m,
            origin: Point::new(0.0, 0.0),
            heading: 0.0,
            shape,
        }
    }

    #[test]
    fn arc_of_a_full_turn_is_a_circle() {
        let length = 10.0 * std::f64::consts::TAU;
        let circle = line(
            Shape::clothoid([0.1, 0.0], 0.0, length, 1_000).unwrap(),
            length,
        );
        let half = circle.at(length / 2.0);
        assert!(half.position.distance(Point::new(0.0, 20.0)) < 1e-12);
        assert!(half.derivative.distance(Point::new(-1.0, 0.0)) < 1e-12);
        assert!(circle.at(length).position.norm() < 1e-12);
    }

    #[test]
    fn spiral_matches_the_fresnel_integrals() {
        // With the heading pi/2 s^2, the ends are C(s) and S(s) (Abramowitz and Stegun, table 7.7).
        let spiral = line(
            Shape::clothoid([0.0, std::f64::consts::PI], 0.0, 2.0, 1_000).unwrap(),
            2.0,
        );
        let one = Point::new(0.779_893_400_376_822_8, 0.438_259_147_390_354_8);
        let two = Point::new(0.488_253_406_075_340_8, 0.343_415_678_363_698_2);
        assert!(spiral.at(1.0).position.distance(one) < 1e-14);
        assert!(spiral.at(2.0).position.distance(two) < 1e-14);
    }

    #[test]
    fn derivative_bounds_hold_for_finite_differences() {
        let cubic = |a, b, c, d| Cubic { a, b, c, d };
        let shapes = [
            Shape::clothoid([0.3, -0.02], 0.0, 30.0, 1_000).unwrap(),
            Shape::Cubic {
                arc: ArcLength::new(
                    cubic(0.0, 1.0, 0.001, -0.0002),
                    cubic(0.0, 0.1, 0.02, -0.0007),
                    30.0,
                )
                .unwrap(),
                scale: 1.0,
            },
        ];
        for shape in shapes {
            let line = line(shape, 30.0);
            let bounds = line.derivative_bounds(0.0, 30.0);
            let turn = |s| line.at(s).heading_rate;
            let h = 1e-2;
            for i in 1..2900 {
                let s = f64::from(i) * h + 0.2;
                let first = (turn(s + h) - turn(s - h)) / (2.0 * h);
                let second = (turn(s + h) - 2.0 * turn(s) + turn(s - h)) / (h * h);
                let found = [turn(s), first, second];
                for (found, bound) in found.into_iter().zip(bounds.heading) {
                    assert!(found.abs() <= bound + 1e-6, "{found} above {bound}");
                }
            }
        }
    }

    #[test]
    fn parameter_at_length_of_a_slope_is_shorter_than_the_length() {
        let slope = Cubic {
            b: 0.75,
            ..Cubic::default()
        };
        assert!((parameter_at_length(slope, 5.0) - 4.0).abs() < 1e-12);
    }
}
