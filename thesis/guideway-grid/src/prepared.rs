//! A prepared scene: draws views from the sorted lines, pass by pass and band by band.
//!
//! Input: the grid of a scene, a view and a style. Output: RGBA pixels and a report.

use std::ops::Range;
use std::sync::Arc;
use std::time::Instant;

use guideway_gpu::device::{DeviceBuffer, Dispatch, Memory, Runner};
use guideway_scene::{
    Budget, Cancel, Frame, FrameSize, Preparation, Prepared, RenderError, Report, Rgba, Scene,
    Stage, Style, View, Work, elapsed_ms,
};
use wgpu::BufferUsages;

use crate::chunk::Chunk;
use crate::frame_context::{FrameContext, Widths, opaque_color};
use crate::grid_builder::{BuiltGrid, GridBuilder};
use crate::local::LocalScene;
use crate::options::Binning;
use crate::pack::Packer;
use crate::params::{GridParams, LINE_BYTES, ViewParams, WORKGROUP};
use crate::pass::Pass;
use crate::pass_plan;
use crate::picture_buffers::{PIXEL_BYTES, PictureBuffers, PictureLayout, Purpose};
use crate::split::WorkSplitter;
use crate::variant::{NAME, Variant};

const BORDERS_NOTE: &str = "Cells list lines without their width, as in the thesis, so strokes are \
     cut at cell borders. Add option `radius` for whole strokes.";

/// Bytes of the counters of a pixel: distance tests and cell look-ups.
const WORK_BYTES: u64 = size_of::<[u32; 2]>() as u64;

/// A scene with its grid, and the buffers of the last picture.
pub(super) struct PreparedGrid {
    variant: Arc<Variant>,
    scene: Arc<Scene>,
    memory: Memory,
    runner: Runner,
    local: LocalScene,
    color: Rgba,
    widths: Widths,
    grid: GridParams,
    grid_buffer: DeviceBuffer,
    chunks: Vec<Chunk>,
    buffers: Option<PictureBuffers>,
    preparation: Preparation,
}

impl PreparedGrid {
    /// Builds the grid of a scene on the device.
    ///
    /// # Errors
    /// When paths have several colors or translucent ones, or memory or the device fail.
    pub(super) fn new(
        variant: Arc<Variant>,
        scene: Arc<Scene>,
        budget: &Budget,
    ) -> Result<Self, RenderError> {
        let color = opaque_color(NAME, &scene)?;
        let start = Instant::now();
        let local = LocalScene::of(&scene);
        let grid = local.grid(&variant.options);
        let bound_ms = elapsed_ms(start);

        let mut memory = Memory::new(Arc::clone(&variant.gpu), NAME, budget);
        let runner = Runner::new(Arc::clone(&variant.gpu), &mut memory)?;
        let uniform = BufferUsages::UNIFORM | BufferUsages::COPY_DST;
        let grid_buffer = memory.zeros("the grid", size_of::<GridParams>() as u64, uniform)?;
        let written = runner.write("the grid", &grid_buffer, &grid);
        written.map_err(|error| memory.device_error(&error))?;
        let packer = Packer {
            scene: &scene,
            local: &local,
            grid: &grid,
            options: &variant.options,
            max_work: variant.gpu.tests_per_submit(),
            max_items: variant.gpu.max_workgroups().saturating_mul(WORKGROUP)
                / variant.options.lines_per_segment(),
        };
        let builder = GridBuilder {
            gpu: &variant.gpu,
            options: &variant.options,
            kernels: &variant.kernels,
            memory: &mut memory,
            runner: &runner,
            grid: &grid_buffer,
        };
        let BuiltGrid {
            chunks,
            stages,
            atomics,
        } = builder.build(&packer, local.segments)?;
        let bound = Stage::host("bound", bound_ms);
        let preparation = Preparation {
            stages: std::iter::once(bound).chain(stages).collect(),
            held_bytes: memory.held_bytes(),
            peak_bytes: memory.take_peak_bytes(),
            work: Work {
                atomics: Some(atomics),
                ..Work::default()
            },
        };
        Ok(Self {
            widths: Widths::of(&scene),
            color,
            variant,
            scene,
            memory,
            runner,
            local,
            grid,
            grid_buffer,
            chunks,
            buffers: None,
            preparation,
        })
    }

    /// The buffers of the last picture when they fit, else new ones.
    fn buffers(
        &mut self,
        size: FrameSize,
        purpose: Purpose,
    ) -> Result<PictureBuffers, RenderError> {
        // To stay within the budget, buffers of another size are freed before new ones are made.
        if let Some(buffers) = self.buffers.take()
            && purpose == Purpose::Picture
            && buffers.layout.size == size
        {
            return Ok(buffers);
        }
        let layout = PictureLayout {
            size,
            purpose,
            view_bytes: size_of::<ViewParams>() as u64,
            state_bytes: PIXEL_BYTES,
            work_bytes: match purpose {
                Purpose::Picture => 0,
                Purpose::Work => WORK_BYTES,
            },
        };
        let (gpu, chunks, grid) = (&self.variant.gpu, &self.chunks, &self.grid_buffer);
        let kernel = self.variant.kernels.for_result(purpose);
        PictureBuffers::new(
            gpu,
            &mut self.memory,
            NAME,
            layout,
            |&[view, pixels, work]| {
                let bind = |chunk: &Chunk| {
                    let (starts, counts) = (&chunk.starts, &chunk.counts);
                    let buffers = [view, grid, starts, counts, &chunk.lists_m, pixels, work];
                    kernel.bind(gpu, &buffers)
                };
                chunks.iter().map(bind).collect()
            },
        )
    }

    /// Draws a frame and passes the result of each band to `take`. Returns the milliseconds of
    /// drawing and of reading back.
    fn draw(
        &self,
        context: &FrameContext,
        buffers: &PictureBuffers,
        cancel: &Cancel,
        mut take: impl FnMut(Range<u32>, &[u8]),
    ) -> Result<(f64, f64), RenderError> {
        let gpu = &self.variant.gpu;
        let kernel = self.variant.kernels.for_result(buffers.layout.purpose);
        let ok = |error| self.memory.device_error(&error);
        let passes = self.passes(context);
        let (mut drawing_ms, mut fetching_ms) = (0.0, 0.0);
        for rows in buffers.bands() {
            for pass in &passes {
                let splitter = WorkSplitter::new(gpu.tests_per_submit(), gpu.max_workgroups());
                let table = &self.chunks[pass.chunk].table;
                for tiles in pass_plan::tile_ranges(pass, context, table, &rows, splitter) {
                    cancel.check()?;
                    let params = context.params(&rows, &tiles, pass);
                    self.runner
                        .write("the view", &buffers.view, &params)
                        .map_err(ok)?;
                    let dispatch = Dispatch {
                        kernel,
                        bindings: &buffers.bindings[pass.chunk],
                        workgroups: tiles.end - tiles.start,
                    };
                    drawing_ms += self.runner.run("the picture", &[dispatch]).map_err(ok)?;
                }
            }
            cancel.check()?;
            let start = Instant::now();
            let (result, row_bytes) = buffers.result();
            let bytes = u64::from(rows.end - rows.start) * row_bytes;
            let fetched =
                self.runner
                    .fetch("the picture", result, &buffers.fetched, bytes, |bytes| {
                        take(rows, bytes);
                    });
            fetched.map_err(ok)?;
            fetching_ms += elapsed_ms(start);
        }
        Ok((drawing_ms, fetching_ms))
    }

    fn passes(&self, context: &FrameContext) -> Vec<Pass> {
        let tables = self.chunks.iter().map(|chunk| &chunk.table);
        pass_plan::passes(context, tables, self.variant.gpu.loops_per_thread())
    }

    fn context(&self, view: &View, style: &Style) -> Result<FrameContext, RenderError> {
        FrameContext::new(
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
        let context = self.context(view, style)?;
        let size = view.size();
        frame.resize(size);
        let (mut bands, mut stages) = (1, Vec::new());
        if self.chunks.is_empty() {
            let Rgba { r, g, b, a } = style.background;
            frame.pixels_mut().fill([r, g, b, a]);
        } else {
            let buffers = self.buffers(size, Purpose::Picture)?;
            let width = size.width() as usize;
            let (drawing_ms, fetching_ms) =
                self.draw(&context, &buffers, cancel, |rows, bytes| {
                    let band = rows.start as usize * width..rows.end as usize * width;
                    frame.pixels_mut()[band].copy_from_slice(bytes.as_chunks().0);
                })?;
            bands = buffers.bands().len() as u32;
            stages.push(self.runner.stage("test pixels", drawing_ms));
            stages.push(Stage::host(Stage::READ_BACK, fetching_ms));
            self.buffers = Some(buffers);
        }
        let cuts_borders = self.variant.options.binning == Binning::LineBox;
        Ok(Report {
            stages,
            lines: self.local.segments * u64::from(self.variant.options.lines_per_segment()),
            peak_bytes: self.memory.take_peak_bytes(),
            bands,
            notes: if cuts_borders {
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
        let context = self.context(view, style)?;
        let (mut tests, mut lookups) = (0, 0);
        if !self.chunks.is_empty() {
            let buffers = self.buffers(view.size(), Purpose::Work)?;
            self.draw(&context, &buffers, cancel, |_, bytes| {
                for [pixel_tests, pixel_lookups] in bytes.as_chunks().0.as_chunks().0 {
                    tests += u64::from(u32::from_le_bytes(*pixel_tests));
                    lookups += u64::from(u32::from_le_bytes(*pixel_lookups));
                }
            })?;
        }
        let pixels = view.size().pixels() as u64;
        let passes = self.passes(&context).len() as u64;
        // A look-up reads a start and a count; every pass but the first reads the pixel's state.
        let state_bytes = pixels * passes.saturating_sub(1) * PIXEL_BYTES;
        Ok(Work {
            tests: Some(tests),
            atomics: Some(0),
            bytes_read: Some(tests * LINE_BYTES + lookups * 2 * 4 + state_bytes),
            bytes_written: Some(pixels * passes * PIXEL_BYTES),
        })
    }
}
