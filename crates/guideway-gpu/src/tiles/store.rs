//! The scene on the device, in as many pieces as it takes, with what the processor must know to change it.

use guideway_scene::RenderError;
use guideway_scene::{Rgba, Scene};
use wgpu::BufferUsages;

use super::NAME;
use super::chunk::{Chunk, Drawn, bytes_of, ranges};
use super::pack::{Packed, Part, device_color, style};
use super::params::{Cluster, Found, PathStyle, Place, Points, Stroke};
use super::ranks::Ranks;
use super::shot::Shot;
use super::twins::Twins;
use crate::device::{DeviceBuffer, Gpu, Memory};

/// Fewest points that a chunk made for changes has room for.
const LEAST_LOOSE_POINTS: u32 = 1 << 14;

/// The scene's buffers, and copies of those that are small.
pub(super) struct Store {
    pub(super) chunks: Vec<Chunk>,
    /// Once a view has come near.
    pub(super) twins: Option<Twins>,
    pub(super) strokes: DeviceBuffer,
    pub(super) clusters: DeviceBuffer,
    pub(super) styles: DeviceBuffer,
    /// Counters, and the list of clusters that are seen.
    pub(super) found: DeviceBuffer,
    pub(super) stroke_list: Vec<Stroke>,
    pub(super) cluster_list: Vec<Cluster>,
    /// Paths of one stroke in each cluster.
    pub(super) whole_paths: Vec<u32>,
    pub(super) style_count: u32,
    pub(super) ranks: Ranks,
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
        for clusters in ranges(&packed.clusters, gpu.binding_bytes()) {
            let own = &mut packed.clusters[clusters.start as usize..clusters.end as usize];
            let first = own[0].first_point;
            let end = own[own.len() - 1].first_point + own[own.len() - 1].points;
            own.iter_mut()
                .for_each(|cluster| cluster.first_point -= first);
            let held = own[0].held();
            let drawn = Drawn::Far {
                least_step_m: own.iter().map(|c| c.step_m).fold(f32::MAX, f32::min),
            };
            let (what, points) = ("the control points", first as usize..end as usize);
            let points = match held {
                Points::Rounded => memory.upload(what, &packed.rounded[points])?,
                Points::Exact => memory.upload(what, &packed.exact_m[points])?,
            };
            let mut chunk = Chunk::new(memory, points, held, clusters, drawn)?;
            chunk.used_points = end - first;
            chunks.push(chunk);
        }
        drop((packed.rounded, packed.exact_m));
        let mut store = Self {
            chunks,
            twins: None,
            strokes: memory.upload("the strokes", &packed.strokes)?,
            clusters: memory.upload("the clusters", &packed.clusters)?,
            styles: memory.upload("the styles", &style_list)?,
            found: found(memory, packed.clusters.len())?,
            stroke_list: packed.strokes,
            cluster_list: packed.clusters,
            whole_paths: Vec::new(),
            style_count: style_list.len() as u32,
            ranks,
        };
        store.count_whole_paths(0..store.cluster_list.len());
        Ok(Some(store))
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

    /// Adds clusters of exact points behind all others, and returns the chunk that has room for them.
    pub(super) fn add(
        &mut self,
        gpu: &Gpu,
        memory: &mut Memory,
        packed: &Packed,
    ) -> Result<usize, RenderError> {
        let points = packed.exact_m.len() as u32;
        let has_room = |c: &Chunk| c.held == Points::Exact && c.spare_points() >= points;
        if !self.chunks.last().is_some_and(has_room) {
            let held = Points::Exact;
            let room = points.saturating_mul(2).max(LEAST_LOOSE_POINTS);
            let bytes = bytes_of(held, room)
                .min(gpu.binding_bytes())
                .max(bytes_of(held, points));
            let what = "changed control points";
            check_seen_at_once(gpu, what, bytes)?;
            let end = self.cluster_list.len() as u32;
            let buffer = memory.zeros(what, bytes, BufferUsages::STORAGE)?;
            let drawn = Drawn::Far { least_step_m: 0.0 };
            self.chunks
                .push(Chunk::new(memory, buffer, held, end..end, drawn)?);
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

    /// All chunks, that of exact points in place of rounded ones last.
    pub(super) fn all_chunks(&self) -> impl Iterator<Item = &Chunk> {
        let twins = self.twins.iter().map(|twins| &twins.chunk);
        self.chunks.iter().chain(twins)
    }

    /// Counts the paths of one stroke of some clusters, after strokes have changed.
    pub(super) fn count_whole_paths(&mut self, clusters: impl Iterator<Item = usize>) {
        self.whole_paths.resize(self.cluster_list.len(), 0);
        for at in clusters {
            let cluster = &self.cluster_list[at];
            let first = cluster.first_stroke as usize;
            let own = &self.stroke_list[first..first + cluster.strokes as usize];
            let whole = own.iter().filter(|stroke| stroke.is_whole_path());
            self.whole_paths[at] = whole.count() as u32;
        }
    }

    /// Paths of one stroke in clusters that may be seen.
    pub(super) fn whole_paths_seen(&self, shot: &Shot<'_>) -> u64 {
        let plain_m = shot.seen_m(None);
        let is_seen = |cluster: &Cluster| {
            let own_m = cluster.width_m().map(|width_m| shot.seen_m(Some(width_m)));
            let seen_m = own_m.unwrap_or(plain_m);
            cluster.bounds().intersects(seen_m)
        };
        let clusters = self.cluster_list.iter().zip(&self.whole_paths);
        let seen = clusters.filter(|(cluster, _)| is_seen(cluster));
        seen.map(|(_, &paths)| u64::from(paths)).sum()
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

/// Whether all paths have one color, and none a width of its own.
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

fn found(memory: &mut Memory, clusters: usize) -> Result<DeviceBuffer, RenderError> {
    let bytes = size_of::<Found>() + clusters.max(1) * size_of::<Place>();
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
