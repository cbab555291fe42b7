use std::ops::Range;
use std::sync::Arc;
use std::time::Instant;

use guideway_render::{
    Budget, Cancel, Frame, Preparation, Prepared, RenderError, Report, Shading, Stage, Style, View,
    density, elapsed_ms,
};
use guideway_scene::Scene;
use guideway_spline::Bounds;
use wgpu::BufferUsages;

use super::canvas::Canvas;
use super::pack::Packed;
use super::params::{Found, FrameParams, Stroke, TILE_PX};
use super::passes::{Bound, Paint, Store};
use super::room::{Room, Size};
use super::shot::Shot;
use super::{NAME, Shared};
use crate::device::{DeviceBuffer, FETCHED, Memory, Runner};

/// Largest frame that is planned for.
const PLANNED_PIXELS: u64 = 3840 * 2160;

/// A scene on the device, and the buffers of the last frame.
pub(super) struct PreparedTiles {
    shared: Arc<Shared>,
    scene: Arc<Scene>,
    memory: Memory,
    runner: Runner,
    /// None if nothing is drawn.
    store: Option<Store>,
    found: DeviceBuffer,
    found_fetched: DeviceBuffer,
    paint: Paint,
    facts: Facts,
    /// Paths of several strokes, which the device does not count.
    parted: Vec<u32>,
    room: Option<Room>,
    canvas: Option<Canvas>,
    preparation: Preparation,
}

/// What the processor needs to know of what it packed.
#[derive(Clone, Copy)]
pub(super) struct Facts {
    pub(super) strokes: u32,
    pub(super) clusters: u32,
    pub(super) reach_m: f64,
    pub(super) has_widths: bool,
}

/// See [`guideway_render::Method::plan_bytes`].
pub(super) fn plan_bytes(scene: &Scene, budget: &Budget) -> u64 {
    let geometry = scene.layout().paths.geometry();
    let paths = scene.draw_order().len() as u64;
    let points = (geometry.segment_count() as u64 + 3 * paths) * size_of::<[f32; 2]>() as u64;
    let strokes = paths * size_of::<Stroke>() as u64;
    let room = Size::first(u32::try_from(paths).unwrap_or(u32::MAX)).bytes();
    let pixels = 2 * PLANNED_PIXELS * size_of::<u32>() as u64;
    (points + strokes + room + pixels).min(budget.memory_bytes)
}

impl PreparedTiles {
    pub(super) fn new(
        shared: Arc<Shared>,
        scene: Arc<Scene>,
        budget: &Budget,
    ) -> Result<Self, RenderError> {
        let mut memory = Memory::new(Arc::clone(&shared.gpu), NAME, budget);
        let runner = Runner::new(Arc::clone(&shared.gpu), &mut memory)?;
        let start = Instant::now();
        let packed = Packed::of(&scene);
        let packed_ms = elapsed_ms(start);
        let start = Instant::now();
        let store = Store::new(&shared.gpu, &mut memory, &packed)?;
        let uploaded_ms = elapsed_ms(start);
        let found_bytes = size_of::<Found>() as u64;
        let counters = BufferUsages::STORAGE | BufferUsages::COPY_SRC | BufferUsages::COPY_DST;
        let found = memory.zeros("the counters", found_bytes, counters)?;
        let found_fetched = memory.zeros("the counters", found_bytes, FETCHED)?;
        Ok(Self {
            paint: Paint::of(&scene),
            facts: Facts {
                strokes: packed.strokes.len() as u32,
                clusters: packed.clusters.len() as u32,
                reach_m: packed.reach_m,
                has_widths: packed.has_widths,
            },
            parted: packed.parted,
            shared,
            scene,
            preparation: Preparation {
                stages: vec![
                    Stage::host("pack", packed_ms),
                    Stage::host("upload", uploaded_ms),
                ],
                held_bytes: memory.held_bytes(),
                peak_bytes: memory.take_peak_bytes(),
                ..Preparation::default()
            },
            memory,
            runner,
            store,
            found,
            found_fetched,
            room: None,
            canvas: None,
        })
    }

    /// Has buffers for pictures of this size, and room for lines.
    fn make_ready(&mut self, view: &View) -> Result<(), RenderError> {
        let gpu = &self.shared.gpu;
        if self.canvas.as_ref().is_none_or(|c| c.size != view.size()) {
            self.canvas = None;
            self.canvas = Some(Canvas::new(gpu, &mut self.memory, view.size())?);
        }
        if self.room.is_none() {
            let size = Size::first(self.facts.strokes).within(gpu, &self.memory);
            self.room = Some(Room::new(&mut self.memory, size)?);
        }
        Ok(())
    }

    /// Draws rows of tiles, and says what was found: all of it may not have fitted.
    fn draw(
        &self,
        shot: &Shot<'_>,
        rows: &Range<u32>,
        stages: &mut Vec<Stage>,
    ) -> Result<Found, RenderError> {
        let (Some(store), Some(room), Some(canvas)) = (&self.store, &self.room, &self.canvas)
        else {
            return Ok(Found::default());
        };
        let trouble = |what| self.memory.trouble(what);
        let gpu = &self.shared.gpu;
        let params: FrameParams = shot.params(canvas, room, rows);
        let bound = Bound {
            gpu,
            kernels: &self.shared.kernels,
            store,
            room,
            canvas,
            found: &self.found,
        };
        let paint = match shot.style.shading {
            Shading::Color => self.paint,
            Shading::Density(_) => Paint::Density,
        };
        let set = self.runner.set("the view", &canvas.frame, &params);
        set.map_err(trouble)?;
        let passes = bound
            .passes(&params, paint, shot.samples())
            .map_err(trouble)?;
        let run = passes.run(&self.runner, &[&self.found, &canvas.counts]);
        merge(stages, run.map_err(trouble)?);
        let mut found = Found::default();
        let fetched = self.runner.fetch(
            "the counters",
            &self.found,
            &self.found_fetched,
            size_of::<Found>() as u64,
            |bytes| bytemuck::bytes_of_mut(&mut found).copy_from_slice(bytes),
        );
        fetched.map_err(trouble)?;
        self.check_rounds(&found, paint)?;
        Ok(found)
    }

    /// Whether each thread of a tile may go on to the end of its list.
    fn check_rounds(&self, found: &Found, paint: Paint) -> Result<(), RenderError> {
        let most = self.shared.gpu.rounds_a_thread() / paint.rounds_a_line();
        if found.longest <= most {
            return Ok(());
        }
        Err(RenderError::Unsupported {
            method: NAME,
            what: format!(
                "{} lines on {TILE_PX} x {TILE_PX} pixels: this device ends a thread after some {most}",
                found.longest
            ),
            remedy: "Zoom in, or use `--method cpu`.".to_owned(),
        })
    }

    /// More room for what was found, if there can be.
    fn grow(&mut self, found: &Found) -> Result<bool, RenderError> {
        let Some(room) = self.room.take() else {
            return Ok(false);
        };
        let (old, size) = (room.size, room.size.for_found(found));
        drop(room);
        let fits = size.fits(&self.shared.gpu) && size.bytes() <= self.memory.spare_bytes();
        let size = if fits { size } else { old };
        self.room = Some(Room::new(&mut self.memory, size)?);
        Ok(fits)
    }

    fn fetch(
        &self,
        rows_px: u32,
        stages: &mut Vec<Stage>,
        take: impl FnOnce(&[u8]),
    ) -> Result<(), RenderError> {
        let Some(canvas) = &self.canvas else {
            return Ok(());
        };
        let start = Instant::now();
        let bytes = u64::from(rows_px) * u64::from(canvas.size.width()) * size_of::<u32>() as u64;
        let what = "the picture";
        let fetched = self
            .runner
            .fetch(what, &canvas.pixels, &canvas.fetched, bytes, take);
        fetched.map_err(|what| self.memory.trouble(what))?;
        merge(
            stages,
            vec![Stage::host(Stage::READ_BACK, elapsed_ms(start))],
        );
        Ok(())
    }

    /// Draws all rows of tiles, in as many bands as it takes; `take` gets the bytes of the rows of pixels of
    /// each. Returns what the first band found, and the number of bands.
    fn draw_bands(
        &mut self,
        shot: &Shot<'_>,
        cancel: &Cancel,
        stages: &mut Vec<Stage>,
        mut take: impl FnMut(Range<u32>, &[u8]),
    ) -> Result<(Found, u32), RenderError> {
        let (all_rows, mut band_rows) = match &self.canvas {
            Some(canvas) => (canvas.rows, canvas.band_rows),
            None => (0, 1),
        };
        let (mut first, mut bands, mut in_all) = (0, 0, Found::default());
        while first < all_rows {
            cancel.check()?;
            let rows = first..all_rows.min(first + band_rows);
            let found = self.draw(shot, &rows, stages)?;
            if self.room.as_ref().is_some_and(|r| !r.size.holds(&found)) {
                if !self.grow(&found)? {
                    if band_rows == 1 {
                        let size = Size::first(0).for_found(&found);
                        return Err(size.refused(&self.memory));
                    }
                    band_rows = band_rows.min(rows.end - rows.start).div_ceil(2);
                }
                continue;
            }
            let rows_px = shot.rows_px(&rows);
            self.fetch(rows_px.end - rows_px.start, stages, |bytes| {
                take(rows_px, bytes);
            })?;
            in_all.lines += found.lines;
            in_all.drawn = found.drawn;
            first = rows.end;
            bands += 1;
        }
        Ok((in_all, bands))
    }

    /// Paths of several strokes that are not proven to be outside the view; the device counts the others.
    fn parted_drawn(&self, shot: &Shot<'_>) -> u64 {
        let paths = &self.scene.layout().paths;
        let is_seen = |path: &&u32| {
            let hull = paths.get(**path as usize).hull_bounds();
            hull.is_some_and(|hull: Bounds<f64>| shot.is_seen(hull, self.scene.width_m(**path)))
        };
        self.parted.iter().filter(is_seen).count() as u64
    }
}

/// Adds stages to those of the same name.
fn merge(stages: &mut Vec<Stage>, more: Vec<Stage>) {
    for stage in more {
        match stages.iter_mut().find(|s| s.name == stage.name) {
            Some(same) => same.elapsed_ms += stage.elapsed_ms,
            None => stages.push(stage),
        }
    }
}

impl Prepared for PreparedTiles {
    fn render(
        &mut self,
        view: &View,
        style: &Style,
        cancel: &Cancel,
        frame: &mut Frame,
    ) -> Result<Report, RenderError> {
        let scene = Arc::clone(&self.scene);
        let shot = Shot::new(view, style, &scene, self.facts)?;
        let size = view.size();
        frame.resize(size);
        let mut stages = Vec::new();
        let (mut found, mut bands) = (Found::default(), 1);
        let mut counts = Vec::new();
        if style.shading != Shading::Color {
            counts.resize(size.pixels(), 0.0_f32);
        }
        if self.store.is_none() {
            let background = style.background;
            let pixel = [background.r, background.g, background.b, background.a];
            frame.pixels_mut().fill(pixel);
        } else {
            self.make_ready(view)?;
            let width = size.width() as usize;
            (found, bands) = self.draw_bands(&shot, cancel, &mut stages, |rows, bytes| {
                let band = rows.start as usize * width..rows.end as usize * width;
                let words = bytes.as_chunks().0;
                if counts.is_empty() {
                    frame.pixels_mut()[band].copy_from_slice(words);
                } else {
                    for (count, word) in counts[band].iter_mut().zip(words) {
                        *count = f32::from_le_bytes(*word);
                    }
                }
            })?;
        }
        if let Shading::Density(tone) = style.shading {
            let start = Instant::now();
            density::shade(&counts, tone, style.background, frame);
            stages.push(Stage::host("shade", elapsed_ms(start)));
        }
        let drawn = u64::from(found.drawn) + self.parted_drawn(&shot);
        Ok(Report {
            stages,
            lines: u64::from(found.lines),
            peak_bytes: self.memory.take_peak_bytes(),
            bands,
            ..Report::of(NAME, &scene, drawn)
        })
    }

    fn preparation(&self) -> &Preparation {
        &self.preparation
    }
}
