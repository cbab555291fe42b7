//! Clusters: a common origin for neighboring strokes, and the quantization of their points.

use guideway_spline::{Affine, Bounds, Point};

use crate::tiles::layouts::{Cluster, PointFormat};

/// Converts world coordinates to those of a cluster.
#[derive(Clone, Copy)]
pub(crate) struct ClusterOrigin {
    origin_m: Point<f64>,
}

impl ClusterOrigin {
    pub(crate) fn of(cluster: &Cluster) -> Self {
        let [high, low] =
            [cluster.origin_high_m, cluster.origin_low_m].map(|[x, y]| Point::new(x, y).to_f64());
        // The origin as the device computes it: two floats are as exact as a double.
        Self {
            origin_m: high + low,
        }
    }

    pub(crate) fn local_m(self, p: Point<f64>) -> [f32; 2] {
        let local = (p - self.origin_m).to_f32();
        [local.x, local.y]
    }
}

impl Cluster {
    /// A cluster without strokes, whose box contains `bounds`.
    pub(crate) fn within(bounds: Bounds<f64>, step_m: f32) -> Self {
        let [origin_high_m, origin_low_m] = split(bounds.center());
        let mut cluster = Self {
            origin_high_m,
            origin_low_m,
            low_m: [0.0; 2],
            high_m: [0.0; 2],
            widest_m: -1.0,
            step_m,
            first_point: 0,
            points: 0,
            first_stroke: 0,
            strokes: 0,
            stored_step_m: step_m,
            is_mapped: 0,
        };
        let local = ClusterOrigin::of(&cluster);
        // Rounding must not shrink the box.
        let grown = |p: [f32; 2], by: f32| p.map(|v| v + by * (v.abs() * f32::EPSILON + step_m));
        cluster.low_m = grown(local.local_m(bounds.min), -1.0);
        cluster.high_m = grown(local.local_m(bounds.max), 1.0);
        cluster
    }

    /// The cluster as a map shows its points, by the same points.
    pub(crate) fn mapped(&self, by: Affine) -> Self {
        let origin_m = by.apply(ClusterOrigin::of(self).origin_m);
        let [origin_high_m, origin_low_m] = split(origin_m);
        let moved = Self {
            origin_high_m,
            origin_low_m,
            ..*self
        };
        if by.as_translation().is_some() {
            return moved;
        }
        let linear = Affine {
            origin: Point::default(),
            ..by
        };
        let [min, max] = [self.low_m, self.high_m].map(|[x, y]| Point::new(x, y).to_f64());
        let corners = Bounds { min, max }.corners();
        let Some(local) = Bounds::of_points(corners.map(|p| linear.apply(p))) else {
            return moved;
        };
        // The device maps in single precision: each coordinate is a sum of two rounded products.
        let reach_m = corners[0].norm().max(corners[1].norm()) * stretch(by);
        let local = local.inflated(4.0 * f64::from(f32::EPSILON) * reach_m);
        let [low, high] = [local.min, local.max].map(Point::to_f32);
        Self {
            low_m: [low.x, low.y],
            high_m: [high.x, high.y],
            // A smaller step may leave the cluster where it is drawn from.
            step_m: self.stored_step_m * stretch(by).max(1.0) as f32,
            is_mapped: 1,
            ..moved
        }
    }

    /// Format of its points.
    pub(crate) fn format(&self) -> PointFormat {
        if self.step_m > 0.0 {
            PointFormat::Rounded
        } else {
            PointFormat::Exact
        }
    }

    /// Quantizes a point to two 16-bit multiples of the step.
    pub(crate) fn quantize(&self, local_m: [f32; 2]) -> u32 {
        // `f32::round` calls a function on most processors. The conversion truncates and saturates:
        // with the number below a half, halves round away from zero, and nothing else does.
        const HALF: f32 = 0.5_f32.next_down();
        let steps = local_m.map(|v| v / self.step_m);
        let [x, y] = steps.map(|v| u32::from((v + HALF.copysign(v)) as i16 as u16));
        x | y << 16
    }

    /// Returns `true` if the box contains points, quantized or not.
    pub(crate) fn includes(&self, points: LocalBox) -> bool {
        let off_m = self.step_m;
        (0..2).all(|axis| {
            self.low_m[axis] <= points.low_m[axis] - off_m
                && self.high_m[axis] >= points.high_m[axis] + off_m
        })
    }

    /// Grows the box to contain points, quantized or not.
    pub(crate) fn include(&mut self, points: LocalBox) {
        let off_m = self.step_m;
        for axis in 0..2 {
            self.low_m[axis] = self.low_m[axis].min(points.low_m[axis] - off_m);
            self.high_m[axis] = self.high_m[axis].max(points.high_m[axis] + off_m);
        }
    }

    /// Bounding box of its control points in world coordinates.
    pub(crate) fn bounds(&self) -> Bounds<f64> {
        let origin = ClusterOrigin::of(self).origin_m;
        let world = |[x, y]: [f32; 2]| origin + Point::new(x, y).to_f64();
        Bounds {
            min: world(self.low_m),
            max: world(self.high_m),
        }
    }

    /// Greatest width of its strokes; `None` if none has its own.
    pub(crate) fn width_m(&self) -> Option<f32> {
        (self.widest_m >= 0.0).then_some(self.widest_m)
    }

    /// Greatest distance of a control point from the origin, along an axis.
    pub(crate) fn reach_m(&self) -> f32 {
        let ends = self.low_m.into_iter().chain(self.high_m);
        ends.map(f32::abs).fold(0.0, f32::max)
    }
}

/// Least and greatest coordinates of points, relative to the origin of a cluster.
#[derive(Clone, Copy)]
pub(crate) struct LocalBox {
    pub(crate) low_m: [f32; 2],
    pub(crate) high_m: [f32; 2],
}

impl LocalBox {
    /// The box of points.
    pub(crate) fn of(points_m: &[[f32; 2]]) -> Self {
        let mut all = Self {
            low_m: [f32::INFINITY; 2],
            high_m: [f32::NEG_INFINITY; 2],
        };
        for &[x, y] in points_m {
            all.low_m = [all.low_m[0].min(x), all.low_m[1].min(y)];
            all.high_m = [all.high_m[0].max(x), all.high_m[1].max(y)];
        }
        all
    }
}

/// Splits a place into two floats per axis that together are nearly as exact as a double.
fn split(place_m: Point<f64>) -> [[f32; 2]; 2] {
    let high = place_m.to_f32();
    let low = (place_m - high.to_f64()).to_f32();
    [[high.x, high.y], [low.x, low.y]]
}

/// Greatest factor by which a map stretches a vector: its larger singular value.
fn stretch(by: Affine) -> f64 {
    let squares = by.x.dot(by.x) + by.y.dot(by.y);
    let area = by.x.cross(by.y);
    let root = (squares * squares - 4.0 * area * area).max(0.0).sqrt();
    ((squares + root) / 2.0).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_round_to_the_nearest_step_halves_away_from_zero() {
        let cluster = Cluster {
            step_m: 1.0,
            ..bytemuck::Zeroable::zeroed()
        };
        let halves = (-66_000..66_000).map(|half| half as f32 / 2.0);
        let numbers = halves.flat_map(|half| [half.next_down(), half, half.next_up()]);
        for v in numbers.chain([0.499_999_97, -0.499_999_97, 1e9, -1e9]) {
            let expected = u32::from(v.round() as i16 as u16);
            assert_eq!(cluster.quantize([v, 0.0]), expected, "{v}");
        }
    }
}
