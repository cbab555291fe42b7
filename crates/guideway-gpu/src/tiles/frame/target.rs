//! State that passes from one picture to the next: buffers, caches, and measures of earlier frames.

use guideway_scene::{RenderError, View};
use rayon::prelude::*;
use wgpu::BufferUsages;

use super::capacity::Capacity;
use super::context::FrameContext;
use super::dispatch_plan::DispatchPlan;
use super::line_buffers::LineBuffers;
use super::line_lod::LineLod;
use super::line_source::LineSource;
use super::occlusion::Occlusion;
use super::tile_buffers::TileBuffers;
use super::window::Window;
use crate::device::{DeviceBuffer, Gpu};
use crate::tiles::cache::line_cache::{CachedLines, max_dirty};
use crate::tiles::cache::picture_cache::{CachedPicture, DirtyArea};
use crate::tiles::cache::scroll::Scroller;
use crate::tiles::constants::{MAX_SPLIT_PARTS, MAX_SPLIT_TILES, SAMPLE_ROWS, Samples, TILE_PX};
use crate::tiles::device_context::{DeviceContext, device_error};
use crate::tiles::kernels::Kernels;
use crate::tiles::layouts::{Cluster, FrameCounters};
use crate::tiles::list_limits::unsplit_limits;
use guideway_scene::cluster::DirtyClusters;

/// Clusters whose boxes one task joins: some 20 microseconds of work.
const TASK_CLUSTERS: usize = 1 << 10;
/// Part of the clusters that may change before a frame draws everything again. Derived: the picture
/// cache draws the parts of half of a picture, the line cache those of a quarter of the clusters.
const MAX_REDRAWN_PART: usize = 2;
/// Bytes of `SplitLists` of `shared/split_lists.wgsl`.
const SPLIT_LISTS_BYTES: u64 = {
    let samples = TILE_PX * TILE_PX * SAMPLE_ROWS * Samples::Fine.per_row() / u32::BITS;
    let words = MAX_SPLIT_TILES * (1 + samples) + MAX_SPLIT_PARTS * 4;
    words as u64 * size_of::<u32>() as u64
};

/// State of a picture.
#[derive(Default)]
pub(crate) struct TargetState {
    /// True if pictures reuse lines and pixels of earlier ones.
    pub(crate) reuses_frames: bool,
    pub(crate) lines: Option<LineBuffers>,
    pub(crate) tiles: Option<TileBuffers>,
    /// `None` until a list is split.
    pub(crate) split_lists: Option<DeviceBuffer>,
    /// `None` until an edit makes cached lines dirty.
    pub(crate) dirty_clusters: Option<DeviceBuffer>,
    /// Bind groups of the buffers above; `None` after one of them was replaced.
    pub(crate) plan: Option<DispatchPlan>,
    /// Lines of the line buffers that later frames may draw.
    pub(crate) cached_lines: Option<CachedLines>,
    /// The finished picture that the pixel buffer holds.
    pub(crate) picture: Option<CachedPicture>,
    pub(crate) scroller: Option<Scroller>,
    pub(crate) occlusion: Occlusion,
    /// True if the last frame showed few clusters.
    pub(crate) has_few_clusters: bool,
    /// True if the last frame had lists to split.
    pub(crate) has_long_lists: bool,
    /// Length of the longest list of the last frame.
    pub(crate) longest_list: u32,
    /// A LOD whose lines exceed the line buffers.
    pub(crate) oversized_lod: Option<LineLod>,
}

impl TargetState {
    /// Prepares buffers for pictures of a view, and line buffers for a scene of `strokes` strokes.
    pub(crate) fn prepare(
        &mut self,
        device: &mut DeviceContext,
        kernels: &Kernels,
        view: &View,
        strokes: u32,
        has_ranks: bool,
    ) -> Result<(), RenderError> {
        if self.tiles.as_ref().is_none_or(|t| t.size != view.size()) {
            (self.tiles, self.picture, self.scroller) = (None, None, None);
            self.drop_bindings();
            let tiles = TileBuffers::new(&device.gpu, &mut device.memory, view.size())?;
            self.tiles = Some(tiles);
        }
        let lacks_ranks = |lines: &LineBuffers| has_ranks && !lines.capacity.has_ranks;
        if self.lines.as_ref().is_none_or(lacks_ranks) {
            self.drop_bindings();
            let first = Capacity::of_strokes(strokes, has_ranks);
            let capacity = self.lines.take().map_or(first, |lines| Capacity {
                has_ranks,
                ..lines.capacity
            });
            self.replace_lines(device, capacity)?;
        }
        if self.has_long_lists {
            self.prepare_split_lists(device, kernels)?;
        }
        Ok(())
    }

    /// Creates line buffers without lines, as far as limits allow.
    fn replace_lines(
        &mut self,
        device: &mut DeviceContext,
        capacity: Capacity,
    ) -> Result<(), RenderError> {
        self.cached_lines = None;
        let capacity = capacity.within(&device.gpu, &device.memory);
        self.lines = Some(LineBuffers::new(&mut device.memory, capacity)?);
        Ok(())
    }

    /// Makes bytes available, by shrinking the line buffers if necessary. Returns whether there are
    /// enough.
    pub(crate) fn reserve(
        &mut self,
        device: &mut DeviceContext,
        bytes: u64,
    ) -> Result<bool, RenderError> {
        if device.memory.spare_bytes() < bytes {
            self.drop_bindings();
            let lines = self.lines.take();
            let has_ranks = lines.is_some_and(|lines| lines.capacity.has_ranks);
            self.split_lists = None;
            self.replace_lines(device, Capacity::of_strokes(0, has_ranks))?;
        }
        Ok(device.memory.spare_bytes() >= bytes)
    }

    /// Prepares the buffer of split lists. Returns whether lists can be split.
    pub(crate) fn prepare_split_lists(
        &mut self,
        device: &mut DeviceContext,
        kernels: &Kernels,
    ) -> Result<bool, RenderError> {
        if self.split_lists.is_some() {
            return Ok(true);
        }
        let max_bytes = device.gpu.max_binding_bytes();
        let max_bytes = max_bytes.min(device.memory.spare_bytes());
        let kernels = kernels.of_tiles(Samples::Fine);
        if SPLIT_LISTS_BYTES > max_bytes || kernels.cover_split.is_none() {
            return Ok(false);
        }
        let (what, usage) = ("split tiles", BufferUsages::STORAGE);
        self.split_lists = Some(device.memory.zeros(what, SPLIT_LISTS_BYTES, usage)?);
        Ok(true)
    }

    /// Enables occlusion after a window that exceeded capacities. Returns whether to draw it again.
    pub(crate) fn enable_occlusion(&mut self, counters: &FrameCounters) -> bool {
        let lines = self.lines.as_ref();
        let line_capacity = lines.map_or(0, |lines| lines.capacity.lines);
        self.occlusion.enable(counters, line_capacity)
    }

    /// Selects the lines of the next window, and uploads the dirty clusters if it refreshes them.
    /// `is_part`: other parts of the picture are reused.
    pub(crate) fn line_source(
        &mut self,
        device: &mut DeviceContext,
        clusters: usize,
        frame: &FrameContext<'_>,
        is_part: bool,
    ) -> Result<LineSource, RenderError> {
        let source = self.select_lines(frame, is_part);
        let is_refreshed = matches!(source, LineSource::Refreshed(..));
        if !is_refreshed || self.upload_dirty_clusters(device, clusters)? {
            return Ok(source);
        }
        self.cached_lines = None;
        Ok(self.select_lines(frame, is_part))
    }

    fn select_lines(&self, frame: &FrameContext<'_>, is_part: bool) -> LineSource {
        let cached = self.cached_lines.as_ref();
        if is_part {
            return LineSource::Window(cached.map_or(0, CachedLines::count));
        }
        let is_oversized = self.oversized_lod == Some(frame.lod);
        if !self.reuses_frames || self.occlusion.is_enabled || is_oversized {
            return LineSource::Window(0);
        }
        match cached.filter(|cached| cached.lod == frame.lod) {
            Some(cached) => cached.source(),
            None => LineSource::Lod,
        }
    }

    /// Returns `false` if the budget has no room for the list.
    fn upload_dirty_clusters(
        &mut self,
        device: &mut DeviceContext,
        clusters: usize,
    ) -> Result<bool, RenderError> {
        let Some(cached) = &self.cached_lines else {
            return Ok(false);
        };
        let list: Vec<u32> = cached.dirty_clusters().map(|index| index as u32).collect();
        let list_bytes = size_of_val(list.as_slice()) as u64;
        let what = "the changed clusters";
        let buffer = self.dirty_clusters.take();
        let buffer = match buffer.filter(|buffer| buffer.bytes() >= list_bytes) {
            Some(buffer) => buffer,
            None => {
                let bytes = ((max_dirty(clusters) + 1) * size_of::<u32>()) as u64;
                if bytes > device.memory.spare_bytes() {
                    return Ok(false);
                }
                self.drop_bindings();
                let usage = BufferUsages::STORAGE | BufferUsages::COPY_DST;
                device.memory.zeros(what, bytes, usage)?
            }
        };
        let written = device.runner.write_at(what, &buffer, 0, &list);
        self.dirty_clusters = Some(buffer);
        written.map_err(device_error)?;
        Ok(true)
    }

    /// Fixed capacity of each tile list of a window, if lists are short enough that it may suffice
    /// for the next view; otherwise 0.
    pub(crate) fn list_capacity(&self, gpu: &Gpu, capacity: Capacity, window: &Window) -> u32 {
        let tiles = window.tiles().max(1) as u32;
        let [min_unsplit, _] = unsplit_limits(gpu);
        let list_capacity = (capacity.references / tiles).min(min_unsplit);
        if self.longest_list <= list_capacity / 2 {
            list_capacity
        } else {
            0
        }
    }

    /// Marks clusters with changed curves in all caches.
    pub(crate) fn mark_dirty(&mut self, dirty: &DirtyClusters, clusters: &[Cluster]) {
        if dirty.len() as usize > clusters.len() / MAX_REDRAWN_PART {
            (self.picture, self.cached_lines) = (None, None);
            return;
        }
        if self.picture.is_some() {
            let dirty: Vec<usize> = dirty.iter().collect();
            let area_of = |dirty: &[usize]| {
                let mut area = DirtyArea::default();
                dirty.iter().for_each(|&index| area.add(&clusters[index]));
                area
            };
            let join = |mut a: DirtyArea, b: DirtyArea| {
                a.join(b);
                a
            };
            let area = match dirty.len() {
                0..=TASK_CLUSTERS => area_of(&dirty),
                _ => {
                    let areas = dirty.par_chunks(TASK_CLUSTERS).map(area_of);
                    areas.reduce(DirtyArea::default, join)
                }
            };
            self.mark_area(area);
        }
        self.cached_lines
            .take_if(|cached| !cached.mark_dirty(dirty, clusters.len()));
    }

    /// Marks an area of changed curves in the cached picture.
    pub(crate) fn mark_area(&mut self, area: DirtyArea) {
        if let Some(picture) = &mut self.picture {
            picture.mark_dirty(area);
        }
    }

    /// Drops the cached picture and the cached lines.
    pub(crate) fn drop_caches(&mut self) {
        self.picture = None;
        self.cached_lines = None;
    }

    /// Drops all bind groups, after a buffer was replaced.
    pub(crate) fn drop_bindings(&mut self) {
        self.plan = None;
        if let Some(scroller) = &mut self.scroller {
            scroller.plan = None;
        }
    }
}
