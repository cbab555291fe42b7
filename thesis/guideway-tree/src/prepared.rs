//! A prepared scene: draws views chunk by chunk and band by band, and follows moved curves.
//!
//! Input: the chunks of a scene, a view and a style. Output: RGBA pixels and a report.

use std::sync::Arc;
use std::time::Instant;

use guideway_gpu::device::{DeviceBuffer, Memory, READBACK_USAGE, Runner};
use guideway_grid::Antialias;
use guideway_grid::per_pixel::{
    LocalScene, PIXEL_BYTES, PictureBuffers, PictureLayout, Purpose, Widths, opaque_color,
    packed_rgba, radius_m,
};
use guideway_scene::{
    Budget, Cancel, Edit, EditOutcome, Frame, FrameSize, NoOpaqueColor, Preparation, Prepared,
    RenderError, Report, Rgba, Scene, Stage, Style, View, Work, elapsed_ms,
};
use wgpu::BufferUsages;

use crate::chunk::{BuiltChunk, Root};
use crate::draw::{Drawing, PROGRESS_BYTES};
use crate::edit::{self, Mover};
use crate::options::Structure;
use crate::pack::{Packer, Place};
use crate::params::{RANKED_SAMPLES, Variant, ViewParams};
use crate::step::Builder;

/// A scene with its chunks, and the buffers of the last picture.
pub(super) struct PreparedTrees {
    variant: Arc<Variant>,
    scene: Arc<Scene>,
    memory: Memory,
    runner: Runner,
    local: LocalScene,
    /// The color of all paths; `None` for several.
    color: Option<Rgba>,
    /// Color per rank, or nothing of use.
    colors: DeviceBuffer,
    widths: Widths,
    chunks: Vec<BuiltChunk>,
    places: Vec<Place>,
    unfinished: DeviceBuffer,
    buffers: Option<PictureBuffers>,
    preparation: Preparation,
}

/// The color of all paths, or `None` if there are several that the variant can draw.
fn color(variant: &Variant, scene: &Scene) -> Result<Option<Rgba>, RenderError> {
    let method = variant.structure.name();
    match scene.opaque_color() {
        Err(error @ NoOpaqueColor::Several) if scene.is_opaque() => {
            if variant.options.antialias == Antialias::Subpixel {
                return Ok(None);
            }
            let remedy = "Add option `aa=subpixel`, or use `--method cpu`.";
            Err(RenderError::unsupported(method, error.to_string(), remedy))
        }
        _ => opaque_color(method, scene).map(Some),
    }
}

impl PreparedTrees {
    /// Packs a scene, and builds its trees on the device.
    ///
    /// # Errors
    /// When paths have colors that the variant does not draw, or memory or the device fail.
    pub(super) fn new(
        variant: Arc<Variant>,
        scene: Arc<Scene>,
        budget: &Budget,
    ) -> Result<Self, RenderError> {
        let color = color(&variant, &scene)?;
        let start = Instant::now();
        let local = LocalScene::of(&scene);
        let mut stages = vec![Stage::host("bound", elapsed_ms(start))];
        let mut memory = Memory::new(Arc::clone(&variant.gpu), variant.structure.name(), budget);
        let runner = Runner::new(Arc::clone(&variant.gpu), &mut memory)?;
        let unfinished = memory.zeros("the progress", PIXEL_BYTES, READBACK_USAGE)?;
        let mut colors = vec![0];
        if color.is_none() {
            let ranks = scene.draw_order().iter();
            colors = ranks.map(|&path| packed_rgba(scene.color(path))).collect();
        }
        let color_bytes = size_of_val(colors.as_slice()) as u64;
        let usage = BufferUsages::STORAGE | BufferUsages::COPY_DST;
        let color_buffer = memory.zeros("the colors", color_bytes, usage)?;
        let written = runner.write_at("the colors", &color_buffer, 0, &colors);
        written.map_err(|error| memory.device_error(&error))?;

        let start = Instant::now();
        let mut packer = Packer::new(&scene, &local);
        stages.push(Stage::host("pack", elapsed_ms(start)));
        let mut builder = Builder {
            variant: &variant,
            memory: &mut memory,
            runner: &runner,
        };
        let mut chunks = Vec::new();
        loop {
            let start = Instant::now();
            let packed = packer.pack(builder.max_leaves());
            Stage::merge(&mut stages, [Stage::host("pack", elapsed_ms(start))]);
            if packed.segments.is_empty() {
                break;
            }
            let chunk = builder.chunk(&packed, color.is_none(), &mut stages)?;
            let quality = builder.quality(&chunk, true)?;
            chunks.push((chunk, quality));
        }
        let places = packer.places;
        let preparation = Preparation {
            stages,
            held_bytes: memory.held_bytes(),
            peak_bytes: memory.take_peak_bytes(),
            work: Work::default(),
        };
        Ok(Self {
            widths: Widths::of(&scene),
            color,
            colors: color_buffer,
            variant,
            scene,
            memory,
            runner,
            local,
            chunks,
            places,
            unfinished,
            buffers: None,
            preparation,
        })
    }

    /// Checks a view, and computes the parameters that all its dispatches share.
    fn params(&self, view: &View, style: &Style) -> Result<ViewParams, RenderError> {
        let method = self.variant.structure.name();
        let radius_m = radius_m(method, view, style, self.widths, &self.local)?;
        let px_per_m = view.px_per_m();
        let reach_m = radius_m + self.variant.options.antialias.margin_px() / px_per_m;
        let root = Root::of(&self.local, reach_m);
        let size = view.size();
        let half = |side: u32| (f64::from(side) / 2.0) as f32;
        Ok(ViewParams {
            center_m: self.local.local_from_world(view.center_m()),
            half_size_px: [half(size.width()), half(size.height())],
            origin_m: root.origin_m,
            side_m: root.side_m,
            reach_m: reach_m as f32,
            m_per_px: (1.0 / px_per_m) as f32,
            px_per_m: px_per_m as f32,
            radius_m: radius_m as f32,
            color: self.color.map_or(0, packed_rgba),
            background: packed_rgba(style.background),
            width_px: size.width(),
            max_level: root.max_level,
            ..bytemuck::Zeroable::zeroed()
        })
    }

    /// Builds the quadtrees of a frame; trees are there already.
    fn build(&mut self, params: &ViewParams) -> Result<Vec<Stage>, RenderError> {
        let mut stages = Vec::new();
        if self.variant.structure == Structure::Quadtree {
            let root = Root {
                origin_m: params.origin_m,
                side_m: params.side_m,
                max_level: params.max_level,
            };
            let mut builder = Builder {
                variant: &self.variant,
                memory: &mut self.memory,
                runner: &self.runner,
            };
            for (chunk, _) in &self.chunks {
                Stage::merge(&mut stages, builder.rebuild(chunk, root)?);
            }
        }
        Ok(stages)
    }

    /// The buffers of the last picture when they fit, else new ones.
    fn buffers(
        &mut self,
        size: FrameSize,
        purpose: Purpose,
    ) -> Result<PictureBuffers, RenderError> {
        // To stay within the budget, buffers of another size are freed before new ones are made.
        if let Some(buffers) = self.buffers.take()
            && (buffers.layout.purpose, buffers.layout.size) == (purpose, size)
        {
            return Ok(buffers);
        }
        let is_ranked = self.color.is_none();
        let ranks = if is_ranked { RANKED_SAMPLES } else { 0 };
        let layout = PictureLayout {
            size,
            purpose,
            view_bytes: size_of::<ViewParams>() as u64,
            state_bytes: PIXEL_BYTES * (1 + ranks),
            work_bytes: PROGRESS_BYTES,
        };
        let (gpu, chunks, colors) = (&self.variant.gpu, &self.chunks, &self.colors);
        let kernel = self.variant.kernels.pixels(is_ranked, purpose);
        let method = self.variant.structure.name();
        PictureBuffers::new(gpu, &mut self.memory, method, layout, |shared| {
            let kernel = kernel.into_iter();
            let each =
                kernel.flat_map(|kernel| chunks.iter().map(move |(chunk, _)| (kernel, chunk)));
            each.map(|(kernel, chunk)| chunk.bind(gpu, kernel, shared, colors))
                .collect()
        })
    }

    fn drawing<'a>(
        &'a self,
        params: &'a ViewParams,
        buffers: &'a PictureBuffers,
        cancel: &'a Cancel,
    ) -> Drawing<'a> {
        Drawing {
            gpu: &self.variant.gpu,
            kernels: &self.variant.kernels,
            memory: &self.memory,
            runner: &self.runner,
            chunks: &self.chunks,
            is_ranked: self.color.is_none(),
            unfinished: &self.unfinished,
            params,
            buffers,
            cancel,
        }
    }

    fn notes(&self) -> Vec<String> {
        let deepest = |(chunk, quality): &BuiltChunk| {
            let balanced = u32::BITS - chunk.leaves.saturating_sub(1).leading_zeros();
            let depth = quality.map_or(0, |quality| quality.depth);
            (depth > 2 * balanced).then_some((depth, balanced))
        };
        let deepest = self.chunks.iter().filter_map(deepest).max();
        let note = deepest.map(|(depth, balanced)| {
            format!(
                "The tree is unbalanced: its deepest leaf is on level {depth}, that of a balanced \
                 tree on level {balanced}."
            )
        });
        note.into_iter().collect()
    }
}

impl Prepared for PreparedTrees {
    fn render(
        &mut self,
        view: &View,
        style: &Style,
        cancel: &Cancel,
        frame: &mut Frame,
    ) -> Result<Report, RenderError> {
        let params = self.params(view, style)?;
        let size = view.size();
        frame.resize(size);
        let (mut bands, mut stages) = (1, Vec::new());
        if self.chunks.is_empty() {
            let Rgba { r, g, b, a } = style.background;
            frame.pixels_mut().fill([r, g, b, a]);
        } else {
            stages = self.build(&params)?;
            let buffers = self.buffers(size, Purpose::Picture)?;
            let width = size.width() as usize;
            let (drawing_ms, fetching_ms) =
                self.drawing(&params, &buffers, cancel)
                    .draw(|rows, bytes| {
                        let band = rows.start as usize * width..rows.end as usize * width;
                        frame.pixels_mut()[band].copy_from_slice(bytes.as_chunks().0);
                    })?;
            bands = buffers.bands().len() as u32;
            stages.push(self.runner.stage("test pixels", drawing_ms));
            stages.push(Stage::host(Stage::READ_BACK, fetching_ms));
            self.buffers = Some(buffers);
        }
        Ok(Report {
            stages,
            lines: self.local.segments * u64::from(self.variant.options.lines_per_segment()),
            peak_bytes: self.memory.take_peak_bytes(),
            bands,
            notes: self.notes(),
            ..Report::of(
                self.variant.structure.name(),
                &self.scene,
                self.scene.draw_order().len() as u64,
            )
        })
    }

    /// Follows moved curves in place: uploads their control points and fits the boxes of the tree
    /// again, or builds it anew once its cost has grown by a third. Other edits, and curves with
    /// another number of control points, need a new preparation.
    fn edit(&mut self, edit: &Edit) -> Result<EditOutcome, RenderError> {
        let Some(moved) = edit::moved_paths(&self.scene, edit, &self.places) else {
            return Ok(EditOutcome::NotInPlace);
        };
        let scene = Arc::make_mut(&mut self.scene);
        scene.edit(edit).map_err(RenderError::Edit)?;
        let mut mover = Mover {
            builder: Builder {
                variant: &self.variant,
                memory: &mut self.memory,
                runner: &self.runner,
            },
            local: &mut self.local,
            chunks: &mut self.chunks,
        };
        let moved_bytes = mover.move_points(&self.scene, &moved)?;
        Ok(EditOutcome::InPlace { moved_bytes })
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
        let params = self.params(view, style)?;
        let (mut tests, mut bytes_read) = (0, 0);
        if !self.chunks.is_empty() {
            self.build(&params)?;
            let buffers = self.buffers(view.size(), Purpose::Work)?;
            self.drawing(&params, &buffers, cancel).draw(|_, pixels| {
                for [_, _, pixel_tests, pixel_bytes] in pixels.as_chunks().0.as_chunks().0 {
                    tests += u64::from(u32::from_le_bytes(*pixel_tests));
                    bytes_read += u64::from(u32::from_le_bytes(*pixel_bytes));
                }
            })?;
        }
        let pixels = view.size().pixels() as u64;
        Ok(Work {
            tests: Some(tests),
            atomics: None,
            bytes_read: Some(bytes_read),
            bytes_written: Some(pixels * (PIXEL_BYTES + PROGRESS_BYTES)),
        })
    }
}
