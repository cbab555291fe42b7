//! Flattens one cluster: from the control points of its paths to polylines.
//!
//! Clusters whose lines fit in 16 bits are flattened once per scale, relative to the origin of the
//! cluster, and cached. Larger clusters are flattened in pixels, frame by frame, without the lines
//! out of the picture.

use std::ops::Range;

use guideway_layout::RunPoints;
use guideway_scene::cluster::CLUSTER_LEN;
use guideway_spline::{Affine, Bounds, Point};

use super::chain_curves::CurveChains;
use super::clipped::flatten_clipped;
use super::knots::{Chain, CurveRun, Knots};
use super::polylines::{PolylineWriter, Polylines};
use super::simplify::DouglasPeucker;
use crate::cpu::ground::frame_context::FrameContext;
use crate::cpu::ground::gesture::ClusterPaths;
use crate::cpu::ground::simd::simd_dispatch;
use crate::cpu::ground::tile::{PASSES, TILE_PX};

/// The lines of a cluster.
#[derive(Debug, Default)]
pub(crate) enum ClusterLines {
    /// Not flattened.
    #[default]
    None,
    /// Vertices relative to the origin of the cluster, y down, with their unit in meters: valid for
    /// every view of that unit.
    Cached(f64, Polylines<i16>),
    /// Vertices in pixels of one frame, in which the lines may touch the picture: of clusters too
    /// large for 16 bits.
    Clipped(Polylines<f32>),
}

/// Steps per pixel that vertices of clipped lines are rounded to. Derived: every such position in a
/// picture of 65,535 pixels, with the lines that leave it, is an `f32`, so that pictures of all
/// sizes have the same vertices.
const CLIPPED_STEPS_PER_PX: f64 = 128.0;

/// Buffers of one thread.
#[derive(Default)]
pub(crate) struct FlattenScratch {
    lines: Polylines<i16>,
    /// Control points in units from the origin.
    points: Vec<Point<f32>>,
    runs: Vec<CurveRun>,
    knots: Knots,
    links: CurveChains,
    chains: Vec<Chain>,
    simplifier: DouglasPeucker,
    /// Control points in pixels.
    pixels: Vec<Point<f64>>,
}

/// Members of a cluster in an order of which every prefix is spread over the cluster: members are
/// in Hilbert order, so this reverses the bits of their numbers.
fn spread_order(members: usize) -> impl Iterator<Item = usize> {
    let reversed = |i: usize| (usize::from((i as u8).reverse_bits()) * CLUSTER_LEN) >> u8::BITS;
    let numbers = 0..CLUSTER_LEN;
    numbers.map(reversed).filter(move |&i| i < members)
}

impl ClusterLines {
    /// Flattens a cluster for a frame, relative to its origin or, if it is oversized, in
    /// pixels of the picture. Such lines are complete only within `rows` of tiles.
    pub(crate) fn flatten(
        &mut self,
        ctx: &FrameContext<'_>,
        is_oversized: bool,
        paths: ClusterPaths<'_>,
        rows: &Range<usize>,
        scratch: &mut FlattenScratch,
    ) {
        if is_oversized {
            let mut lines = match std::mem::take(self) {
                Self::Clipped(lines) => lines,
                Self::None | Self::Cached(..) => Polylines::default(),
            };
            scratch.flatten_clipped(ctx, paths, rows, &mut lines);
            *self = Self::Clipped(lines);
            return;
        }
        let unit_m = ctx.unit_m();
        let mut lines = match std::mem::take(self) {
            Self::Cached(_, lines) => lines,
            Self::None | Self::Clipped(_) => Polylines::default(),
        };
        scratch.flatten_local(ctx, paths, unit_m);
        lines.copy_from(&scratch.lines);
        *self = Self::Cached(unit_m, lines);
    }

    /// Number of paths and of lines that may touch the picture, in which the origin lies at
    /// `origin_px`.
    pub(crate) fn visible_counts(&self, ctx: &FrameContext<'_>, origin_px: Point<f64>) -> [u32; 2] {
        match self {
            Self::None => [0, 0],
            Self::Clipped(lines) => lines.path_and_line_counts(),
            Self::Cached(unit_m, lines) => {
                let within = clip_units(ctx, origin_px, *unit_m);
                let mut counts = [0, 0];
                count_within_by(ctx.simd, lines, &within, &mut counts);
                counts
            }
        }
    }

    /// Number of paths and of lines.
    pub(crate) fn path_and_line_counts(&self) -> [u32; 2] {
        match self {
            Self::None => [0, 0],
            Self::Cached(_, lines) => lines.path_and_line_counts(),
            Self::Clipped(lines) => lines.path_and_line_counts(),
        }
    }

    /// Prefetches the vertices and boxes.
    #[inline(always)]
    pub(crate) fn prefetch(&self) {
        match self {
            Self::None => {}
            Self::Cached(_, lines) => lines.prefetch(),
            Self::Clipped(lines) => lines.prefetch(),
        }
    }

    /// Heap bytes held.
    pub(crate) fn bytes(&self) -> u64 {
        match self {
            Self::None => 0,
            Self::Cached(_, lines) => lines.bytes(),
            Self::Clipped(lines) => lines.bytes(),
        }
    }
}

simd_dispatch!(
    fn count_within_by(lines: &Polylines<i16>, within: &Bounds<f32>, counts: &mut [u32; 2])
    by count_within
);

#[inline(always)]
fn count_within(lines: &Polylines<i16>, within: &Bounds<f32>, counts: &mut [u32; 2]) {
    *counts = lines.count_within(within);
}

/// Box of the center lines that touch the picture, in units from the origin of a cluster, y down.
fn clip_units(ctx: &FrameContext<'_>, origin_px: Point<f64>, unit_m: f64) -> Bounds<f32> {
    let units_per_px = 1.0 / (ctx.view.px_per_m() * unit_m);
    let clip = ctx.clip_px();
    Bounds {
        min: ((clip.min - origin_px) * units_per_px).to_f32(),
        max: ((clip.max - origin_px) * units_per_px).to_f32(),
    }
}

impl FlattenScratch {
    /// Heap bytes held.
    pub(crate) fn bytes(&self) -> u64 {
        let buffers = self.points.capacity() * size_of::<Point<f32>>()
            + self.runs.capacity() * size_of::<CurveRun>()
            + self.chains.capacity() * size_of::<Chain>()
            + self.pixels.capacity() * size_of::<Point<f64>>();
        let lists = self.knots.bytes() + self.links.bytes() + self.simplifier.bytes();
        self.lines.bytes() + lists + buffers as u64
    }

    /// Flattens all shown paths into `self.lines`, in units from `origin_m`.
    fn flatten_local(&mut self, ctx: &FrameContext<'_>, paths: ClusterPaths<'_>, unit_m: f64) {
        let scene = ctx.scene;
        let Self {
            lines,
            points,
            runs,
            ..
        } = self;
        lines.clear();
        let units_per_m = 1.0 / unit_m;
        let turn = paths.by.filter(|by| by.as_translation().is_none());
        let local = |p: Point<f64>| {
            let mut from_origin = p - paths.origin_m;
            if let Some(by) = turn {
                from_origin = by.x * from_origin.x + by.y * from_origin.y;
            }
            let Point { x, y } = from_origin;
            Point::new(x * units_per_m, -y * units_per_m).to_f32()
        };
        points.clear();
        runs.clear();
        for member in spread_order(paths.rows.len()) {
            let path = paths.rows[member];
            if !paths.draws(scene, path) {
                continue;
            }
            for run in scene.layout().paths.geometry().runs(path as usize) {
                let first = points.len();
                match run {
                    RunPoints::F64(run) => points.extend(run.iter().map(|&p| local(p))),
                    RunPoints::F32(run) => points.extend(run.iter().map(|p| local(p.to_f64()))),
                }
                runs.extend(CurveRun::new(member, first..points.len()));
            }
        }
        let key = ctx.cache_key();
        simplify_by(ctx.simd, self, key.tolerance_units, key.chains_curves);
    }

    /// Flattens all shown paths into `clipped`, in pixels, within some rows of tiles. The counts
    /// are those of the whole picture.
    fn flatten_clipped(
        &mut self,
        ctx: &FrameContext<'_>,
        paths: ClusterPaths<'_>,
        rows: &Range<usize>,
        clipped: &mut Polylines<f32>,
    ) {
        let pixels = &mut self.pixels;
        clipped.clear();
        let (transform, anchor_px) = (ctx.transform, ctx.transform.anchor_px());
        let (clip, reach) = (ctx.clip_px(), ctx.max_radius_px() + 1.0);
        let clip = Bounds {
            min: clip.min - anchor_px,
            max: clip.max - anchor_px,
        };
        let in_picture = |vertex: Point<f64>| {
            let snap = |x: f64| (x * CLIPPED_STEPS_PER_PX).round() / CLIPPED_STEPS_PER_PX;
            Point::new(snap(vertex.x), snap(vertex.y)) + anchor_px
        };
        let top = (rows.start * TILE_PX) as f64 - reach;
        let bottom = (rows.end * TILE_PX) as f64 + reach;
        let mut writer = PolylineWriter::new();
        let (mut path_count, mut line_count) = (0, 0);
        let by = paths.by.unwrap_or(Affine::IDENTITY);
        for (member, &path) in paths.rows.iter().enumerate() {
            if !paths.draws(ctx.scene, path) {
                continue;
            }
            let before = line_count;
            for run in ctx.scene.layout().paths.geometry().runs(path as usize) {
                pixels.clear();
                pixels.extend(run.iter().map(|p| transform.pixel_from_anchor(by.apply(p))));
                let mut last = None;
                flatten_clipped(pixels, clip, &mut |start, end| {
                    let (start, end) = (in_picture(start), in_picture(end));
                    line_count += 1;
                    if start.y.max(end.y) < top || start.y.min(end.y) > bottom {
                        return;
                    }
                    if last != Some(start) {
                        writer.finish_chain(clipped);
                        writer.begin_chain(1 << member);
                        writer.push(start.to_f32(), clipped);
                    }
                    writer.push(end.to_f32(), clipped);
                    last = Some(end);
                });
                writer.finish_chain(clipped);
            }
            path_count += u32::from(line_count > before);
        }
        (0..PASSES).for_each(|pass| clipped.end_pass(pass));
        clipped.finish();
        clipped.set_counts([path_count, line_count]);
    }
}

simd_dispatch!(
    fn simplify_by(scratch: &mut FlattenScratch, tolerance: f32, chains_curves: bool)
    by simplify_all
);

/// Rounds a number of less than 16 bits to the nearest integer.
#[inline(always)]
fn round(x: f32) -> i16 {
    /// Adding this rounds a number, in the lowest bits of the sum.
    const ROUND: f32 = 1.5 * (1 << 23) as f32;
    (x + ROUND).to_bits() as i16
}

/// Turns all runs of `scratch` into its polylines; chains curves that share end points if asked to.
#[inline(always)]
fn simplify_all(scratch: &mut FlattenScratch, tolerance: f32, chains_curves: bool) {
    let FlattenScratch {
        lines,
        points,
        runs,
        knots,
        links,
        chains,
        simplifier,
        ..
    } = scratch;
    knots.reset(points);
    links.link_runs(runs, points, chains_curves);
    links.append_knots((runs, points), knots, chains);
    knots.find_slack(tolerance);
    simplifier.simplify(knots, chains);
    let mut writer = PolylineWriter::new();
    let mut ended = 0;
    for chain in chains {
        (ended..chain.pass).for_each(|pass| lines.end_pass(pass));
        ended = chain.pass;
        writer.begin_chain(chain.members);
        simplifier.vertices(knots, &chain.knots, points, tolerance, |vertex| {
            let vertex = Point {
                x: round(vertex.x),
                y: round(vertex.y),
            };
            writer.push(vertex, lines);
        });
        writer.finish_chain(lines);
    }
    (ended..PASSES).for_each(|pass| lines.end_pass(pass));
    lines.finish();
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_prefix_of_the_spread_order_covers_the_cluster() {
        let all: Vec<usize> = spread_order(CLUSTER_LEN).collect();
        assert_eq!(all[..4], [0, 32, 16, 48]);
        let mut sorted: Vec<usize> = spread_order(50).collect();
        sorted.sort_unstable();
        assert!(sorted.into_iter().eq(0..50));
    }
}
