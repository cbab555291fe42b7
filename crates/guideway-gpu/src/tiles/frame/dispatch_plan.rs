//! The dispatches of a window with their bind groups. A plan is reused while its buffers and its
//! key stay the same.

use guideway_scene::Stage;

use super::line_buffers::LineBuffers;
use super::tile_buffers::TileBuffers;
use super::workgroups::Workgroups;
use crate::device::{Bindings, DeviceBuffer, DeviceError, Dispatch, Gpu, Kernel, Runner};
use crate::tiles::constants::{
    COUNTED_LINES_EACH, FEW_CLUSTERS, LINE_THREADS, MAX_PARTS_LOG2, Samples,
};
use crate::tiles::kernels::Kernels;
use crate::tiles::layouts::{FrameCounters, FrameParams};
use crate::tiles::paint_mode::PaintMode;
use crate::tiles::upload::scene_buffers::SceneBuffers;

/// Name of the single stage of a frame whose stages are not timed.
const WHOLE_FRAME: &str = "draw";

/// All buffers of a window.
pub(crate) struct FrameBuffers<'a> {
    pub(crate) gpu: &'a Gpu,
    pub(crate) kernels: &'a Kernels,
    pub(crate) scene: &'a SceneBuffers,
    pub(crate) lines: &'a LineBuffers,
    pub(crate) tiles: &'a TileBuffers,
    pub(crate) split_lists: Option<&'a DeviceBuffer>,
    pub(crate) dirty_clusters: Option<&'a DeviceBuffer>,
    /// True if each stage is timed.
    pub(crate) times_stages: bool,
}

/// Everything that selects the dispatches of a plan.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct PlanKey {
    pub(crate) paint: PaintMode,
    pub(crate) samples: Samples,
    /// Draws cached lines.
    pub(crate) draws_cached: bool,
    /// Flattens the lines of dirty clusters again.
    pub(crate) refreshes_dirty: bool,
    /// Bins cached lines without counting, into lists of fixed capacity.
    pub(crate) bins_at_once: bool,
    /// Draws in two occlusion passes.
    pub(crate) uses_occlusion: bool,
    /// Several workgroups flatten each cluster.
    pub(crate) has_few_clusters: bool,
    /// Several workgroups cover tiles with long lists.
    pub(crate) splits_lists: bool,
}

/// The stages of a window.
pub(crate) struct DispatchPlan {
    key: PlanKey,
    stages: Vec<(&'static str, Vec<PlannedDispatch>)>,
}

/// A kernel with its buffers.
struct PlannedDispatch {
    kernel: Kernel,
    bindings: Bindings,
    workgroups: Workgroups,
}

impl DispatchPlan {
    pub(crate) fn new(b: &FrameBuffers<'_>, key: PlanKey) -> Result<Self, DeviceError> {
        let mut plan = Self {
            key,
            stages: Vec::new(),
        };
        let (kernels, counters) = (b.kernels, &b.scene.counters);
        if key.draws_cached {
            if let Some(dirty) = b.dirty_clusters.filter(|_| key.refreshes_dirty) {
                let (frame, clusters) = (&b.tiles.frame, &b.scene.clusters);
                let buffers = [frame, clusters, counters, &b.lines.lines, dirty];
                let kernel = &kernels.invalidate_lines;
                plan.add("invalidate", b, kernel, Workgroups::DirtyClusters, &buffers)?;
                plan.add_flatten(b, 0)?;
            }
            plan.add_cached(b)?;
            return Ok(plan);
        }
        let cull = [&b.tiles.frame, &b.scene.clusters, counters];
        plan.add("cull", b, &kernels.cull, Workgroups::Clusters, &cull)?;
        let passes: &[usize] = if key.uses_occlusion { &[1, 2] } else { &[0] };
        for &pass in passes {
            plan.add_flatten(b, pass)?;
            plan.add_bin(b)?;
        }
        Ok(plan)
    }

    /// Adds the stage from curves to lines.
    fn add_flatten(&mut self, b: &FrameBuffers<'_>, pass: usize) -> Result<(), DeviceError> {
        for points in b.scene.all_point_buffers() {
            let buffers = [
                &b.tiles.frame,
                &points.dispatches[pass],
                &points.points,
                &b.scene.strokes,
                &b.scene.clusters,
                &b.scene.styles,
                &b.scene.counters,
                &b.lines.lines,
                &b.lines.line_ranks,
                &b.tiles.tile_counts,
            ];
            let has_few = self.key.has_few_clusters;
            let clusters = points.clusters.len() as u32;
            // A small point buffer beside large ones has a dispatch of its own, which takes as long
            // as its slowest workgroup.
            let is_small = clusters <= FEW_CLUSTERS && !has_few;
            let kernels = &b.kernels.flatten[usize::from(is_small || has_few)];
            let kernel = &kernels[points.format as usize];
            let parts_log2 = if is_small { MAX_PARTS_LOG2 } else { 0 };
            let workgroups = Workgroups::VisibleClusters(clusters << parts_log2, points.distance);
            self.add("flatten", b, kernel, workgroups, &buffers)?;
        }
        Ok(())
    }

    /// Adds the stages from cached lines to pixels.
    fn add_cached(&mut self, b: &FrameBuffers<'_>) -> Result<(), DeviceError> {
        let kernels = b.kernels;
        let mut buffers = vec![
            &b.tiles.frame,
            &b.scene.counters,
            &b.lines.lines,
            &b.lines.line_ranks,
            &b.scene.styles,
            &b.tiles.tile_counts,
        ];
        if self.key.bins_at_once {
            buffers.push(&b.lines.references);
            let kernel = &kernels.bin_cached;
            self.add("bin", b, kernel, Workgroups::CachedLines, &buffers)?;
            return self.add_draw(b);
        }
        let workgroups = Workgroups::Lines(LINE_THREADS * COUNTED_LINES_EACH);
        self.add("count", b, &kernels.count_cached, workgroups, &buffers)?;
        self.add_bin(b)
    }

    /// Adds the stages from counted lines to pixels.
    fn add_bin(&mut self, b: &FrameBuffers<'_>) -> Result<(), DeviceError> {
        let kernels = b.kernels;
        let SceneBuffers {
            styles, counters, ..
        } = b.scene;
        let LineBuffers {
            lines,
            line_ranks,
            references,
            ..
        } = b.lines;
        let TileBuffers {
            frame,
            tile_counts,
            tile_lists,
            list_cursors,
            ..
        } = b.tiles;
        let threads = Workgroups::TileThreads;
        let buffers = [frame, tile_counts, tile_lists, list_cursors, counters];
        self.add("offsets", b, &kernels.tile_offsets, threads, &buffers)?;
        if let Some(split_lists) = b.split_lists.filter(|_| self.key.splits_lists) {
            let buffers = [frame, tile_lists, counters, split_lists];
            self.add("offsets", b, &kernels.split_tiles, threads, &buffers)?;
        }
        let buffers = [
            frame,
            counters,
            lines,
            line_ranks,
            styles,
            list_cursors,
            references,
        ];
        let workgroups = Workgroups::Lines(LINE_THREADS);
        self.add("bin", b, &kernels.bin_lines, workgroups, &buffers)?;
        if self.key.paint.sorts_lists() {
            let buffers = [frame, tile_lists, references, line_ranks, counters];
            for kernel in &kernels.sort_lists {
                self.add("sort", b, kernel, Workgroups::Tiles, &buffers)?;
            }
        }
        self.add_draw(b)
    }

    /// Adds the stage from tile lists to pixels.
    fn add_draw(&mut self, b: &FrameBuffers<'_>) -> Result<(), DeviceError> {
        let mut buffers = vec![
            &b.tiles.frame,
            &b.tiles.tile_lists,
            &b.lines.references,
            &b.lines.lines,
            &b.lines.line_ranks,
            &b.scene.styles,
            &b.tiles.pixels,
        ];
        if self.key.paint == PaintMode::SingleColor {
            buffers.push(&b.tiles.tile_counts);
        }
        buffers.push(&b.scene.counters);
        let split_lists = b.split_lists.filter(|_| self.key.splits_lists);
        let split = b.kernels.of_tiles(self.key.samples).cover_split.as_ref();
        if let Some(([cover, resolve], split_lists)) = split.zip(split_lists) {
            buffers.push(split_lists);
            self.add("cover", b, cover, Workgroups::PartsAndTiles, &buffers)?;
            return self.add("cover", b, resolve, Workgroups::SplitTiles, &buffers);
        }
        let kernel = self.key.paint.kernel(b.kernels, self.key.samples);
        self.add("cover", b, kernel, Workgroups::Tiles, &buffers)
    }

    fn add(
        &mut self,
        stage: &'static str,
        b: &FrameBuffers<'_>,
        kernel: &Kernel,
        workgroups: Workgroups,
        buffers: &[&DeviceBuffer],
    ) -> Result<(), DeviceError> {
        let dispatch = PlannedDispatch {
            kernel: kernel.clone(),
            bindings: kernel.bind(b.gpu, buffers)?,
            workgroups,
        };
        let stage = if b.times_stages { stage } else { WHOLE_FRAME };
        match self.stages.last_mut() {
            Some((last, dispatches)) if *last == stage => dispatches.push(dispatch),
            _ => self.stages.push((stage, vec![dispatch])),
        }
        Ok(())
    }

    /// Returns `true` if the plan has this key.
    pub(crate) fn has_key(&self, key: PlanKey) -> bool {
        self.key == key
    }

    /// Clears the counters and runs all stages in order.
    pub(crate) fn run(
        &self,
        b: &FrameBuffers<'_>,
        params: &FrameParams,
        runner: &Runner,
    ) -> Result<Vec<Stage>, DeviceError> {
        let dispatches: Vec<Vec<_>> = self
            .stages
            .iter()
            .map(|(_, dispatches)| {
                let dispatch = |planned| dispatch(planned, b.gpu, params);
                dispatches.iter().map(dispatch).collect()
            })
            .collect();
        let names = self.stages.iter().map(|(name, _)| *name);
        let stages: Vec<_> = names.zip(dispatches.iter().map(Vec::as_slice)).collect();
        let tile_counts = &b.tiles.tile_counts;
        let cleared = [
            (&b.scene.counters, size_of::<FrameCounters>() as u64),
            (tile_counts, tile_counts.bytes()),
        ];
        runner.run_stages("the frame", &cleared, &stages)
    }
}

fn dispatch<'a>(planned: &'a PlannedDispatch, gpu: &Gpu, params: &FrameParams) -> Dispatch<'a> {
    Dispatch {
        kernel: &planned.kernel,
        bindings: &planned.bindings,
        workgroups: planned.workgroups.count(gpu, params),
    }
}
