//! One opaque color: covers the samples of a tile in any order, and finds pixels that stay full.

use super::cluster_in_tile::{ClusterInTile, DrawRange, prefetch_next};
use super::job::{BandJob, BandProbe, ScenePart, Tile};
use super::resting_coverage::RestingCoverage;
use super::thread_scratch::ThreadScratch;
use crate::cpu::ground::samples::SOLID;
use crate::cpu::ground::simd::simd_dispatch;
use crate::cpu::ground::tile::{PASSES, PixelRows, TILE_PX};

/// Most clusters of a sparse tile: they hide little of each other, so all passes are drawn at once.
const FEW_CLUSTERS: usize = 6;
/// Most line ranges of a sparse tile.
const FEW_LINE_RANGES: usize = 64;
/// Share of open pixels after the first pass from which on full pixels are no longer recorded: it
/// would cost more than it saves.
const MIN_OPEN_SHARE: f32 = 0.95;
/// Share of open pixels at the start up to which all passes are drawn at once: the first ones hide
/// little of the others.
const MAX_OPEN_SHARE: f32 = 0.75;

/// Covers samples of all pixels of a tile that are not known to be full.
pub(super) fn cover_open_pixels(job: &BandJob<'_>, scratch: &mut ThreadScratch, tile: &Tile) {
    if let Some(resting) = job.resting {
        return cover_over_resting(job, resting, scratch, tile);
    }
    let full = job.full_pixels.tile(job.ctx.simd, tile.corner);
    if full == [u32::MAX; TILE_PX] {
        scratch.solid.begin_full();
    } else {
        cover_solid_by(job.ctx.simd, job, scratch, tile, Some(&full));
    }
}

/// Covers samples with the paths of a gesture, over those of resting paths. The tile is whole.
fn cover_over_resting(
    job: &BandJob<'_>,
    resting: &RestingCoverage,
    scratch: &mut ThreadScratch,
    tile: &Tile,
) {
    let cover = |scratch: &mut ThreadScratch, part, closed| {
        let job = BandJob { part, ..*job };
        let clusters = job.lists.clusters(tile.index);
        scratch.clusters.clear();
        scratch
            .clusters
            .extend(clusters.filter(|&key| job.draws(key)));
        cover_solid_by(job.ctx.simd, &job, scratch, tile, closed);
    };
    let is_known = resting.load(tile.corner, &mut scratch.solid);
    if !is_known {
        cover(scratch, ScenePart::Resting, Some(&[0; TILE_PX]));
        resting.store(tile.corner, &scratch.solid);
    }
    cover(scratch, ScenePart::Moved, None);
}

/// Finds the full pixels of a tile that inset strokes fill, too: they stay full while the view
/// zooms.
pub(super) fn find_full_pixels(
    job: &BandJob<'_>,
    probe: BandProbe<'_>,
    scratch: &mut ThreadScratch,
    tile: &Tile,
) {
    let ctx = probe.ctx;
    let tile_row = tile.corner.y as usize / TILE_PX;
    if !probe.found.rows.contains(&tile_row) {
        return;
    }
    let inset_job = BandJob {
        ctx,
        common_radius_px: ctx.common_radius_px(),
        max_radius_px: ctx.max_radius_px(),
        ..*job
    };
    let known = probe.full_pixels.tile(ctx.simd, tile.corner);
    let (touched, in_view) = scratch.solid.pixel_coverage(tile.width_px, tile.height_px);
    let mut closed = in_view;
    for (closed, known) in closed.iter_mut().zip(&known) {
        *closed = !*closed | known;
    }
    cover_solid_by(ctx.simd, &inset_job, scratch, tile, Some(&closed));
    let (_, mut full) = scratch.solid.pixel_coverage(tile.width_px, tile.height_px);
    for (full, in_view) in full.iter_mut().zip(&in_view) {
        *full &= in_view;
    }
    probe.found.store(tile.corner, touched, &full);
}

simd_dispatch!(
    fn cover_solid_by(
        job: &BandJob<'_>,
        scratch: &mut ThreadScratch,
        tile: &Tile,
        closed: Option<&PixelRows>
    )
    by cover_solid
);
/// Covers samples with the lines of a tile, in any order, until all samples are covered. Pixels of
/// `closed` count as covered from the start; `None` goes on with the samples that are covered.
#[inline(always)]
fn cover_solid(
    job: &BandJob<'_>,
    scratch: &mut ThreadScratch,
    tile: &Tile,
    closed: Option<&PixelRows>,
) {
    let ThreadScratch {
        solid: mask,
        solid_caps: cap_tables,
        clusters,
        ..
    } = scratch;
    let all = (tile.width_px * tile.height_px) as f32;
    if let Some(closed) = closed {
        mask.begin(tile.width_px, tile.height_px);
        mask.close_pixels(closed);
    }
    let open = mask.open_count() as f32;
    let is_sparse = clusters.len() <= FEW_CLUSTERS;
    // A probe needs to know which pixels are full.
    let may_skip_closing = job.probe.is_none();
    let line_ranges = || {
        let all = job.lists.line_ranges(tile.index);
        all.flat_map(|all| all.chunk_by(|a, b| a.key == b.key))
            .filter(|of_cluster| job.draws(of_cluster[0].key))
    };
    let range_count = || line_ranges().map(<[_]>::len).sum::<usize>();
    if may_skip_closing && is_sparse && range_count() <= FEW_LINE_RANGES {
        mask.skip_closing();
    }
    let min_open = open * MIN_OPEN_SHARE;
    for of_cluster in line_ranges() {
        if mask.is_full() {
            return;
        }
        let cluster = ClusterInTile::<SOLID>::new(job, tile, of_cluster[0].key);
        cluster.cover_solid(mask, cap_tables, DrawRange::Lines(of_cluster));
    }
    let is_mostly_full = open <= all * MAX_OPEN_SHARE;
    let at_once = if is_sparse || is_mostly_full {
        PASSES
    } else {
        1
    };
    for first in (0..PASSES).step_by(at_once) {
        if may_skip_closing && first == 1 && mask.open_count() as f32 >= min_open {
            mask.skip_closing();
        }
        for (i, &key) in clusters.iter().enumerate() {
            if mask.is_full() {
                return;
            }
            prefetch_next(job, clusters, i);
            let range = DrawRange::Passes(first..first + at_once);
            ClusterInTile::<SOLID>::new(job, tile, key).cover_solid(mask, cap_tables, range);
        }
    }
}
