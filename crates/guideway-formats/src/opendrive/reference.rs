//! The reference line of a road.

use guideway_spline::Point;

use super::polynomial::Cubic;

/// Greatest turn of one panel of integration, in radians. Eight nodes are then exact to rounding.
const PANEL_RAD: f64 = 0.5;

/// Nodes and weights of Gauss-Legendre quadrature on [-1, 1], of the positive half (Abramowitz and Stegun,
/// table 25.4).
const GAUSS: [(f64, f64); 4] = [
    (0.183_434_642_495_649_8, 0.362_683_783_378_362),
    (0.525_532_409_916_329, 0.313_706_645_877_887_3),
    (0.796_666_477_413_626_7, 0.222_381_034_453_374_5),
    (0.960_289_856_497_536_3, 0.101_228_536_290_376_3),
];

/// One record of a plan view: how the reference line goes on from a place.
#[derive(Clone, Debug)]
pub(super) struct Line {
    /// Where it begins along the road, and how long it is, in meters.
    pub(super) start_m: f64,
    pub(super) length_m: f64,
    pub(super) origin: Point<f64>,
    /// From the x axis, counter-clockwise, in radians.
    pub(super) heading: f64,
    pub(super) shape: Shape,
}

/// What a line is, by the distance s from its start.
#[derive(Clone, Debug)]
pub(super) enum Shape {
    /// A line, an arc or a spiral: its curvature is `curvature + rate s`, in 1/m and 1/m^2.
    Turn {
        curvature: f64,
        rate: f64,
        /// Where its panels begin, from the origin.
        panels: Vec<Point<f64>>,
    },
    /// (u, v) seen along the heading.
    Cubic { u: Cubic, v: Cubic },
}

/// Where a line is at a distance, and how it goes on.
#[derive(Clone, Copy, Debug)]
pub(super) struct Motion {
    pub(super) position: Point<f64>,
    /// The derivative of the position, 1 long where s is the length of the way.
    pub(super) velocity: Point<f64>,
    /// The derivative of the heading, in 1/m.
    pub(super) turn: f64,
}

/// How wild a line is over a stretch.
#[derive(Clone, Copy, Debug)]
pub(super) struct Wildness {
    /// A bound of the fourth derivative of the position.
    pub(super) position: f64,
    /// Bounds of the first four derivatives of the heading.
    pub(super) heading: [f64; 4],
}

impl Shape {
    /// A line whose curvature changes evenly. None if it turns so often that it takes more panels than given.
    pub(super) fn turn(
        [curvature, rate]: [f64; 2],
        heading: f64,
        length_m: f64,
        most_panels: u64,
    ) -> Option<Self> {
        let most = curvature.abs().max((curvature + rate * length_m).abs());
        let count = (most * length_m / PANEL_RAD).ceil().max(1.0);
        if count.is_nan() || count > most_panels as f64 {
            return None;
        }
        let step = length_m / count;
        let mut panels = vec![Point::new(0.0, 0.0)];
        for i in 1..count as u64 {
            let from = step * (i - 1) as f64;
            let way = integrate(from, step, |s| heading + s * (curvature + 0.5 * rate * s));
            panels.push(panels[panels.len() - 1] + way);
        }
        Some(Self::Turn {
            curvature,
            rate,
            panels,
        })
    }
}

impl Line {
    pub(super) fn end_m(&self) -> f64 {
        self.start_m + self.length_m
    }

    /// Where it is at a distance from its start, which may be a little beyond its length.
    pub(super) fn at(&self, s: f64) -> Motion {
        match &self.shape {
            Shape::Turn {
                curvature,
                rate,
                panels,
            } => {
                let heading = |s: f64| self.heading + s * (curvature + 0.5 * rate * s);
                let step = self.length_m / panels.len() as f64;
                let panel = ((s / step) as usize).min(panels.len() - 1);
                let from = step * panel as f64;
                let way = panels[panel] + integrate(from, s - from, heading);
                Motion {
                    position: self.origin + way,
                    velocity: unit(heading(s)),
                    turn: curvature + rate * s,
                }
            }
            Shape::Cubic { u, v } => {
                let ([x, dx], [y, dy]) = (u.at(s), v.at(s));
                let ahead = unit(self.heading);
                let place = |x: f64, y: f64| ahead * x + left_of(ahead) * y;
                let velocity = Point::new(dx, dy);
                let acceleration = Point::new(u.second(s), v.second(s));
                Motion {
                    position: self.origin + place(x, y),
                    velocity: place(dx, dy),
                    turn: velocity.cross(acceleration) / velocity.dot(velocity),
                }
            }
        }
    }

    /// Bounds over the stretch from s to s + length. Infinite where the line may stop, for there it has no
    /// heading.
    ///
    /// Of polynomials with the velocity w, a complex number, the heading is Im log w. Its derivatives follow
    /// from those of w, the third of which is zero: with a = |w'| / |w| and b = |w''| / |w|, they are at most
    /// a, b + a^2, 3 a b + 2 a^3 and 3 b^2 + 12 a^2 b + 6 a^4.
    pub(super) fn wildness(&self, s: f64, length: f64) -> Wildness {
        match &self.shape {
            Shape::Turn {
                curvature, rate, ..
            } => {
                let [start, end] = [s, s + length].map(|s| (curvature + rate * s).abs());
                let heading = [start.max(end), rate.abs(), 0.0, 0.0];
                Wildness {
                    // The position is the integral of the direction.
                    position: direction_bounds(heading)[3],
                    heading,
                }
            }
            Shape::Cubic { u, v } => {
                let velocity = |s: f64| Point::new(u.at(s)[1], v.at(s)[1]);
                let acceleration = |s: f64| Point::new(u.second(s), v.second(s)).norm();
                let most = acceleration(s).max(acceleration(s + length));
                let least = velocity(s + 0.5 * length).norm() - 0.5 * length * most;
                let jerk = 6.0 * Point::new(u.d, v.d).norm();
                let heading = match least > 0.0 {
                    true => {
                        let (a, b) = (most / least, jerk / least);
                        [
                            a,
                            b + a * a,
                            3.0 * a * b + 2.0 * a.powi(3),
                            3.0 * b * b + 12.0 * a * a * b + 6.0 * a.powi(4),
                        ]
                    }
                    false => [f64::INFINITY; 4],
                };
                Wildness {
                    position: 0.0,
                    heading,
                }
            }
        }
    }
}

/// Bounds of the derivatives of the direction e^(i heading), from the value on, by those of the heading: the
/// complete Bell polynomials.
pub(super) fn direction_bounds([h1, h2, h3, h4]: [f64; 4]) -> [f64; 5] {
    [
        1.0,
        h1,
        h2 + h1 * h1,
        h3 + 3.0 * h1 * h2 + h1.powi(3),
        h4 + 4.0 * h1 * h3 + 3.0 * h2 * h2 + 6.0 * h1 * h1 * h2 + h1.powi(4),
    ]
}

/// How far u goes until the curve (u, v(u)) is `length_m` long.
pub(super) fn reach(v: Cubic, length_m: f64) -> f64 {
    const PANELS: u32 = 8;
    let length = |reach: f64| {
        let step = reach / f64::from(PANELS);
        let panel = |i| gauss(step * f64::from(i), step, |u| 1_f64.hypot(v.at(u)[1]));
        (0..PANELS).map(panel).sum::<f64>()
    };
    // The curve is at least as long as u.
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

pub(super) fn left_of(direction: Point<f64>) -> Point<f64> {
    Point::new(-direction.y, direction.x)
}

fn unit(heading: f64) -> Point<f64> {
    let (sin, cos) = heading.sin_cos();
    Point::new(cos, sin)
}

/// The way along a heading.
fn integrate(from: f64, length: f64, heading: impl Fn(f64) -> f64) -> Point<f64> {
    Point::new(
        gauss(from, length, |s| heading(s).cos()),
        gauss(from, length, |s| heading(s).sin()),
    )
}

fn gauss(from: f64, length: f64, f: impl Fn(f64) -> f64) -> f64 {
    let half = 0.5 * length;
    let middle = from + half;
    let pair =
        |(node, weight): (f64, f64)| (f(middle - half * node) + f(middle + half * node)) * weight;
    half * GAUSS.into_iter().map(pair).sum::<f64>()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line(shape: Shape, length_m: f64) -> Line {
        Line {
            start_m: 0.0,
            length_m,
            origin: Point::new(0.0, 0.0),
            heading: 0.0,
            shape,
        }
    }

    #[test]
    fn an_arc_closes_to_a_circle() {
        let length = 10.0 * std::f64::consts::TAU;
        let circle = line(Shape::turn([0.1, 0.0], 0.0, length, 1_000).unwrap(), length);
        let half = circle.at(length / 2.0);
        assert!(half.position.distance(Point::new(0.0, 20.0)) < 1e-12);
        assert!(half.velocity.distance(Point::new(-1.0, 0.0)) < 1e-12);
        assert!(circle.at(length).position.norm() < 1e-12);
    }

    #[test]
    fn a_spiral_is_that_of_fresnel() {
        // Heading pi/2 s^2: the ends are C(s) and S(s), here for s = 1 and 2 (Abramowitz and Stegun, table 7.7).
        let spiral = line(
            Shape::turn([0.0, std::f64::consts::PI], 0.0, 2.0, 1_000).unwrap(),
            2.0,
        );
        let one = Point::new(0.779_893_400_376_822_8, 0.438_259_147_390_354_8);
        let two = Point::new(0.488_253_406_075_340_8, 0.343_415_678_363_698_2);
        assert!(spiral.at(1.0).position.distance(one) < 1e-14);
        assert!(spiral.at(2.0).position.distance(two) < 1e-14);
    }

    #[test]
    fn the_bounds_hold_for_differences() {
        let cubic = |a, b, c, d| Cubic { a, b, c, d };
        let shapes = [
            Shape::turn([0.3, -0.02], 0.0, 30.0, 1_000).unwrap(),
            Shape::Cubic {
                u: cubic(0.0, 1.0, 0.001, -0.0002),
                v: cubic(0.0, 0.1, 0.02, -0.0007),
            },
        ];
        for shape in shapes {
            let line = line(shape, 30.0);
            let wildness = line.wildness(0.0, 30.0);
            let turn = |s| line.at(s).turn;
            let h = 1e-2;
            for i in 1..2900 {
                let s = f64::from(i) * h + 0.2;
                let first = (turn(s + h) - turn(s - h)) / (2.0 * h);
                let second = (turn(s + h) - 2.0 * turn(s) + turn(s - h)) / (h * h);
                let found = [turn(s), first, second];
                for (found, bound) in found.into_iter().zip(wildness.heading) {
                    assert!(found.abs() <= bound + 1e-6, "{found} above {bound}");
                }
            }
        }
    }

    #[test]
    fn the_reach_of_a_slope_is_shorter_than_its_length() {
        let slope = Cubic {
            b: 0.75,
            ..Cubic::default()
        };
        assert!((reach(slope, 5.0) - 4.0).abs() < 1e-12);
    }
}
