use std::cmp::Ordering;

use guideway_spline::{Bounds, Point};

type P = Point<f64>;

/// A convex polygon in meters: its corners counter-clockwise, from the leftmost (of these the lowest). A
/// line has two corners, a point one.
#[derive(Clone, Debug, PartialEq)]
pub struct ConvexPolygon {
    points: Vec<P>,
}

impl ConvexPolygon {
    /// The smallest that holds all points; none if there are none. Corners that only rounding tells apart are one:
    /// the edge between them would have no direction, and the order of edges is that of their directions.
    ///
    /// EnvelopeSource: Andrew's monotone chain (1979).
    pub fn hull(points: impl IntoIterator<Item = P>) -> Option<Self> {
        // Adding zero leaves one of the two zeros.
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
        // The first comes again at the end, if there is another.
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

    /// The box around it.
    pub fn bounds(&self) -> Bounds<f64> {
        let first = Bounds {
            min: self.points[0],
            max: self.points[0],
        };
        let others = self.points[1..].iter();
        others.fold(first, |all, &p| all.union(Bounds { min: p, max: p }))
    }

    /// Its area.
    pub fn area_m2(&self) -> f64 {
        let from = self.points[0];
        let corners = self.points[1..].windows(2);
        let twice = corners.map(|ends| (ends[0] - from).cross(ends[1] - from));
        twice.sum::<f64>() / 2.0
    }

    /// Its two halves, left and right or below and above the middle of its box, whichever cuts the longer side.
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
        // A point has no halves but itself.
        halves.map(|half| Self::hull(half).unwrap_or_else(|| self.clone()))
    }

    /// Whether a point is inside or on the border.
    pub fn contains(&self, point: P) -> bool {
        let mut nearest = OriginDistance::default();
        self.points.iter().for_each(|&p| nearest.add(p - point));
        nearest.distance() == 0.0
    }

    /// All sums of a point of one and a point of the other (Minkowski): the edges of both in the order of
    /// their directions (de Berg et al., Computational Geometry, 13.3).
    #[must_use]
    pub fn sum(&self, other: &Self) -> Self {
        let mut points = Vec::with_capacity(self.points.len() + other.points.len());
        let second = Ring::new(&other.points);
        Ring::new(&self.points).add(second, |p| points.push(p));
        // Rounding may have made another corner the leftmost.
        Self::hull(points).expect("there are corners")
    }

    /// How far it is from another, zero if they meet: the distance of the origin from their difference.
    pub fn distance(&self, other: &Self) -> f64 {
        let mut nearest = OriginDistance::default();
        let second = Ring::mirrored(&other.points);
        Ring::new(&self.points).add(second, |p| nearest.add(p));
        nearest.distance()
    }
}

/// The corners of a polygon from its leftmost (lowest) on, as they are or mirrored in the origin.
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
        // The rightmost (highest) becomes the leftmost (lowest).
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

    /// Visits the corners of the sum with another, counter-clockwise.
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

/// Which of two edges comes first around a polygon that begins at its leftmost corner.
fn by_direction(a: P, b: P) -> Ordering {
    let is_back = |e: P| e.x < 0.0 || (e.x == 0.0 && e.y < 0.0);
    let half = is_back(a).cmp(&is_back(b));
    // Adding zero makes one of the two zeros.
    half.then_with(|| 0.0_f64.total_cmp(&(a.cross(b) + 0.0)))
}

/// The distance of the origin from a polygon whose corners come one by one.
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
        // The origin is inside if it is to the left of all edges.
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
        // Also of a line or a point, which has no inside.
        self.edge(self.last, first);
        if self.is_outside {
            self.square.unwrap_or(0.0).sqrt()
        } else {
            0.0
        }
    }
}
