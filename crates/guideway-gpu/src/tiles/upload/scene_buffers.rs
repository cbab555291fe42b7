//! The buffers of a scene, with host copies of strokes and clusters for edits.

use std::sync::atomic::{AtomicU32, Ordering::Relaxed};

use bytemuck::Zeroable;
use guideway_scene::{RenderError, Rgba, Scene};
use rayon::prelude::*;
use wgpu::BufferUsages;

use super::draw_ranks::DrawRanks;
use super::exact_points::ExactPoints;
use super::hidden_strokes::HiddenStrokes;
use super::pack::{Packed, device_color, path_style};
use super::point_buffer::{PointBuffer, ViewDistance, buffer_ranges};
use crate::device::{DeviceBuffer, Gpu, Memory, Patcher};
use crate::tiles::device_context::{DeviceContext, device_error};
use crate::tiles::layouts::{Cluster, ClusterSlot, FrameCounters, PathStyle, PointFormat, Stroke};
use crate::tiles::options::NAME;

/// Least capacity of a point buffer for edited paths, in points.
const MIN_EDIT_POINTS: u32 = 1 << 14;

/// Part of the strokes and clusters that there is room for behind them.
const SPARE_PART: usize = 8;

/// Buffers grow in steps of this size.
const SPARE_STEP_BYTES: u64 = 1 << 12;
/// Slots that the counters before the slots take the place of.
const SLOTS_OF_COUNTERS: usize = size_of::<FrameCounters>() / size_of::<ClusterSlot>();
const _: () = assert!(size_of::<FrameCounters>().is_multiple_of(size_of::<ClusterSlot>()));
const COUNTERS: &str = "the list of visible clusters";

/// Clusters whose paths one task counts.
const TASK_CLUSTERS: usize = 256;

/// Paths whose styles one task looks up.
const TASK_PATHS: usize = 1 << 11;

/// Buffers of a scene.
pub(crate) struct SceneBuffers {
    pub(crate) point_buffers: Vec<PointBuffer>,
    /// `None` until a view is near.
    pub(crate) exact_points: Option<ExactPoints>,
    pub(crate) strokes: DeviceBuffer,
    pub(crate) clusters: DeviceBuffer,
    pub(crate) styles: DeviceBuffer,
    /// Counters, and a slot per cluster.
    pub(crate) counters: DeviceBuffer,
    pub(crate) stroke_list: Vec<Stroke>,
    pub(crate) cluster_list: Vec<Cluster>,
    /// Place of each cluster in the order of the sorted parts, but for those of later edits.
    places: Vec<u32>,
    pub(crate) hidden: HiddenStrokes,
    /// Number of shown strokes in each cluster that are whole paths.
    pub(crate) whole_paths: Vec<AtomicU32>,
    pub(crate) style_count: u32,
    pub(crate) ranks: DrawRanks,
}

impl SceneBuffers {
    /// Uploads a scene. `None` if it has no strokes.
    pub(crate) fn new(
        gpu: &Gpu,
        memory: &mut Memory,
        scene: &Scene,
        mut packed: Packed,
        ranks: DrawRanks,
    ) -> Result<Option<Self>, RenderError> {
        if packed.strokes.is_empty() {
            return Ok(None);
        }
        let style_list = style_list(scene, &ranks);
        let strokes = packed.strokes.len();
        let strokes_bytes = strokes * size_of::<Stroke>();
        check_binding(gpu, "the strokes", strokes_bytes as u64)?;
        check_binding(gpu, "the styles", size_of_val(style_list.as_slice()) as u64)?;
        let point_buffers = upload_points(gpu, memory, &mut packed, 0)?;
        drop((packed.rounded, packed.exact_m));
        // A gesture needs more strokes and clusters: copying larger buffers takes longer than that.
        let [spare_strokes, spare_clusters] =
            [strokes, packed.clusters.len()].map(|len| len / SPARE_PART);
        packed.clusters.reserve_exact(spare_clusters);
        let cluster_bytes: &[u8] = bytemuck::cast_slice(&packed.clusters);
        let stroke_bytes = packed.strokes.bytes_of(0..strokes);
        let least = |len: usize, size: usize| ((len * size) as u64).min(gpu.max_binding_bytes());
        let mut buffers = Self {
            point_buffers,
            exact_points: None,
            strokes: memory.upload_parts(
                "the strokes",
                &stroke_bytes,
                least(strokes + spare_strokes, size_of::<Stroke>()),
            )?,
            clusters: memory.upload_parts(
                "the clusters",
                &[cluster_bytes],
                least(packed.clusters.len() + spare_clusters, size_of::<Cluster>()),
            )?,
            styles: memory.upload("the styles", &style_list)?,
            counters: counters(memory, packed.clusters.len() + spare_clusters)?,
            stroke_list: packed.strokes.joined(spare_strokes),
            cluster_list: packed.clusters,
            places: packed.places,
            hidden: HiddenStrokes::default(),
            whole_paths: Vec::new(),
            style_count: style_list.len() as u32,
            ranks,
        };
        buffers.count_whole_paths(0..buffers.cluster_list.len());
        Ok(Some(buffers))
    }

    /// Gives all paths one style in new buffers. Returns the bytes sent.
    pub(crate) fn fill_styles(
        &mut self,
        device: &mut DeviceContext,
        patcher: &mut Option<Patcher>,
        scene: &Scene,
        style: PathStyle,
    ) -> Result<u64, RenderError> {
        let count = self.ranks.count(scene);
        let bytes = (count * size_of::<PathStyle>()) as u64;
        check_binding(&device.gpu, "the styles", bytes)?;
        let usage = BufferUsages::STORAGE | BufferUsages::COPY_DST;
        self.styles = device.memory.zeros("the styles", bytes, usage)?;
        self.style_count = count as u32;
        let (patcher, target) = device.patch(patcher, &self.styles)?;
        patcher.fill(&target, count, &style)?;
        Ok(size_of::<PathStyle>() as u64)
    }

    /// Sends all styles, to a new buffer if their number has changed. Returns their bytes.
    pub(crate) fn send_styles(
        &mut self,
        device: &mut DeviceContext,
        scene: &Scene,
    ) -> Result<u64, RenderError> {
        let list = style_list(scene, &self.ranks);
        let (what, bytes) = ("the styles", size_of_val(list.as_slice()) as u64);
        if list.len() == self.style_count as usize {
            let parts = [bytemuck::cast_slice(&list)];
            let written = device.runner.write_parts(what, &self.styles, &parts);
            written.map_err(device_error)?;
        } else {
            check_binding(&device.gpu, what, bytes)?;
            self.styles = device.memory.upload(what, &list)?;
            self.style_count = list.len() as u32;
        }
        Ok(bytes)
    }

    /// Appends clusters of exact points. Returns the index of the point buffer with room for them.
    pub(crate) fn append(
        &mut self,
        gpu: &Gpu,
        memory: &mut Memory,
        packed: &Packed,
    ) -> Result<usize, RenderError> {
        let points = packed.exact_m.len() as u32;
        let has_room =
            |b: &PointBuffer| b.format == PointFormat::Exact && b.spare_points() >= points;
        if !self.point_buffers.last().is_some_and(has_room) {
            let format = PointFormat::Exact;
            let capacity = points.saturating_mul(2).max(MIN_EDIT_POINTS);
            let bytes = format
                .bytes(capacity)
                .min(gpu.max_binding_bytes())
                .max(format.bytes(points));
            let what = "changed control points";
            check_binding(gpu, what, bytes)?;
            let end = self.cluster_list.len() as u32;
            let buffer = memory.zeros(what, bytes, BufferUsages::STORAGE)?;
            let distance = ViewDistance::Far { min_step_m: 0.0 };
            let buffer = PointBuffer::new(memory, buffer, format, end..end, distance)?;
            self.point_buffers.push(buffer);
        }
        let index = self.point_buffers.len() - 1;
        let buffer = &mut self.point_buffers[index];
        let first_stroke = self.stroke_list.len() as u32;
        let strokes = packed.strokes.iter();
        strokes.for_each(|piece| self.stroke_list.extend_from_slice(piece));
        let shifted = packed.clusters.iter().map(|cluster| Cluster {
            first_point: cluster.first_point + buffer.used_points,
            first_stroke: cluster.first_stroke + first_stroke,
            ..*cluster
        });
        self.cluster_list.extend(shifted);
        buffer.used_points += points;
        buffer.clusters.end = self.cluster_list.len() as u32;
        Ok(index)
    }

    /// Appends clusters in point buffers of their own. [`Self::send_new`] sends the lists.
    pub(crate) fn append_apart(
        &mut self,
        gpu: &Gpu,
        memory: &mut Memory,
        mut packed: Packed,
    ) -> Result<(), RenderError> {
        let first_stroke = self.stroke_list.len() as u32;
        let first_cluster = self.cluster_list.len() as u32;
        let points = upload_points(gpu, memory, &mut packed, first_cluster)?;
        self.point_buffers.extend(points);
        let strokes = packed.strokes.iter();
        strokes.for_each(|piece| self.stroke_list.extend_from_slice(piece));
        let shifted = packed.clusters.iter().map(|cluster| Cluster {
            first_stroke: cluster.first_stroke + first_stroke,
            ..*cluster
        });
        self.cluster_list.extend(shifted);
        Ok(())
    }

    /// The place of a cluster in the order of the sorted parts, in which those of exact points are
    /// between those of rounded ones. Clusters of later edits come last.
    pub(crate) fn place(&self, cluster: usize) -> u32 {
        self.places.get(cluster).copied().unwrap_or(cluster as u32)
    }

    /// All point buffers, the exact points of near clusters last.
    pub(crate) fn all_point_buffers(&self) -> impl Iterator<Item = &PointBuffer> {
        let exact = self.exact_points.iter().map(|exact| &exact.buffer);
        self.point_buffers.iter().chain(exact)
    }

    /// Counts a stroke that was shown or hidden.
    pub(crate) fn count_shown(&self, cluster: usize, stroke: u32, is_hidden: bool) {
        if self.stroke_list[stroke as usize].is_whole_path() {
            let paths = &self.whole_paths[cluster];
            match is_hidden {
                true => paths.fetch_sub(1, Relaxed),
                false => paths.fetch_add(1, Relaxed),
            };
        }
    }

    /// Returns `true` if a stroke has segments, and its path is not hidden.
    pub(crate) fn is_drawn(&self, stroke: u32) -> bool {
        self.stroke_list[stroke as usize].is_drawn() && !self.hidden.is_hidden(stroke)
    }

    /// A stroke as the device has it.
    pub(crate) fn flagged_stroke(&self, stroke: u32) -> Stroke {
        let is_hidden = self.hidden.is_hidden(stroke);
        self.stroke_list[stroke as usize].flagged(is_hidden)
    }

    /// Counts the whole paths of some clusters, after their strokes have changed.
    pub(crate) fn count_whole_paths(&mut self, clusters: impl Iterator<Item = usize>) {
        let all = self.cluster_list.len();
        self.whole_paths.resize_with(all, AtomicU32::default);
        let count = |index: usize| {
            let cluster = &self.cluster_list[index];
            let first = cluster.first_stroke as usize;
            let strokes = &self.stroke_list[first..first + cluster.strokes as usize];
            let is_counted = |(index, stroke): &(u32, &Stroke)| {
                stroke.is_whole_path() && !self.hidden.is_hidden(*index)
            };
            let strokes = (cluster.first_stroke..).zip(strokes);
            strokes.filter(is_counted).count() as u32
        };
        let clusters: Vec<usize> = clusters.collect();
        let counted = clusters.par_iter().with_min_len(TASK_CLUSTERS);
        let counts: Vec<u32> = counted.map(|&index| count(index)).collect();
        for (index, count) in clusters.into_iter().zip(counts) {
            *self.whole_paths[index].get_mut() = count;
        }
    }

    /// Makes room on the device for the strokes and clusters from these indices on, and sends them.
    /// Returns the bytes sent.
    pub(crate) fn send_new(
        &mut self,
        device: &mut DeviceContext,
        [first_stroke, first_cluster]: [usize; 2],
    ) -> Result<u64, RenderError> {
        let (gpu, memory) = (&device.gpu, &mut device.memory);
        let (strokes, clusters) = (self.stroke_list.len(), self.cluster_list.len());
        grow_to(
            gpu,
            memory,
            "the strokes",
            &mut self.strokes,
            strokes * size_of::<Stroke>(),
        )?;
        let bytes = clusters * size_of::<Cluster>();
        grow_to(gpu, memory, "the clusters", &mut self.clusters, bytes)?;
        let bytes = counters_bytes(clusters);
        grow_to(gpu, memory, COUNTERS, &mut self.counters, bytes)?;
        let strokes = first_stroke as u32..strokes as u32;
        let strokes: Vec<Stroke> = strokes.map(|stroke| self.flagged_stroke(stroke)).collect();
        let clusters = &self.cluster_list[first_cluster..];
        let (runner, first_stroke) = (&device.runner, first_stroke as u32);
        let written = runner.write_at("the strokes", &self.strokes, first_stroke, &strokes);
        written.map_err(device_error)?;
        let first_cluster = first_cluster as u32;
        let written = runner.write_at("the clusters", &self.clusters, first_cluster, clusters);
        written.map_err(device_error)?;
        // Clusters of an earlier gesture may have left their line blocks.
        let slots = vec![ClusterSlot::zeroed(); clusters.len()];
        let first_slot = (SLOTS_OF_COUNTERS + first_cluster as usize) as u32;
        let written = runner.write_at(COUNTERS, &self.counters, first_slot, &slots);
        written.map_err(device_error)?;
        Ok((size_of_val(strokes.as_slice()) + size_of_val(clusters)) as u64)
    }
}

/// Uploads the points of packed clusters, which become those from `first_cluster` on, in as many
/// buffers as binding limits require. The clusters then index their buffer.
fn upload_points(
    gpu: &Gpu,
    memory: &mut Memory,
    packed: &mut Packed,
    first_cluster: u32,
) -> Result<Vec<PointBuffer>, RenderError> {
    let mut buffers = Vec::new();
    for range in buffer_ranges(&packed.clusters, gpu.max_binding_bytes()) {
        let clusters = &mut packed.clusters[range.start as usize..range.end as usize];
        let first = clusters[0].first_point;
        let last = clusters[clusters.len() - 1];
        let end = last.first_point + last.points;
        for cluster in clusters.iter_mut() {
            cluster.first_point -= first;
        }
        let format = clusters[0].format();
        let distance = ViewDistance::Far {
            min_step_m: clusters.iter().map(|c| c.step_m).fold(f32::MAX, f32::min),
        };
        let (what, points) = ("the control points", first as usize..end as usize);
        let points = match format {
            PointFormat::Rounded => {
                memory.upload_parts(what, &packed.rounded.bytes_of(points), 0)?
            }
            PointFormat::Exact => memory.upload_parts(what, &packed.exact_m.bytes_of(points), 0)?,
        };
        let range = range.start + first_cluster..range.end + first_cluster;
        let mut buffer = PointBuffer::new(memory, points, format, range, distance)?;
        buffer.used_points = end - first;
        buffers.push(buffer);
    }
    Ok(buffers)
}

/// Grows a buffer that is too small, to a quarter more than needed as far as bindings allow.
fn grow_to(
    gpu: &Gpu,
    memory: &mut Memory,
    what: &'static str,
    buffer: &mut DeviceBuffer,
    bytes: usize,
) -> Result<(), RenderError> {
    let needed = bytes as u64;
    if buffer.bytes() >= needed {
        return Ok(());
    }
    check_binding(gpu, what, needed)?;
    let with_spare = (needed + needed / 4).next_multiple_of(SPARE_STEP_BYTES);
    memory.grow(what, buffer, with_spare.min(gpu.max_binding_bytes()))
}

/// The style of each rank; a single one if all paths look alike.
fn style_list(scene: &Scene, ranks: &DrawRanks) -> Vec<PathStyle> {
    if scene.is_plain() {
        let color = scene.common_color().unwrap_or(Rgba::BLACK);
        return vec![PathStyle {
            color: device_color(color),
            width_m: -1.0,
        }];
    }
    let all_ranks = (0..ranks.count(scene) as u32).into_par_iter();
    let styles = all_ranks.with_min_len(TASK_PATHS);
    styles
        .map(|rank| path_style(scene, ranks.row(rank)))
        .collect()
}

fn counters(memory: &mut Memory, clusters: usize) -> Result<DeviceBuffer, RenderError> {
    let usage = BufferUsages::STORAGE | BufferUsages::COPY_SRC | BufferUsages::COPY_DST;
    memory.zeros(COUNTERS, counters_bytes(clusters) as u64, usage)
}

/// Bytes of the counters and a slot per cluster.
fn counters_bytes(clusters: usize) -> usize {
    size_of::<FrameCounters>() + clusters.max(1) * size_of::<ClusterSlot>()
}

fn check_binding(gpu: &Gpu, what: &str, bytes: u64) -> Result<(), RenderError> {
    let limit = gpu.max_binding_bytes();
    if bytes <= limit {
        return Ok(());
    }
    Err(RenderError::unsupported(
        NAME,
        format!("{what}: {bytes} bytes exceed the device's limit of {limit} per binding"),
        "Draw fewer paths, or use `--method cpu`.",
    ))
}
