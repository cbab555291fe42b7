//! Clusters: a common origin for neighboring strokes, and the quantization of their points.

use guideway_spline::{Bounds, Point};

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
        let origin = bounds.center();
        let high = origin.to_f32();
        let low = (origin - high.to_f64()).to_f32();
        let mut cluster = Self {
            origin_high_m: [high.x, high.y],
            origin_low_m: [low.x, low.y],
            low_m: [0.0; 2],
            high_m: [0.0; 2],
            widest_m: -1.0,
            step_m,
            first_point: 0,
            points: 0,
            first_stroke: 0,
            strokes: 0,
        };
        let local = ClusterOrigin::of(&cluster);
        // Rounding must not shrink the box.
        let grown = |p: [f32; 2], by: f32| p.map(|v| v + by * (v.abs() * f32::EPSILON + step_m));
        cluster.low_m = grown(local.local_m(bounds.min), -1.0);
        cluster.high_m = grown(local.local_m(bounds.max), 1.0);
        cluster
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
        // The conversion saturates.
        let [x, y] = local_m.map(|v| u32::from((v / self.step_m).round() as i16 as u16));
        x | y << 16
    }

    /// Grows the box to contain a point, quantized or not.
    pub(crate) fn include(&mut self, [x, y]: [f32; 2]) {
        let off_m = self.step_m;
        self.low_m = [self.low_m[0].min(x - off_m), self.low_m[1].min(y - off_m)];
        self.high_m = [self.high_m[0].max(x + off_m), self.high_m[1].max(y + off_m)];
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
