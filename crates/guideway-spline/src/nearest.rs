use crate::{Point, Real, uniform};

/// How often a segment is halved at most: its parts are then as short as the rounding of t.
const MAX_HALVINGS: u32 = 50;

/// The point of a run that is nearest to another point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Nearest {
    /// Index of the segment in the run.
    pub segment: usize,
    /// Parameter in the segment, 0 to 1.
    pub t: f64,
    /// The point on the curve.
    pub point: Point<f64>,
    /// How far it is from the other.
    pub distance: f64,
}

/// The point of a run nearest to `query`; none if the run has fewer than four points.
///
/// No other point of the run is nearer by more than `tolerance` (unit of the points), which is raised
/// to 10^-12 of the distances involved if it is below.
///
/// Branch and bound: a part of the curve is within f of its chord, f being the greatest distance of its
/// Bezier points from the chord (see [`flatten_run`](crate::flatten_run)); so it can be skipped if the
/// chord is farther from `query` than the best found plus f. Halving divides f by four: a few steps
/// a segment, but sqrt(radius / tolerance) of them around the center of an arc.
pub fn nearest_on_run<T: Real>(
    points: &[Point<T>],
    query: Point<f64>,
    tolerance: f64,
) -> Option<Nearest> {
    // Relative to the query, so that far from the origin no digits are lost.
    let local = |segment: &[Point<T>; 4]| segment.map(|p| p.to_f64() - query);
    let segments = || points.array_windows().map(local).enumerate();
    // A good guess first lets whole segments be skipped.
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
    /// A candidate: `point` is still relative to the query.
    fn new(segment: usize, t: f64, point: Point<f64>) -> Self {
        Self {
            segment,
            t,
            point,
            distance: point.norm(),
        }
    }
}

/// Looks through the segment `index` for a point nearer to the origin.
struct Search {
    index: usize,
    tolerance: f64,
    best: Nearest,
}

impl Search {
    /// `part` is the segment from t = a to b.
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
    /// Fraction of the way at the point of the chord nearest to `point`.
    fn nearest(&self, point: Point<f64>) -> f64 {
        let way = self.end - self.start;
        let length_squared = way.dot(way);
        if length_squared > 0.0 {
            ((point - self.start).dot(way) / length_squared).clamp(0.0, 1.0)
        } else {
            0.0
        }
    }

    fn distance(&self, point: Point<f64>) -> f64 {
        let foot = self.start.lerp(self.end, self.nearest(point));
        point.distance(foot)
    }
}
