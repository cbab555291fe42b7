//! Paths as the device reads them: strokes near each other in clusters, each with an origin of its own.

use guideway_layout::Layout;
use guideway_scene::Scene;
use guideway_spline::{Bounds, Point, hilbert};

use super::params::{
    CLUSTER_STROKES, Cluster, PathStyle, SEGMENTS_BIT, STROKE_SEGMENTS, Stroke, WHOLE_PATH,
};

/// Paths for the device. Clusters count points and strokes from the first of these.
#[derive(Default)]
pub(super) struct Packed {
    pub(super) points_m: Vec<[f32; 2]>,
    pub(super) strokes: Vec<Stroke>,
    pub(super) clusters: Vec<Cluster>,
}

/// A part of a run of a path.
#[derive(Clone, Copy)]
pub(super) struct Part {
    pub(super) path: u32,
    rank: u32,
    run: u32,
    first_point: u32,
    pub(super) segments: u32,
    pub(super) is_whole: bool,
}

/// Points from the origin of a cluster.
#[derive(Clone, Copy)]
pub(super) struct Local {
    origin_m: Point<f64>,
}

impl Local {
    pub(super) fn of(cluster: &Cluster) -> Self {
        let [high, low] =
            [cluster.origin_high_m, cluster.origin_low_m].map(|[x, y]| Point::new(x, y).to_f64());
        // What the device takes for the origin; two floats are as exact as a double.
        Self {
            origin_m: high + low,
        }
    }

    pub(super) fn of_world(self, p: Point<f64>) -> [f32; 2] {
        let local = (p - self.origin_m).to_f32();
        [local.x, local.y]
    }
}

impl Packed {
    /// Packs parts. Neighbours in the world become neighbours in memory.
    pub(super) fn of(scene: &Scene, mut parts: Vec<Part>) -> Self {
        let mut packed = Self::default();
        sort_by_place(scene, &mut parts);
        for cluster in parts.chunks(CLUSTER_STROKES as usize) {
            packed.add_cluster(scene, cluster);
        }
        packed
    }

    fn add_cluster(&mut self, scene: &Scene, parts: &[Part]) {
        let layout = scene.layout();
        let points = || parts.iter().flat_map(|part| part.points(layout));
        let Some(bounds) = Bounds::of_points(points()) else {
            return;
        };
        let origin = bounds.center();
        let high = origin.to_f32();
        let low = (origin - high.to_f64()).to_f32();
        let mut cluster = Cluster {
            origin_high_m: [high.x, high.y],
            origin_low_m: [low.x, low.y],
            low_m: [0.0; 2],
            high_m: [0.0; 2],
            widest_m: -1.0,
            first_point: self.points_m.len() as u32,
            points: 0,
            first_stroke: self.strokes.len() as u32,
            strokes: parts.len() as u32,
            padding: 0,
        };
        let local = Local::of(&cluster);
        // Rounding must not make the box smaller.
        let grown = |p: [f32; 2], by: f32| p.map(|v| v + by * (v.abs() * f32::EPSILON));
        cluster.low_m = grown(local.of_world(bounds.min), -1.0);
        cluster.high_m = grown(local.of_world(bounds.max), 1.0);
        for part in parts {
            let width_m = scene.width_m(part.path).unwrap_or(-1.0);
            cluster.widest_m = cluster.widest_m.max(width_m);
            let first_point = self.points_m.len() as u32 - cluster.first_point;
            self.strokes.push(part.stroke(first_point));
            self.points_m
                .extend(part.points(layout).map(|p| local.of_world(p)));
        }
        cluster.points = self.points_m.len() as u32 - cluster.first_point;
        self.clusters.push(cluster);
    }
}

impl Cluster {
    /// Has a box that holds this point.
    pub(super) fn hold(&mut self, [x, y]: [f32; 2]) {
        self.low_m = [self.low_m[0].min(x), self.low_m[1].min(y)];
        self.high_m = [self.high_m[0].max(x), self.high_m[1].max(y)];
    }

    /// The box of its control points in the world.
    pub(super) fn bounds(&self) -> Bounds<f64> {
        let origin = Local::of(self).origin_m;
        let world = |[x, y]: [f32; 2]| origin + Point::new(x, y).to_f64();
        Bounds {
            min: world(self.low_m),
            max: world(self.high_m),
        }
    }

    /// Greatest distance of a control point from the origin, along an axis.
    pub(super) fn reach_m(&self) -> f32 {
        let ends = self.low_m.into_iter().chain(self.high_m);
        ends.map(f32::abs).fold(0.0, f32::max)
    }
}

impl Part {
    /// The parts of a path, of at most 32 segments each.
    pub(super) fn of_path(layout: &Layout, path: u32, rank: u32, parts: &mut Vec<Self>) {
        let first = parts.len();
        for (run, index) in layout.paths.get(path as usize).runs().zip(0..) {
            let segments = run.len() - 3;
            for first in (0..segments).step_by(STROKE_SEGMENTS) {
                parts.push(Self {
                    path,
                    rank,
                    run: index,
                    first_point: first as u32,
                    segments: (segments - first).min(STROKE_SEGMENTS) as u32,
                    is_whole: false,
                });
            }
        }
        if let [whole] = &mut parts[first..] {
            whole.is_whole = true;
        }
    }

    pub(super) fn stroke(&self, first_point: u32) -> Stroke {
        let whole = if self.is_whole { WHOLE_PATH } else { 0 };
        Stroke {
            extent: first_point | self.segments << SEGMENTS_BIT | whole,
            rank: self.rank,
        }
    }

    pub(super) fn points<'a>(
        &self,
        layout: &'a Layout,
    ) -> impl Iterator<Item = Point<f64>> + use<'a> {
        let mut runs = layout.paths.get(self.path as usize).runs();
        let run = runs.nth(self.run as usize);
        let first = self.first_point as usize;
        let points = first..first + self.segments as usize + 3;
        points.filter_map(move |index| Some(run.as_ref()?.get(index)))
    }
}

/// What a path looks like.
pub(super) fn style(scene: &Scene, row: u32) -> PathStyle {
    PathStyle {
        color: device_color(scene.color(row)),
        width_m: scene.width_m(row).unwrap_or(-1.0),
    }
}

/// A colour as the device's pixels have it: red in the lowest byte.
pub(super) fn device_color(color: guideway_scene::Rgba) -> u32 {
    u32::from_le_bytes([color.r, color.g, color.b, color.a])
}

/// Sorts parts so that neighbours stay together: by the middle of their ends.
fn sort_by_place(scene: &Scene, parts: &mut [Part]) {
    let Some(bounds) = scene.bounds() else {
        return;
    };
    let layout = scene.layout();
    parts.sort_by_cached_key(|part| {
        let mut points = part.points(layout);
        let first = points.next().unwrap_or_default();
        let last = points.last().unwrap_or(first);
        hilbert(first + (last - first) * 0.5, bounds)
    });
}
