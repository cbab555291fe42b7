//! Keeps the exact points of near clusters on the device: a window reports clusters without them,
//! and is drawn again after they are uploaded.

use guideway_scene::RenderError;

use super::context::FrameContext;
use super::renderer::Renderer;
use crate::device::{DeviceError, READBACK_USAGE};
use crate::tiles::device_context::{DeviceContext, device_error};
use crate::tiles::layouts::{Cluster, ClusterSlot, FrameCounters, PointFormat};
use crate::tiles::options::NAME;
use crate::tiles::upload::exact_points::{EXACT_POINTS, ExactPoints};
use crate::tiles::upload::near_upload::upload_exact;
use crate::tiles::upload::point_buffer::DISPATCH_BYTES;

/// Least capacity of the cache in points, if the budget allows.
const MIN_POINTS: u32 = 1 << 16;

/// Result of an upload.
pub(super) enum NearUpload {
    /// All missing points are on the device.
    Complete,
    /// The window needs this many points, more than fit.
    TooMany(u32),
}

/// Creates the cache of exact points if a view may need it.
pub(super) fn ensure_exact(
    r: &mut Renderer<'_>,
    frame: &FrameContext<'_>,
) -> Result<(), RenderError> {
    let buffers = r.scene.buffers.as_ref();
    let has_cache = buffers.is_none_or(|buffers| buffers.exact_points.is_some());
    if has_cache || !frame.is_near() || allocate(r, 0)? {
        return Ok(());
    }
    Err(over_budget(r.device, 0))
}

/// Uploads the exact points that a window has reported missing.
pub(super) fn upload_missing(
    r: &mut Renderer<'_>,
    frame: &FrameContext<'_>,
    counters: &FrameCounters,
) -> Result<NearUpload, RenderError> {
    let near = near_clusters(r, frame, counters)?;
    let needed = point_count(r, &near);
    let exact = r.scene.buffers.as_ref();
    let Some(exact) = exact.and_then(|buffers| buffers.exact_points.as_ref()) else {
        return Ok(NearUpload::TooMany(needed));
    };
    let is_missing = |cluster: &u32| exact.first_point(*cluster).is_none();
    let missing: Vec<u32> = near.iter().copied().filter(is_missing).collect();
    if missing.is_empty() {
        return Err(device_error(DeviceError::Rejected {
            operation: EXACT_POINTS.to_owned(),
            message: "the device reports points missing that it has".to_owned(),
        }));
    }
    let spare_points = exact.buffer.spare_points();
    if point_count(r, &missing) <= spare_points {
        upload_exact(r.scene, r.device, &missing)?;
        return Ok(NearUpload::Complete);
    }
    // A new cache drops the points of all other clusters.
    if !allocate(r, needed)? {
        return Ok(NearUpload::TooMany(needed));
    }
    upload_exact(r.scene, r.device, &near)?;
    Ok(NearUpload::Complete)
}

/// The error for a single tile that needs more exact points than fit.
pub(super) fn over_budget(device: &DeviceContext, points: u32) -> RenderError {
    let held_bytes = device.memory.held_bytes();
    RenderError::Budget {
        method: NAME,
        what: EXACT_POINTS,
        needed_bytes: held_bytes + PointFormat::Exact.bytes(points),
        budget_bytes: held_bytes + device.memory.spare_bytes(),
    }
}

/// Reads back the visible clusters that are too near for their rounded points.
fn near_clusters(
    r: &mut Renderer<'_>,
    frame: &FrameContext<'_>,
    counters: &FrameCounters,
) -> Result<Vec<u32>, RenderError> {
    let what = "the list of visible clusters";
    let first = size_of::<FrameCounters>();
    let clusters = r.scene.facts.clusters as usize;
    let bytes = (first + clusters * size_of::<ClusterSlot>()) as u64;
    r.target.reserve(r.device, bytes)?;
    let readback = r.device.memory.zeros(what, bytes, READBACK_USAGE)?;
    let Some(buffers) = &r.scene.buffers else {
        return Ok(Vec::new());
    };
    let mut near = Vec::new();
    let runner = &r.device.runner;
    let fetched = runner.fetch(what, &buffers.counters, &readback, bytes, |bytes| {
        let slots = bytes[first..].chunks_exact(size_of::<ClusterSlot>());
        let exact = slots.rev().take(counters.exact_clusters as usize);
        let visible = exact.map(|bytes| bytemuck::pod_read_unaligned::<ClusterSlot>(bytes).visible);
        let is_near = |index: &u32| {
            let cluster = buffers.cluster_list.get(*index as usize);
            cluster.is_some_and(|c| c.step_m > frame.max_step_m())
        };
        near.extend(visible.filter(is_near));
    });
    fetched.map_err(device_error)?;
    near.sort_unstable();
    Ok(near)
}

fn point_count(r: &Renderer<'_>, clusters: &[u32]) -> u32 {
    let buffers = r.scene.buffers.as_ref();
    let list = buffers.map_or(&[][..], |buffers| &buffers.cluster_list);
    clusters.iter().map(|&i| list[i as usize].points).sum()
}

/// Replaces the cache by an empty one for `points` points, and more if the budget allows. Returns
/// `false` if the budget has no room for them.
fn allocate(r: &mut Renderer<'_>, points: u32) -> Result<bool, RenderError> {
    r.target.drop_bindings();
    let Some(buffers) = &mut r.scene.buffers else {
        return Ok(false);
    };
    buffers.exact_points = None;
    // Clusters of rounded points come first.
    let is_rounded = |c: &Cluster| c.format() == PointFormat::Rounded;
    let clusters = buffers.cluster_list.partition_point(is_rounded);
    let generous = points.saturating_add(points / 2).max(MIN_POINTS);
    for points in [generous, points] {
        let bytes = ExactPoints::buffer_bytes(clusters, points);
        let exceeds_binding = bytes > r.device.gpu.max_binding_bytes();
        if exceeds_binding || !r.target.reserve(r.device, bytes + DISPATCH_BYTES)? {
            continue;
        }
        let clusters = &buffers.cluster_list[..clusters];
        let exact = ExactPoints::new(&mut r.device.memory, clusters, points)?;
        buffers.exact_points = Some(exact);
        r.scene.write_dispatches(r.device)?;
        return Ok(true);
    }
    Ok(false)
}
