//! Draws a picture window by window, and grows buffers or splits windows that overflow them. Reads
//! pixels back.

use std::ops::Range;
use std::sync::atomic::Ordering::Relaxed;
use std::time::Instant;

use guideway_scene::{Cancel, PathState, RenderError, Stage, elapsed_ms};

use super::capacity::Capacity;
use super::context::{FrameContext, WindowJob};
use super::draw_window::{draw_window, exceeds_loops};
use super::line_source::LineSource;
use super::near_points::{NearUpload, ensure_exact, over_budget, upload_missing};
use super::renderer::{Deliver, DrawResult, Renderer};
use super::window::Window;
use crate::device::Memory;
use crate::tiles::cache::picture_cache::{CachedPicture, PictureReuse};
use crate::tiles::cache::scroll::scroll;
use crate::tiles::constants::{MAX_SPLIT_PARTS, MAX_SPLIT_TILES, TILE_PX};
use crate::tiles::device_context::device_error;
use crate::tiles::layouts::{Cluster, FrameCounters};
use crate::tiles::options::NAME;
use crate::tiles::paint_mode::PaintMode;
use crate::tiles::upload::uploaded_scene::UploadedScene;

/// Draws a picture, or the part of it that cannot be reused. `deliver` takes its rows.
pub(crate) fn draw_picture(
    r: &mut Renderer<'_>,
    frame: &FrameContext<'_>,
    paint: PaintMode,
    cancel: &Cancel,
    mut deliver: impl Deliver,
) -> Result<DrawResult, RenderError> {
    let mut result = DrawResult::default();
    let Some(tiles) = &r.target.tiles else {
        return Ok(result);
    };
    let (columns, rows, band_rows) = (tiles.columns, tiles.rows, tiles.band_rows);
    let size = frame.view.size();
    let reuse = reuse_picture(r, frame, &mut result.stages)?;
    let mut picture = CachedPicture::new(frame.view, frame.style);
    for first_row in (0..rows).step_by(band_rows as usize) {
        let end_row = rows.min(first_row + band_rows);
        let mut windows = vec![Window {
            columns: 0..columns,
            rows: first_row..end_row,
        }];
        if let Some(reuse) = &reuse {
            (windows, picture) = (reuse.windows.clone(), reuse.picture);
            result.is_part = true;
        }
        draw_windows(r, frame, paint, windows, first_row, cancel, &mut result)?;
        let rows_px = first_row * TILE_PX..size.height().min(end_row * TILE_PX);
        let pixels = (rows_px.start * size.width()) as usize..(rows_px.end * size.width()) as usize;
        deliver(r, pixels, &mut result.stages)?;
    }
    if r.target.reuses_frames {
        r.target.picture = Some(picture);
    }
    Ok(result)
}

/// Scrolls the cached picture to the view. `None` if nothing can be reused.
fn reuse_picture(
    r: &mut Renderer<'_>,
    frame: &FrameContext<'_>,
    stages: &mut Vec<Stage>,
) -> Result<Option<PictureReuse>, RenderError> {
    let target = &mut *r.target;
    let (Some(picture), Some(tiles)) = (target.picture.take(), &mut target.tiles) else {
        return Ok(None);
    };
    let Some(reuse) = picture.reuse_for(frame, tiles) else {
        return Ok(None);
    };
    let Some(by) = &reuse.scroll else {
        return Ok(Some(reuse));
    };
    let (kernel, plan) = (&r.kernels.scroll, &mut target.plan);
    match scroll(r.device, kernel, tiles, plan, &mut target.scroller, by)? {
        Some(scrolled) => {
            Stage::merge(stages, scrolled);
            Ok(Some(reuse))
        }
        None => Ok(None),
    }
}

/// Draws windows in order. Splits a window that exceeds capacities that cannot grow.
fn draw_windows(
    r: &mut Renderer<'_>,
    frame: &FrameContext<'_>,
    paint: PaintMode,
    mut windows: Vec<Window>,
    first_row: u32,
    cancel: &Cancel,
    result: &mut DrawResult,
) -> Result<(), RenderError> {
    windows.reverse();
    while let Some(window) = windows.pop() {
        cancel.check()?;
        ensure_exact(r, frame)?;
        let clusters = r.scene.buffers.as_ref().map_or(0, |b| b.cluster_list.len());
        let lines = r
            .target
            .line_source(r.device, clusters, frame, result.is_part)?;
        let job = WindowJob {
            window: &window,
            first_row,
            lines,
        };
        let counters = draw_window(r, frame, paint, &job, result)?;
        match next_step(r, frame, paint, &job, &counters, result)? {
            NextStep::Done => {}
            NextStep::DrawAgain => windows.push(window),
            NextStep::Split([first, second]) => windows.extend([second, first]),
        }
    }
    Ok(())
}

/// The step after a window.
enum NextStep {
    Done,
    /// Capacities have grown, or the window is drawn in another way.
    DrawAgain,
    Split([Window; 2]),
}

fn next_step(
    r: &mut Renderer<'_>,
    frame: &FrameContext<'_>,
    paint: PaintMode,
    job: &WindowJob<'_>,
    counters: &FrameCounters,
    result: &mut DrawResult,
) -> Result<NextStep, RenderError> {
    let fills_cache = job.lines == LineSource::Lod;
    let is_single_color = paint == PaintMode::SingleColor;
    let halves = || job.window.halves();
    if counters.missing_clusters > 0 {
        let NearUpload::TooMany(points) = upload_missing(r, frame, counters)? else {
            return Ok(NextStep::DrawAgain);
        };
        if fills_cache {
            r.target.oversized_lod = Some(frame.lod);
            return Ok(NextStep::DrawAgain);
        }
        return match halves() {
            Some(halves) => Ok(NextStep::Split(halves)),
            None => Err(over_budget(r.device, points)),
        };
    }
    let exceeds_loops = exceeds_loops(r, counters, paint);
    let lines = r.target.lines.as_ref();
    if !exceeds_loops && lines.is_some_and(|lines| lines.capacity.holds(counters)) {
        // A part of a picture says little about all of it.
        if is_single_color && !result.is_part {
            r.target.occlusion.update(job.window, counters);
        }
        result.lines += u64::from(counters.lines);
        result.work.add(counters);
        result.windows += 1;
        return Ok(NextStep::Done);
    }
    if is_single_color && r.target.enable_occlusion(counters) {
        return Ok(NextStep::DrawAgain);
    }
    if exceeds_loops {
        let was_split = counters.longest_unsplit > 0;
        if is_single_color && !was_split && r.target.prepare_split_lists(r.device, r.kernels)? {
            return Ok(NextStep::DrawAgain);
        }
        let lacks_parts =
            counters.split_tiles > MAX_SPLIT_TILES || counters.split_parts > MAX_SPLIT_PARTS;
        return match halves().filter(|_| lacks_parts) {
            Some(halves) => Ok(NextStep::Split(halves)),
            None => Err(too_many_lines(counters)),
        };
    }
    if grow_lines(r, frame, counters)? {
        return Ok(NextStep::DrawAgain);
    }
    if fills_cache {
        r.target.oversized_lod = Some(frame.lod);
        return Ok(NextStep::DrawAgain);
    }
    match halves() {
        Some(halves) => Ok(NextStep::Split(halves)),
        None => {
            let capacity = Capacity::of_strokes(0, frame.needs_ranks(paint));
            let capacity = capacity.grown_to(counters, false);
            Err(capacity.over_budget(&r.device.memory))
        }
    }
}

/// Grows the line buffers to what a window has counted. Drops split lists and unneeded exact points
/// if the budget is short. Returns `false` if there is no room.
fn grow_lines(
    r: &mut Renderer<'_>,
    frame: &FrameContext<'_>,
    counters: &FrameCounters,
) -> Result<bool, RenderError> {
    let Some(lines) = r.target.lines.take() else {
        return Ok(false);
    };
    let cached = r.target.cached_lines.take();
    r.target.drop_bindings();
    let old = lines.capacity;
    let capacity = old.grown_to(counters, r.target.occlusion.is_enabled);
    let is_short = |memory: &Memory| capacity.bytes() > memory.spare_bytes() + old.bytes();
    if is_short(&r.device.memory) {
        r.target.split_lists = None;
    }
    if let Some(buffers) = &mut r.scene.buffers
        && is_short(&r.device.memory)
        && !frame.is_near()
    {
        buffers.exact_points = None;
    }
    let fits = capacity.fits_bindings(&r.device.gpu) && !is_short(&r.device.memory);
    let lines = if fits {
        lines.grown(&mut r.device.memory, capacity)?
    } else {
        lines
    };
    r.target.cached_lines = cached.filter(|_| lines.capacity.lines == old.lines);
    r.target.lines = Some(lines);
    Ok(fits)
}

/// Fetches the first pixels of the pixel buffer, which are these of the picture. `take` receives
/// their range in the picture and their bytes, part by part.
pub(crate) fn fetch_pixels(
    r: &Renderer<'_>,
    pixels: Range<usize>,
    stages: &mut Vec<Stage>,
    mut take: impl FnMut(Range<usize>, &[u8]),
) -> Result<(), RenderError> {
    let Some(tiles) = &r.target.tiles else {
        return Ok(());
    };
    let start = Instant::now();
    let bytes = (pixels.len() * size_of::<u32>()) as u64;
    let mut first = pixels.start;
    let take = |bytes: &[u8]| {
        let end = first + bytes.len() / size_of::<u32>();
        take(first..end, bytes);
        first = end;
    };
    let (what, through) = ("the picture", &tiles.readbacks);
    let runner = &r.device.runner;
    let fetched = runner.fetch_in_parts(what, &tiles.pixels, through, bytes, take);
    fetched.map_err(device_error)?;
    let read = Stage::host(Stage::READ_BACK, elapsed_ms(start));
    Stage::merge(stages, [read]);
    Ok(())
}

fn too_many_lines(counters: &FrameCounters) -> RenderError {
    RenderError::unsupported(
        NAME,
        format!(
            "{} lines on {TILE_PX} x {TILE_PX} pixels: this device ends threads that run so long",
            counters.longest_list
        ),
        "Zoom in, or use `--method cpu`.",
    )
}

/// Number of paths that may be visible.
pub(crate) fn count_drawn_paths(
    scene: &UploadedScene,
    frame: &FrameContext<'_>,
    result: &DrawResult,
) -> u64 {
    let is_whole = !result.is_part && result.windows == 1;
    let single_stroke_paths = match (&scene.buffers, result.drawn_paths) {
        (Some(_), Some(paths)) if is_whole => u64::from(paths),
        // The device counts paths per window, and none of cached lines: count whole clusters.
        (Some(buffers), _) => {
            let plain_m = frame.visible_bounds_m(None);
            let is_visible = |cluster: &Cluster| {
                let width_m = cluster.width_m();
                let own_m = width_m.map(|width_m| frame.visible_bounds_m(Some(width_m)));
                cluster.bounds().intersects(own_m.unwrap_or(plain_m))
            };
            let clusters = buffers.cluster_list.iter().zip(&buffers.whole_paths);
            let visible = clusters.filter(|(cluster, _)| is_visible(cluster));
            visible
                .map(|(_, paths)| u64::from(paths.load(Relaxed)))
                .sum()
        }
        (None, _) => 0,
    };
    let paths = &scene.scene.layout().paths;
    let is_visible = |path: &&u32| {
        let hull = paths.get(**path as usize).hull_bounds();
        let width_m = scene.scene.width_m(**path);
        let shown = |hull| match &scene.gesture {
            Some(gesture) => gesture.shown_hull(**path, hull),
            None => hull,
        };
        let is_shown = scene.scene.state(**path) == PathState::Shown;
        is_shown && hull.is_some_and(|hull| shown(hull).intersects(frame.visible_bounds_m(width_m)))
    };
    let others = scene.multi_stroke_paths.iter().filter(is_visible);
    single_stroke_paths + others.count() as u64
}
