//! The scene on the device, in as many pieces as it takes, with what the processor must know to change it.

use std::ops::Range;

use guideway_render::RenderError;
use guideway_scene::{Rgba, Scene};
use guideway_spline::Bounds;
use wgpu::BufferUsages;

use super::NAME;
use super::pack::{Packed, Part, device_color, style};
use super::params::{ChunkParams, Cluster, Found, PathStyle, Stroke};
use super::ranks::Ranks;
use crate::device::{DeviceBuffer, Gpu, Memory};

const POINT_BYTES: u64 = size_of::<[f32; 2]>() as u64;
/// Fewest points that a chunk made for changes has room for.
const LEAST_LOOSE_POINTS: u32 = 1 << 14;

/// All clusters at once; and those of a first round, and the others after it.
const ROUNDS: usize = 3;

/// The scene's buffers, and copies of those that are small.
pub(super) struct Store {
    pub(super) chunks: Vec<Chunk>,
    pub(super) strokes: DeviceBuffer,
    pub(super) clusters: DeviceBuffer,
    pub(super) styles: DeviceBuffer,
    /// Counters, and the list of clusters that are seen.
    pub(super) found: DeviceBuffer,
    pub(super) stroke_list: Vec<Stroke>,
    pub(super) cluster_list: Vec<Cluster>,
    pub(super) style_count: u32,
    pub(super) ranks: Ranks,
}

/// Control points that a shader sees at once.
pub(super) struct Chunk {
    /// For each of [`ROUNDS`].
    pub(super) params: [DeviceBuffer; ROUNDS],
    pub(super) points_m: DeviceBuffer,
    /// Whose points they are.
    pub(super) clusters: Range<u32>,
    used_points: u32,
}

impl Chunk {
    fn spare_points(&self) -> u32 {
        (self.points_m.bytes() / POINT_BYTES) as u32 - self.used_points
    }

    pub(super) fn params_of(&self, round: u32) -> ChunkParams {
        ChunkParams {
            first_cluster: self.clusters.start,
            end_cluster: self.clusters.end,
            round,
            padding: 0,
        }
    }
}

impl Store {
    /// Brings a scene to the device; none if there is nothing in it.
    pub(super) fn new(
        gpu: &Gpu,
        memory: &mut Memory,
        scene: &Scene,
        mut packed: Packed,
        ranks: Ranks,
    ) -> Result<Option<Self>, RenderError> {
        if packed.strokes.is_empty() {
            return Ok(None);
        }
        let style_list = style_list(scene, &ranks);
        let strokes_bytes = size_of_val(packed.strokes.as_slice()) as u64;
        check_seen_at_once(gpu, "the strokes", strokes_bytes)?;
        check_seen_at_once(gpu, "the styles", size_of_val(style_list.as_slice()) as u64)?;
        let mut chunks = Vec::new();
        let most_points = u32::try_from(gpu.binding_bytes() / POINT_BYTES).unwrap_or(u32::MAX);
        for clusters in chunks_of(&packed.clusters, most_points) {
            let own = &mut packed.clusters[clusters.start as usize..clusters.end as usize];
            let first = own[0].first_point;
            let end = own[own.len() - 1].first_point + own[own.len() - 1].points;
            own.iter_mut()
                .for_each(|cluster| cluster.first_point -= first);
            let points = &packed.points_m[first as usize..end as usize];
            chunks.push(Chunk {
                params: chunk_params(memory)?,
                points_m: memory.upload("the control points", points)?,
                clusters,
                used_points: end - first,
            });
        }
        drop(packed.points_m);
        Ok(Some(Self {
            chunks,
            strokes: memory.upload("the strokes", &packed.strokes)?,
            clusters: memory.upload("the clusters", &packed.clusters)?,
            styles: memory.upload("the styles", &style_list)?,
            found: found(memory, packed.clusters.len())?,
            stroke_list: packed.strokes,
            cluster_list: packed.clusters,
            style_count: style_list.len() as u32,
            ranks,
        }))
    }

    /// Has every rank's style on the device, as it is now.
    pub(super) fn renew_styles(
        &mut self,
        gpu: &Gpu,
        memory: &mut Memory,
        scene: &Scene,
    ) -> Result<u64, RenderError> {
        let list = style_list(scene, &self.ranks);
        let bytes = size_of_val(list.as_slice()) as u64;
        check_seen_at_once(gpu, "the styles", bytes)?;
        self.styles = memory.upload("the styles", &list)?;
        self.style_count = list.len() as u32;
        Ok(bytes)
    }

    /// Adds clusters behind all others, and returns the chunk that has room for their points.
    pub(super) fn add(
        &mut self,
        gpu: &Gpu,
        memory: &mut Memory,
        packed: &Packed,
    ) -> Result<usize, RenderError> {
        let points = packed.points_m.len() as u32;
        let has_room = self
            .chunks
            .last()
            .is_some_and(|c| c.spare_points() >= points);
        if !has_room {
            let room = u64::from(points.saturating_mul(2).max(LEAST_LOOSE_POINTS));
            let room = room
                .min(gpu.binding_bytes() / POINT_BYTES)
                .max(u64::from(points));
            check_seen_at_once(gpu, "changed control points", room * POINT_BYTES)?;
            let end = self.cluster_list.len() as u32;
            self.chunks.push(Chunk {
                params: chunk_params(memory)?,
                points_m: memory.zeros(
                    "changed control points",
                    room * POINT_BYTES,
                    BufferUsages::STORAGE,
                )?,
                clusters: end..end,
                used_points: 0,
            });
        }
        let at = self.chunks.len() - 1;
        let chunk = &mut self.chunks[at];
        let first_stroke = self.stroke_list.len() as u32;
        self.stroke_list.extend_from_slice(&packed.strokes);
        let moved = packed.clusters.iter().map(|cluster| Cluster {
            first_point: cluster.first_point + chunk.used_points,
            first_stroke: cluster.first_stroke + first_stroke,
            ..*cluster
        });
        self.cluster_list.extend(moved);
        chunk.used_points += points;
        chunk.clusters.end = self.cluster_list.len() as u32;
        Ok(at)
    }

    /// Paths of one stroke in clusters that may be seen, by their box and greatest width.
    pub(super) fn whole_paths_seen(
        &self,
        is_seen: impl Fn(Bounds<f64>, Option<f32>) -> bool,
    ) -> u64 {
        let width_m = |cluster: &Cluster| (cluster.widest_m >= 0.0).then_some(cluster.widest_m);
        let seen = self
            .cluster_list
            .iter()
            .filter(|c| is_seen(c.bounds(), width_m(c)));
        let strokes = seen.map(|cluster| {
            let first = cluster.first_stroke as usize;
            let own = &self.stroke_list[first..first + cluster.strokes as usize];
            own.iter().filter(|stroke| stroke.is_whole_path()).count() as u64
        });
        strokes.sum()
    }

    /// Has room on the device for all strokes and clusters. Returns whether they were brought there anew.
    pub(super) fn make_room(
        &mut self,
        gpu: &Gpu,
        memory: &mut Memory,
    ) -> Result<bool, RenderError> {
        let holds = |buffer: &DeviceBuffer, bytes: usize| buffer.bytes() >= bytes as u64;
        let strokes_bytes = size_of_val(self.stroke_list.as_slice());
        let clusters_bytes = size_of_val(self.cluster_list.as_slice());
        if holds(&self.strokes, strokes_bytes) && holds(&self.clusters, clusters_bytes) {
            return Ok(false);
        }
        check_seen_at_once(gpu, "the strokes", strokes_bytes as u64)?;
        self.strokes = with_spare(memory, "the strokes", &self.stroke_list)?;
        self.clusters = with_spare(memory, "the clusters", &self.cluster_list)?;
        let room = self.clusters.bytes() as usize / size_of::<Cluster>();
        self.found = found(memory, room)?;
        Ok(true)
    }
}

/// Values with room for a quarter more of them.
fn with_spare<T: bytemuck::Pod>(
    memory: &mut Memory,
    what: &'static str,
    values: &[T],
) -> Result<DeviceBuffer, RenderError> {
    let mut padded = values.to_vec();
    padded.resize(values.len() + values.len() / 4 + 64, T::zeroed());
    memory.upload(what, &padded)
}

/// The parts of all drawn paths.
pub(super) fn all_parts(scene: &Scene, ranks: &Ranks) -> Vec<Part> {
    let mut parts = Vec::with_capacity(scene.draw_order().len());
    for &path in scene.draw_order() {
        if let Some(rank) = ranks.rank(path) {
            Part::of_path(scene.layout(), path, rank, &mut parts);
        }
    }
    parts
}

/// Whether all paths have one colour, and none a width of its own.
pub(super) fn is_plain(scene: &Scene) -> bool {
    let mut widths = scene.draw_order().iter().map(|&path| scene.width_m(path));
    scene.common_color().is_some() && widths.all(|width| width.is_none())
}

/// What each rank looks like, or one style that stands for all.
fn style_list(scene: &Scene, ranks: &Ranks) -> Vec<PathStyle> {
    if is_plain(scene) {
        let color = scene.common_color().unwrap_or(Rgba::BLACK);
        return vec![PathStyle {
            color: device_color(color),
            width_m: -1.0,
        }];
    }
    let ranks_there = 0..ranks.count(scene) as u32;
    ranks_there
        .map(|rank| style(scene, ranks.row(rank)))
        .collect()
}

/// Cuts clusters where their points are too many for one buffer.
fn chunks_of(clusters: &[Cluster], most_points: u32) -> Vec<Range<u32>> {
    let mut chunks: Vec<Range<u32>> = Vec::new();
    let mut points = 0;
    for (cluster, index) in clusters.iter().zip(0..) {
        match chunks.last_mut() {
            Some(last) if points + cluster.points <= most_points => last.end = index + 1,
            _ => {
                chunks.push(index..index + 1);
                points = 0;
            }
        }
        points += cluster.points;
    }
    chunks
}

fn chunk_params(memory: &mut Memory) -> Result<[DeviceBuffer; ROUNDS], RenderError> {
    let usage = BufferUsages::UNIFORM | BufferUsages::COPY_DST;
    let mut one = || memory.zeros("the clusters", size_of::<ChunkParams>() as u64, usage);
    Ok([one()?, one()?, one()?])
}

fn found(memory: &mut Memory, clusters: usize) -> Result<DeviceBuffer, RenderError> {
    let bytes = size_of::<Found>() + clusters.max(1) * size_of::<u32>();
    let usage = BufferUsages::STORAGE | BufferUsages::COPY_SRC | BufferUsages::COPY_DST;
    memory.zeros("the list of clusters seen", bytes as u64, usage)
}

fn check_seen_at_once(gpu: &Gpu, what: &str, bytes: u64) -> Result<(), RenderError> {
    let most = gpu.binding_bytes();
    if bytes <= most {
        return Ok(());
    }
    Err(RenderError::Unsupported {
        method: NAME,
        what: format!(
            "{what}, {bytes} bytes, on a device that lets a shader see only {most} at once"
        ),
        remedy: "Draw fewer paths, or use `--method cpu`.".to_owned(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn clusters_are_cut_where_a_buffer_is_full() {
        let of_points = |points| Cluster {
            points,
            ..bytemuck::Zeroable::zeroed()
        };
        let clusters = [5, 5, 6, 9, 1, 10].map(of_points);
        assert_eq!(chunks_of(&clusters, 10), [0..2, 2..3, 3..5, 5..6]);
        assert_eq!(chunks_of(&[], 10), []);
    }
}
