//! [`CpuPrepared`]: a prepared scene and what lasts between its frames.

use std::sync::Arc;

use guideway_layout::clock::Instant;
use guideway_scene::density::ToneScale;
use guideway_scene::{Budget, Preparation, RenderError, Scene, Stage, Style, View, elapsed_ms};
use rayon::{ThreadPool, ThreadPoolBuilder};

use super::clusters::PreparedClusters;
use super::memory::{fixed_bytes, over_budget, threads};
use super::picture_cache::PictureCache;
use super::pipeline::FramePipeline;
use crate::cpu::ground::gesture::ShownGesture;
use crate::cpu::ground::simd::SimdLevel;
use crate::cpu::raster::full_pixel_cache::FullPixelCache;
use crate::cpu::raster::resting_coverage::RestingCoverage;

/// A prepared scene, with the state that passes from one frame to the next.
pub(crate) struct CpuPrepared {
    pub(super) scene: Arc<Scene>,
    pub(super) budget: Budget,
    /// `None` for the thread pool of the process.
    pub(super) pool: Option<ThreadPool>,
    pub(super) clusters: PreparedClusters,
    pub(super) gesture: Option<ShownGesture>,
    pub(super) preparation: Preparation,
    pub(super) pipeline: FramePipeline,
    pub(super) picture: Option<PictureCache>,
    pub(super) full_pixels: FullPixelCache,
    pub(super) resting: RestingCoverage,
    /// Tone scale of the last picture whose density was drawn in strips.
    pub(super) tones: Option<(View, Style, ToneScale)>,
    pub(super) simd: SimdLevel,
}

pub(super) fn install<R: Send>(pool: Option<&ThreadPool>, work: impl FnOnce() -> R + Send) -> R {
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
            resting: RestingCoverage::default(),
            tones: None,
            simd: SimdLevel::default(),
        })
    }
}
