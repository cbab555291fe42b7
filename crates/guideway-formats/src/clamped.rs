//! Paths as clamped B-splines, as other programs have curves: they begin and end at their outer points.

use guideway_layout::{PathRef, RunPoints};
use guideway_spline::{Point, uniform};

/// Positions this near are one, in meters. It is also the step to which written positions are rounded, so
/// that a sum that went 1e-16 wrong does not take twenty digits.
pub(crate) const POSITION_STEP_M: f64 = 1e-6;

/// Runs of a path this near are joined, in meters: in single precision, those that meet do so no better. It is
/// half of what a curve may be off.
const JOINED_M: f64 = 5e-5;

/// A coordinate as it is written.
pub(crate) fn rounded(meters: f64) -> f64 {
    let steps = 1.0 / POSITION_STEP_M;
    // Adding zero turns -0 into 0.
    (meters * steps).round() / steps + 0.0
}

/// A curve of degree 1 (straight lines) or 3, without weights.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct ClampedCurve {
    pub(crate) degree: usize,
    /// Whole numbers from 0 up, one a segment; the outer ones are there degree + 1 times.
    pub(crate) knots: Vec<f64>,
    pub(crate) points: Vec<Point<f64>>,
}

impl ClampedCurve {
    /// A whole path; none if it has no curve. Where it is broken, a knot is there degree + 1 times.
    pub(crate) fn from_path(path: PathRef<'_>) -> Option<Self> {
        let runs: Vec<_> = path.runs().collect();
        (!runs.is_empty()).then(|| Self::of(&runs))
    }

    /// The parts of a path that hang together.
    pub(crate) fn connected_parts(path: PathRef<'_>) -> Vec<Self> {
        let runs: Vec<_> = path.runs().collect();
        let parts = runs.chunk_by(|a, b| meets(end(*a), start(*b)));
        parts.map(Self::of).collect()
    }

    /// Whether it is one straight line.
    pub(crate) fn as_line(&self) -> Option<[Point<f64>; 2]> {
        match self.points[..] {
            [start, end] => Some([start, end]),
            _ => None,
        }
    }

    fn of(runs: &[RunPoints<'_>]) -> Self {
        let mut segments = runs.iter().flat_map(|run| run.segments());
        let is_straight = segments.all(|s| is_straight(&uniform::to_bezier(&s), POSITION_STEP_M));
        let degree = if is_straight { 1 } else { 3 };
        let mut curve = Self {
            degree,
            knots: Vec::new(),
            points: Vec::new(),
        };
        let mut passed = 0;
        for &run in runs {
            let points = match is_straight {
                true => vertices(run),
                false => clamped(run),
            };
            let is_joined = curve
                .points
                .last()
                .is_some_and(|&last| meets(last, points[0]));
            let times = if is_joined { degree } else { degree + 1 };
            curve
                .knots
                .extend(std::iter::repeat_n(f64::from(passed), times));
            curve
                .points
                .extend(points.iter().skip(usize::from(is_joined)));
            let segments = run.segments().len() as u32;
            curve
                .knots
                .extend((1..segments).map(|i| f64::from(passed + i)));
            passed += segments;
        }
        curve
            .knots
            .extend(std::iter::repeat_n(f64::from(passed), degree + 1));
        curve
    }
}

fn meets(a: Point<f64>, b: Point<f64>) -> bool {
    a.distance(b) <= JOINED_M
}

fn start(run: RunPoints<'_>) -> Point<f64> {
    uniform::start(&[run.get(0), run.get(1), run.get(2), run.get(3)])
}

fn end(run: RunPoints<'_>) -> Point<f64> {
    let last = run.len() - 1;
    uniform::end(&[last - 3, last - 2, last - 1, last].map(|i| run.get(i)))
}

/// Where the segments of a run begin and end.
fn vertices(run: RunPoints<'_>) -> Vec<Point<f64>> {
    let ends = run.segments().map(|segment| uniform::end(&segment));
    std::iter::once(start(run)).chain(ends).collect()
}

/// The control points over clamped knots: inserting each outer knot until it is fourfold moves the first two
/// and the last two points, and leaves those between as they are (Boehm 1980).
fn clamped(run: RunPoints<'_>) -> Vec<Point<f64>> {
    let count = run.len();
    let third = |near: usize, far: usize| (run.get(near) * 2.0 + run.get(far)) * (1.0 / 3.0);
    let mut points = vec![start(run), third(1, 2)];
    points.extend((2..count - 2).map(|i| run.get(i)));
    points.extend([third(count - 2, count - 3), end(run)]);
    points
}

/// Whether a Bezier curve is the straight line between its ends, passed once, apart from `step`.
pub(crate) fn is_straight(bezier: &[Point<f64>; 4], step: f64) -> bool {
    let [start, first, second, end] = *bezier;
    let chord = end - start;
    let length = chord.norm();
    let inner = [first - start, second - start];
    if length <= step {
        return inner.iter().all(|p| p.norm() <= step);
    }
    let along = inner.map(|p| p.dot(chord) / length);
    let aside = inner.map(|p| p.cross(chord).abs() / length);
    let steps = [along[0], along[1] - along[0], length - along[1]];
    aside.iter().all(|&d| d <= step) && steps.iter().all(|&s| s >= -step)
}

#[cfg(test)]
mod tests {
    use guideway_layout::{Layout, NewPath};
    use guideway_spline::{Nurbs, Runs};

    use super::*;

    fn path_of(runs: &Runs) -> Layout {
        let mut layout = Layout::default();
        layout.paths.push(&NewPath {
            runs,
            ..NewPath::default()
        });
        layout
    }

    fn wavy(count: usize) -> Vec<Point<f64>> {
        let wave = |i: usize| (i as f64 * 1.7).sin() * 3.0;
        (0..count).map(|i| Point::new(i as f64, wave(i))).collect()
    }

    #[test]
    fn the_clamped_curve_is_the_curve() {
        for lengths in [vec![4], vec![5], vec![9], vec![4, 6], vec![7, 4, 5]] {
            let mut runs = Runs::default();
            for (i, &length) in lengths.iter().enumerate() {
                let shift = Point::new(0.0, 100.0 * i as f64);
                let run: Vec<_> = wavy(length).iter().map(|&p| p + shift).collect();
                runs.push(&run);
            }
            let layout = path_of(&runs);
            let path = layout.paths.get(0);
            let whole = ClampedCurve::from_path(path).unwrap();
            let curve = Nurbs::new(3, whole.knots.clone(), whole.points.clone(), None).unwrap();
            let segments: Vec<_> = path.runs().flat_map(RunPoints::segments).collect();
            for (i, segment) in segments.iter().enumerate() {
                for t in [0.0, 0.25, 0.5, 0.999] {
                    let apart = curve
                        .point(i as f64 + t)
                        .distance(uniform::point(segment, t));
                    assert!(apart < 1e-9, "{lengths:?} segment {i} at {t}: {apart}");
                }
            }
            assert_eq!(ClampedCurve::connected_parts(path).len(), lengths.len());
        }
    }

    #[test]
    fn straight_runs_become_their_vertices() {
        let points =
            [(0.0, 0.0), (4.0, 0.0), (4.0, 3.0), (9.0, 3.0)].map(|(x, y)| Point::new(x, y));
        let mut runs = Runs::default();
        guideway_spline::polyline_to_runs(&points, &mut runs);
        let whole = ClampedCurve::from_path(path_of(&runs).paths.get(0)).unwrap();
        assert_eq!((whole.degree, &whole.points[..]), (1, &points[..]));
        assert_eq!(whole.knots, [0.0, 0.0, 1.0, 2.0, 3.0, 3.0]);
        assert_eq!(whole.as_line(), None);
    }

    #[test]
    fn a_line_is_straight_however_it_is_passed_but_not_if_it_turns_back() {
        let is_line = |at: [f64; 4]| {
            let mut runs = Runs::default();
            runs.push_bezier(&at.map(|s| Point::new(3.0, 4.0) * s));
            let curve = ClampedCurve::from_path(path_of(&runs).paths.get(0)).unwrap();
            curve.as_line().is_some_and(|[start, end]| {
                meets(start, Point::new(0.0, 0.0)) && meets(end, Point::new(3.0, 4.0))
            })
        };
        assert!(is_line([0.0, 0.1, 0.2, 1.0]));
        assert!(is_line([0.0, 0.0, 1.0, 1.0]));
        assert!(!is_line([0.0, 1.5, 0.5, 1.0]));
    }
}
