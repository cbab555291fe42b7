//! Renders frames of a prepared scene within the memory budget.

use bytemuck::cast_slice;
use guideway_scene::density::ToneMap;
use guideway_scene::{
    Cancel, Coloring, Edit, EditOutcome, Frame, Gesture, Preparation, Prepared, RenderError,
    Report, Shading, Strip, Style, View,
};

use super::flatten_visible::DrawError;
use super::memory::{FrameMemory, NAME, fixed_bytes, over_budget};
use super::picture_cache::PictureCache;
use super::pipeline::FrameTarget;
use super::state::{CpuPrepared, install};
use crate::cpu::ground::gesture::ShownGesture;
#[cfg(test)]
use crate::cpu::ground::simd::SimdLevel;

/// Most pixels of a strip: 128 MiB of colors.
const STRIP_PIXELS: usize = 1 << 25;

impl Prepared for CpuPrepared {
    fn render(
        &mut self,
        view: &View,
        style: &Style,
        cancel: &Cancel,
        frame: &mut Frame,
    ) -> Result<Report, RenderError> {
        self.render_strip(&Strip::whole(view), style, cancel, frame)
    }

    fn strip_pixels(&self) -> usize {
        STRIP_PIXELS
    }

    fn render_strip(
        &mut self,
        strip: &Strip,
        style: &Style,
        cancel: &Cancel,
        frame: &mut Frame,
    ) -> Result<Report, RenderError> {
        let gesture = self.gesture.as_ref();
        let shift_m = gesture.map(|gesture| gesture.shift_m);
        let strip = &strip.with_world_moved(shift_m.unwrap_or_default())?;
        let may_rest = gesture.is_some_and(|gesture| !gesture.moves_all);
        let memory = FrameMemory::plan(
            fixed_bytes(&self.scene, &self.budget) + gesture.map_or(0, ShownGesture::bytes),
            (
                strip,
                style,
                may_rest && self.clusters.style.solid.is_some(),
            ),
            &mut self.picture,
            &mut self.full_pixels,
            &self.budget,
        );
        // A frame that fails leaves no picture.
        let mut picture = self.picture.take();
        let needed = memory.needed_bytes;
        let Some(limit_bytes) = self.budget.memory_bytes.checked_sub(needed) else {
            return Err(over_budget("the picture", needed, &self.budget));
        };
        let Self {
            scene,
            budget,
            pool,
            clusters,
            gesture,
            pipeline,
            tones,
            simd,
            full_pixels,
            resting,
            ..
        } = self;
        let shown = (&**scene, gesture.as_ref());
        let ctx = clusters
            .style
            .frame_context(shown, *simd, (strip, style, cancel));
        pipeline.start();
        let bands = install(pool.as_ref(), || {
            let is_moved = pipeline.time("cull", |p| {
                frame.resize(strip.size());
                p.visible.cull(clusters.index.bounds(), &ctx);
                p.damage.clear(strip);
                let picture = picture.as_mut();
                let is_moved =
                    picture.is_some_and(|picture| picture.move_to(&ctx, &p.visible, &mut p.damage));
                if !is_moved {
                    p.damage.fill(strip);
                } else if memory.uses_resting {
                    p.damage.widen_to_tiles(strip);
                }
                is_moved
            });
            let can_probe = memory.uses_full_pixels
                && !is_moved
                && gesture.as_ref().is_none_or(ShownGesture::is_at_rest);
            let found = can_probe.then(|| full_pixels.plan(&ctx)).flatten();
            let mut target = FrameTarget {
                ctx: &ctx,
                frame,
                cached: picture.as_ref().filter(|_| is_moved),
                resting: memory.uses_resting.then(|| resting.of_frame(&ctx)),
                full_pixels: full_pixels.lookup(&ctx, 0.0),
                probe: found.as_ref().map(|found| {
                    let known = full_pixels.lookup(&ctx, found.max_px_per_m());
                    (found, known)
                }),
                limit_bytes,
            };
            let drawn = match style.shading {
                Shading::Color => pipeline.draw(&mut target, clusters),
                Shading::Density(tone) => pipeline.draw_density(&mut target, clusters, tone, tones),
            };
            let bands = drawn.map_err(|error| match error {
                DrawError::OverBudget(bytes) => {
                    over_budget("the lines of one row of tiles", needed + bytes, budget)
                }
                DrawError::Failed(error) => error,
            })?;
            if let Some(found) = found {
                full_pixels.store(found);
            }
            if strip.is_whole() {
                pipeline.time("keep", |p| {
                    let pixels = match style.shading {
                        Shading::Color => frame.pixels(),
                        Shading::Density(_) => cast_slice(&p.counts),
                    };
                    // Lines may soon need the other half of the budget.
                    let used_bytes = memory.own_bytes + memory.frame_bytes + p.peak_bytes;
                    let has_room = used_bytes <= budget.memory_bytes / 2;
                    let drawn = (&ctx, is_moved);
                    PictureCache::keep(&mut picture, drawn, &p.damage, pixels, has_room);
                });
            }
            Ok(bands)
        })?;
        let picture_bytes = picture.as_ref().map_or(0, PictureCache::bytes);
        let picture_bytes = memory.picture_bytes.max(picture_bytes);
        self.picture = picture;
        Ok(Report {
            stages: std::mem::take(&mut pipeline.stages),
            lines: pipeline.line_count,
            peak_bytes: memory.own_bytes + picture_bytes + pipeline.peak_bytes,
            bands,
            density: tones
                .as_ref()
                .filter(|_| style.shading != Shading::Color)
                .map(|(_, _, tones)| tones.legend()),
            ..Report::of(NAME, scene, pipeline.path_count)
        })
    }

    fn count_paths(
        &mut self,
        view: &View,
        style: &Style,
        cancel: &Cancel,
        counts: &mut Vec<f32>,
    ) -> Result<Option<Report>, RenderError> {
        let shading = Shading::Density(ToneMap::Linear);
        let style = Style { shading, ..*style };
        let report = self.render(view, &style, cancel, &mut Frame::new(view.size()))?;
        counts.clone_from(&self.pipeline.counts);
        Ok(Some(report))
    }

    fn edit(&mut self, edit: &Edit) -> Result<EditOutcome, RenderError> {
        self.apply_edit(edit)
    }

    fn recolor(&mut self, coloring: &Coloring) -> Result<EditOutcome, RenderError> {
        Ok(self.take_colors(coloring))
    }

    fn show_gesture(&mut self, gesture: Option<&Gesture>) -> Result<EditOutcome, RenderError> {
        self.map_gesture(gesture)
    }

    fn preparation(&self) -> &Preparation {
        &self.preparation
    }
}

/// Access for tests.
#[cfg(test)]
impl CpuPrepared {
    /// Returns `true` if the last frame drew only a part of the picture.
    pub(crate) fn has_reused(&self) -> bool {
        let rects = self.pipeline.damage.rects_px();
        let damaged: usize = rects.map(|(x, y)| x.len() * y.len()).sum();
        let all = self.picture.as_ref().map_or(0, PictureCache::pixel_count);
        damaged < all
    }

    /// Number of pixels of a picture that are known to be full.
    pub(crate) fn known_pixels(&self, view: &View, style: &Style) -> u32 {
        let shift_m = self.gesture.as_ref().map(|gesture| gesture.shift_m);
        let strip = Strip::whole(view).with_world_moved(shift_m.unwrap_or_default());
        let (strip, cancel) = (strip.unwrap(), Cancel::default());
        let frame = (&strip, style, &cancel);
        let shown = (&*self.scene, self.gesture.as_ref());
        let ctx = self.clusters.style.frame_context(shown, self.simd, frame);
        self.full_pixels.lookup(&ctx, 0.0).count(&ctx)
    }

    /// Number of tiles of which the samples of resting paths are known.
    pub(crate) fn known_resting_tiles(&self) -> usize {
        self.resting.known_tiles()
    }

    /// Lists lines per tile for clusters of `min_tiles` tiles or more.
    pub(crate) fn list_lines_from(&mut self, min_tiles: usize) {
        self.pipeline.lists.line_lists.min_tiles = min_tiles;
    }

    /// Number of clusters that the last frame has flattened.
    pub(crate) fn flattened_clusters(&self) -> usize {
        self.pipeline.dirty_clusters.len()
    }

    /// Makes the next frame start from the curves.
    pub(crate) fn forget_picture(&mut self) {
        self.picture = None;
        self.full_pixels.forget();
        self.clusters.cache.evict(|_| false);
    }

    pub(crate) fn set_simd(&mut self, simd: SimdLevel) {
        self.simd = simd;
    }
}
