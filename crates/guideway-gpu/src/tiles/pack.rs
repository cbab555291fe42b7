//! Paths as the device reads them: strokes near each other in clusters, each with an origin of its own.

use guideway_layout::Layout;
use guideway_scene::Scene;
use guideway_spline::{Bounds, Point, hilbert};

use super::params::{
    CLUSTER_STROKES, Cluster, PathStyle, Points, SEGMENTS_BIT, STROKE_SEGMENTS, Stroke, WHOLE_PATH,
};

/// The largest steps that points may be rounded to, in parts of the scene's size: a view of all of it would have to be
/// 16,384 pixels wide for them to be too coarse.
const STEPS_OF_SCENE: f64 = (1 << 20) as f64;
/// Steps from the origin of a cluster to the farthest place that its points may be moved to; 16 bits hold a few more.
const STEPS_TO_BORDER: f64 = 32_000.0;

/// How paths are packed, for as long as a scene is on the device.
#[derive(Clone, Copy)]
pub(super) struct Packing {
    /// Where the paths are.
    bounds_m: Bounds<f64>,
    /// Points in larger steps than this are not rounded.
    most_step_m: f64,
}

/// Paths for the device. Clusters count points and strokes from the first of these; rounded ones come first.
#[derive(Default)]
pub(super) struct Packed {
    pub(super) rounded: Vec<u32>,
    pub(super) exact_m: Vec<[f32; 2]>,
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

impl Packing {
    pub(super) fn of(scene: &Scene) -> Self {
        let bounds_m = scene.bounds().unwrap_or(Bounds {
            min: Point::default(),
            max: Point::default(),
        });
        let size_m = bounds_m.size();
        Self {
            bounds_m,
            most_step_m: size_m.x.max(size_m.y) / STEPS_OF_SCENE,
        }
    }

    /// The same, but nothing is rounded.
    pub(super) fn exact(self) -> Self {
        Self {
            most_step_m: 0.0,
            ..self
        }
    }

    /// Sorts parts so that neighbors stay together: by the middle of their ends. The strokes of a path lie in this order.
    pub(super) fn sort(&self, layout: &Layout, parts: &mut [Part]) {
        parts.sort_by_cached_key(|part| {
            let mut points = part.points(layout);
            let first = points.next().unwrap_or_default();
            let last = points.last().unwrap_or(first);
            hilbert(first + (last - first) * 0.5, self.bounds_m)
        });
    }

    /// The step of a cluster whose points fill a box of this size; zero if they are not rounded.
    fn step_m(&self, size_m: Point<f64>) -> f32 {
        let border_m = |size_m: f64| size_m / 2.0 + moves_m(size_m);
        let step_m = border_m(size_m.x).max(border_m(size_m.y)) / STEPS_TO_BORDER;
        if step_m <= self.most_step_m {
            step_m as f32
        } else {
            0.0
        }
    }
}

/// How far a cluster's points may go beyond its box of this size along an axis: farther away would make it too large to be of
/// use.
pub(super) fn moves_m(size_m: f64) -> f64 {
    size_m.max(1.0)
}

impl Packed {
    /// Packs parts. Neighbors in the world become neighbors in memory.
    pub(super) fn of(scene: &Scene, mut parts: Vec<Part>, packing: Packing) -> Self {
        let (mut packed, mut exact) = (Self::default(), Self::default());
        packing.sort(scene.layout(), &mut parts);
        for parts in parts.chunks(CLUSTER_STROKES as usize) {
            let points = parts.iter().flat_map(|part| part.points(scene.layout()));
            let Some(bounds) = Bounds::of_points(points) else {
                continue;
            };
            let cluster = Cluster::within(bounds, packing.step_m(bounds.size()));
            match cluster.held() {
                Points::Rounded => packed.add(scene, cluster, parts),
                Points::Exact => exact.add(scene, cluster, parts),
            }
        }
        let strokes = packed.strokes.len() as u32;
        packed.strokes.append(&mut exact.strokes);
        let behind = exact.clusters.into_iter().map(|cluster| Cluster {
            first_stroke: cluster.first_stroke + strokes,
            ..cluster
        });
        packed.clusters.extend(behind);
        packed.exact_m = exact.exact_m;
        packed
    }

    fn add(&mut self, scene: &Scene, mut cluster: Cluster, parts: &[Part]) {
        let layout = scene.layout();
        let local = Local::of(&cluster);
        let held = cluster.held();
        cluster.first_point = match held {
            Points::Rounded => self.rounded.len() as u32,
            Points::Exact => self.exact_m.len() as u32,
        };
        cluster.first_stroke = self.strokes.len() as u32;
        cluster.strokes = parts.len() as u32;
        for part in parts {
            let width_m = scene.width_m(part.path).unwrap_or(-1.0);
            cluster.widest_m = cluster.widest_m.max(width_m);
            let stroke = part.stroke(cluster.points);
            cluster.points += stroke.points();
            self.strokes.push(stroke);
            let points = part.points(layout).map(|p| local.of_world(p));
            match held {
                Points::Rounded => self.rounded.extend(points.map(|p| cluster.rounded(p))),
                Points::Exact => self.exact_m.extend(points),
            }
        }
        self.clusters.push(cluster);
    }
}

impl Cluster {
    /// One without strokes.
    fn within(bounds: Bounds<f64>, step_m: f32) -> Self {
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
        let local = Local::of(&cluster);
        // Rounding must not make the box smaller.
        let grown = |p: [f32; 2], by: f32| p.map(|v| v + by * (v.abs() * f32::EPSILON + step_m));
        cluster.low_m = grown(local.of_world(bounds.min), -1.0);
        cluster.high_m = grown(local.of_world(bounds.max), 1.0);
        cluster
    }

    pub(super) fn held(&self) -> Points {
        if self.step_m > 0.0 {
            Points::Rounded
        } else {
            Points::Exact
        }
    }

    /// A point in steps.
    pub(super) fn rounded(&self, local_m: [f32; 2]) -> u32 {
        // The conversion holds what is too far at the border.
        let [x, y] = local_m.map(|v| u32::from((v / self.step_m).round() as i16 as u16));
        x | y << 16
    }

    /// Has a box that holds this point, rounded or not.
    pub(super) fn hold(&mut self, [x, y]: [f32; 2]) {
        let off_m = self.step_m;
        self.low_m = [self.low_m[0].min(x - off_m), self.low_m[1].min(y - off_m)];
        self.high_m = [self.high_m[0].max(x + off_m), self.high_m[1].max(y + off_m)];
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

    /// The greatest width that a stroke has of its own, if any has.
    pub(super) fn width_m(&self) -> Option<f32> {
        (self.widest_m >= 0.0).then_some(self.widest_m)
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

/// A color as the device's pixels have it: red in the lowest byte.
pub(super) fn device_color(color: guideway_scene::Rgba) -> u32 {
    u32::from_le_bytes([color.r, color.g, color.b, color.a])
}
