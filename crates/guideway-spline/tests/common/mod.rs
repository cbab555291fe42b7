//! Random curves, dense sampling and the distance between two sampled curves.
#![allow(dead_code, reason = "each test binary uses its own part")]

use guideway_spline::{Nurbs, Point, Runs, knots, uniform};
use proptest::prelude::*;

pub(crate) type P = Point<f64>;

pub(crate) fn point_within(reach: f64) -> impl Strategy<Value = P> {
    (-reach..reach, -reach..reach).prop_map(|(x, y)| Point::new(x, y))
}

/// Valid curves with all kinds of knots: open, clamped, closed, and non-uniform with repetitions.
pub(crate) fn nurbs(
    degrees: std::ops::RangeInclusive<usize>,
    rational: impl Strategy<Value = bool>,
) -> impl Strategy<Value = Nurbs> {
    (degrees, 1..8usize, 0..4u8, rational)
        .prop_flat_map(|(degree, spans, kind, rational)| {
            let n = degree + spans;
            let points = prop::collection::vec(point_within(50.0), n);
            let weights = prop::collection::vec(0.2..5.0, n);
            let gap = prop_oneof![3 => Just(0.0), 2 => Just(1.0), 2 => 0.01..3.0];
            let gaps = prop::collection::vec(gap, n + degree + 1);
            (Just((degree, kind, rational)), points, weights, gaps)
        })
        .prop_filter_map(
            "a domain with a width",
            |((degree, kind, rational), mut points, mut weights, gaps)| {
                let knots = match kind {
                    0 => knots::uniform_open(degree, points.len()),
                    1 => knots::uniform_clamped(degree, points.len()),
                    2 => {
                        let distinct = points.len();
                        points = knots::close(degree, &points);
                        weights = knots::close(degree, &weights);
                        knots::uniform_closed(degree, distinct)
                    }
                    _ => gaps
                        .iter()
                        .scan(-3.0, |u, gap| {
                            *u += gap;
                            Some(*u)
                        })
                        .collect(),
                };
                Nurbs::new(degree, knots, points, rational.then_some(weights)).ok()
            },
        )
}

/// Parameter ranges of the spans with a positive width.
pub(crate) fn spans(curve: &Nurbs) -> Vec<(f64, f64)> {
    let (p, n) = (curve.degree(), curve.points().len());
    let pairs = curve.knots()[p..=n].windows(2);
    pairs.map(|k| (k[0], k[1])).filter(|(a, b)| a < b).collect()
}

/// `count` + 1 points of a span. The last one is the limit from the left: the curve may break
/// there.
pub(crate) fn span_samples(curve: &Nurbs, (a, b): (f64, f64), count: usize) -> Vec<P> {
    let at = |i: usize| {
        let u = a + (b - a) * (i as f64 / count as f64);
        curve.point(if i == count { b.next_down().max(a) } else { u })
    };
    (0..=count).map(at).collect()
}

/// The start of a run and `count` points per segment.
pub(crate) fn run_samples(run: &[P], count: usize) -> Vec<P> {
    let mut samples = vec![uniform::start(uniform::segment(run, 0))];
    for i in 0..run.len() - 3 {
        let at = |k: usize| uniform::point(uniform::segment(run, i), k as f64 / count as f64);
        samples.extend((1..=count).map(at));
    }
    samples
}

pub(crate) fn distance_to_line(p: P, a: P, b: P) -> f64 {
    let (v, c) = (p - a, b - a);
    let t = v.dot(c) / c.dot(c);
    // t is NaN if a = b: `clamp` keeps NaN, `max` replaces it.
    (v - c * t.clamp(0.0, 1.0).max(0.0)).norm()
}

pub(crate) fn distance_to_polyline(p: P, polyline: &[P]) -> f64 {
    let lines = polyline.windows(2);
    lines
        .map(|l| distance_to_line(p, l[0], l[1]))
        .fold(f64::INFINITY, f64::min)
}

/// One-way Hausdorff distance from the vertices of one polyline to the lines of another.
pub(crate) fn one_way(from: &[P], to: &[P]) -> f64 {
    from.iter()
        .map(|p| distance_to_polyline(*p, to))
        .fold(0.0, f64::max)
}

/// Bound of the distance between a densely sampled curve and its polyline: twice the estimate
/// h^2/8 |C''| from second differences.
pub(crate) fn sagitta(samples: &[P]) -> f64 {
    let bends = samples
        .windows(3)
        .map(|s| (s[0] - s[1] * 2.0 + s[2]).norm());
    bends.fold(0.0, f64::max) / 4.0
}

/// Largest absolute coordinate, at least 1: the reference of relative errors.
pub(crate) fn scale(points: &[P]) -> f64 {
    points
        .iter()
        .map(|p| p.x.abs().max(p.y.abs()))
        .fold(1.0, f64::max)
}

/// Runs of all shapes: free, all points equal, collinear with cusps, loops, far from the origin.
pub(crate) fn run() -> impl Strategy<Value = Vec<P>> {
    let free = prop::collection::vec(point_within(20.0), 4..40);
    let walk = prop::collection::vec((0.2..2.0, -0.6..0.6), 4..60).prop_map(|steps| {
        let (mut at, mut heading) = (Point::new(0.0, 0.0), 0.0_f64);
        let step = |(length, turn): (f64, f64)| {
            heading += turn;
            at = at + Point::new(heading.cos(), heading.sin()) * length;
            at
        };
        steps.into_iter().map(step).collect::<Vec<_>>()
    });
    let in_line = prop::collection::vec(-9.0..9.0, 4..20).prop_map(|along: Vec<f64>| {
        let at = |t: &f64| Point::new(t * 0.6, t * -0.8);
        along.iter().map(at).collect::<Vec<_>>()
    });
    let grid = prop::collection::vec((0..3u8, 0..3u8), 4..20).prop_map(|cells| {
        let at = |(x, y)| Point::new(f64::from(x), f64::from(y));
        cells.into_iter().map(at).collect::<Vec<_>>()
    });
    let equal = (point_within(20.0), 4..9usize).prop_map(|(p, n)| vec![p; n]);
    let shape = prop_oneof![3 => free, 3 => walk, 1 => in_line, 2 => grid, 1 => equal];
    let offset = prop_oneof![3 => Just(0.0), 1 => Just(1e7), 1 => Just(-12345.678)];
    (shape, offset).prop_map(|(points, by)| {
        let by = Point::new(by, -by);
        points.into_iter().map(|p| p + by).collect()
    })
}

/// All segments of all runs.
pub(crate) fn segments(runs: &Runs) -> Vec<[P; 4]> {
    let of_run = |run: &[P]| {
        (0..run.len() - 3)
            .map(|i| *uniform::segment(run, i))
            .collect::<Vec<_>>()
    };
    runs.iter().flat_map(of_run).collect()
}

/// Largest difference at equal parameters, where each segment is one span.
pub(crate) fn difference(curve: &Nurbs, runs: &Runs) -> f64 {
    let (segments, spans) = (segments(runs), spans(curve));
    assert_eq!(segments.len(), spans.len());
    let at_span = |(segment, span): (&[P; 4], &(f64, f64))| {
        let expected = span_samples(curve, *span, 8);
        let at = |i: usize| uniform::point(segment, i as f64 / 8.0).distance(expected[i]);
        (0..=8).map(at).fold(0.0, f64::max)
    };
    let differences = segments.iter().zip(&spans).map(at_span);
    differences.fold(0.0, f64::max)
}

pub(crate) fn zigzag(count: usize) -> Vec<P> {
    let at = |i: usize| Point::new(i as f64 * 3.0, (i % 2) as f64 * 5.0 + (i % 3) as f64);
    (0..count).map(at).collect()
}
