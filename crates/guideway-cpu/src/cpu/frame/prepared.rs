//! Method `cpu` with a prepared scene: draws frames within the memory budget, and applies edits.

use std::sync::Arc;

use bytemuck::cast_slice;
use guideway_layout::clock::Instant;
use guideway_scene::cluster::PendingEdit;
use guideway_scene::density::{ToneMap, ToneScale};
use guideway_scene::{
    Budget, Cancel, Edit, EditOutcome, Frame, Gesture, GesturePaths, Preparation, Prepared,
    RenderError, Report, Scene, Shading, Stage, Strip, Style, View, elapsed_ms,
};
use guideway_spline::Bounds;
use rayon::{ThreadPool, ThreadPoolBuilder};

use super::clusters::{PreparedClusters, StyleSummary};
use super::flatten_visible::DrawError;
use super::memory::{FrameMemory, NAME, fixed_bytes, over_budget, threads};
use super::picture_cache::PictureCache;
use super::pipeline::{FramePipeline, FrameTarget};
use crate::cpu::ground::gesture::ShownGesture;
use crate::cpu::ground::simd::SimdLevel;
use crate::cpu::raster::full_pixel_cache::FullPixelCache;

/// Most pixels of a strip: 128 MiB of colors.
const STRIP_PIXELS: usize = 1 << 25;

/// A prepared scene, with the state that passes from one frame to the next.
pub(crate) struct CpuPrepared {
    scene: Arc<Scene>,
    budget: Budget,
    /// `None` for the thread pool of the process.
    pool: Option<ThreadPool>,
    clusters: PreparedClusters,
    gesture: Option<ShownGesture>,
    preparation: Preparation,
    pipeline: FramePipeline,
    picture: Option<PictureCache>,
    full_pixels: FullPixelCache,
    /// Tone scale of the last picture whose density was drawn in strips.
    tones: Option<(View, Style, ToneScale)>,
    simd: SimdLevel,
}

fn install<R: Send>(pool: Option<&ThreadPool>, work: impl FnOnce() -> R + Send) -> R {
    match pool {
        Some(pool) => pool.install(work),
        None => work(),
    }
}

impl CpuPrepared {
    /// Sorts the paths of a scene into clusters.
    ///
    /// # Errors
    /// [`RenderError::Budget`] if the clusters and the buffers of the threads exceed the budget.
    pub(crate) fn new(scene: Arc<Scene>, budget: &Budget) -> Result<Self, RenderError> {
        let fixed = fixed_bytes(&scene, budget);
        if fixed > budget.memory_bytes {
            return Err(over_budget("the index of the paths", fixed, budget));
        }
        // If the system refuses more threads, use those that the process shares.
        let builder = ThreadPoolBuilder::new().num_threads(budget.threads);
        let pool = (budget.threads > 0).then(|| builder.build().ok()).flatten();
        let start = Instant::now();
        let clusters = install(pool.as_ref(), || PreparedClusters::new(&scene));
        let held_bytes = clusters.bytes();
        Ok(Self {
            scene,
            budget: *budget,
            pool,
            clusters,
            gesture: None,
            preparation: Preparation {
                stages: vec![Stage::host("sort", elapsed_ms(start))],
                held_bytes,
                peak_bytes: held_bytes,
                ..Preparation::default()
            },
            pipeline: FramePipeline::new(threads(budget)),
            picture: None,
            full_pixels: FullPixelCache::default(),
            tones: None,
            simd: SimdLevel::default(),
        })
    }

    /// Splits the paths of a gesture off from others.
    fn begin_gesture(&mut self, gesture: &Gesture) -> Result<ShownGesture, RenderError> {
        let scene = &*self.scene;
        let paths = GesturePaths::begin(scene, gesture).map_err(RenderError::Edit)?;
        // At most, each path gets into a cluster of the gesture.
        let copies = PreparedClusters::planned_bytes(gesture.paths.len());
        let needed = fixed_bytes(scene, &self.budget) + copies + scene.row_count() as u64;
        if needed > self.budget.memory_bytes {
            return Err(over_budget(
                "the paths of the gesture",
                needed,
                &self.budget,
            ));
        }
        let clusters = &mut self.clusters;
        let begin = || clusters.begin_gesture(scene, paths, &gesture.paths);
        let shown = install(self.pool.as_ref(), begin);
        self.take_changes(&self.clusters.boxes_of(&shown.thinned));
        Ok(shown)
    }

    /// Shows the scene without a gesture.
    fn end_gesture(&mut self) {
        if let Some(gesture) = self.gesture.take() {
            let clusters = &mut self.clusters;
            let changes = install(self.pool.as_ref(), || clusters.end_gesture(gesture));
            self.take_changes(&changes);
        }
    }

    /// Forgets what the caches have of places where paths were or are.
    fn take_changes(&mut self, changes: &[Bounds<f64>]) {
        self.tones = None;
        self.full_pixels.forget();
        if let Some(picture) = &mut self.picture {
            picture.add_changes(changes);
        }
    }
}

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
        let memory = FrameMemory::plan(
            fixed_bytes(&self.scene, &self.budget)
                + self.gesture.as_ref().map_or(0, ShownGesture::bytes),
            (strip, style),
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
                }
                is_moved
            });
            let can_probe = memory.uses_full_pixels && !is_moved;
            let found = can_probe.then(|| full_pixels.plan(&ctx)).flatten();
            let mut target = FrameTarget {
                ctx: &ctx,
                frame,
                cached: picture.as_ref().filter(|_| is_moved),
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
        self.end_gesture();
        let Self {
            scene,
            budget,
            pool,
            clusters,
            picture,
            full_pixels,
            tones,
            ..
        } = self;
        let begin = |paths: &[u32]| -> Vec<PendingEdit> {
            // The scene rejects an edit of paths that it does not have.
            let last = paths.iter().copied().max();
            if last.is_some_and(|path| path as usize >= scene.row_count()) {
                return Vec::new();
            }
            install(pool.as_ref(), || clusters.begin_edit(scene, paths))
        };
        let pending = match edit {
            Edit::Transform { paths, .. } | Edit::Reshape { paths, .. } => begin(paths),
            Edit::SetStates(_) => begin(&edit.paths().collect::<Vec<u32>>()),
            Edit::Restyle(_) | Edit::Insert(_) | Edit::Tables(_) => Vec::new(),
        };
        let scene_now = Arc::make_mut(scene);
        install(pool.as_ref(), || scene_now.edit(edit)).map_err(RenderError::Edit)?;
        if matches!(edit, Edit::Tables(_)) {
            return Ok(EditOutcome::InPlace { moved_bytes: 0 });
        }
        *tones = None;
        full_pixels.forget();
        let fixed = fixed_bytes(scene, budget);
        if fixed > budget.memory_bytes {
            return Err(over_budget("the index of the paths", fixed, budget));
        }
        let before = (clusters.style.solid, clusters.style.own_widths);
        let changes = install(pool.as_ref(), || {
            if !matches!(edit, Edit::Transform { .. } | Edit::Reshape { .. }) {
                clusters.style = StyleSummary::of(scene);
            }
            match edit {
                Edit::Transform { by, .. } => clusters.apply_edit(scene, &pending, Some(*by)),
                Edit::Reshape { .. } | Edit::SetStates(_) => {
                    clusters.apply_edit(scene, &pending, None)
                }
                Edit::Restyle(_) => clusters.bounds_of(&edit.paths().collect::<Vec<_>>()),
                Edit::Insert(_) => clusters.append(scene),
                Edit::Tables(_) => Vec::new(),
            }
        });
        if let Some(picture) = picture {
            // One color is drawn by another rasterizer than several.
            if before == (clusters.style.solid, clusters.style.own_widths) {
                picture.add_changes(&changes);
            } else {
                picture.forget();
            }
        }
        Ok(EditOutcome::InPlace { moved_bytes: 0 })
    }

    fn show_gesture(&mut self, gesture: Option<&Gesture>) -> Result<EditOutcome, RenderError> {
        let shown = self.gesture.as_ref();
        let is_shown =
            gesture.is_some_and(|new| shown.is_some_and(|shown| shown.paths.are_of(new)));
        if !is_shown {
            self.end_gesture();
        }
        if let Some(gesture) = gesture {
            let shown = match self.gesture.take() {
                Some(shown) => shown,
                None => self.begin_gesture(gesture)?,
            };
            let checked = shown.paths.check(gesture.by);
            let shown = self.gesture.insert(shown);
            if let Err(error) = checked {
                self.end_gesture();
                return Err(RenderError::Edit(error));
            }
            let clusters = &mut self.clusters;
            let changes = install(self.pool.as_ref(), || {
                clusters.map_gesture(shown, gesture.by)
            });
            self.take_changes(&changes);
        }
        Ok(EditOutcome::InPlace { moved_bytes: 0 })
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
        let (strip, cancel) = (Strip::whole(view), Cancel::default());
        let frame = (&strip, style, &cancel);
        let shown = (&*self.scene, self.gesture.as_ref());
        let ctx = self.clusters.style.frame_context(shown, self.simd, frame);
        self.full_pixels.lookup(&ctx, 0.0).count(&ctx)
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
