//! [`Curve`]: the curve of one path in forms that are independent of its division into runs.
//!
//! `same_curve` compares two curves by tests of increasing cost: end points, area between curve and
//! chord, control points, points at equal steps of arc length.

use guideway_spline::{Point, bezier, segment_length, uniform};

use crate::PathRef;

/// Points per curve in the comparison of two curves.
pub(super) const SAMPLES: usize = 9;

/// Points of a curve at equal steps of arc length, including both ends.
pub(super) type Samples = [Point<f64>; SAMPLES];

type Segment = [Point<f64>; 4];

/// The curve of one path. Its buffers serve one path after the other.
#[derive(Debug, Default)]
pub(super) struct Curve {
    segments: Vec<Segment>,
    lengths_m: Vec<f64>,
}

impl Curve {
    /// Replaces the curve by that of a path.
    pub(super) fn load(&mut self, path: PathRef<'_>) {
        self.segments.clear();
        self.segments
            .extend(path.runs().flat_map(|run| run.segments()));
    }

    /// Start and end; `None` if there is no curve or an end is not finite.
    pub(super) fn ends(&self) -> Option<[Point<f64>; 2]> {
        let ends = [
            uniform::start(self.segments.first()?),
            uniform::end(self.segments.last()?),
        ];
        ends.iter().all(|p| p.is_finite()).then_some(ends)
    }

    /// Area between curve and chord. Cheap, and independent of the division into segments.
    pub(super) fn chord_area(&self) -> ChordArea {
        let origin = self
            .segments
            .first()
            .map_or_else(Point::default, uniform::start);
        let (mut area, mut end) = (ChordArea::default(), Point::default());
        for segment in &self.segments {
            let b = uniform::to_bezier(segment).map(|p| p - origin);
            // A gap between runs counts as the straight line across it.
            area.add(&[end, end, b[0], b[0]]);
            area.add(&b);
            end = b[3];
        }
        area
    }

    /// Returns `true` if each control point is within `within_m` of that of a path: then so is the
    /// curve.
    pub(super) fn has_points_of(&self, path: PathRef<'_>, reversed: bool, within_m: f64) -> bool {
        if path.runs().map(|run| run.segments().len()).sum::<usize>() != self.segments.len() {
            return false;
        }
        let is_near = |a: Point<f64>, b: Point<f64>| a.distance(b) <= within_m;
        let mut theirs = path.runs().flat_map(|run| run.segments());
        if reversed {
            let mut pairs = self.segments.iter().rev().zip(theirs);
            pairs.all(|(a, b)| (0..4).all(|i| is_near(a[i], b[3 - i])))
        } else {
            let mut own = self.segments.iter();
            own.all(|a| {
                theirs
                    .next()
                    .is_some_and(|b| (0..4).all(|i| is_near(a[i], b[i])))
            })
        }
    }

    /// Points at equal steps of arc length, located within `precision_m` along the curve. They do
    /// not depend on the division into segments.
    ///
    /// # Panics
    /// When there is no segment.
    pub(super) fn samples(&mut self, precision_m: f64) -> Samples {
        self.lengths_m.clear();
        self.lengths_m
            .extend(self.segments.iter().map(|s| segment_length(s, precision_m)));
        let total_m: f64 = self.lengths_m.iter().sum();
        let mut points = [uniform::start(&self.segments[0]); SAMPLES];
        let (mut index, mut passed_m) = (0, 0.0);
        for (i, point) in points.iter_mut().enumerate().skip(1) {
            let target_m = total_m * i as f64 / (SAMPLES - 1) as f64;
            while index + 1 < self.segments.len() && passed_m + self.lengths_m[index] < target_m {
                passed_m += self.lengths_m[index];
                index += 1;
            }
            let segment = &self.segments[index];
            let t = parameter_at(
                segment,
                target_m - passed_m,
                self.lengths_m[index],
                precision_m,
            );
            *point = uniform::point(segment, t);
        }
        points
    }
}

/// The signed area between a curve and its chord, positive to the left of the curve.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct ChordArea {
    area_m2: f64,
    /// Upper bound of the length of the curve.
    length_bound_m: f64,
}

impl ChordArea {
    /// Adds the area of the sector between the origin and a Bezier curve.
    fn add(&mut self, b: &Segment) {
        let near = b[0].cross(b[1]) + b[2].cross(b[3]);
        let far = b[0].cross(b[2]) + b[1].cross(b[2]) + b[1].cross(b[3]);
        // Green's theorem: half the integral of C x C', in Bezier coefficients.
        self.area_m2 += 0.05 * (6.0 * near + 3.0 * far + b[0].cross(b[3]));
        self.length_bound_m += b.windows(2).map(|leg| leg[0].distance(leg[1])).sum::<f64>();
    }

    /// Returns `true` if the areas allow curves whose distance is at most `within_m` everywhere.
    pub(super) fn may_match(self, other: Self, reversed: bool, within_m: f64) -> bool {
        let own_m2 = if reversed {
            -self.area_m2
        } else {
            self.area_m2
        };
        // The strip between the curves is no longer than both together, and no wider than
        // `within_m`.
        let length_m = self.length_bound_m + other.length_bound_m + within_m;
        (own_m2 - other.area_m2).abs() <= within_m * length_m
    }
}

/// The parameter at arc length `target_m` of a segment of length `whole_m`, by Newton's method with
/// bisection as a safeguard.
fn parameter_at(segment: &Segment, target_m: f64, whole_m: f64, precision_m: f64) -> f64 {
    if target_m >= whole_m {
        return 1.0;
    }
    let bezier = uniform::to_bezier(segment);
    let (mut low, mut high) = (0.0, 1.0);
    let mut t = target_m / whole_m;
    for _ in 0..40 {
        let [part, _] = bezier::split(&bezier, t);
        let over_m = segment_length(&uniform::from_bezier(&part), precision_m) - target_m;
        if over_m.abs() <= precision_m {
            break;
        }
        if over_m > 0.0 {
            high = t;
        } else {
            low = t;
        }
        let newton = t - over_m / uniform::derivative(segment, t).norm();
        t = if low < newton && newton < high {
            newton
        } else {
            0.5 * (low + high)
        };
    }
    t
}
