//! Packs path parts for the device: sorts them by the Hilbert curve, groups 64 to a cluster, and
//! quantizes the points of clusters that are small beside the scene.

use guideway_layout::Layout;
use guideway_scene::{Rgba, Scene};
use guideway_spline::{Bounds, Point, hilbert};
use rayon::prelude::*;

use super::cluster::ClusterOrigin;
use super::concatenated::{Pieces, keep_freed_memory};
use super::path_parts::PathPart;
use crate::tiles::constants::CLUSTER_STROKES;
use crate::tiles::layouts::{Cluster, PathStyle, PointFormat, Stroke};

/// Steps per scene size, at least. Derived: a view of the whole scene shows the rounding only if it
/// is wider than 16,384 pixels.
const STEPS_PER_SCENE: f64 = (1 << 20) as f64;
/// Steps from the origin of a cluster to the farthest place that its points may move to. Derived:
/// slightly less than 16 bits hold.
const MAX_STEPS: f64 = 32_000.0;

/// Parts that one task packs: whole clusters.
const TASK_PARTS: usize = 32 * CLUSTER_STROKES as usize;

/// Packing parameters of a scene while it is on the device.
#[derive(Clone, Copy)]
pub(crate) struct Packing {
    /// Bounds of all paths.
    bounds_m: Bounds<f64>,
    /// Greatest quantization step; clusters that need a larger one have exact points.
    max_step_m: f64,
}

/// Packed strokes. Clusters index these points and strokes; those with rounded points come first.
pub(crate) struct Packed {
    pub(crate) rounded: Pieces<u32>,
    pub(crate) exact_m: Pieces<[f32; 2]>,
    pub(crate) strokes: Pieces<Stroke>,
    pub(crate) clusters: Vec<Cluster>,
    /// Place of each cluster in the order of the sorted parts.
    pub(crate) places: Vec<u32>,
}

/// The result of a task; its clusters index its own points and strokes.
#[derive(Default)]
struct PackedTask {
    rounded: Vec<u32>,
    exact_m: Vec<[f32; 2]>,
    strokes: Vec<Stroke>,
    clusters: Vec<Cluster>,
    places: Vec<u32>,
}

impl Packing {
    pub(crate) fn of(scene: &Scene) -> Self {
        let bounds_m = scene.bounds().unwrap_or(Bounds {
            min: Point::default(),
            max: Point::default(),
        });
        let size_m = bounds_m.size();
        Self {
            bounds_m,
            max_step_m: size_m.x.max(size_m.y) / STEPS_PER_SCENE,
        }
    }

    /// The same packing with exact points only.
    pub(crate) fn exact(self) -> Self {
        Self {
            max_step_m: 0.0,
            ..self
        }
    }

    /// Sorts parts along the Hilbert curve, by the midpoint of their ends. The strokes of a path
    /// are found in this order, so the order of two parts must not depend on the others.
    pub(crate) fn sort(&self, layout: &Layout, parts: &mut [PathPart]) {
        let place = |part: &PathPart| {
            let mut points = part.points(layout);
            let first = points.next().unwrap_or_default();
            let last = points.last().unwrap_or(first);
            hilbert(first + (last - first) * 0.5, self.bounds_m)
        };
        match parts.len() {
            0..=TASK_PARTS => parts.sort_by_cached_key(place),
            _ => parts.par_sort_by_cached_key(place),
        }
    }

    /// The step of a cluster of this size; 0 if its points stay exact.
    fn step_m(&self, size_m: Point<f64>) -> f32 {
        let border_m = |size_m: f64| size_m / 2.0 + max_move_m(size_m);
        let step_m = border_m(size_m.x).max(border_m(size_m.y)) / MAX_STEPS;
        if step_m <= self.max_step_m {
            step_m as f32
        } else {
            0.0
        }
    }
}

/// Farthest that points of a cluster of this size may move beyond its box along an axis: a larger
/// cluster would cull badly.
pub(crate) fn max_move_m(size_m: f64) -> f64 {
    size_m.max(1.0)
}

impl Packed {
    /// Packs parts. Neighbors in the world become neighbors in memory. All threads share the work.
    pub(crate) fn of(scene: &Scene, mut parts: Vec<PathPart>, packing: Packing) -> Self {
        keep_freed_memory();
        packing.sort(scene.layout(), &mut parts);
        Self::of_sorted(scene, &parts, packing)
    }

    /// Packs parts whose neighbors in the world are neighbors already. All threads share the work.
    pub(crate) fn of_sorted(scene: &Scene, parts: &[PathPart], packing: Packing) -> Self {
        let tasks = parts.par_chunks(TASK_PARTS).enumerate();
        let tasks = tasks.map(|(index, parts)| {
            let first_place = index * (TASK_PARTS / CLUSTER_STROKES as usize);
            PackedTask::of(scene, parts, first_place as u32, packing)
        });
        let (mut packed, mut exact) = (Vec::new(), Vec::new());
        for [rounded, of_exact] in tasks.collect::<Vec<_>>() {
            packed.push(rounded);
            exact.push(of_exact);
        }
        packed.append(&mut exact);
        Self::joined(packed)
    }

    /// Joins clusters with their strokes and points.
    fn joined(tasks: Vec<PackedTask>) -> Self {
        let (mut first_stroke, mut first_points) = (0, [0, 0]);
        let mut clusters = Vec::with_capacity(tasks.iter().map(|task| task.clusters.len()).sum());
        let (mut rounded, mut exact_m, mut strokes) = (Vec::new(), Vec::new(), Vec::new());
        let mut places = Vec::with_capacity(clusters.capacity());
        for task in tasks {
            places.extend(task.places);
            clusters.extend(task.clusters.iter().map(|cluster| Cluster {
                first_stroke: cluster.first_stroke + first_stroke,
                first_point: cluster.first_point + first_points[cluster.format() as usize],
                ..*cluster
            }));
            first_stroke += task.strokes.len() as u32;
            first_points[PointFormat::Rounded as usize] += task.rounded.len() as u32;
            first_points[PointFormat::Exact as usize] += task.exact_m.len() as u32;
            rounded.push(task.rounded);
            exact_m.push(task.exact_m);
            strokes.push(task.strokes);
        }
        Self {
            rounded: Pieces::new(rounded.into_iter()),
            exact_m: Pieces::new(exact_m.into_iter()),
            strokes: Pieces::new(strokes.into_iter()),
            clusters,
            places,
        }
    }
}

impl PackedTask {
    /// Packs parts: clusters of rounded and of exact points. The first one has a place among those
    /// of all tasks.
    fn of(scene: &Scene, parts: &[PathPart], first_place: u32, packing: Packing) -> [Self; 2] {
        let (mut packed, mut exact) = (Self::default(), Self::default());
        // Paths of a cluster lie anywhere in memory.
        let geometry = scene.layout().paths.geometry();
        let prefetch = |part: &PathPart| geometry.prefetch(part.path as usize);
        let mut ahead = parts.chunks(CLUSTER_STROKES as usize).skip(1);
        for (parts, place) in parts.chunks(CLUSTER_STROKES as usize).zip(first_place..) {
            ahead.next().into_iter().flatten().for_each(prefetch);
            let points = parts.iter().flat_map(|part| part.points(scene.layout()));
            let Some(bounds) = Bounds::of_points(points) else {
                continue;
            };
            let cluster = Cluster::within(bounds, packing.step_m(bounds.size()));
            let of_format = match cluster.format() {
                PointFormat::Rounded => &mut packed,
                PointFormat::Exact => &mut exact,
            };
            of_format.add(scene, cluster, parts);
            of_format.places.push(place);
        }
        [packed, exact]
    }

    fn add(&mut self, scene: &Scene, mut cluster: Cluster, parts: &[PathPart]) {
        let layout = scene.layout();
        let origin = ClusterOrigin::of(&cluster);
        let format = cluster.format();
        cluster.first_point = match format {
            PointFormat::Rounded => self.rounded.len() as u32,
            PointFormat::Exact => self.exact_m.len() as u32,
        };
        cluster.first_stroke = self.strokes.len() as u32;
        cluster.strokes = parts.len() as u32;
        let mut points_m = Vec::new();
        for part in parts {
            let width_m = scene.width_m(part.path).unwrap_or(-1.0);
            cluster.widest_m = cluster.widest_m.max(width_m);
            let stroke = part.stroke(cluster.points);
            cluster.points += stroke.points();
            self.strokes.push(stroke);
            match format {
                PointFormat::Rounded => {
                    points_m.clear();
                    part.append_local(layout, origin, &mut points_m);
                    let points = points_m.iter().map(|&p| cluster.quantize(p));
                    self.rounded.extend(points);
                }
                PointFormat::Exact => part.append_local(layout, origin, &mut self.exact_m),
            }
        }
        self.clusters.push(cluster);
    }
}

/// Color and width of a path.
pub(crate) fn path_style(scene: &Scene, row: u32) -> PathStyle {
    PathStyle {
        color: device_color(scene.color(row)),
        width_m: scene.width_m(row).unwrap_or(-1.0),
    }
}

/// A color as in the device's pixels: red in the lowest byte.
pub(crate) fn device_color(color: Rgba) -> u32 {
    u32::from_le_bytes([color.r, color.g, color.b, color.a])
}
