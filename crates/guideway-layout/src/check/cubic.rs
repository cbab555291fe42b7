//! Directions, stops and curvature of one cubic segment.

use guideway_spline::{Point, bezier, uniform};

/// One segment as a Bezier curve, with the length below which vectors are rounding errors.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cubic {
    /// The Bezier points, in meters.
    pub(super) points: [Point<f64>; 4],
    noise_m: f64,
}

impl Cubic {
    /// `rounding` is the relative error of the stored coordinates.
    pub(super) fn new(segment: &[Point<f64>; 4], rounding: f64) -> Self {
        Self::of_bezier(uniform::to_bezier(segment), rounding)
    }

    fn of_bezier(points: [Point<f64>; 4], rounding: f64) -> Self {
        let far = |largest: f64, p: Point<f64>| largest.max(p.x.abs()).max(p.y.abs());
        let coordinate_m = points.into_iter().fold(0.0, far);
        let size_m = points.into_iter().map(|p| p - points[0]).fold(0.0, far);
        Self {
            points,
            noise_m: 1e-6 * size_m + rounding * coordinate_m,
        }
    }

    /// Direction at the start, defined even if the speed is zero there.
    pub(super) fn start_direction(&self) -> Option<Point<f64>> {
        let [p0, p1, p2, p3] = self.points;
        self.first_long([p1 - p0, p2 - p0, p3 - p0])
    }

    /// Direction at the end, defined even if the speed is zero there.
    pub(super) fn end_direction(&self) -> Option<Point<f64>> {
        let [p0, p1, p2, p3] = self.points;
        self.first_long([p3 - p2, p3 - p1, p3 - p0])
    }

    fn first_long(&self, vectors: [Point<f64>; 3]) -> Option<Point<f64>> {
        let square = self.noise_m * self.noise_m;
        vectors.into_iter().find(|v| v.dot(*v) > square)
    }

    /// Splits the curve at each inner parameter where it may stop and turn: the speed of one
    /// coordinate vanishes there, and that of the other may.
    pub(super) fn parts_at_stops(&self, rounding: f64) -> impl Iterator<Item = [Self; 2]> {
        let p = self.points;
        let speeds = [p[1] - p[0], p[2] - p[1], p[3] - p[2]];
        let chord = p[3] - p[0];
        let never_stops = speeds.iter().all(|v| v.dot(chord) > 0.0);
        let roots = if never_stops {
            [f64::NAN; 2]
        } else {
            let largest = |of: fn(&Point<f64>) -> f64| speeds.iter().map(of).fold(0.0, f64::max);
            if largest(|v| v.x.abs()) >= largest(|v| v.y.abs()) {
                quadratic_roots(speeds.map(|v| v.x))
            } else {
                quadratic_roots(speeds.map(|v| v.y))
            }
        };
        let inside = roots.into_iter().filter(|t| 0.0 < *t && *t < 1.0);
        inside.map(move |t| bezier::split(&p, t).map(|part| Self::of_bezier(part, rounding)))
    }
}

/// Roots of the quadratic with these Bezier coefficients; NaN where there is none.
fn quadratic_roots([q0, q1, q2]: [f64; 3]) -> [f64; 2] {
    // (1 - t)^2 q0 + 2 t (1 - t) q1 + t^2 q2 = a t^2 - 2 b t + q0
    let (a, b) = (q0 - 2.0 * q1 + q2, q0 - q1);
    // Rounding may turn the discriminant of a double root slightly negative.
    let discriminant = b * b - a * q0;
    let slack = 1e-14 * b * b;
    let root = if discriminant.abs() <= slack {
        0.0
    } else {
        discriminant.sqrt()
    };
    let sum = b + root.copysign(b);
    [sum / a, q0 / sum]
}

/// The greatest curvature of a segment, in 1/m, and its position.
///
/// Samples the segment, then refines the best sample by ternary search.
pub(super) fn greatest_curvature(segment: &[Point<f64>; 4], rounding: f64) -> (f64, Point<f64>) {
    // The curvature of a cubic has few maxima, so 16 steps separate them.
    const STEPS: u32 = 16;
    let noise_m = rounding
        * segment
            .iter()
            .map(|p| p.x.abs().max(p.y.abs()))
            .fold(0.0, f64::max);
    let at = |t| curvature(segment, t, noise_m);
    let candidates = (0..=STEPS).map(|i| f64::from(i) / f64::from(STEPS));
    let coarse = candidates
        .max_by(|&a, &b| at(a).total_cmp(&at(b)))
        .unwrap_or(0.0);
    let step = 1.0 / f64::from(STEPS);
    let (mut low, mut high) = ((coarse - step).max(0.0), (coarse + step).min(1.0));
    // 24 steps shrink the interval by (2/3)^24, or 6e-5.
    for _ in 0..24 {
        let third = (high - low) / 3.0;
        if at(low + third) < at(high - third) {
            low += third;
        } else {
            high -= third;
        }
    }
    let fine = 0.5 * (low + high);
    let best = if at(fine) > at(coarse) { fine } else { coarse };
    (at(best), uniform::point(segment, best))
}

fn curvature(segment: &[Point<f64>; 4], t: f64, noise_m: f64) -> f64 {
    let (first, second) = (
        uniform::derivative(segment, t),
        uniform::second_derivative(segment, t),
    );
    let (speed, cross) = (first.norm(), first.cross(second).abs());
    // On a straight line with zero end speed, rounding divided by the small speed looks like a
    // bend.
    if cross <= noise_m * (speed + second.norm()) {
        0.0
    } else {
        cross / (speed * speed * speed)
    }
}
