//! Clamped B-splines: converts the uniform B-spline runs of a path to the clamped curves that other
//! programs use, which begin and end at their outer control points.

use guideway_layout::{PathRef, RunPoints, WrittenCurve};
use guideway_spline::{Point, uniform};

/// Step to which written positions are rounded, in meters; positions this near are equal.
///
/// Rounding keeps a sum with an error of 1e-16 from taking twenty digits.
pub(crate) const POSITION_STEP_M: f64 = 1e-6;

/// Largest gap between runs that count as connected, in meters.
///
/// Derived: coordinates in single precision meet no better at 1 km, and it is half the tolerance of
/// written curves.
pub(crate) const JOIN_TOLERANCE_M: f64 = 5e-5;

/// Rounds a coordinate to [`POSITION_STEP_M`].
pub(crate) fn rounded(meters: f64) -> f64 {
    let steps = 1.0 / POSITION_STEP_M;
    // Adding zero maps -0 to 0.
    (meters * steps).round() / steps + 0.0
}

/// A clamped, non-rational B-spline of degree 1 (straight lines) or 3.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct ClampedCurve {
    pub(crate) degree: usize,
    /// Knots 0, 1, 2, ...: one per segment end, the outer two with multiplicity degree + 1.
    pub(crate) knots: Vec<f64>,
    pub(crate) points: Vec<Point<f64>>,
}

impl ClampedCurve {
    /// Converts a path to one curve, or `None` if it has no run. A gap in the path is a knot of
    /// multiplicity degree + 1.
    pub(crate) fn from_path(path: PathRef<'_>) -> Option<Self> {
        let runs: Vec<_> = path.runs().collect();
        (!runs.is_empty()).then(|| Self::from_runs(&runs))
    }

    /// Converts each connected part of a path to a curve.
    pub(crate) fn connected_parts(path: PathRef<'_>) -> Vec<Self> {
        let runs: Vec<_> = path.runs().collect();
        let parts = runs.chunk_by(|a, b| is_joined(end(*a), start(*b)));
        parts.map(Self::from_runs).collect()
    }

    /// Returns the end points if the curve is one straight line.
    pub(crate) fn as_line(&self) -> Option<[Point<f64>; 2]> {
        match self.points[..] {
            [start, end] => Some([start, end]),
            _ => None,
        }
    }

    /// Returns whether the curve is the straight line between two positions, which a format
    /// implies where an edge has no curve.
    pub(crate) fn is_line_between(&self, ends: [Point<f64>; 2]) -> bool {
        self.as_line().is_some_and(|line| {
            let apart = line[0].distance(ends[0]).max(line[1].distance(ends[1]));
            apart <= POSITION_STEP_M
        })
    }

    /// Returns the curve as a writer writes it: knots from 0 to 1, rounded positions.
    pub(crate) fn into_written(self) -> WrittenCurve {
        let last = self.knots.last().copied().unwrap_or(1.0);
        let round = |p: Point<f64>| Point::new(rounded(p.x), rounded(p.y));
        WrittenCurve {
            degree: self.degree as u32,
            knots: self.knots.iter().map(|knot| knot / last).collect(),
            points_m: self.points.into_iter().map(round).collect(),
            weights: None,
        }
    }

    fn from_runs(runs: &[RunPoints<'_>]) -> Self {
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
            let continues = curve
                .points
                .last()
                .is_some_and(|&last| is_joined(last, points[0]));
            let multiplicity = if continues { degree } else { degree + 1 };
            curve
                .knots
                .extend(std::iter::repeat_n(f64::from(passed), multiplicity));
            curve
                .points
                .extend(points.iter().skip(usize::from(continues)));
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

/// Returns whether a writer writes a path with the numbers of its file, so that its runs are all
/// that the layout needs. `ends` are the positions of its nodes.
pub(crate) fn is_rewritten_as(
    path: PathRef<'_>,
    ends: Option<[Point<f64>; 2]>,
    written: &WrittenCurve,
) -> bool {
    let may_be_same = written.weights.is_none() && matches!(written.degree, 1 | 3);
    may_be_same
        && ClampedCurve::from_path(path).is_some_and(|curve| {
            let is_omitted = ends.is_some_and(|ends| curve.is_line_between(ends));
            !is_omitted && curve.into_written() == *written
        })
}

fn is_joined(a: Point<f64>, b: Point<f64>) -> bool {
    a.distance(b) <= JOIN_TOLERANCE_M
}

fn start(run: RunPoints<'_>) -> Point<f64> {
    uniform::start(&[run.get(0), run.get(1), run.get(2), run.get(3)])
}

fn end(run: RunPoints<'_>) -> Point<f64> {
    let last = run.len() - 1;
    uniform::end(&[last - 3, last - 2, last - 1, last].map(|i| run.get(i)))
}

/// Returns the end points of the segments of a run, first to last.
fn vertices(run: RunPoints<'_>) -> Vec<Point<f64>> {
    let ends = run.segments().map(|segment| uniform::end(&segment));
    std::iter::once(start(run)).chain(ends).collect()
}

/// Returns the control points over clamped knots.
///
/// Knot insertion (Boehm 1980) raises each outer knot to multiplicity 4. That moves the first two
/// and the last two points and leaves those between unchanged.
fn clamped(run: RunPoints<'_>) -> Vec<Point<f64>> {
    let count = run.len();
    let third = |near: usize, far: usize| (run.get(near) * 2.0 + run.get(far)) * (1.0 / 3.0);
    let mut points = vec![start(run), third(1, 2)];
    points.extend((2..count - 2).map(|i| run.get(i)));
    points.extend([third(count - 2, count - 3), end(run)]);
    points
}

/// Returns whether a Bezier curve is the straight line between its ends, without turning back,
/// within `step` meters.
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

    fn layout_with(runs: &Runs) -> Layout {
        let mut layout = Layout::default();
        layout.paths.push(&NewPath {
            runs,
            ..NewPath::default()
        });
        layout
    }

    fn wave_points(count: usize) -> Vec<Point<f64>> {
        let wave = |i: usize| (i as f64 * 1.7).sin() * 3.0;
        (0..count).map(|i| Point::new(i as f64, wave(i))).collect()
    }

    #[test]
    fn clamped_curve_equals_the_uniform_runs() {
        for lengths in [vec![4], vec![5], vec![9], vec![4, 6], vec![7, 4, 5]] {
            let mut runs = Runs::default();
            for (i, &length) in lengths.iter().enumerate() {
                let shift = Point::new(0.0, 100.0 * i as f64);
                let run: Vec<_> = wave_points(length).iter().map(|&p| p + shift).collect();
                runs.push(&run);
            }
            let layout = layout_with(&runs);
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
    fn straight_runs_convert_to_degree_one() {
        let points =
            [(0.0, 0.0), (4.0, 0.0), (4.0, 3.0), (9.0, 3.0)].map(|(x, y)| Point::new(x, y));
        let mut runs = Runs::default();
        guideway_spline::polyline_to_runs(&points, &mut runs);
        let whole = ClampedCurve::from_path(layout_with(&runs).paths.get(0)).unwrap();
        assert_eq!((whole.degree, &whole.points[..]), (1, &points[..]));
        assert_eq!(whole.knots, [0.0, 0.0, 1.0, 2.0, 3.0, 3.0]);
        assert_eq!(whole.as_line(), None);
    }

    #[test]
    fn as_line_accepts_any_parametrization_but_not_a_reversal() {
        let is_line = |at: [f64; 4]| {
            let mut runs = Runs::default();
            runs.push_bezier(&at.map(|s| Point::new(3.0, 4.0) * s));
            let curve = ClampedCurve::from_path(layout_with(&runs).paths.get(0)).unwrap();
            curve.as_line().is_some_and(|[start, end]| {
                is_joined(start, Point::new(0.0, 0.0)) && is_joined(end, Point::new(3.0, 4.0))
            })
        };
        assert!(is_line([0.0, 0.1, 0.2, 1.0]));
        assert!(is_line([0.0, 0.0, 1.0, 1.0]));
        assert!(!is_line([0.0, 1.5, 0.5, 1.0]));
    }
}
