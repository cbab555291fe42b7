//! Plans the memory of a frame: the bytes that it needs at least, and the caches that the budget
//! has room for.

use guideway_scene::{Budget, RenderError, Scene, Shading, Strip, Style};

use super::clusters::PreparedClusters;
use super::picture_cache::PictureCache;
use crate::cpu::raster::full_pixel_cache::{FullPixelBand, FullPixelCache};
use crate::cpu::raster::resting_coverage::RestingCoverage;
use crate::cpu::raster::thread_scratch::ThreadScratch;

/// Name of the method in options, errors and reports.
pub(crate) const NAME: &str = "cpu";

/// Memory of a frame.
pub(crate) struct FrameMemory {
    /// The fixed buffers, the frame itself, and the cached picture.
    pub(crate) needed_bytes: u64,
    /// The fixed buffers.
    pub(crate) own_bytes: u64,
    pub(crate) frame_bytes: u64,
    pub(crate) picture_bytes: u64,
    /// True if the frame looks up known full pixels and looks for new ones.
    pub(crate) uses_full_pixels: bool,
    /// True if the frame copies the samples of resting paths.
    pub(crate) uses_resting: bool,
}

impl FrameMemory {
    /// Plans a frame beside `fixed_bytes`, in which paths of one opaque color may rest beside those
    /// of a gesture. Drops the cached picture and the full pixels if the budget has no room for
    /// them.
    pub(crate) fn plan(
        fixed_bytes: u64,
        (strip, style, may_rest): (&Strip, &Style, bool),
        picture: &mut Option<PictureCache>,
        full_pixels: &mut FullPixelCache,
        budget: &Budget,
    ) -> Self {
        let pixels = strip.size().pixels();
        let is_density = style.shading != Shading::Color;
        let frame_bytes = (pixels * size_of::<[u8; 4]>()) as u64;
        let mut own_bytes = fixed_bytes;
        if is_density {
            own_bytes += (pixels * size_of::<f32>()) as u64;
        }
        let limit_bytes = budget.memory_bytes;
        picture.take_if(|picture| {
            !strip.is_whole() || own_bytes + frame_bytes + picture.bytes() > limit_bytes
        });
        let picture_bytes = picture.as_ref().map_or(0, PictureCache::bytes);
        let full_bytes = full_pixels.bytes() + FullPixelBand::planned_bytes(pixels);
        let all_bytes = own_bytes + frame_bytes + picture_bytes + full_bytes;
        let uses_full_pixels = strip.is_whole() && !is_density && all_bytes <= limit_bytes / 2;
        if uses_full_pixels {
            own_bytes += full_bytes;
        } else {
            full_pixels.forget();
        }
        let resting_bytes = RestingCoverage::planned_bytes(strip);
        let has_room = own_bytes + frame_bytes + picture_bytes + resting_bytes <= limit_bytes / 2;
        let uses_resting = may_rest && strip.is_whole() && !is_density && has_room;
        if uses_resting {
            own_bytes += resting_bytes;
        }
        Self {
            needed_bytes: own_bytes + frame_bytes + picture_bytes,
            own_bytes,
            frame_bytes,
            picture_bytes,
            uses_full_pixels,
            uses_resting,
        }
    }
}

/// Bytes that every frame needs, however small.
pub(crate) fn fixed_bytes(scene: &Scene, budget: &Budget) -> u64 {
    let scratches = threads(budget) as u64 * ThreadScratch::bytes(scene.is_opaque());
    PreparedClusters::planned_bytes(scene.row_count()) + scratches
}

/// Number of threads that draw.
pub(crate) fn threads(budget: &Budget) -> usize {
    if budget.threads > 0 {
        budget.threads
    } else {
        rayon::current_num_threads()
    }
}

/// The error of a request that exceeds the budget.
pub(crate) fn over_budget(what: &'static str, needed_bytes: u64, budget: &Budget) -> RenderError {
    RenderError::Budget {
        method: NAME,
        what,
        needed_bytes,
        budget_bytes: budget.memory_bytes,
    }
}
