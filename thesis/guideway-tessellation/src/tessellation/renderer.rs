//! A scene on the device, drawn view by view. It lives on one thread, with its context.

use std::rc::Rc;
use std::sync::Arc;
use std::time::Instant;

use guideway_scene::{
    Budget, Cancel, Frame, Preparation, RenderError, Report, Shading, Stage, Style, View, Work,
    elapsed_ms,
};
use guideway_scene::{Rgba, Scene};

use super::background::Background;
use super::camera;
use super::chunk::{Chunk, STAGING_BYTES, Seen};
use super::plan::{Plan, TooLong, one_color};
use super::programs::Programs;
use super::shared::{self, VIEW};
use super::tiles::{Tile, Tiling};
use super::work::work;
use crate::device::GlDevice;
use crate::options::TessellationOptions;
use crate::sys::{Buffer, Gl, Limits, Primitives, Target, Timeline};

/// Lines may be this far off their place before a view is refused.
const MOST_ERROR_PX: f64 = 0.1;

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
    /// That of the last frame.
    target: Option<Rc<Target>>,
    timeline: Timeline,
    primitives: Primitives,
}

/// What a method needs to start a renderer on another thread.
pub(super) struct Start {
    pub(super) device: Arc<GlDevice>,
    pub(super) method: &'static str,
    pub(super) options: TessellationOptions,
    pub(super) limits: Limits,
    pub(super) budget: Budget,
    pub(super) scene: Arc<Scene>,
}

impl Renderer {
    pub(super) fn new(start: Start) -> Result<(Self, Preparation), RenderError> {
        let Start {
            method,
            options,
            limits,
            scene,
            ..
        } = start;
        let unsupported = |what: &str, remedy: &str| unsupported(method, what, remedy);
        let failed = |what| RenderError::Device { method, what };
        let color = one_color(&scene)
            .map_err(|what| unsupported(what, "Draw it in one color, or by another method."))?;

        let mut stages = Vec::new();
        let mut since = Instant::now();
        let mut done = |name| {
            stages.push(Stage::host(name, elapsed_ms(since)));
            since = Instant::now();
        };
        let plan = Plan::new(&scene, options.commands, &limits).map_err(|TooLong { row }| {
            let id = scene.layout().paths.id(row as usize);
            let most = limits.buffer_bytes;
            unsupported(
                &format!("path `{id}`: its control points fill more than the {most} bytes of one buffer of the device"),
                "Split the path, or draw it by another method.",
            )
        })?;
        let held_bytes = plan.bytes(options.commands) + size_of::<shared::View>() as u64;
        let peak_bytes = held_bytes + STAGING_BYTES;
        if peak_bytes > start.budget.memory_bytes {
            return Err(RenderError::Budget {
                method,
                what: "the control points and what is drawn of them",
                needed_bytes: peak_bytes,
                budget_bytes: start.budget.memory_bytes,
            });
        }
        done("plan");

        let gl = Gl::new(start.device.platform).map_err(failed)?;
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
            budget_bytes: start.budget.memory_bytes,
            scene,
            color,
            plan,
            programs,
            chunks,
            view,
            target: None,
            timeline: Timeline::new(&gl),
            primitives: Primitives::new(&gl).map_err(failed)?,
            gl,
        };
        Ok((renderer, preparation))
    }

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
        let drawn = self.chunks.iter().map(Chunk::seen_paths).sum();
        self.report(view, style, drawn, tiling.count(), read_back_ms)
    }

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
        let seen = self.chunks.iter().map(Chunk::seen);
        let seen = seen.fold(Seen::default(), |a, b| Seen {
            paths: a.paths + b.paths,
            segments: a.segments + b.segments,
        });
        self.gl.check("counting").map_err(|e| self.failed(e))?;
        Ok(work(self.options.commands, paths, seen, tiling.count()))
    }

    /// How the view is cut, once it is sure that it can be drawn.
    fn tiling(&self, view: &View, style: &Style) -> Result<Tiling, RenderError> {
        if style.shading != Shading::Color {
            let remedy = "Ask for colors, or for another method.";
            return Err(unsupported(self.method, "density", remedy));
        }
        let error_px = camera::error_px(&self.plan, view);
        if error_px > MOST_ERROR_PX {
            return Err(unsupported(
                self.method,
                &format!(
                    "so close a view: single precision would place lines up to {error_px:.2} pixels off"
                ),
                "Zoom out, or ask for another method.",
            ));
        }
        let pixels = view.size().pixels() as u64;
        let needed = |target_pixels| {
            self.held_bytes()
                + Target::bytes_for(target_pixels, self.samples())
                + pixels * size_of::<[u8; 4]>() as u64
        };
        let spare = self.budget_bytes.saturating_sub(needed(0));
        let most_pixels = spare / Target::bytes_for(1, self.samples());
        let side = self.limits.picture_side;
        Tiling::new(view.size(), side, most_pixels).ok_or_else(|| RenderError::Budget {
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

    /// What tiles are drawn into: that of the last frame if it fits.
    fn target(&mut self, tiling: &Tiling) -> Result<Rc<Target>, RenderError> {
        let (width, height, samples) = (tiling.width, tiling.height, self.samples());
        // An old one goes before the new one comes: both together may be more than the budget.
        let kept = self.target.take();
        let target = match kept.filter(|target| target.is(width, height, samples)) {
            Some(target) => target,
            None => {
                Rc::new(Target::new(&self.gl, width, height, samples).map_err(|e| self.failed(e))?)
            }
        };
        self.target = Some(Rc::clone(&target));
        Ok(target)
    }

    /// Lists what is seen of the whole view.
    fn cull(&mut self, view: &View, tile: &Tile) -> Result<(), RenderError> {
        self.look(view, tile);
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
        self.look(view, tile);
        self.mark()?;
        let (x, y) = tile.viewport_middle();
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

    fn look(&self, view: &View, tile: &Tile) {
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
        // Culling, then each tile; between them is what the host does.
        let stage = |name, elapsed_ms| Stage {
            name,
            elapsed_ms,
            clock: self.timeline.clock(),
        };
        let draw_ms = elapsed_ms[2..].iter().step_by(2).sum();
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
            notes: self.notes(view, style),
            ..Report::of(self.method, &self.scene, drawn)
        })
    }

    /// What is drawn otherwise than asked.
    fn notes(&self, view: &View, style: &Style) -> Vec<String> {
        let mut notes = Vec::new();
        let widths = &self.plan.widths;
        if !widths.are_one_pixel(&style.line_rule, view.px_per_m()) {
            notes.push("Lines are one pixel wide, whatever is asked.".to_owned());
        }
        // The control points of a straight segment reach three times as far as it does.
        if self.plan.smallest_m * view.px_per_m() < 3.0 {
            notes.push("Paths shorter than a pixel may leave no mark.".to_owned());
        }
        if self.samples() > 1 && self.gl.is_software() {
            notes.push(
                "Anti-aliased lines have small gaps, for the processor stands in for a graphics device here."
                    .to_owned(),
            );
        }
        notes
    }

    fn failed(&self, what: String) -> RenderError {
        let method = self.method;
        RenderError::Device { method, what }
    }
}

fn unsupported(method: &'static str, what: &str, remedy: &str) -> RenderError {
    RenderError::Unsupported {
        method,
        what: what.to_owned(),
        remedy: remedy.to_owned(),
    }
}
