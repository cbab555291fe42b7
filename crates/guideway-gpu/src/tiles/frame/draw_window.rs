//! Draws one window, and updates the caches by its counters.

use guideway_scene::{RenderError, Stage};

use super::context::{FrameContext, WindowJob};
use super::dispatch_plan::{DispatchPlan, FrameBuffers, PlanKey};
use super::line_source::LineSource;
use super::renderer::{DrawResult, Renderer};
use crate::tiles::cache::line_cache::CachedLines;
use crate::tiles::constants::FEW_CLUSTERS;
use crate::tiles::device_context::device_error;
use crate::tiles::layouts::FrameCounters;
use crate::tiles::list_limits::has_long_list;
use crate::tiles::paint_mode::PaintMode;

/// Draws a window. Returns its counters, which may exceed capacities.
pub(super) fn draw_window(
    r: &mut Renderer<'_>,
    frame: &FrameContext<'_>,
    paint: PaintMode,
    job: &WindowJob<'_>,
    result: &mut DrawResult,
) -> Result<FrameCounters, RenderError> {
    // After an error nothing stays cached.
    let cached = r.target.cached_lines.take();
    let plan = r.target.plan.take();
    let target = &*r.target;
    let (Some(scene), Some(lines), Some(tiles)) = (&r.scene.buffers, &target.lines, &target.tiles)
    else {
        return Ok(FrameCounters::default());
    };
    let refreshes_dirty = matches!(job.lines, LineSource::Refreshed(..));
    let draws_cached = refreshes_dirty || matches!(job.lines, LineSource::Cached(_));
    let is_single_color = paint == PaintMode::SingleColor;
    let splits_lists = target.split_lists.is_some() && target.has_long_lists && is_single_color;
    let bins_cached = draws_cached && !refreshes_dirty && !splits_lists && is_single_color;
    let list_capacity = if bins_cached {
        target.list_capacity(&r.device.gpu, lines.capacity, job.window)
    } else {
        0
    };

    let key = PlanKey {
        paint,
        samples: frame.samples(),
        draws_cached,
        refreshes_dirty,
        bins_at_once: list_capacity > 0,
        uses_occlusion: target.occlusion.is_enabled && is_single_color,
        has_few_clusters: target.has_few_clusters,
        splits_lists,
    };
    let params = frame.params(job, lines.capacity, list_capacity);
    let buffers = FrameBuffers {
        gpu: &r.device.gpu,
        kernels: r.kernels,
        scene,
        lines,
        tiles,
        split_lists: target.split_lists.as_ref(),
        dirty_clusters: target.dirty_clusters.as_ref(),
        times_stages: r.times_stages,
    };
    let plan = match plan.filter(|plan| plan.has_key(key)) {
        Some(plan) => plan,
        None => DispatchPlan::new(&buffers, key).map_err(device_error)?,
    };
    let runner = &r.device.runner;
    let written = runner.write("the view", &tiles.frame, &params);
    written.map_err(device_error)?;
    let stages = plan.run(&buffers, &params, runner).map_err(device_error)?;
    Stage::merge(&mut result.stages, stages);
    let mut counters = r.device.fetch_counters(&scene.counters)?;

    let end = job.lines.first_new().saturating_add(counters.lines);
    let fits = end <= lines.capacity.lines;
    let is_complete = fits && counters.missing_clusters == 0;
    let drawn_paths = (*frame.view, counters.drawn_paths);
    let cached_paths = cached.as_ref().and_then(|cached| cached.drawn_paths);
    let clusters = scene.cluster_list.len();
    r.target.plan = Some(plan);
    r.target.cached_lines = match job.lines {
        LineSource::Window(first) => cached.filter(|_| first > 0),
        LineSource::Lod => is_complete.then(|| CachedLines::new(frame.lod, end, drawn_paths)),
        LineSource::Cached(_) => cached,
        LineSource::Refreshed(..) => cached
            .filter(|_| is_complete)
            .and_then(|cached| cached.refreshed(end)),
    };
    if job.lines.first_new() > 0 && !fits {
        // The space behind the cached lines is too small. The cached lines of a LOD may serve a
        // part of the picture, too.
        let source = r.target.line_source(r.device, clusters, frame, false)?;
        let lines = match source {
            LineSource::Lod => LineSource::Window(0),
            other => other,
        };
        let job = WindowJob { lines, ..*job };
        return draw_window(r, frame, paint, &job, result);
    }
    if draws_cached {
        counters.lines = end;
        let paths = cached_paths.filter(|(view, _)| !refreshes_dirty && view == frame.view);
        result.drawn_paths = paths.map(|(_, paths)| paths);
    } else {
        result.drawn_paths = Some(counters.drawn_paths);
        let visible = counters.rounded_clusters + counters.exact_clusters;
        r.target.has_few_clusters = visible <= FEW_CLUSTERS;
    }
    r.target.longest_list = counters.longest_list;
    if list_capacity > 0 && counters.longest_list > 0 {
        // A list has exceeded its fixed capacity.
        return draw_window(r, frame, paint, job, result);
    }
    let is_long = exceeds_loops(r, &counters, paint) || has_long_list(&r.device.gpu, &counters);
    r.target.has_long_lists = is_single_color && is_long;
    if splits_lists {
        counters.longest_list = counters.longest_unsplit;
    }
    Ok(counters)
}

/// Returns `true` if the longest list needs more loop iterations than a thread may run.
pub(super) fn exceeds_loops(r: &Renderer<'_>, counters: &FrameCounters, paint: PaintMode) -> bool {
    paint.loops(counters) > u64::from(r.device.gpu.loops_per_thread())
}
