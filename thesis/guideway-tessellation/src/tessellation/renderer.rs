//! Renders a scene from the device's buffers. Lives on one thread, together with its context.
//!
//! Input: a view and a style. Output: RGBA pixels and a report.

use std::rc::Rc;
use std::sync::Arc;
use std::time::Instant;

use guideway_scene::{
    Budget, Cancel, Frame, Preparation, RenderError, Report, Rgba, Scene, Shading, Stage, Style,
    View, Work, elapsed_ms,
};

use super::background::Background;
use super::camera;
use super::chunk::{Chunk, STAGING_BYTES, VisibleCounts};
use super::notes::notes;
use super::plan::{PathTooLong, Plan};
use super::programs::Programs;
use super::shared::{self, VIEW};
use super::tiles::{Tile, Tiling};
use super::work::work;
use crate::device::GlDevice;
use crate::error::GlError;
use crate::options::TessellationOptions;
use crate::sys::{Buffer, Gl, Limits, PrimitiveCounter, Target, Timeline};

/// Largest displacement of a line by rounding, in pixels, before a view is refused.
const MAX_ERROR_PX: f64 = 0.1;

/// A scene on the device.
pub(super) struct Renderer {
    gl: Rc<Gl>,
    method: &'static str,
    options: TessellationOptions,
    limits: Limits,
    budget_bytes: u64,
    scene: Arc<Scene>,
    color: Rgba,
    plan: Plan,
    programs: Programs,
    chunks: Vec<Chunk>,
    view: Buffer,
    /// The target of the last frame.
    target: Option<Rc<Target>>,
    timeline: Timeline,
    primitives: PrimitiveCounter,
}

/// The input of [`Renderer::new`], which moves to another thread.
pub(super) struct RendererConfig {
    pub(super) device: Arc<GlDevice>,
    pub(super) method: &'static str,
    pub(super) options: TessellationOptions,
    pub(super) limits: Limits,
    pub(super) budget: Budget,
    pub(super) scene: Arc<Scene>,
}

impl Renderer {
    /// Plans a scene, compiles the shaders and uploads the buffers.
    ///
    /// # Errors
    /// When the scene is unsupported, or memory or the device fail.
    pub(super) fn new(config: RendererConfig) -> Result<(Self, Preparation), RenderError> {
        let RendererConfig {
            method,
            options,
            limits,
            scene,
            ..
        } = config;
        let failed = |error: GlError| error.of_method(method);
        let color = scene.opaque_color().map_err(|error| {
            let remedy = "Use one opaque color, or another method.";
            RenderError::unsupported(method, error.to_string(), remedy)
        })?;

        let mut stages = Vec::new();
        let mut since = Instant::now();
        let mut done = |name| {
            stages.push(Stage::host(name, elapsed_ms(since)));
            since = Instant::now();
        };
        let plan = Plan::new(&scene, options.commands, &limits).map_err(|PathTooLong { row }| {
            let id = scene.layout().paths.id(row as usize);
            let limit = limits.buffer_bytes;
            RenderError::unsupported(
                method,
                format!(
                    "path `{id}`, whose control points exceed the {limit} bytes of one buffer of \
                     the device"
                ),
                "Split the path, or use another method.",
            )
        })?;
        let held_bytes = plan.bytes(options.commands) + size_of::<shared::View>() as u64;
        let peak_bytes = held_bytes + STAGING_BYTES;
        if peak_bytes > config.budget.memory_bytes {
            return Err(RenderError::Budget {
                method,
                what: "the control points and the draw commands",
                needed_bytes: peak_bytes,
                budget_bytes: config.budget.memory_bytes,
            });
        }
        done("plan");

        let gl = Gl::new(config.device.platform).map_err(failed)?;
        #[cfg(test)]
        gl.allow_allocations(limits.allocations);
        let programs = Programs::new(&gl, options).map_err(failed)?;
        done("compile");

        let mut chunks = Vec::new();
        for chunk_plan in &plan.chunks {
            let chunk = Chunk::new(&gl, chunk_plan, options.commands).map_err(failed)?;
            chunk.fill(&scene, &plan, chunk_plan);
            chunks.push(chunk);
        }
        let view = Buffer::of(&gl, "the view", &shared::View::default()).map_err(failed)?;
        gl.finish(|| true)
            .and_then(|()| gl.check("uploading"))
            .map_err(failed)?;
        done("upload");
        let buffers = chunks.iter().map(Chunk::bytes);
        let preparation = Preparation {
            stages,
            held_bytes: buffers.sum::<u64>() + view.bytes(),
            peak_bytes,
            ..Preparation::default()
        };
        let renderer = Self {
            method,
            options,
            limits,
            budget_bytes: config.budget.memory_bytes,
            scene,
            color,
            plan,
            programs,
            chunks,
            view,
            target: None,
            timeline: Timeline::new(&gl),
            primitives: PrimitiveCounter::new(&gl).map_err(failed)?,
            gl,
        };
        Ok((renderer, preparation))
    }

    /// Draws a view into a frame.
    pub(super) fn render(
        &mut self,
        view: &View,
        style: &Style,
        cancel: &Cancel,
        frame: &mut Frame,
    ) -> Result<Report, RenderError> {
        let tiling = self.tiling(view, style)?;
        cancel.check()?;
        let target = self.target(&tiling)?;
        let background = Background::new(style.background, self.samples());
        frame.resize(view.size());
        self.cull(view, &tiling.first())?;
        let mut read_back_ms = 0.0;
        for tile in tiling.tiles() {
            cancel.check()?;
            self.draw(view, &tile, &target, background)?;
            self.finish(cancel)?;
            let started = Instant::now();
            self.read(&tile, &target, background, frame)?;
            read_back_ms += elapsed_ms(started);
        }
        let drawn = self.chunks.iter().map(Chunk::visible_paths).sum();
        self.report(view, style, drawn, tiling.count(), read_back_ms)
    }

    /// Counts the work of a view without drawing it.
    pub(super) fn count_work(
        &mut self,
        view: &View,
        style: &Style,
        cancel: &Cancel,
    ) -> Result<Work, RenderError> {
        let tiling = self.tiling(view, style)?;
        cancel.check()?;
        self.cull(view, &tiling.first())?;
        self.finish(cancel)?;
        let paths: u64 = self.chunks.iter().map(Chunk::path_count).sum();
        let visible = self.chunks.iter().map(Chunk::visible);
        let visible = visible.fold(VisibleCounts::default(), |a, b| VisibleCounts {
            paths: a.paths + b.paths,
            segments: a.segments + b.segments,
        });
        self.gl.check("counting").map_err(|e| self.failed(e))?;
        Ok(work(self.options.commands, paths, visible, tiling.count()))
    }

    /// Checks that the method can draw a view, and splits it into tiles.
    fn tiling(&self, view: &View, style: &Style) -> Result<Tiling, RenderError> {
        if style.shading != Shading::Color {
            let remedy = "Use color shading, or another method.";
            return Err(RenderError::unsupported(
                self.method,
                "shading by density",
                remedy,
            ));
        }
        let error_px = camera::error_px(&self.plan, view);
        if error_px > MAX_ERROR_PX {
            return Err(RenderError::unsupported(
                self.method,
                format!(
                    "this scale: single precision would displace lines by up to {error_px:.2} \
                     pixels; the limit is {MAX_ERROR_PX}"
                ),
                "Zoom out, or use another method.",
            ));
        }
        let pixels = view.size().pixels() as u64;
        let needed = |target_pixels| {
            self.held_bytes()
                + Target::bytes_for(target_pixels, self.samples())
                + pixels * size_of::<[u8; 4]>() as u64
        };
        let spare = self.budget_bytes.saturating_sub(needed(0));
        let max_pixels = spare / Target::bytes_for(1, self.samples());
        let side = self.limits.picture_side;
        Tiling::new(view.size(), side, max_pixels).ok_or_else(|| RenderError::Budget {
            method: self.method,
            what: "one row of the picture",
            needed_bytes: needed(u64::from(view.size().width().min(side / 2))),
            budget_bytes: self.budget_bytes,
        })
    }

    fn samples(&self) -> u32 {
        self.options.antialias.samples(self.limits.samples)
    }

    fn held_bytes(&self) -> u64 {
        self.chunks.iter().map(Chunk::bytes).sum::<u64>() + self.view.bytes()
    }

    /// The target of the tiles: that of the last frame if its size matches.
    fn target(&mut self, tiling: &Tiling) -> Result<Rc<Target>, RenderError> {
        let (width, height, samples) = (tiling.width, tiling.height, self.samples());
        // Frees the old target before the new allocation: both together may exceed the budget.
        let last = self.target.take();
        let target = match last.filter(|target| target.has_size(width, height, samples)) {
            Some(target) => target,
            None => {
                Rc::new(Target::new(&self.gl, width, height, samples).map_err(|e| self.failed(e))?)
            }
        };
        self.target = Some(Rc::clone(&target));
        Ok(target)
    }

    /// Lists the draws of all paths that are visible in the whole view.
    fn cull(&mut self, view: &View, tile: &Tile) -> Result<(), RenderError> {
        self.write_view(view, tile);
        self.timeline.restart();
        self.mark()?;
        for chunk in &self.chunks {
            chunk.cull(&self.gl, &self.programs.cull);
        }
        self.gl.barrier();
        self.mark()?;
        self.gl.check("culling").map_err(|e| self.failed(e))
    }

    fn draw(
        &mut self,
        view: &View,
        tile: &Tile,
        target: &Target,
        background: Background,
    ) -> Result<(), RenderError> {
        self.write_view(view, tile);
        self.mark()?;
        let (x, y) = tile.viewport_center();
        target.begin(background.stored(), x as i32, y as i32, tile.viewport_side);
        self.primitives.during(|| {
            for chunk in &self.chunks {
                chunk.draw(&self.gl, &self.programs.draw);
            }
        });
        target.resolve();
        self.mark()?;
        self.gl.check("drawing").map_err(|e| self.failed(e))
    }

    fn write_view(&self, view: &View, tile: &Tile) {
        let uniforms = camera::uniforms(&self.plan, view, tile, self.color);
        self.view.write(0, &[uniforms]);
        self.view.bind_uniform(VIEW);
    }

    fn mark(&mut self) -> Result<(), RenderError> {
        let marked = self.timeline.mark();
        marked.map_err(|e| self.failed(e))
    }

    fn finish(&self, cancel: &Cancel) -> Result<(), RenderError> {
        let finished = self.gl.finish(|| cancel.check().is_ok());
        cancel.check()?;
        finished
            .and_then(|()| self.gl.check("drawing"))
            .map_err(|e| self.failed(e))
    }

    fn read(
        &self,
        tile: &Tile,
        target: &Target,
        background: Background,
        frame: &mut Frame,
    ) -> Result<(), RenderError> {
        let row_pixels = frame.size().width();
        let first = tile.y as usize * row_pixels as usize + tile.x as usize;
        let pixels = &mut frame.pixels_mut()[first..];
        target.read(tile.width, tile.height, row_pixels, pixels);
        let rows = pixels.chunks_mut(row_pixels as usize);
        for row in rows.take(tile.height as usize) {
            background.restore(&mut row[..tile.width as usize]);
        }
        let read = self.gl.check("reading the picture");
        read.map_err(|e| self.failed(e))
    }

    fn report(
        &self,
        view: &View,
        style: &Style,
        drawn: u64,
        bands: u32,
        read_back_ms: f64,
    ) -> Result<Report, RenderError> {
        let elapsed_ms = self.timeline.elapsed_ms();
        let lines = self.primitives.count();
        self.gl.check("measuring").map_err(|e| self.failed(e))?;
        // Even intervals are the culling pass and the tiles; odd ones are host work between them.
        let stage = |name, elapsed_ms| Stage {
            name,
            elapsed_ms,
            clock: self.timeline.clock(),
        };
        let draw_ms = elapsed_ms[2..].iter().step_by(2).sum();
        let has_gaps = self.samples() > 1 && self.gl.is_software();
        let target_bytes = self.target.as_ref().map_or(0, |target| target.bytes());
        Ok(Report {
            stages: vec![
                stage("cull", elapsed_ms[0]),
                stage("tessellate and draw", draw_ms),
                Stage::host(Stage::READ_BACK, read_back_ms),
            ],
            lines,
            peak_bytes: self.held_bytes() + target_bytes,
            bands,
            notes: notes(&self.plan, view, style, has_gaps),
            ..Report::of(self.method, &self.scene, drawn)
        })
    }

    fn failed(&self, error: GlError) -> RenderError {
        error.of_method(self.method)
    }
}
