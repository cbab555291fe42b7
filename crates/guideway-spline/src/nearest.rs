//! Nearest point of a run to a query point, by branch and bound over Bezier hulls.

use crate::{Point, Real, uniform};

/// Most halvings of a segment. Derived: parts of 2^-50 are about as short as the rounding error of
/// t.
const MAX_HALVINGS: u32 = 50;

/// The point of a run that is nearest to a query point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Nearest {
    /// Index of the segment in the run.
    pub segment: usize,
    /// Parameter in the segment, 0 to 1.
    pub t: f64,
    /// The point on the curve.
    pub point: Point<f64>,
    /// Distance to the query point.
    pub distance: f64,
}

/// The point of a run nearest to `query`; `None` if the run has fewer than four points.
///
/// No other point of the run is nearer by more than `tolerance` (in the unit of the points), which
/// is raised to 10^-12 of the distances involved if it is lower.
///
/// ```text
///       . - ~ - .          f: greatest distance of a Bezier point from the chord
///    A ----------- E       the part lies within f of its chord AE (see `flatten_run`)
///           |
///           | d            the part can be skipped if d - f >= best distance so far
///         query
/// ```
///
/// Cost: halving divides f by four, so a segment takes a few steps, but around the center of an arc
/// sqrt(radius / tolerance) of them.
pub fn nearest_on_run<T: Real>(
    points: &[Point<T>],
    query: Point<f64>,
    tolerance: f64,
) -> Option<Nearest> {
    // Relative to the query, so that far from the origin no digits are lost.
    let local = |segment: &[Point<T>; 4]| segment.map(|p| p.to_f64() - query);
    let segments = || points.array_windows().map(local).enumerate();
    // A good first guess lets the search skip whole segments.
    let starts = segments().map(|(i, p)| Nearest::new(i, 0.0, uniform::start(&p)));
    let mut best = starts.min_by(|a, b| a.distance.total_cmp(&b.distance))?;
    for (index, p) in segments() {
        let size = p.iter().map(|p| p.norm()).fold(0.0, f64::max);
        let mut search = Search {
            index,
            tolerance: tolerance.max(1e-12 * size),
            best,
        };
        search.visit(&p, (0.0, 1.0), MAX_HALVINGS);
        best = search.best;
    }
    best.point = query + best.point;
    Some(best)
}

impl Nearest {
    /// A candidate whose `point` is relative to the query.
    fn new(segment: usize, t: f64, point: Point<f64>) -> Self {
        Self {
            segment,
            t,
            point,
            distance: point.norm(),
        }
    }
}

/// Search of the segment `index` for a point nearer to the origin, which is the query.
struct Search {
    index: usize,
    tolerance: f64,
    best: Nearest,
}

impl Search {
    /// Visits the part of the segment from t = a to b.
    fn visit(&mut self, part: &[Point<f64>; 4], (a, b): (f64, f64), halvings_left: u32) {
        let [start, first, second, end] = uniform::to_bezier(part);
        let chord = Chord { start, end };
        let s = chord.nearest(Point::new(0.0, 0.0));
        let flatness = chord.distance(first).max(chord.distance(second));
        let least = start.lerp(end, s).norm() - flatness;
        if least + self.tolerance >= self.best.distance {
            return;
        }
        let t = a + (b - a) * s;
        let candidate = Nearest::new(self.index, t, uniform::point(part, s));
        if candidate.distance < self.best.distance {
            self.best = candidate;
        }
        if halvings_left == 0 || least + self.tolerance >= self.best.distance {
            return;
        }
        let middle = 0.5 * (a + b);
        let [left, right] = uniform::halves(part);
        let mut order = [(left, (a, middle)), (right, (middle, b))];
        if s > 0.5 {
            order.reverse();
        }
        for (half, range) in order {
            self.visit(&half, range, halvings_left - 1);
        }
    }
}

struct Chord {
    start: Point<f64>,
    end: Point<f64>,
}

impl Chord {
    /// Parameter, 0 to 1, of the point of the chord nearest to `point`.
    fn nearest(&self, point: Point<f64>) -> f64 {
        let vector = self.end - self.start;
        let length_squared = vector.dot(vector);
        if length_squared > 0.0 {
            ((point - self.start).dot(vector) / length_squared).clamp(0.0, 1.0)
        } else {
            0.0
        }
    }

    fn distance(&self, point: Point<f64>) -> f64 {
        let foot = self.start.lerp(self.end, self.nearest(point));
        point.distance(foot)
    }
}
