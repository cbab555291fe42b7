//! Resting coverage: the samples that the paths at rest cover while a gesture moves others. Frames
//! of one view draw the moved paths alone, over a copy of these samples.
//!
//! ```text
//!   first frame   resting paths -> samples -> copy
//!                                     + moved paths -> pixels
//!   next frames                  copy + moved paths -> pixels
//! ```

use std::sync::{Mutex, MutexGuard, PoisonError};

use guideway_scene::{Strip, Style};
use guideway_spline::Point;

use super::coverage_mask::CoverageMask;
use super::coverage_mask::stored::StoredMask;
use crate::cpu::ground::damage::TileGrid;
use crate::cpu::ground::frame_context::FrameContext;
use crate::cpu::ground::samples::SOLID;
use crate::cpu::ground::snapped_view::SnappedTransform;
use crate::cpu::ground::tile::TILE_PX;

/// The samples of each tile of a picture that was drawn since the gesture began.
#[derive(Default)]
pub(crate) struct RestingCoverage {
    /// The view and the style of the samples.
    drawn: Option<(SnappedTransform, Style)>,
    columns: usize,
    tiles: Vec<Mutex<Option<StoredMask>>>,
}

impl RestingCoverage {
    /// The coverage for a frame: without samples if they are of another view or style.
    pub(crate) fn of_frame(&mut self, ctx: &FrameContext<'_>) -> &Self {
        let grid = TileGrid::of(ctx.strip);
        let drawn = Some((ctx.transform, *ctx.style));
        if (self.drawn, self.columns, self.tiles.len()) != (drawn, grid.columns, grid.len()) {
            self.drawn = drawn;
            self.columns = grid.columns;
            self.tiles.clear();
            self.tiles.resize_with(grid.len(), Mutex::default);
        }
        self
    }

    /// Sets the mask to the samples of a whole tile. Returns `false` if they are not known.
    pub(crate) fn load(&self, corner: Point<f64>, mask: &mut CoverageMask<SOLID>) -> bool {
        let stored = self.tile(corner);
        stored.as_ref().map(|stored| mask.load(stored)).is_some()
    }

    /// Copies the samples of a whole tile.
    pub(crate) fn store(&self, corner: Point<f64>, mask: &CoverageMask<SOLID>) {
        *self.tile(corner) = Some(mask.stored());
    }

    fn tile(&self, corner: Point<f64>) -> MutexGuard<'_, Option<StoredMask>> {
        let [column, row] = [corner.x, corner.y].map(|px| px as usize / TILE_PX);
        let tile = &self.tiles[row * self.columns + column];
        tile.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Number of tiles whose samples are known.
    #[cfg(test)]
    pub(crate) fn known_tiles(&self) -> usize {
        let is_known = |tile: &&Mutex<Option<StoredMask>>| {
            let stored = tile.lock().unwrap_or_else(PoisonError::into_inner);
            stored.is_some()
        };
        self.tiles.iter().filter(is_known).count()
    }

    /// Upper bound of the heap bytes for a picture.
    pub(crate) fn planned_bytes(strip: &Strip) -> u64 {
        let of_tile = size_of::<Mutex<Option<StoredMask>>>() as u64 + StoredMask::MAX_BYTES;
        TileGrid::of(strip).len() as u64 * of_tile
    }
}
