//! Cubic Bezier curves: evaluates, splits, reverses and moves them.

use crate::{Bounds, Nearest, Point, nearest_on_run, uniform};

/// Four control points; the parameter runs from 0 to 1.
pub type Bezier = [Point<f64>; 4];

/// Distance below which two points are one, in meters.
pub const SAME_M: f64 = 1e-6;

/// The straight line between two points, with even speed.
pub fn line(start: Point<f64>, end: Point<f64>) -> Bezier {
    [
        start,
        start.lerp(end, 1.0 / 3.0),
        start.lerp(end, 2.0 / 3.0),
        end,
    ]
}

/// Returns `true` if a curve is a straight line of even speed, up to rounding.
pub fn is_line(b: &Bezier) -> bool {
    let straight = line(b[0], b[3]);
    let size = (b[3] - b[0]).norm();
    let far = b[0].x.abs().max(b[0].y.abs());
    let slack = 1e-9 * size + 1e-12 * far;
    b[1].distance(straight[1]) <= slack && b[2].distance(straight[2]) <= slack
}

/// Box of the control points, which contains the curve.
pub fn bounds(b: &Bezier) -> Bounds<f64> {
    let of = |f: fn(f64, f64) -> f64| {
        let point = |p: Point<f64>, q: Point<f64>| Point::new(f(p.x, q.x), f(p.y, q.y));
        point(point(b[0], b[1]), point(b[2], b[3]))
    };
    Bounds {
        min: of(f64::min),
        max: of(f64::max),
    }
}

/// The point at a parameter.
pub fn point(b: &Bezier, t: f64) -> Point<f64> {
    split(b, t)[0][3]
}

/// The parts before and after a parameter, by de Casteljau's algorithm.
///
/// A parameter beyond 0 to 1 extends the curve.
pub fn split(b: &Bezier, t: f64) -> [Bezier; 2] {
    let [p01, p12, p23] = [0, 1, 2].map(|i| b[i].lerp(b[i + 1], t));
    let (p012, p123) = (p01.lerp(p12, t), p12.lerp(p23, t));
    let middle = p012.lerp(p123, t);
    [[b[0], p01, p012, middle], [middle, p123, p23, b[3]]]
}

/// The part of a cubic between two parameters, `0 <= from < to <= 1`.
pub fn part(b: &Bezier, from: f64, to: f64) -> Bezier {
    let rest = match from > 0.0 {
        true => split(b, from)[1],
        false => *b,
    };
    if to >= 1.0 {
        return rest;
    }
    // The parameter within the rest of the cubic.
    let t = (to - from) / (1.0 - from);
    split(&rest, t.clamp(0.0, 1.0))[0]
}

/// The first derivative at a parameter.
pub fn derivative(b: &Bezier, t: f64) -> Point<f64> {
    uniform::derivative(&uniform::from_bezier(b), t)
}

/// The same curve with greater parameters: one cubic whose parts are two consecutive ones. `None`
/// if the second one does not continue the polynomial of the first one.
///
/// Their lengths may differ, as those of the parts of [`split`] do. Two lines of one direction are
/// one line.
pub fn unite(first: &Bezier, second: &Bezier) -> Option<Bezier> {
    let polygon = |b: &Bezier| b.windows(2).map(|leg| leg[0].distance(leg[1])).sum::<f64>();
    let size = polygon(first).max(polygon(second));
    let far = first.iter().chain(second).map(|p| p.x.abs().max(p.y.abs()));
    let slack = 1e-10 * size + 1e-15 * far.fold(0.0, f64::max);
    if is_line(first) && is_line(second) {
        let whole = line(first[0], second[3]);
        let t = first[0].distance(first[3]) / whole[0].distance(whole[3]);
        let is_between = (0.0..=1.0).contains(&t);
        return (is_between && point(&whole, t).distance(first[3]) <= slack).then_some(whole);
    }
    // The derivatives at the common point are as the widths of the parameter ranges.
    let width = second[0].distance(second[1]) / first[2].distance(first[3]);
    if !(1e-9..1e9).contains(&width) {
        return None;
    }
    // The longer one is extended, which loses no digits.
    if width > 1.0 + 1e-9 {
        return unite(&reversed(second), &reversed(first)).map(|whole| reversed(&whole));
    }
    let [whole, _] = split(first, 1.0 + width);
    let [_, rest] = split(&whole, 1.0 / (1.0 + width));
    let is_same = rest
        .iter()
        .zip(second)
        .all(|(p, q)| p.distance(*q) <= slack);
    is_same.then_some([first[0], whole[1], whole[2], second[3]])
}

/// Unit direction at the start; `None` for a curve without length.
pub fn start_direction(b: &Bezier) -> Option<Point<f64>> {
    let vectors = [b[1] - b[0], b[2] - b[0], b[3] - b[0]];
    vectors.into_iter().find_map(unit)
}

/// Unit direction at the end; `None` for a curve without length.
pub fn end_direction(b: &Bezier) -> Option<Point<f64>> {
    let vectors = [b[3] - b[2], b[3] - b[1], b[3] - b[0]];
    vectors.into_iter().find_map(unit)
}

/// A vector of length 1 in the same direction; `None` below a nanometer.
pub fn unit(vector: Point<f64>) -> Option<Point<f64>> {
    let length = vector.norm();
    (length > 1e-9).then(|| vector * (1.0 / length))
}

/// Angle between two directions, in radians from 0 to pi.
pub fn angle_rad(from: Point<f64>, to: Point<f64>) -> f64 {
    from.cross(to).abs().atan2(from.dot(to))
}

/// The same curve from end to start.
pub fn reversed(b: &Bezier) -> Bezier {
    [b[3], b[2], b[1], b[0]]
}

/// The point of a curve nearest to another one, within a micrometer.
pub fn nearest(b: &Bezier, to: Point<f64>) -> Nearest {
    let start = || Nearest {
        segment: 0,
        t: 0.0,
        point: b[0],
        distance: b[0].distance(to),
    };
    if is_line(b) {
        let vector = b[3] - b[0];
        let t = ((to - b[0]).dot(vector) / vector.dot(vector)).clamp(0.0, 1.0);
        if t.is_nan() {
            return start();
        }
        let point = b[0].lerp(b[3], t);
        return Nearest {
            segment: 0,
            t,
            point,
            distance: point.distance(to),
        };
    }
    nearest_on_run(&uniform::from_bezier(b), to, SAME_M).unwrap_or_else(start)
}

/// Moves the start of a curve to a point. A line stays straight; the tangent of another curve
/// stays.
pub fn move_start(b: &mut Bezier, to: Point<f64>) {
    if is_line(b) {
        *b = line(to, b[3]);
    } else {
        b[1] = b[1] + (to - b[0]);
        b[0] = to;
    }
}

/// Moves the end of a curve to a point, as [`move_start`].
pub fn move_end(b: &mut Bezier, to: Point<f64>) {
    let mut back = reversed(b);
    move_start(&mut back, to);
    *b = reversed(&back);
}

#[cfg(test)]
mod tests {
    use super::*;

    const BEND: Bezier = [
        Point::new(0.0, 0.0),
        Point::new(4.0, 0.0),
        Point::new(4.0, 1.0),
        Point::new(4.0, 5.0),
    ];

    #[test]
    fn parts_meet_and_keep_the_curve() {
        let [left, right] = split(&BEND, 0.3);
        assert_eq!((left[3], right[0]), (point(&BEND, 0.3), point(&BEND, 0.3)));
        assert!(point(&left, 0.5).distance(point(&BEND, 0.15)) < 1e-12);
        assert!(point(&right, 0.5).distance(point(&BEND, 0.65)) < 1e-12);
    }

    #[test]
    fn parts_unite_again_and_others_do_not() {
        for t in [0.001, 0.3, 0.5, 0.9] {
            let [left, right] = split(&BEND, t);
            let whole = unite(&left, &right).unwrap();
            assert!(
                whole.iter().zip(&BEND).all(|(p, q)| p.distance(*q) < 1e-6),
                "{t} {whole:?}"
            );
            // A short part says less about the rest.
            let mut other = right;
            other[2].x += 1e-6 / t.powi(3);
            assert_eq!(unite(&left, &other), None);
        }
        let p = |x: f64| Point::new(x, 0.5 * x);
        assert_eq!(
            unite(&line(p(0.0), p(1.0)), &line(p(1.0), p(8.0))),
            Some(line(p(0.0), p(8.0)))
        );
        assert_eq!(unite(&line(p(0.0), p(1.0)), &line(p(1.0), p(0.5))), None);
        let corner = line(p(1.0), Point::new(5.0, 0.5));
        assert_eq!(unite(&line(p(0.0), p(1.0)), &corner), None);
    }

    #[test]
    fn moved_ends_keep_lines_straight_and_tangents() {
        let mut straight = line(Point::new(0.0, 0.0), Point::new(3.0, 0.0));
        move_end(&mut straight, Point::new(3.0, 1.0));
        assert!(is_line(&straight) && !is_line(&BEND));
        let mut bend = BEND;
        move_start(&mut bend, Point::new(0.0, 0.1));
        assert_eq!(start_direction(&bend), start_direction(&BEND));
        assert_eq!(bend[0], Point::new(0.0, 0.1));
    }

    #[test]
    fn nearest_point_of_lines_and_bends() {
        let straight = line(Point::new(0.0, 0.0), Point::new(10.0, 0.0));
        let found = nearest(&straight, Point::new(4.0, 0.5));
        assert!((found.t - 0.4).abs() < 1e-12 && (found.distance - 0.5).abs() < 1e-12);
        let at = point(&BEND, 0.6);
        assert!(nearest(&BEND, at).distance < 1e-5);
        let dot = line(Point::new(1.0, 1.0), Point::new(1.0, 1.0));
        assert_eq!(nearest(&dot, Point::new(1.0, 3.0)).distance, 2.0);
    }
}
