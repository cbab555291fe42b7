//! Fits one cubic curve to points along another curve: least squares with given end directions.
//!
//! Source: P. J. Schneider, "An algorithm for automatically fitting digitized curves", Graphics
//! Gems, 1990. Each round solves for the lengths of the two handles, then moves the parameter of
//! each point towards its nearest point on the curve.

use guideway_spline::Point;

/// Rounds after which a curve that is not near the points is given up. Measured: circular arcs of
/// up to a right angle take at most three.
const ROUNDS: usize = 12;

/// Fits a cubic curve to points. Returns the curve and an upper bound of its distance from the
/// points; `None` if that is above `tolerance_m`.
pub(super) fn fit_cubic(points: &[Point<f64>], tolerance_m: f64) -> Option<([Point<f64>; 4], f64)> {
    let (&start, &end) = (points.first()?, points.last()?);
    let count = points.len();
    let first = direction([0, 1, 2, 3].map(|i| points.get(i)))?;
    let last = direction([1, 2, 3, 4].map(|i| points.get(count.wrapping_sub(i))))?;
    let mut parameters = chord_parameters(points)?;
    for _ in 0..ROUNDS {
        let handles = handle_lengths(points, &parameters, [first, last])?;
        let curve = [
            start,
            start + first * handles[0],
            end + last * handles[1],
            end,
        ];
        let away = points.iter().zip(&parameters);
        let error = away
            .map(|(p, &t)| at(&curve, t).distance(*p))
            .fold(0.0, f64::max);
        if error <= tolerance_m {
            return Some((curve, error));
        }
        for (point, t) in points.iter().zip(&mut parameters) {
            *t = nearer(&curve, *point, *t);
        }
    }
    None
}

/// Direction of a curve at the first of several points on it. Exact for four points at equal steps
/// of the parameter of one cubic curve.
fn direction(points: [Option<&Point<f64>>; 4]) -> Option<Point<f64>> {
    let [Some(&a), Some(&b), c, d] = points else {
        return None;
    };
    let tangent = match (c, d) {
        (Some(&c), Some(&d)) => (b - a) * 18.0 - (c - a) * 9.0 + (d - a) * 2.0,
        _ => b - a,
    };
    let length = tangent.norm();
    (length > 0.0).then(|| tangent * (1.0 / length))
}

/// The share of the length of the polygon up to each point.
fn chord_parameters(points: &[Point<f64>]) -> Option<Vec<f64>> {
    let mut length = 0.0;
    let mut lengths = vec![0.0];
    for pair in points.array_windows::<2>() {
        length += pair[0].distance(pair[1]);
        lengths.push(length);
    }
    (length > 0.0).then(|| lengths.iter().map(|l| l / length).collect())
}

/// Lengths of the two handles for the least sum of squared distances. `None` if one of them is not
/// positive.
fn handle_lengths(
    points: &[Point<f64>],
    parameters: &[f64],
    [first, last]: [Point<f64>; 2],
) -> Option<[f64; 2]> {
    let (start, end) = (points[0], points[points.len() - 1]);
    let (mut c00, mut c01, mut c11, mut x0, mut x1) = (0.0, 0.0, 0.0, 0.0, 0.0);
    for (point, &t) in points.iter().zip(parameters) {
        let s = 1.0 - t;
        let (b1, b2) = (3.0 * s * s * t, 3.0 * s * t * t);
        let (a0, a1) = (first * b1, last * b2);
        let without = start * (s * s * s + b1) + end * (b2 + t * t * t);
        let rest = *point - without;
        c00 += a0.dot(a0);
        c01 += a0.dot(a1);
        c11 += a1.dot(a1);
        x0 += a0.dot(rest);
        x1 += a1.dot(rest);
    }
    let determinant = c00 * c11 - c01 * c01;
    let lengths = [
        (x0 * c11 - x1 * c01) / determinant,
        (c00 * x1 - c01 * x0) / determinant,
    ];
    lengths
        .iter()
        .all(|&l| l.is_finite() && l > 0.0)
        .then_some(lengths)
}

fn at([a, b, c, d]: &[Point<f64>; 4], t: f64) -> Point<f64> {
    let s = 1.0 - t;
    *a * (s * s * s) + *b * (3.0 * s * s * t) + *c * (3.0 * s * t * t) + *d * (t * t * t)
}

/// One step of Newton towards the parameter of the nearest point.
fn nearer(curve: &[Point<f64>; 4], point: Point<f64>, t: f64) -> f64 {
    let [a, b, c, d] = *curve;
    let s = 1.0 - t;
    let velocity = ((b - a) * (s * s) + (c - b) * (2.0 * s * t) + (d - c) * (t * t)) * 3.0;
    let acceleration = ((c - b * 2.0 + a) * s + (d - c * 2.0 + b) * t) * 6.0;
    let away = at(curve, t) - point;
    let slope = velocity.dot(velocity) + away.dot(acceleration);
    let step = away.dot(velocity) / slope;
    match step.is_finite() {
        true => (t - step).clamp(0.0, 1.0),
        false => t,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fit_finds_a_cubic_curve_again_and_no_other_one() {
        let handles = [(0.0, 0.0), (3.0, 0.0), (4.0, 1.0), (4.0, 4.0)];
        let curve = handles.map(|(x, y)| Point::new(x, y));
        let points: Vec<_> = (0..=40).map(|i| at(&curve, f64::from(i) / 40.0)).collect();
        let (fitted, error) = fit_cubic(&points, 1e-3).unwrap();
        assert!(error <= 1e-3);
        assert!(fitted[1].distance(curve[1]) < 0.05, "{fitted:?}");
        let wave = |i: i32| Point::new(f64::from(i), f64::from(i).sin());
        let wave: Vec<_> = (0..=40).map(wave).collect();
        assert_eq!(fit_cubic(&wave, 1e-2), None);
        assert_eq!(fit_cubic(&[Point::new(1.0, 1.0); 3], 1e-2), None);
    }
}
