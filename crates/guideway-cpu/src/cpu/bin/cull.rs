//! Culls clusters: tests the bounds of each cluster against the view, and returns the visible
//! clusters with the pixels and tiles that they may touch.

use std::ops::Range;

use guideway_scene::cluster::ClusterBounds;
use guideway_spline::{Bounds, Point};
use rayon::prelude::*;

use crate::cpu::ground::fixed_steps;
use crate::cpu::ground::frame_context::FrameContext;
use crate::cpu::ground::tile::{MAX_UNITS, TILE_PX};

/// Clusters per task: their test takes some 10 us.
const CHUNK_LEN: usize = 512;

/// A cluster that may touch the picture.
#[derive(Debug)]
pub(crate) struct VisibleCluster {
    /// Its number in the cluster index.
    pub(crate) cluster: u32,
    /// Its origin, in pixels.
    pub(crate) origin_px: Point<f64>,
    /// The pixels that it may touch.
    pub(crate) bounds_px: Bounds<f32>,
    /// True if all of it lies within the picture.
    pub(crate) is_inside: bool,
    /// True if it is too large for cached lines: its lines are clipped at the picture, frame by
    /// frame.
    pub(crate) is_oversized: bool,
    /// True if the 16-bit rasterizer can draw it.
    pub(crate) fits_fixed_point: bool,
    /// True if a gesture moves it, and not all others.
    pub(crate) is_moved: bool,
    /// First tile column and row that it may touch, and the end (exclusive).
    columns: [u16; 2],
    rows: [u16; 2],
}

impl VisibleCluster {
    fn new(cluster: u32, bounds: ClusterBounds, ctx: &FrameContext<'_>) -> Option<Self> {
        let picture = ctx.picture_px();
        let touched = ctx.touched_px(bounds.bounds);
        if !touched.intersects(picture) {
            return None;
        }
        let tiles = |min: f64, max: f64, side_px: f64| {
            let end = (max.min(side_px) / TILE_PX as f64).ceil();
            [(min.max(0.0) / TILE_PX as f64) as u16, (end as u16).max(1)]
        };
        Some(Self {
            cluster,
            origin_px: ctx.transform.pixel(bounds.origin),
            bounds_px: Bounds {
                min: touched.min.to_f32(),
                max: touched.max.to_f32(),
            },
            is_inside: picture.contains(touched.min) && picture.contains(touched.max),
            is_oversized: bounds.reach_m() > MAX_UNITS * ctx.unit_m(),
            fits_fixed_point: fixed_steps::fits(
                bounds.reach_m() * ctx.view.px_per_m(),
                ctx.min_radius_px()..=ctx.max_radius_px(),
            ),
            is_moved: (ctx.gesture)
                .is_some_and(|gesture| !gesture.moves_all && gesture.moves(cluster)),
            columns: tiles(touched.min.x, touched.max.x, picture.max.x),
            rows: tiles(touched.min.y, touched.max.y, picture.max.y),
        })
    }

    /// Columns of tiles that it may touch.
    pub(crate) fn columns(&self) -> Range<usize> {
        usize::from(self.columns[0])..usize::from(self.columns[1])
    }

    /// Rows of tiles that it may touch.
    pub(crate) fn rows(&self) -> Range<usize> {
        usize::from(self.rows[0])..usize::from(self.rows[1])
    }

    /// Returns `true` if it may touch some rows of tiles.
    pub(crate) fn is_in(&self, rows: &Range<usize>) -> bool {
        self.rows().start < rows.end && rows.start < self.rows().end
    }
}

/// The visible clusters, by ascending number. The key of one is its chunk and its index in the
/// chunk.
#[derive(Default)]
pub(crate) struct VisibleClusters {
    chunks: Vec<Vec<VisibleCluster>>,
}

impl VisibleClusters {
    /// Replaces all by the clusters that are visible in a frame. All threads share the work.
    pub(crate) fn cull(&mut self, bounds: &[Option<ClusterBounds>], ctx: &FrameContext<'_>) {
        self.chunks
            .resize_with(bounds.len().div_ceil(CHUNK_LEN), Vec::new);
        let chunks = self.chunks.par_iter_mut().zip(bounds.par_chunks(CHUNK_LEN));
        chunks.enumerate().for_each(|(chunk, (visible, bounds))| {
            visible.clear();
            let numbered = (Self::first_key(chunk)..).zip(bounds);
            visible.extend(
                numbered
                    .filter_map(|(cluster, bounds)| VisibleCluster::new(cluster, (*bounds)?, ctx)),
            );
        });
    }

    /// All visible clusters.
    pub(crate) fn iter(&self) -> impl Iterator<Item = &VisibleCluster> {
        self.chunks.iter().flatten()
    }

    /// All visible clusters in chunks, in parallel.
    pub(crate) fn par_chunks(&self) -> impl ParallelIterator<Item = &[VisibleCluster]> {
        self.chunks.par_iter().map(Vec::as_slice)
    }

    /// All visible clusters with their keys.
    pub(crate) fn with_keys(&self) -> impl Iterator<Item = (u32, &VisibleCluster)> {
        self.with_keys_of(0..self.chunks.len())
    }

    /// The visible clusters of some chunks, with their keys.
    pub(crate) fn with_keys_of(
        &self,
        chunks: Range<usize>,
    ) -> impl Iterator<Item = (u32, &VisibleCluster)> {
        let numbered = chunks.clone().zip(&self.chunks[chunks]);
        numbered.flat_map(|(chunk, visible)| (Self::first_key(chunk)..).zip(visible))
    }

    /// The least key of a chunk.
    pub(crate) fn first_key(chunk: usize) -> u32 {
        (chunk * CHUNK_LEN) as u32
    }

    /// Number of visible clusters.
    pub(crate) fn len(&self) -> usize {
        self.chunks.iter().map(Vec::len).sum()
    }

    /// Number of chunks.
    pub(crate) fn chunks(&self) -> usize {
        self.chunks.len()
    }

    /// The visible cluster of a key.
    #[inline(always)]
    pub(crate) fn get(&self, key: u32) -> &VisibleCluster {
        &self.chunks[key as usize / CHUNK_LEN][key as usize % CHUNK_LEN]
    }

    /// Heap bytes held.
    pub(crate) fn bytes(&self) -> u64 {
        let entries: usize = self.chunks.iter().map(Vec::capacity).sum();
        let chunks = self.chunks.capacity() * size_of::<Vec<VisibleCluster>>();
        (entries * size_of::<VisibleCluster>() + chunks) as u64
    }
}
