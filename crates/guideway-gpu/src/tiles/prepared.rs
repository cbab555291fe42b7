//! A prepared scene: routes renders, edits and work counts to the stages.

use std::any::Any;
use std::ops::Range;
use std::sync::Arc;
use std::time::Instant;

use guideway_scene::{
    Budget, Cancel, Coloring, DevicePicture, Edit, EditOutcome, Frame, Gesture, Preparation,
    Prepared, RenderError, Report, Scene, Shading, Stage, Style, View, Work,
    cluster::DirtyClusters, density, elapsed_ms,
};

use super::device_context::{DeviceContext, device_error};
use super::frame::context::FrameContext;
use super::frame::draw::{count_drawn_paths, draw_picture, fetch_pixels};
use super::frame::presenter::Presenter;
use super::frame::renderer::{Deliver, DrawResult, Renderer};
use super::frame::target::TargetState;
use super::kernels::Kernels;
use super::options::{NAME, Shared};
use super::paint_mode::PaintMode;
use super::upload::edit::{self, SceneBufferEdit};
use super::upload::edit_effect::EditEffect;
use super::upload::gesture;
use super::upload::pack::Packing;
use super::upload::recolor::recolor;
use super::upload::scene_buffers::SceneBuffers;
use super::upload::uploaded_scene::UploadedScene;

/// A scene on the device, and the state of its last picture.
pub(crate) struct PreparedTiles {
    shared: Arc<Shared>,
    pub(crate) device: DeviceContext,
    pub(crate) scene: UploadedScene,
    pub(crate) target: TargetState,
    preparation: Preparation,
    /// Textures of pictures that stay on the device.
    pub(crate) presenter: Option<Presenter>,
}

impl PreparedTiles {
    pub(crate) fn new(
        shared: Arc<Shared>,
        scene: Arc<Scene>,
        budget: &Budget,
    ) -> Result<Self, RenderError> {
        let patch_kernel = shared.kernels.patch.clone();
        let mut prepared = Self {
            device: DeviceContext::new(Arc::clone(&shared.gpu), patch_kernel, budget)?,
            target: TargetState {
                reuses_frames: shared.options.reuses_frames,
                ..TargetState::default()
            },
            scene: UploadedScene::new(scene),
            shared,
            preparation: Preparation::default(),
            presenter: None,
        };
        prepared.upload(prepared.scene.packing)?;
        Ok(prepared)
    }

    /// Uploads the scene, in place of its earlier buffers.
    pub(crate) fn upload(&mut self, packing: Packing) -> Result<(), RenderError> {
        self.target.drop_bindings();
        self.target.drop_caches();
        let stages = self.scene.upload(&mut self.device, packing)?;
        self.preparation = Preparation {
            stages,
            held_bytes: self.device.memory.held_bytes(),
            peak_bytes: self.device.memory.take_peak_bytes(),
            ..Preparation::default()
        };
        Ok(())
    }

    /// Uploads the scene again if an upload or an edit failed halfway.
    fn recover(&mut self) -> Result<(), RenderError> {
        if self.scene.is_incomplete {
            self.upload(Packing::of(&self.scene.scene))
        } else {
            Ok(())
        }
    }

    /// The kernels that draw what the buffers show.
    fn kernels(&self) -> Result<Arc<Kernels>, RenderError> {
        match &self.scene.gesture {
            Some(gesture) if gesture.turns() => self.shared.mapping_kernels().map_err(device_error),
            _ => Ok(Arc::clone(&self.shared.kernels)),
        }
    }

    /// Updates the caches after a change of the buffers. Returns the bytes sent to the device.
    fn take_effect(&mut self, effect: &EditEffect) -> u64 {
        if effect.changes_appearance {
            self.target.picture = None;
        }
        if let Some(buffers) = &self.scene.buffers {
            self.target.mark_dirty(&effect.dirty, &buffers.cluster_list);
        }
        if effect.loses_lines {
            self.target.cached_lines = None;
        }
        if effect.replaces_buffers {
            self.target.drop_bindings();
        }
        effect.moved_bytes
    }

    /// Updates the caches after an edit, or uploads the scene again.
    fn take_outcome(&mut self, outcome: &SceneBufferEdit) -> Result<EditOutcome, RenderError> {
        if let SceneBufferEdit::Applied(effect) = outcome {
            let moved_bytes = self.take_effect(effect);
            return Ok(EditOutcome::InPlace { moved_bytes });
        }
        self.upload(Packing::of(&self.scene.scene))?;
        let bytes = |buffers: &SceneBuffers| {
            let points = buffers.point_buffers.iter().map(|b| b.points.bytes());
            let lists = [&buffers.strokes, &buffers.clusters, &buffers.styles];
            points.sum::<u64>() + lists.map(|b| b.bytes()).iter().sum::<u64>()
        };
        Ok(EditOutcome::InPlace {
            moved_bytes: self.scene.buffers.as_ref().map_or(0, bytes),
        })
    }

    /// Marks what the gesture shows in the caches, at its present place.
    fn mark_gesture(&mut self) {
        let (Some(gesture), Some(buffers)) = (&self.scene.gesture, &self.scene.buffers) else {
            return;
        };
        self.target.mark_area(gesture.shown_area());
        // Few clusters are worth a list, and many drop the cached lines at once.
        if let Some(cached) = &mut self.target.cached_lines {
            let all = buffers.cluster_list.len();
            let mut dirty = DirtyClusters::default();
            gesture
                .mapped_clusters()
                .for_each(|cluster| dirty.add(cluster));
            if !cached.mark_dirty(&dirty, all) {
                self.target.cached_lines = None;
            }
        }
    }

    /// Shows the scene without a gesture. Returns the bytes sent to the device.
    fn end_gesture(&mut self) -> Result<u64, RenderError> {
        self.mark_gesture();
        let effect = gesture::end(&mut self.scene, &mut self.device)?;
        Ok(self.take_effect(&effect))
    }

    fn draw(
        &mut self,
        kernels: &Kernels,
        frame: &FrameContext<'_>,
        paint: PaintMode,
        cancel: &Cancel,
        deliver: impl Deliver,
    ) -> Result<DrawResult, RenderError> {
        let mut renderer = Renderer {
            device: &mut self.device,
            kernels,
            scene: &mut self.scene,
            target: &mut self.target,
            times_stages: self.shared.options.times_stages,
        };
        draw_picture(&mut renderer, frame, paint, cancel, deliver)
    }

    fn report(&mut self, context: &FrameContext<'_>, result: DrawResult) -> Report {
        let drawn = count_drawn_paths(&self.scene, context, &result);
        Report {
            lines: result.lines,
            stages: result.stages,
            peak_bytes: self.device.memory.take_peak_bytes(),
            bands: result.windows.max(1),
            ..Report::of(NAME, &self.scene.scene, drawn)
        }
    }

    fn prepare_target(
        &mut self,
        frame: &FrameContext<'_>,
        paint: PaintMode,
    ) -> Result<(), RenderError> {
        let strokes = self.scene.stroke_count();
        let has_ranks = frame.needs_ranks(paint);
        let kernels = &self.shared.kernels;
        self.target
            .prepare(&mut self.device, kernels, frame.view, strokes, has_ranks)
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
        self.recover()?;
        let context = FrameContext::new(view, style, self.scene.facts)?;
        let size = view.size();
        frame.resize(size);
        let mut counts = Vec::new();
        if style.shading != Shading::Color {
            counts.resize(size.pixels(), 0.0_f32);
        }
        let mut result = DrawResult::default();
        if self.scene.buffers.is_none() {
            let background = style.background;
            let pixel = [background.r, background.g, background.b, background.a];
            frame.pixels_mut().fill(pixel);
        } else {
            let paint = match style.shading {
                Shading::Color => self.scene.facts.paint,
                Shading::Density(_) => PaintMode::Density,
            };
            self.prepare_target(&context, paint)?;
            let kernels = self.kernels()?;
            let mut take = |pixels: Range<usize>, bytes: &[u8]| {
                let words = bytes.as_chunks().0;
                if counts.is_empty() {
                    frame.pixels_mut()[pixels].copy_from_slice(words);
                } else {
                    for (count, word) in counts[pixels].iter_mut().zip(words) {
                        *count = f32::from_le_bytes(*word);
                    }
                }
            };
            result = self.draw(&kernels, &context, paint, cancel, |r, pixels, stages| {
                fetch_pixels(r, pixels, stages, &mut take)
            })?;
        }
        let mut legend = None;
        if let Shading::Density(tone) = style.shading {
            let start = Instant::now();
            legend = Some(density::shade(&counts, tone, style.background, frame));
            result.stages.push(Stage::host("shade", elapsed_ms(start)));
        }
        Ok(Report {
            density: legend,
            ..self.report(&context, result)
        })
    }

    fn device(&self) -> Option<&(dyn Any + Send + Sync)> {
        Some(self.device.gpu.device())
    }

    /// Density is shaded in main memory.
    fn render_on_device(
        &mut self,
        view: &View,
        style: &Style,
        cancel: &Cancel,
    ) -> Result<Option<(DevicePicture, Report)>, RenderError> {
        self.recover()?;
        if style.shading != Shading::Color || self.scene.buffers.is_none() {
            return Ok(None);
        }
        let context = FrameContext::new(view, style, self.scene.facts)?;
        let paint = self.scene.facts.paint;
        self.prepare_target(&context, paint)?;
        let mut presenter = match self.presenter.take() {
            Some(presenter) => presenter,
            None => {
                let kernel = self.shared.presenting_kernel().map_err(device_error)?;
                Presenter::new(kernel, &mut self.device)?
            }
        };
        let texture = presenter.texture(&mut self.device, view.size())?;
        let kernels = self.kernels()?;
        let result = self.draw(&kernels, &context, paint, cancel, |r, pixels, _| {
            match &r.target.tiles {
                Some(tiles) => presenter.present(r.device, &tiles.pixels, pixels, &texture),
                None => Ok(()),
            }
        });
        self.presenter = Some(presenter);
        let report = self.report(&context, result?);
        Ok(Some((DevicePicture::new(texture), report)))
    }

    fn edit(&mut self, edit: &Edit) -> Result<EditOutcome, RenderError> {
        self.end_gesture()?;
        let outcome = edit::apply(&mut self.scene, &mut self.device, edit)?;
        self.take_outcome(&outcome)
    }

    fn recolor(&mut self, coloring: &Coloring) -> Result<EditOutcome, RenderError> {
        if !self.scene.scene.accepts(coloring) {
            return Ok(EditOutcome::NotInPlace);
        }
        self.end_gesture()?;
        let outcome = recolor(&mut self.scene, &mut self.device, coloring)?;
        self.take_outcome(&outcome)
    }

    fn show_gesture(&mut self, gesture: Option<&Gesture>) -> Result<EditOutcome, RenderError> {
        self.recover()?;
        let mut moved_bytes = 0;
        let shown = self.scene.gesture.as_ref();
        let is_shown = gesture.is_some_and(|new| shown.is_some_and(|shown| shown.is_of(new)));
        if !is_shown {
            moved_bytes += self.end_gesture()?;
        }
        if let Some(gesture) = gesture {
            if !is_shown {
                let effect = gesture::begin(&mut self.scene, &mut self.device, gesture)?;
                moved_bytes += self.take_effect(&effect);
            }
            self.mark_gesture();
            match gesture::map(&mut self.scene, &self.device, gesture.by) {
                Ok(effect) => moved_bytes += self.take_effect(&effect),
                Err(error) => {
                    self.end_gesture()?;
                    return Err(error);
                }
            }
            self.mark_gesture();
        }
        Ok(EditOutcome::InPlace { moved_bytes })
    }

    fn preparation(&self) -> &Preparation {
        &self.preparation
    }

    /// Counts the work of a picture drawn without caches. Density is not counted.
    fn count_work(
        &mut self,
        view: &View,
        style: &Style,
        cancel: &Cancel,
    ) -> Result<Work, RenderError> {
        self.recover()?;
        let paint = self.scene.facts.paint;
        if style.shading != Shading::Color || self.scene.buffers.is_none() {
            return Ok(Work::default());
        }
        let counting = self.shared.counting_kernels().map_err(device_error)?;
        let context = FrameContext::new(view, style, self.scene.facts)?;
        self.prepare_target(&context, paint)?;
        self.target.picture = None;
        self.target.drop_bindings();
        let reuses_frames = std::mem::replace(&mut self.target.reuses_frames, false);
        // The first picture finds out how few clusters the view shows: the last view may differ.
        let result = self
            .draw(&counting, &context, paint, cancel, |_, _, _| Ok(()))
            .and_then(|_| self.draw(&counting, &context, paint, cancel, |_, _, _| Ok(())));
        self.target.reuses_frames = reuses_frames;
        self.target.drop_bindings();
        Ok(result?.work.work())
    }
}
