//! Input of the raster stage: the data that all tiles of a band share, and the tile to draw.

use guideway_scene::cluster::ClusterIndex;
use guideway_spline::Point;

use super::full_pixel_cache::{FullPixelBand, FullPixelLookup};
use super::resting_coverage::RestingCoverage;
use crate::cpu::bin::cull::VisibleClusters;
use crate::cpu::bin::tile_lists::TileLists;
use crate::cpu::flatten::line_cache::LineCache;
use crate::cpu::ground::damage::{DamageMap, TileGrid};
use crate::cpu::ground::frame_context::FrameContext;
use crate::cpu::ground::samples::columns;

/// A band of the picture, with its clusters, lines and tile lists.
#[derive(Clone, Copy)]
pub(crate) struct BandJob<'a> {
    pub(crate) ctx: &'a FrameContext<'a>,
    pub(crate) grid: &'a TileGrid,
    pub(crate) index: &'a ClusterIndex,
    pub(crate) cache: &'a LineCache,
    /// Draw rank of each path; `None` if ranks are rows.
    pub(crate) ranks: Option<&'a [u32]>,
    pub(crate) visible: &'a VisibleClusters,
    pub(crate) lists: &'a TileLists,
    /// The pixels that are drawn.
    pub(crate) damage: &'a DamageMap,
    /// The clusters that are drawn.
    pub(crate) part: ScenePart,
    /// Coverage of the paths that rest while a gesture moves others.
    pub(crate) resting: Option<&'a RestingCoverage>,
    /// Pixels that are known to be full.
    pub(crate) full_pixels: FullPixelLookup<'a>,
    /// Probe for pixels that stay full.
    pub(crate) probe: Option<BandProbe<'a>>,
    /// Half the stroke width in pixels, if all paths share one.
    pub(crate) common_radius_px: Option<f64>,
    /// Half the stroke width of the widest path, in pixels.
    pub(crate) max_radius_px: f64,
}

impl BandJob<'_> {
    /// Half the stroke width of a path, in columns.
    #[inline(always)]
    pub(crate) fn radius<const C: usize>(&self, path: u32) -> f32 {
        let own_px = || self.ctx.radius_px(path);
        columns::<C>(self.common_radius_px.unwrap_or_else(own_px))
    }

    /// Returns `true` if the part has a visible cluster.
    #[inline(always)]
    pub(crate) fn draws(&self, key: u32) -> bool {
        match self.part {
            ScenePart::All => true,
            ScenePart::Resting => !self.visible.get(key).is_moved,
            ScenePart::Moved => self.visible.get(key).is_moved,
        }
    }
}

/// A part of the visible clusters.
#[derive(Clone, Copy)]
pub(crate) enum ScenePart {
    All,
    /// Clusters that no gesture moves.
    Resting,
    /// Clusters that a gesture moves.
    Moved,
}

/// A look for pixels that stay full in the frames to come.
#[derive(Clone, Copy)]
pub(crate) struct BandProbe<'a> {
    /// The frame with inset strokes.
    pub(crate) ctx: &'a FrameContext<'a>,
    /// Receives the pixels.
    pub(crate) found: &'a FullPixelBand,
    /// Pixels that are known to stay full already.
    pub(crate) full_pixels: FullPixelLookup<'a>,
}

/// The damaged part of a tile.
pub(crate) struct Tile {
    /// Index in the grid of the band.
    pub(crate) index: usize,
    /// Upper left corner of the damage, in pixels of the view.
    pub(crate) corner: Point<f64>,
    pub(crate) width_px: usize,
    pub(crate) height_px: usize,
}
