//! The buffers of a scene, with host copies of strokes and clusters for edits.

use std::sync::atomic::{AtomicU32, Ordering::Relaxed};

use guideway_scene::{RenderError, Rgba, Scene};
use rayon::prelude::*;
use wgpu::BufferUsages;

use super::draw_ranks::DrawRanks;
use super::exact_points::ExactPoints;
use super::hidden_strokes::HiddenStrokes;
use super::pack::{Packed, device_color, path_style};
use super::path_parts::PathPart;
use super::point_buffer::{PointBuffer, ViewDistance, buffer_ranges};
use crate::device::{DeviceBuffer, Gpu, Memory, Patcher};
use crate::tiles::device_context::DeviceContext;
use crate::tiles::layouts::{Cluster, ClusterSlot, FrameCounters, PathStyle, PointFormat, Stroke};
use crate::tiles::options::NAME;

/// Least capacity of a point buffer for edited paths, in points.
const MIN_EDIT_POINTS: u32 = 1 << 14;

/// Clusters whose paths one task counts.
const TASK_CLUSTERS: usize = 256;

/// Paths that one task cuts into parts.
const TASK_PATHS: usize = 1 << 14;

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
        let strokes_bytes = size_of_val(packed.strokes.as_slice()) as u64;
        check_binding(gpu, "the strokes", strokes_bytes)?;
        check_binding(gpu, "the styles", size_of_val(style_list.as_slice()) as u64)?;
        let point_buffers = upload_points(gpu, memory, &mut packed, 0)?;
        drop((packed.rounded, packed.exact_m));
        let mut buffers = Self {
            point_buffers,
            exact_points: None,
            strokes: memory.upload("the strokes", &packed.strokes)?,
            clusters: memory.upload("the clusters", &packed.clusters)?,
            styles: memory.upload("the styles", &style_list)?,
            counters: counters(memory, packed.clusters.len())?,
            stroke_list: packed.strokes,
            cluster_list: packed.clusters,
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

    /// Uploads all styles anew. Returns their bytes.
    pub(crate) fn upload_styles(
        &mut self,
        gpu: &Gpu,
        memory: &mut Memory,
        scene: &Scene,
    ) -> Result<u64, RenderError> {
        let list = style_list(scene, &self.ranks);
        let bytes = size_of_val(list.as_slice()) as u64;
        check_binding(gpu, "the styles", bytes)?;
        self.styles = memory.upload("the styles", &list)?;
        self.style_count = list.len() as u32;
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
        self.stroke_list.extend_from_slice(&packed.strokes);
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

    /// Appends clusters in point buffers of their own. [`Self::grow`] makes room for the lists.
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
        self.stroke_list.append(&mut packed.strokes);
        let shifted = packed.clusters.iter().map(|cluster| Cluster {
            first_stroke: cluster.first_stroke + first_stroke,
            ..*cluster
        });
        self.cluster_list.extend(shifted);
        Ok(())
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

    /// Grows the buffers of strokes and clusters to hold their lists. Returns whether it has
    /// uploaded them anew.
    pub(crate) fn grow(&mut self, gpu: &Gpu, memory: &mut Memory) -> Result<bool, RenderError> {
        let holds = |buffer: &DeviceBuffer, bytes: usize| buffer.bytes() >= bytes as u64;
        let strokes_bytes = size_of_val(self.stroke_list.as_slice());
        let clusters_bytes = size_of_val(self.cluster_list.as_slice());
        if holds(&self.strokes, strokes_bytes) && holds(&self.clusters, clusters_bytes) {
            return Ok(false);
        }
        check_binding(gpu, "the strokes", strokes_bytes as u64)?;
        let strokes = 0..self.stroke_list.len() as u32;
        let strokes: Vec<Stroke> = strokes.map(|stroke| self.flagged_stroke(stroke)).collect();
        self.strokes = upload_with_spare(memory, "the strokes", &strokes)?;
        self.clusters = upload_with_spare(memory, "the clusters", &self.cluster_list)?;
        let capacity = self.clusters.bytes() as usize / size_of::<Cluster>();
        self.counters = counters(memory, capacity)?;
        Ok(true)
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
            PointFormat::Rounded => memory.upload(what, &packed.rounded[points])?,
            PointFormat::Exact => memory.upload(what, &packed.exact_m[points])?,
        };
        let range = range.start + first_cluster..range.end + first_cluster;
        let mut buffer = PointBuffer::new(memory, points, format, range, distance)?;
        buffer.used_points = end - first;
        buffers.push(buffer);
    }
    Ok(buffers)
}

/// Uploads values with room for a quarter more.
fn upload_with_spare<T: bytemuck::Pod>(
    memory: &mut Memory,
    what: &'static str,
    values: &[T],
) -> Result<DeviceBuffer, RenderError> {
    let mut padded = values.to_vec();
    padded.resize(values.len() + values.len() / 4 + 64, T::zeroed());
    memory.upload(what, &padded)
}

/// The parts of all drawn paths.
pub(crate) fn all_parts(scene: &Scene, ranks: &DrawRanks) -> Vec<PathPart> {
    let tasks = scene.draw_order().par_chunks(TASK_PATHS).map(|paths| {
        let mut parts = Vec::with_capacity(paths.len());
        for &path in paths {
            if let Some(rank) = ranks.rank(path) {
                PathPart::of_path(scene.layout(), path, rank, &mut parts);
            }
        }
        parts
    });
    tasks.collect::<Vec<_>>().concat()
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
    let bytes = size_of::<FrameCounters>() + clusters.max(1) * size_of::<ClusterSlot>();
    let usage = BufferUsages::STORAGE | BufferUsages::COPY_SRC | BufferUsages::COPY_DST;
    memory.zeros("the list of visible clusters", bytes as u64, usage)
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
