use std::ops::Range;
use std::sync::Arc;
use std::time::Instant;

use guideway_scene::{
    Budget, Cancel, Frame, FrameSize, Preparation, Prepared, RenderError, Report, Stage, Style,
    View, Work, elapsed_ms,
};
use guideway_scene::{Rgba, Scene};
use wgpu::BufferUsages;

use crate::build::{Builder, Built, Chunk};
use crate::canvas::{Canvas, PIXEL_BYTES, Purpose};
use crate::cut::Cutter;
use crate::local::Local;
use crate::options::Binning;
use crate::pack::Packer;
use crate::params::{GridParams, LINE_BYTES, WORKGROUP};
use crate::pass::Pass;
use crate::shot::{Shot, Widths};
use crate::{NAME, Variant, pass, unsupported};
use guideway_gpu::device::{DeviceBuffer, Dispatch, Memory, Runner};

const BORDERS_NOTE: &str = "Lines are listed without their width, as the thesis writes: part of it is \
     missing across the borders of cells. Option `radius` mends that.";

/// A scene whose lines are sorted, and the buffers of the last picture.
pub(super) struct PreparedGrid {
    variant: Arc<Variant>,
    scene: Arc<Scene>,
    memory: Memory,
    runner: Runner,
    local: Local,
    color: Rgba,
    widths: Widths,
    grid: GridParams,
    grid_buffer: DeviceBuffer,
    chunks: Vec<Chunk>,
    canvas: Option<Canvas>,
    preparation: Preparation,
}

/// The color of all paths.
fn one_color(scene: &Scene) -> Result<Rgba, RenderError> {
    match scene.common_color() {
        None => Err(unsupported(
            "paths of several colors",
            "Leave --color-by out, or use `--method cpu`.",
        )),
        Some(color) if !color.is_opaque() => Err(unsupported(
            "translucent paths",
            "Ask for an opaque color, or use `--method cpu`.",
        )),
        Some(color) => Ok(color),
    }
}

fn widths(scene: &Scene) -> Widths {
    let mut widths = scene.draw_order().iter().map(|&path| scene.width_m(path));
    let first = widths.next().flatten();
    if widths.all(|width| width == first) {
        Widths::One(first)
    } else {
        Widths::Several
    }
}

impl PreparedGrid {
    pub(super) fn new(
        variant: Arc<Variant>,
        scene: Arc<Scene>,
        budget: &Budget,
    ) -> Result<Self, RenderError> {
        let color = one_color(&scene)?;
        let start = Instant::now();
        let local = Local::of(&scene);
        let grid = local.grid(&variant.options);
        let bounded_ms = elapsed_ms(start);

        let mut memory = Memory::new(Arc::clone(&variant.gpu), NAME, budget);
        let runner = Runner::new(Arc::clone(&variant.gpu), &mut memory)?;
        let uniform = BufferUsages::UNIFORM | BufferUsages::COPY_DST;
        let grid_buffer = memory.zeros("the grid", size_of::<GridParams>() as u64, uniform)?;
        let set = runner.set("the grid", &grid_buffer, &grid);
        set.map_err(|what| memory.trouble(what))?;
        let packer = Packer {
            scene: &scene,
            local: &local,
            grid: &grid,
            options: &variant.options,
            most_work: variant.gpu.tests_a_submit(),
            most_items: variant.gpu.most_workgroups().saturating_mul(WORKGROUP)
                / variant.options.lines_a_segment(),
        };
        let builder = Builder {
            gpu: &variant.gpu,
            options: &variant.options,
            kernels: &variant.kernels,
            memory: &mut memory,
            runner: &runner,
            grid: &grid_buffer,
        };
        let Built {
            chunks,
            stages,
            atomics,
        } = builder.build(&packer, local.segments)?;
        let bounded = Stage::host("bound", bounded_ms);
        let preparation = Preparation {
            stages: std::iter::once(bounded).chain(stages).collect(),
            held_bytes: memory.held_bytes(),
            peak_bytes: memory.take_peak_bytes(),
            work: Work {
                atomics: Some(atomics),
                ..Work::default()
            },
        };
        Ok(Self {
            widths: widths(&scene),
            color,
            variant,
            scene,
            memory,
            runner,
            local,
            grid,
            grid_buffer,
            chunks,
            canvas: None,
            preparation,
        })
    }

    fn canvas(&mut self, size: FrameSize, purpose: Purpose) -> Result<Canvas, RenderError> {
        // A picture keeps its canvas; what was kept for another size gives way first.
        if let Some(canvas) = self.canvas.take()
            && purpose == Purpose::Picture
            && canvas.size == size
        {
            return Ok(canvas);
        }
        Canvas::new(
            &self.variant.gpu,
            &mut self.memory,
            size,
            purpose,
            &self.variant.kernels,
            &self.grid_buffer,
            &self.chunks,
        )
    }

    /// Draws on a canvas, hands out band by band what came of it, and returns milliseconds of drawing and of
    /// fetching.
    fn draw(
        &self,
        shot: &Shot,
        canvas: &Canvas,
        cancel: &Cancel,
        mut take: impl FnMut(Range<u32>, &[u8]),
    ) -> Result<(f64, f64), RenderError> {
        let gpu = &self.variant.gpu;
        let kernel = canvas.purpose.kernel(&self.variant.kernels);
        let ok = |what| self.memory.trouble(what);
        let passes = self.passes(shot);
        let (mut drawing_ms, mut fetching_ms) = (0.0, 0.0);
        for rows in canvas.bands() {
            for pass in &passes {
                let cutter = Cutter::new(gpu.tests_a_submit(), gpu.most_workgroups());
                for tiles in pass.cut(shot, &self.chunks[pass.chunk].table, &rows, cutter) {
                    cancel.check()?;
                    let params = shot.params(&rows, &tiles, pass);
                    self.runner
                        .set("the view", &canvas.view, &params)
                        .map_err(ok)?;
                    let dispatch = Dispatch {
                        kernel,
                        bindings: &canvas.bindings[pass.chunk],
                        workgroups: tiles.end - tiles.start,
                    };
                    drawing_ms += self.runner.run("the picture", &[dispatch]).map_err(ok)?;
                }
            }
            cancel.check()?;
            let start = Instant::now();
            let (result, row_bytes) = canvas.result();
            let bytes = u64::from(rows.end - rows.start) * row_bytes;
            let fetched =
                self.runner
                    .fetch("the picture", result, &canvas.fetched, bytes, |bytes| {
                        take(rows, bytes);
                    });
            fetched.map_err(ok)?;
            fetching_ms += elapsed_ms(start);
        }
        Ok((drawing_ms, fetching_ms))
    }

    fn passes(&self, shot: &Shot) -> Vec<Pass> {
        let tables = self.chunks.iter().map(|chunk| &chunk.table);
        pass::passes(shot, tables, self.variant.gpu.rounds_a_thread())
    }

    fn shot(&self, view: &View, style: &Style) -> Result<Shot, RenderError> {
        Shot::new(
            view,
            style,
            self.color,
            self.widths,
            self.local,
            self.grid,
            &self.variant.options,
        )
    }
}

impl Prepared for PreparedGrid {
    fn render(
        &mut self,
        view: &View,
        style: &Style,
        cancel: &Cancel,
        frame: &mut Frame,
    ) -> Result<Report, RenderError> {
        let shot = self.shot(view, style)?;
        let size = view.size();
        frame.resize(size);
        let (mut bands, mut stages) = (1, Vec::new());
        if self.chunks.is_empty() {
            let Rgba { r, g, b, a } = style.background;
            frame.pixels_mut().fill([r, g, b, a]);
        } else {
            let canvas = self.canvas(size, Purpose::Picture)?;
            let width = size.width() as usize;
            let (drawing_ms, fetching_ms) = self.draw(&shot, &canvas, cancel, |rows, bytes| {
                let band = rows.start as usize * width..rows.end as usize * width;
                frame.pixels_mut()[band].copy_from_slice(bytes.as_chunks().0);
            })?;
            bands = canvas.bands().len() as u32;
            stages.push(self.runner.stage("test pixels", drawing_ms));
            stages.push(Stage::host(Stage::READ_BACK, fetching_ms));
            self.canvas = Some(canvas);
        }
        let loses_borders = self.variant.options.binning == Binning::LineBox;
        Ok(Report {
            stages,
            lines: self.local.segments * u64::from(self.variant.options.lines_a_segment()),
            peak_bytes: self.memory.take_peak_bytes(),
            bands,
            notes: if loses_borders {
                vec![BORDERS_NOTE.to_owned()]
            } else {
                Vec::new()
            },
            ..Report::of(NAME, &self.scene, self.scene.draw_order().len() as u64)
        })
    }

    fn preparation(&self) -> &Preparation {
        &self.preparation
    }

    fn count_work(
        &mut self,
        view: &View,
        style: &Style,
        cancel: &Cancel,
    ) -> Result<Work, RenderError> {
        let shot = self.shot(view, style)?;
        let (mut tests, mut looks) = (0, 0);
        if !self.chunks.is_empty() {
            let canvas = self.canvas(view.size(), Purpose::Work)?;
            self.draw(&shot, &canvas, cancel, |_, bytes| {
                for [of_tests, of_looks] in bytes.as_chunks().0.as_chunks().0 {
                    tests += u64::from(u32::from_le_bytes(*of_tests));
                    looks += u64::from(u32::from_le_bytes(*of_looks));
                }
            })?;
        }
        let pixels = view.size().pixels() as u64;
        let passes = self.passes(&shot).len() as u64;
        // Two tables a look; what is remembered is read again by every pass but the first.
        let remembered = pixels * passes.saturating_sub(1) * PIXEL_BYTES;
        Ok(Work {
            tests: Some(tests),
            atomics: Some(0),
            bytes_read: Some(tests * LINE_BYTES + looks * 2 * 4 + remembered),
            bytes_written: Some(pixels * passes * PIXEL_BYTES),
        })
    }
}
