//! Convex polygons: hull, Minkowski sum and distance.
//!
//! ```text
//!    A + B: merge the edges of both by direction       distance(A, B) = distance of the
//!    O(n + m)                                          origin from A + (-B); 0 inside
//! ```

use std::cmp::Ordering;

use guideway_spline::{Bounds, Point};

type P = Point<f64>;

/// A convex polygon in meters: its corners counter-clockwise from the leftmost, and of several
/// leftmost ones the lowest. A line segment has two corners, a point has one.
#[derive(Clone, Debug, PartialEq)]
pub struct ConvexPolygon {
    points: Vec<P>,
}

impl ConvexPolygon {
    /// The convex hull of points; `None` without points. Merges corners that differ by rounding
    /// errors only, because the edge between them has no reliable direction.
    ///
    /// Source: Andrew's monotone chain (1979). Cost: O(n log n).
    pub fn hull(points: impl IntoIterator<Item = P>) -> Option<Self> {
        // Adding 0 turns -0 into 0, so that equal points are adjacent after sorting.
        let points = points.into_iter().map(|p| p + P::default());
        let mut sorted: Vec<P> = points.collect();
        sorted.sort_unstable_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
        sorted.dedup();
        let mut hull: Vec<P> = Vec::with_capacity(sorted.len() + 1);
        let lower = sorted.iter();
        let upper = sorted.iter().rev().skip(1);
        let mut kept = 1;
        for (i, &p) in lower.chain(upper).enumerate() {
            if i == sorted.len() {
                kept = hull.len();
            }
            while let [.., a, b] = hull[..]
                && hull.len() > kept
                && (b - a).cross(p - b) <= 0.0
            {
                hull.pop();
            }
            hull.push(p);
        }
        // The upper chain ends at the first point.
        if hull.len() > 1 {
            hull.pop();
        }
        let far = |m: f64, p: &P| m.max(p.x.abs()).max(p.y.abs());
        let noise_m = 32.0 * f64::EPSILON * sorted.iter().fold(0.0, far);
        let is_noise = |apart: P| apart.dot(apart) <= noise_m * noise_m;
        hull.dedup_by(|p, kept| is_noise(*p - *kept));
        if let [first, .., last] = hull[..]
            && is_noise(first - last)
        {
            hull.pop();
        }
        (!hull.is_empty()).then_some(Self { points: hull })
    }

    /// The corners.
    pub fn points(&self) -> &[P] {
        &self.points
    }

    /// The bounding box.
    pub fn bounds(&self) -> Bounds<f64> {
        let first = Bounds {
            min: self.points[0],
            max: self.points[0],
        };
        let others = self.points[1..].iter();
        others.fold(first, |all, &p| all.union(Bounds { min: p, max: p }))
    }

    /// The area, in square meters.
    pub fn area_m2(&self) -> f64 {
        let from = self.points[0];
        let corners = self.points[1..].windows(2);
        let twice = corners.map(|ends| (ends[0] - from).cross(ends[1] - from));
        twice.sum::<f64>() / 2.0
    }

    /// Its two halves: cut across the longer side of the bounding box, through its center.
    pub(crate) fn halves(&self) -> [Self; 2] {
        let size = self.bounds().size();
        let middle = self.bounds().center();
        let side = |p: P| match size.x >= size.y {
            true => p.x - middle.x,
            false => p.y - middle.y,
        };
        let mut halves = [Vec::new(), Vec::new()];
        for (i, &p) in self.points.iter().enumerate() {
            let next = self.points[(i + 1) % self.points.len()];
            let (here, there) = (side(p), side(next));
            halves[usize::from(here > 0.0)].push(p);
            if here == 0.0 {
                halves[1].push(p);
            } else if here * there < 0.0 {
                let cut = p.lerp(next, here / (here - there));
                halves.iter_mut().for_each(|half| half.push(cut));
            }
        }
        // Both halves of a point are the point.
        halves.map(|half| Self::hull(half).unwrap_or_else(|| self.clone()))
    }

    /// Returns `true` if a point is inside or on the boundary.
    pub fn contains(&self, point: P) -> bool {
        let mut nearest = OriginDistance::default();
        self.points.iter().for_each(|&p| nearest.add(p - point));
        nearest.distance() == 0.0
    }

    /// The Minkowski sum: all sums of a point of each polygon.
    ///
    /// Source: de Berg et al., Computational Geometry, 13.3. Cost: O(n + m).
    #[must_use]
    pub fn sum(&self, other: &Self) -> Self {
        let mut points = Vec::with_capacity(self.points.len() + other.points.len());
        let second = Ring::new(&other.points);
        Ring::new(&self.points).add(second, |p| points.push(p));
        // Rounding may change the leftmost corner.
        Self::hull(points).expect("there are corners")
    }

    /// The distance from another polygon; 0 if they touch or overlap. Computed as the distance of
    /// the origin from their Minkowski difference. Cost: O(n + m).
    pub fn distance(&self, other: &Self) -> f64 {
        let mut nearest = OriginDistance::default();
        let second = Ring::mirrored(&other.points);
        Ring::new(&self.points).add(second, |p| nearest.add(p));
        nearest.distance()
    }
}

/// The corners of a polygon, or of its reflection in the origin, from the leftmost (lowest) one.
#[derive(Clone, Copy)]
struct Ring<'a> {
    points: &'a [P],
    first: usize,
    sign: f64,
}

impl<'a> Ring<'a> {
    fn new(points: &'a [P]) -> Self {
        Self {
            points,
            first: 0,
            sign: 1.0,
        }
    }

    fn mirrored(points: &'a [P]) -> Self {
        // The reflection maps the rightmost (highest) corner to the leftmost (lowest) one.
        let rank = |p: P, q: P| p.x.total_cmp(&q.x).then(p.y.total_cmp(&q.y));
        let last = (0..points.len()).max_by(|&i, &j| rank(points[i], points[j]));
        Self {
            points,
            first: last.unwrap_or(0),
            sign: -1.0,
        }
    }

    fn point(&self, i: usize) -> P {
        let (at, count) = (self.first + i, self.points.len());
        self.points[if at < count { at } else { at - count }] * self.sign
    }

    fn edge(&self, i: usize) -> Option<P> {
        let edges = match self.points.len() {
            1 => 0,
            corners => corners,
        };
        (i < edges).then(|| self.point(i + 1) - self.point(i))
    }

    /// Visits the corners of the Minkowski sum with another ring, counter-clockwise.
    fn add(self, other: Self, mut visit: impl FnMut(P)) {
        let (mut i, mut j) = (0, 0);
        loop {
            visit(self.point(i) + other.point(j));
            let order = match (self.edge(i), other.edge(j)) {
                (Some(a), Some(b)) => by_direction(a, b),
                (Some(_), None) => Ordering::Less,
                (None, Some(_)) => Ordering::Greater,
                (None, None) => return,
            };
            i += usize::from(order != Ordering::Greater);
            j += usize::from(order != Ordering::Less);
            if self.edge(i).is_none() && other.edge(j).is_none() {
                return;
            }
        }
    }
}

/// The order of two edges around a polygon that starts at its leftmost corner.
fn by_direction(a: P, b: P) -> Ordering {
    let is_back = |e: P| e.x < 0.0 || (e.x == 0.0 && e.y < 0.0);
    let half = is_back(a).cmp(&is_back(b));
    // Adding 0 turns -0 into 0.
    half.then_with(|| 0.0_f64.total_cmp(&(a.cross(b) + 0.0)))
}

/// Computes the distance of the origin from a polygon, one corner at a time.
#[derive(Default)]
struct OriginDistance {
    first: Option<P>,
    last: P,
    square: Option<f64>,
    is_outside: bool,
}

impl OriginDistance {
    fn add(&mut self, p: P) {
        match self.first {
            None => {
                self.first = Some(p);
                self.square = Some(p.dot(p));
            }
            Some(_) => self.edge(self.last, p),
        }
        self.last = p;
    }

    fn edge(&mut self, from: P, to: P) {
        let way = to - from;
        // The origin is inside if it is to the left of every edge.
        self.is_outside |= from.cross(to) <= 0.0;
        let t = (-from.dot(way) / way.dot(way)).clamp(0.0, 1.0);
        let foot = if t.is_nan() { from } else { from + way * t };
        let square = foot.dot(foot);
        self.square = Some(self.square.map_or(square, |least| least.min(square)));
    }

    fn distance(mut self) -> f64 {
        let Some(first) = self.first else {
            return f64::INFINITY;
        };
        // Closes the polygon; also marks a line segment or a point, which has no inside.
        self.edge(self.last, first);
        if self.is_outside {
            self.square.unwrap_or(0.0).sqrt()
        } else {
            0.0
        }
    }
}
