//! The lines of one cluster relative to a tile: lists the pieces that may touch it, or covers
//! samples with them.

use std::ops::Range;

use guideway_spline::{Bounds, Point};

use super::bits::set_bits;
use super::caps::{CapTable, CapTables};
use super::coverage_mask::CoverageMask;
use super::fixed_point::line_batch::FixedLines;
use super::job::{BandJob, Tile};
use super::line_batch::stroke_lines;
use crate::cpu::bin::cull::VisibleCluster;
use crate::cpu::bin::line_lists::LineRange;
use crate::cpu::flatten::cluster_lines::ClusterLines;
use crate::cpu::flatten::polylines::{Coordinate, Polylines};
use crate::cpu::flatten::tile_lines::TileLines;
use crate::cpu::ground::samples::{SOLID, columns};
use crate::cpu::ground::tile::{LANES, TILE_PX};

/// Most tiles of a cluster whose pieces are drawn without a test of their boxes: almost all of them
/// touch each tile.
const FEW_TILES: usize = 4;

/// A piece that may touch a tile.
pub(crate) struct PieceRef {
    /// Draw rank of its path.
    pub(crate) rank: u32,
    /// Key of the visible cluster.
    pub(crate) key: u32,
    pub(crate) piece: u32,
}

/// The lines of a cluster that are drawn at once.
#[derive(Clone)]
pub(crate) enum DrawRange<'a> {
    /// Consecutive passes.
    Passes(Range<usize>),
    /// The lines that may touch the tile.
    Lines(&'a [LineRange]),
}

/// A cluster relative to a tile of `C` sample columns per pixel.
#[derive(Clone, Copy)]
pub(crate) struct ClusterInTile<'a, const C: usize> {
    job: &'a BandJob<'a>,
    tile: &'a Tile,
    visible: &'a VisibleCluster,
}

impl<'a, const C: usize> ClusterInTile<'a, C> {
    #[inline(always)]
    pub(crate) fn new(job: &'a BandJob<'a>, tile: &'a Tile, key: u32) -> Self {
        let visible = job.visible.get(key);
        Self { job, tile, visible }
    }

    #[inline(always)]
    pub(crate) fn lines(&self) -> &'a ClusterLines {
        &self.job.cache.lines[self.visible.cluster as usize]
    }

    /// Maps cached lines to the tile.
    #[inline(always)]
    pub(crate) fn map_cached<T>(
        &self,
        unit_m: f64,
        lines: &'a Polylines<T>,
    ) -> TileLines<'a, T, C> {
        let unit_px = unit_m * self.job.ctx.view.px_per_m();
        TileLines::cached(lines, unit_px, self.visible.origin_px - self.tile.corner)
    }

    /// Maps clipped lines to the tile.
    #[inline(always)]
    pub(crate) fn map_clipped<T>(&self, lines: &'a Polylines<T>) -> TileLines<'a, T, C> {
        TileLines::clipped(lines, self.tile.corner)
    }

    /// Appends the pieces that may touch the tile.
    #[inline(always)]
    pub(crate) fn collect_pieces(&self, key: u32, pieces: &mut Vec<PieceRef>) {
        match self.lines() {
            ClusterLines::Cached(unit_m, lines) => {
                self.collect_from(&self.map_cached(*unit_m, lines), key, pieces);
            }
            ClusterLines::Clipped(lines) => {
                self.collect_from(&self.map_clipped(lines), key, pieces);
            }
            ClusterLines::None => {}
        }
    }

    #[inline(always)]
    fn collect_from<T: Coordinate>(
        &self,
        mapped: &TileLines<'_, T, C>,
        key: u32,
        pieces: &mut Vec<PieceRef>,
    ) {
        let within = self.tile_box(mapped);
        let all = 0..mapped.lines.pieces();
        for first in all.clone().step_by(LANES) {
            for lane in set_bits(mapped.lines.pieces_meeting(first, all.end, &within)) {
                let piece = first + lane;
                pieces.push(self.piece_ref(mapped.lines, key, piece as u32));
            }
        }
    }

    /// Appends the piece of a line range.
    #[inline(always)]
    pub(crate) fn add_piece(&self, range: &LineRange, pieces: &mut Vec<PieceRef>) {
        let LineRange { key, piece, .. } = *range;
        match self.lines() {
            ClusterLines::Cached(_, lines) => pieces.push(self.piece_ref(lines, key, piece)),
            ClusterLines::Clipped(lines) => pieces.push(self.piece_ref(lines, key, piece)),
            ClusterLines::None => {}
        }
    }

    #[inline(always)]
    fn piece_ref<T: Coordinate>(&self, lines: &Polylines<T>, key: u32, piece: u32) -> PieceRef {
        let path = self.path(lines.member(piece as usize));
        let ranks = self.job.ranks;
        let rank = ranks.map_or(path, |ranks| ranks[path as usize]);
        PieceRef { rank, key, piece }
    }

    /// A point of the cluster's paths as the frame shows it, in pixels from the tile's corner.
    pub(crate) fn shown_px(&self, at_m: Point<f64>) -> Point<f64> {
        let ctx = self.job.ctx;
        let by = ctx
            .gesture
            .and_then(|gesture| gesture.map_of(self.visible.cluster));
        let shown_m = by.map_or(at_m, |by| by.apply(at_m));
        ctx.transform.pixel(shown_m) - self.tile.corner
    }

    /// The path of a member of the cluster.
    #[inline(always)]
    fn path(&self, member: usize) -> u32 {
        self.job.index.rows_of(self.visible.cluster)[member]
    }

    /// The path of a piece; `None` if the cluster has no lines.
    #[inline(always)]
    pub(crate) fn path_of(&self, piece: usize) -> Option<u32> {
        match self.lines() {
            ClusterLines::Cached(_, lines) => Some(self.path(lines.member(piece))),
            ClusterLines::Clipped(lines) => Some(self.path(lines.member(piece))),
            ClusterLines::None => None,
        }
    }

    /// Box in which lines may touch the tile, in the unit of their vertices.
    #[inline(always)]
    fn tile_box<T>(&self, mapped: &TileLines<'_, T, C>) -> Bounds<f32> {
        let reach = columns::<C>(self.job.max_radius_px + 1.0 / 16.0);
        let side = (TILE_PX * C) as f32;
        let per_column = 1.0 / mapped.scale;
        let min = Point::new(-reach, -reach) - mapped.offset;
        let max = Point::new(side + reach, side + reach) - mapped.offset;
        Bounds {
            min: min * per_column,
            max: max * per_column,
        }
    }
}

impl<'a> ClusterInTile<'a, SOLID> {
    /// Maps cached lines to the tile in fixed point, if the cluster is small enough.
    #[inline(always)]
    fn map_fixed(&self, unit_m: f64, lines: &'a Polylines<i16>) -> Option<FixedLines<'a>> {
        let unit_px = unit_m * self.job.ctx.view.px_per_m();
        let origin_px = self.visible.origin_px - self.tile.corner;
        (self.visible.fits_fixed_point).then(|| FixedLines::new(lines, unit_px, origin_px))
    }

    /// Half the stroke width of a piece, in columns.
    #[inline(always)]
    fn radius<T: Coordinate>(&self, mapped: &TileLines<'_, T, SOLID>, piece: usize) -> f32 {
        let own_px = || (self.job.ctx).radius_px(self.path(mapped.lines.member(piece)));
        columns::<SOLID>(self.job.common_radius_px.unwrap_or_else(own_px))
    }

    /// Covers samples with some of the lines, all of one opaque color.
    #[inline(always)]
    pub(crate) fn cover_solid(
        &self,
        mask: &mut CoverageMask<SOLID>,
        cap_tables: &mut CapTables<SOLID>,
        range: DrawRange<'_>,
    ) {
        let corner = self.tile.corner.to_f32();
        let bounds_px = self.visible.bounds_px;
        if !mask.is_open(bounds_px.min - corner, bounds_px.max - corner) {
            return;
        }
        match self.lines() {
            ClusterLines::Cached(unit_m, lines) => {
                self.cover_solid_with(
                    mask,
                    cap_tables,
                    &self.map_cached(*unit_m, lines),
                    range,
                    self.map_fixed(*unit_m, lines),
                );
            }
            // Ends of clipped lines depend on the view: they say nothing of the frames to come.
            ClusterLines::Clipped(_) if self.job.ctx.inset_for_zoom.is_some() => {}
            ClusterLines::Clipped(lines) => {
                self.cover_solid_with(mask, cap_tables, &self.map_clipped(lines), range, None);
            }
            ClusterLines::None => {}
        }
    }

    #[inline(always)]
    fn cover_solid_with<T: Coordinate>(
        &self,
        mask: &mut CoverageMask<SOLID>,
        cap_tables: &mut CapTables<SOLID>,
        mapped: &TileLines<'_, T, SOLID>,
        range: DrawRange<'_>,
        fixed: Option<FixedLines<'_>>,
    ) {
        let passes = match range {
            DrawRange::Passes(passes) => passes,
            DrawRange::Lines(line_ranges) => {
                for line_range in line_ranges {
                    let caps = cap_tables.of(self.radius(mapped, line_range.piece as usize));
                    let [start, end] = line_range.starts.map(|vertex| vertex as usize);
                    cover(mapped, &fixed, mask, start..end, caps);
                }
                return;
            }
        };
        let pieces = mapped.lines.pieces_of_passes(passes);
        if pieces.is_empty() {
            return;
        }
        let is_wide = self.visible.columns().len() * self.visible.rows().len() > FEW_TILES;
        match self.job.common_radius_px {
            Some(radius_px) if !is_wide => {
                let caps = cap_tables.of(columns::<SOLID>(radius_px));
                let starts = mapped.lines.line_starts(pieces);
                cover(mapped, &fixed, mask, starts, caps);
            }
            _ => {
                let within = self.tile_box(mapped);
                for first in pieces.clone().step_by(LANES) {
                    for lane in set_bits(mapped.lines.pieces_meeting(first, pieces.end, &within)) {
                        let piece = first + lane;
                        let starts = mapped.lines.line_starts(piece..piece + 1);
                        let caps = cap_tables.of(self.radius(mapped, piece));
                        cover(mapped, &fixed, mask, starts, caps);
                    }
                }
            }
        }
    }
}

/// Prefetches the lines of the cluster behind the one that is drawn: clusters lie anywhere in
/// memory.
#[inline(always)]
pub(crate) fn prefetch_next(job: &BandJob<'_>, clusters: &[u32], drawn: usize) {
    if let Some(&next) = clusters.get(drawn + 1) {
        let visible = job.visible.get(next);
        job.cache.lines[visible.cluster as usize].prefetch();
    }
}

/// Covers samples with the lines that start at some vertices, in fixed point if possible.
#[inline(always)]
fn cover<T: Coordinate>(
    mapped: &TileLines<'_, T, SOLID>,
    fixed: &Option<FixedLines<'_>>,
    mask: &mut CoverageMask<SOLID>,
    starts: Range<usize>,
    caps: &CapTable<SOLID>,
) {
    match fixed {
        Some(fixed) => fixed.stroke(mask, starts, caps),
        None => stroke_lines(mapped, mask, starts, caps),
    }
}
