//! Sizes of dispatches.

use crate::device::Gpu;
use crate::tiles::constants::{
    CLUSTER_THREADS, LINE_THREADS, LIST_THREADS, MAX_PARTS_LOG2, MAX_SPLIT_PARTS, MAX_SPLIT_TILES,
};
use crate::tiles::layouts::FrameParams;
use crate::tiles::upload::point_buffer::ViewDistance;

/// Most workgroups of a kernel whose workgroups take one item after the other.
const MAX_LOOPING_WORKGROUPS: u32 = 1 << 14;

/// The items that a dispatch has workgroups for.
#[derive(Clone, Copy)]
pub(crate) enum Workgroups {
    /// One thread per cluster.
    Clusters,
    /// One workgroup per dirty cluster.
    DirtyClusters,
    /// This many workgroups that take visible clusters in turn, if the point buffer draws any.
    VisibleClusters(u32, ViewDistance),
    /// Workgroups for this many lines each, which take lines in turn.
    Lines(u32),
    /// `threads_per_line` threads per cached line.
    CachedLines,
    /// One workgroup per tile.
    Tiles,
    /// One workgroup per list part, then one per tile.
    PartsAndTiles,
    /// One workgroup per split tile.
    SplitTiles,
    /// One thread per tile.
    TileThreads,
}

impl Workgroups {
    /// Number of workgroups for a window.
    pub(crate) fn count(self, gpu: &Gpu, params: &FrameParams) -> u32 {
        let looping = |items: u32| items.clamp(1, MAX_LOOPING_WORKGROUPS.min(gpu.max_workgroups()));
        let lines = match params.cached_lines {
            0 => params.line_capacity,
            cached => cached,
        };
        let tiles = params.columns * params.rows;
        match self {
            Self::Clusters => params.clusters.div_ceil(CLUSTER_THREADS),
            Self::DirtyClusters => params.dirty_clusters,
            Self::VisibleClusters(_, distance) if !distance.draws_any(params.max_step_m) => 0,
            Self::VisibleClusters(clusters, _) if params.dirty_clusters == 0 => looping(clusters),
            Self::VisibleClusters(clusters, _) => {
                looping(clusters.min(params.dirty_clusters << MAX_PARTS_LOG2))
            }
            Self::Lines(lines_each) => looping(lines.div_ceil(lines_each)),
            Self::CachedLines => {
                let threads = params.cached_lines * params.threads_per_line;
                looping(threads.div_ceil(LINE_THREADS))
            }
            Self::Tiles => tiles,
            Self::PartsAndTiles => MAX_SPLIT_PARTS + tiles,
            Self::SplitTiles => MAX_SPLIT_TILES,
            Self::TileThreads => tiles.div_ceil(LIST_THREADS),
        }
    }
}
