//! The scene as the device reads it: strokes near each other in clusters, each with an origin of its own.

use guideway_layout::Layout;
use guideway_scene::Scene;
use guideway_spline::{Bounds, Point};

use super::params::{CLUSTER_STROKES, Cluster, STROKE_SEGMENTS, Stroke, WHOLE_PATH};

/// A scene for the device.
#[derive(Default)]
pub(super) struct Packed {
    pub(super) points_m: Vec<[f32; 2]>,
    pub(super) strokes: Vec<Stroke>,
    pub(super) clusters: Vec<Cluster>,
    /// Paths of several strokes, which the device does not count.
    pub(super) parted: Vec<u32>,
    /// Greatest distance of a control point from its cluster's origin, along an axis.
    pub(super) reach_m: f64,
    /// Whether any path has a width of its own.
    pub(super) has_widths: bool,
}

/// A part of a run of a path.
#[derive(Clone, Copy)]
struct Part {
    path: u32,
    rank: u32,
    run: u32,
    first_point: u32,
    segments: u32,
    is_whole: bool,
}

impl Packed {
    /// Packs the drawn paths. Neighbours in the world become neighbours in memory.
    pub(super) fn of(scene: &Scene) -> Self {
        let mut packed = Self::default();
        let mut parts = Vec::new();
        for (&path, rank) in scene.draw_order().iter().zip(0..) {
            let first = parts.len();
            add_parts(scene.layout(), path, rank, &mut parts);
            match &mut parts[first..] {
                [whole] => whole.is_whole = true,
                _ => packed.parted.push(path),
            }
            packed.has_widths |= scene.width_m(path).is_some();
        }
        sort_by_place(scene, &mut parts);
        for parts in parts.chunks(CLUSTER_STROKES as usize) {
            packed.add_cluster(scene, parts);
        }
        packed
    }

    fn add_cluster(&mut self, scene: &Scene, parts: &[Part]) {
        let layout = scene.layout();
        let points = || parts.iter().flat_map(|part| control_points(layout, part));
        let Some(bounds) = Bounds::of_points(points()) else {
            return;
        };
        let origin = bounds.center();
        let high = origin.to_f32();
        let low = (origin - high.to_f64()).to_f32();
        // What the device takes for the origin; two floats are as exact as a double.
        let origin = high.to_f64() + low.to_f64();
        let local = |p: Point<f64>| {
            let local = (p - origin).to_f32();
            [local.x, local.y]
        };
        let mut widest_m = -1.0_f32;
        for part in parts {
            let width_m = scene.width_m(part.path).unwrap_or(-1.0);
            widest_m = widest_m.max(width_m);
            self.strokes.push(Stroke {
                first_point: self.points_m.len() as u32,
                segments: part.segments | if part.is_whole { WHOLE_PATH } else { 0 },
                rank: part.rank,
                color: device_color(scene.color(part.path)),
                width_m,
                padding: 0,
            });
            self.points_m
                .extend(control_points(layout, part).map(local));
        }
        let size = bounds.size();
        self.reach_m = self.reach_m.max(size.x / 2.0).max(size.y / 2.0);
        // Rounding must not make the box smaller.
        let grown = |p: [f32; 2], by: f32| p.map(|v| v + by * (v.abs() * f32::EPSILON));
        self.clusters.push(Cluster {
            origin_high_m: [high.x, high.y],
            origin_low_m: [low.x, low.y],
            low_m: grown(local(bounds.min), -1.0),
            high_m: grown(local(bounds.max), 1.0),
            widest_m,
            padding: 0,
        });
    }
}

/// A colour as the device's pixels have it: red in the lowest byte.
pub(super) fn device_color(color: guideway_scene::Rgba) -> u32 {
    u32::from_le_bytes([color.r, color.g, color.b, color.a])
}

fn add_parts(layout: &Layout, path: u32, rank: u32, parts: &mut Vec<Part>) {
    for (run, index) in layout.paths.get(path as usize).runs().zip(0..) {
        let segments = run.len() - 3;
        for first in (0..segments).step_by(STROKE_SEGMENTS) {
            parts.push(Part {
                path,
                rank,
                run: index,
                first_point: first as u32,
                segments: (segments - first).min(STROKE_SEGMENTS) as u32,
                is_whole: false,
            });
        }
    }
}

fn control_points<'a>(
    layout: &'a Layout,
    part: &Part,
) -> impl Iterator<Item = Point<f64>> + use<'a> {
    let run = layout
        .paths
        .get(part.path as usize)
        .runs()
        .nth(part.run as usize);
    let first = part.first_point as usize;
    let points = first..first + part.segments as usize + 3;
    points.filter_map(move |index| Some(run.as_ref()?.get(index)))
}

/// Sorts parts along a curve that keeps neighbours together (Morton 1966): by the middle of their ends.
fn sort_by_place(scene: &Scene, parts: &mut [Part]) {
    let Some(bounds) = scene.bounds() else {
        return;
    };
    let size = bounds.size();
    let per_m = f64::from(u16::MAX) / size.x.max(size.y).max(f64::MIN_POSITIVE);
    let layout = scene.layout();
    parts.sort_by_cached_key(|part| {
        let mut points = control_points(layout, part);
        let first = points.next().unwrap_or_default();
        let last = points.last().unwrap_or(first);
        let middle = (first + (last - first) * 0.5 - bounds.min) * per_m;
        // A float beyond the range becomes its nearest end.
        spread(middle.x as u16) | spread(middle.y as u16) << 1
    });
}

/// A zero after each bit.
fn spread(value: u16) -> u32 {
    let mut bits = u32::from(value);
    for (shift, mask) in [
        (8, 0x00ff_00ff),
        (4, 0x0f0f_0f0f),
        (2, 0x3333_3333),
        (1, 0x5555_5555),
    ] {
        bits = (bits | bits << shift) & mask;
    }
    bits
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bits_are_spread() {
        assert_eq!(spread(0), 0);
        assert_eq!(spread(0b1011), 0b100_0101);
        assert_eq!(spread(u16::MAX), 0x5555_5555);
    }
}
