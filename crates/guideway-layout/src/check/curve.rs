use guideway_spline::{Point, segment_length, uniform};

use super::cubic;
use crate::PathRef;

/// Number of points, evenly spaced along a curve, by which two curves are compared.
pub(super) const SAMPLES: usize = 9;

/// Points of a curve at equal steps of length, both ends included.
pub(super) type Samples = [Point<f64>; SAMPLES];

type Segment = [Point<f64>; 4];

/// The curve of one path; its buffers are used again for the next.
#[derive(Debug, Default)]
pub(super) struct Curve {
    segments: Vec<Segment>,
    lengths_m: Vec<f64>,
}

impl Curve {
    /// Takes the curve of a path in place of the one before.
    pub(super) fn load(&mut self, path: PathRef<'_>) {
        self.segments.clear();
        self.segments
            .extend(path.runs().flat_map(|run| run.segments()));
    }

    /// Where it begins and ends; none if there is no curve or it is not finite.
    pub(super) fn ends(&self) -> Option<[Point<f64>; 2]> {
        let ends = [
            uniform::start(self.segments.first()?),
            uniform::end(self.segments.last()?),
        ];
        ends.iter().all(|p| p.is_finite()).then_some(ends)
    }

    /// How far it swings to one side of its chord. Cheap, and the same however it is put together.
    pub(super) fn swing(&self) -> Swing {
        let origin = self
            .segments
            .first()
            .map_or_else(Point::default, uniform::start);
        let (mut swing, mut end) = (Swing::default(), Point::default());
        for segment in &self.segments {
            let b = uniform::to_bezier(segment).map(|p| p - origin);
            // A gap between runs counts as the straight line across it.
            swing.add(&[end, end, b[0], b[0]]);
            swing.add(&b);
            end = b[3];
        }
        swing
    }

    /// Whether the control points are those of a path, one by one: then so is the curve.
    pub(super) fn has_points_of(&self, path: PathRef<'_>, reversed: bool, within_m: f64) -> bool {
        if path.runs().map(|run| run.segments().len()).sum::<usize>() != self.segments.len() {
            return false;
        }
        let close = |a: Point<f64>, b: Point<f64>| a.distance(b) <= within_m;
        let mut theirs = path.runs().flat_map(|run| run.segments());
        if reversed {
            let mut pairs = self.segments.iter().rev().zip(theirs);
            pairs.all(|(a, b)| (0..4).all(|i| close(a[i], b[3 - i])))
        } else {
            let mut own = self.segments.iter();
            own.all(|a| {
                theirs
                    .next()
                    .is_some_and(|b| (0..4).all(|i| close(a[i], b[i])))
            })
        }
    }

    /// Points at equal steps of length, found this closely along the curve. They do not depend on how
    /// the curve is put together.
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

/// The area between a curve and its chord, to the left of the curve.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Swing {
    area_m2: f64,
    /// The curve is not longer than this.
    reach_m: f64,
}

impl Swing {
    /// Adds the sector from the origin to a Bezier curve.
    fn add(&mut self, b: &Segment) {
        let near = b[0].cross(b[1]) + b[2].cross(b[3]);
        let far = b[0].cross(b[2]) + b[1].cross(b[2]) + b[1].cross(b[3]);
        // Half the integral of C x C'.
        self.area_m2 += 0.05 * (6.0 * near + 3.0 * far + b[0].cross(b[3]));
        self.reach_m += b.windows(2).map(|leg| leg[0].distance(leg[1])).sum::<f64>();
    }

    /// Whether the two can belong to curves that are nowhere farther than this from each other.
    pub(super) fn may_match(self, other: Self, reversed: bool, within_m: f64) -> bool {
        let own_m2 = if reversed {
            -self.area_m2
        } else {
            self.area_m2
        };
        // The strip between them is no longer than the two, and no wider than `within_m`.
        (own_m2 - other.area_m2).abs() <= within_m * (self.reach_m + other.reach_m + within_m)
    }
}

/// The parameter at which a segment of `whole_m` has run `target_m`.
fn parameter_at(segment: &Segment, target_m: f64, whole_m: f64, precision_m: f64) -> f64 {
    if target_m >= whole_m {
        return 1.0;
    }
    let bezier = uniform::to_bezier(segment);
    let (mut low, mut high) = (0.0, 1.0);
    let mut t = target_m / whole_m;
    for _ in 0..40 {
        let [part, _] = cubic::split(&bezier, t);
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
