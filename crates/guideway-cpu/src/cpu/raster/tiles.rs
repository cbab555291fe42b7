//! Rasterizes a band tile by tile: covers the samples of each damaged tile with the lines listed
//! for it, and resolves them to colors or densities. Threads take rows of tiles, and parts of rows.

use std::cmp::Reverse;
use std::sync::Mutex;

use guideway_scene::{RenderError, Rgba};
use guideway_spline::Point;
use guideway_spline::mem::prefetch;
use rayon::prelude::*;

use super::background::{Background, solid_ramp};
use super::cluster_in_tile::{ClusterInTile, prefetch_next};
use super::counted::CountedTile;
use super::job::{BandJob, Tile};
use super::layered::LayeredTile;
use super::resolve::ResolveSource;
use super::solid::{cover_open_pixels, find_full_pixels};
use super::thread_scratch::ThreadScratch;
use super::tile_rows::{TilePixels, TileRows};
use crate::cpu::ground::per_thread::thread_slot;
use crate::cpu::ground::samples::{LAYERED, SamplePattern};
use crate::cpu::ground::simd::simd_dispatch;
use crate::cpu::ground::tile::TILE_PX;

/// Pieces of several colors that are sorted first; every further batch is twice as large. Most
/// tiles are full before all pieces are sorted.
const FIRST_SORTED: usize = 256;
/// Most tiles per task.
const MAX_TILES: usize = 8;

/// Threads, each with its buffers.
type Scratches<'a> = &'a [Mutex<ThreadScratch>];

/// Draws the colors of a band. `load` fills rows of pixels, from a row of the picture on, with what
/// the undamaged pixels show.
///
/// # Errors
/// [`RenderError::Cancelled`].
pub(crate) fn draw_colors(
    job: &BandJob<'_>,
    scratches: Scratches<'_>,
    pixels: &mut [[u8; 4]],
    load: impl Fn(usize, &mut [[u8; 4]]) + Sync,
) -> Result<(), RenderError> {
    let background = job.ctx.style.background;
    let Some(color) = job.ctx.solid else {
        return draw_layers(job, scratches, pixels, load, background);
    };
    let ramp = solid_ramp(color, background);
    for_each_tile(
        job,
        scratches,
        pixels,
        load,
        ramp[0],
        |scratch, tile, pixels| {
            cover_open_pixels(job, scratch, tile);
            let source = ResolveSource::Solid(&scratch.solid, &ramp);
            source.resolve(job.ctx.simd, tile.width_px, pixels);
            if let Some(probe) = job.probe {
                find_full_pixels(job, probe, scratch, tile);
            }
        },
    )
}

/// Draws the colors of a band with paths of several colors.
fn draw_layers(
    job: &BandJob<'_>,
    scratches: Scratches<'_>,
    pixels: &mut [[u8; 4]],
    load: impl Fn(usize, &mut [[u8; 4]]) + Sync,
    background: Rgba,
) -> Result<(), RenderError> {
    let empty = background.to_u32().to_be_bytes();
    let background = Background::new(background);
    for_each_tile(
        job,
        scratches,
        pixels,
        load,
        empty,
        |scratch, tile, pixels| {
            cover_layers_by(job.ctx.simd, job, scratch, tile);
            let source = ResolveSource::Layered(&scratch.layers, &background);
            source.resolve(job.ctx.simd, tile.width_px, pixels);
        },
    )
}

/// Draws the densities of a band: the mean number of paths that cover each pixel. `load` as in
/// [`draw_colors`].
///
/// # Errors
/// [`RenderError::Cancelled`].
pub(crate) fn draw_densities(
    job: &BandJob<'_>,
    scratches: Scratches<'_>,
    pixels: &mut [f32],
    load: impl Fn(usize, &mut [f32]) + Sync,
) -> Result<(), RenderError> {
    for_each_tile(
        job,
        scratches,
        pixels,
        load,
        0.0,
        |scratch, tile, pixels| {
            count_layers_by(job.ctx.simd, job, scratch, tile);
            for (pixels, counts) in pixels.rows().zip(scratch.counts.iter()) {
                for (pixel, &count) in pixels.iter_mut().zip(counts) {
                    *pixel = count.max(0) as f32 / (2 * SamplePattern::<LAYERED>::COUNT) as f32;
                }
            }
        },
    )
}

/// Calls `draw` for each damaged tile that is not empty, with its rows of pixels; fills empty tiles
/// with `empty`. Before, calls `load` for the pixels of each row of tiles.
fn for_each_tile<P: Copy + Send + Sync>(
    job: &BandJob<'_>,
    scratches: Scratches<'_>,
    pixels: &mut [P],
    load: impl Fn(usize, &mut [P]) + Sync,
    empty: P,
    draw: impl Fn(&mut ThreadScratch, &Tile, &mut TilePixels<'_, '_, P>) + Sync,
) -> Result<(), RenderError> {
    let width_px = job.ctx.view.size().width() as usize;
    let rows = pixels.par_chunks_mut(width_px * TILE_PX);
    rows.enumerate().try_for_each(|(row, pixels)| {
        load((job.grid.rows.start + row) * TILE_PX, pixels);
        for_each_in_row(
            job,
            scratches,
            row,
            TileRows::new(pixels, width_px),
            empty,
            &draw,
        )
    })
}

/// [`for_each_tile`] for some tiles of a row, split over the threads that are free.
fn for_each_in_row<P: Copy + Send + Sync>(
    job: &BandJob<'_>,
    scratches: Scratches<'_>,
    row: usize,
    mut tiles: TileRows<'_, P>,
    empty: P,
    draw: &(impl Fn(&mut ThreadScratch, &Tile, &mut TilePixels<'_, '_, P>) + Sync),
) -> Result<(), RenderError> {
    if tiles.columns.len() > MAX_TILES {
        let [left, right] = tiles.halves();
        let (left, right) = rayon::join(
            || for_each_in_row(job, scratches, row, left, empty, draw),
            || for_each_in_row(job, scratches, row, right, empty, draw),
        );
        return left.and(right);
    }
    let mut scratch = thread_slot(scratches);
    let tile_row = job.grid.rows.start + row;
    for column in tiles.columns.clone() {
        job.ctx.cancel.check()?;
        let damage = job.damage.at(column, tile_row);
        if damage.is_empty() {
            continue;
        }
        let (columns, rows) = (damage.columns(), damage.rows());
        let tile = Tile {
            index: job.grid.tile(column, tile_row),
            corner: Point::new(
                (column * TILE_PX + columns.start) as f64,
                (tile_row * TILE_PX + rows.start) as f64,
            ),
            width_px: columns.len(),
            height_px: rows.len(),
        };
        let mut pixels = tiles.tile(column, columns, rows);
        scratch.clusters.clear();
        scratch.clusters.extend(job.lists.clusters(tile.index));
        let mut line_ranges = job.lists.line_ranges(tile.index);
        if scratch.clusters.is_empty() && line_ranges.all(<[_]>::is_empty) {
            pixels.rows().for_each(|row| row.fill(empty));
        } else {
            // Last written a frame ago, they have left the near caches.
            pixels.rows().for_each(|row| prefetch(row));
            draw(&mut scratch, &tile, &mut pixels);
        }
    }
    Ok(())
}

// One dispatch per function: compiled as one, each is optimized less for the sake of the others.
simd_dispatch!(
    fn cover_layers_by(job: &BandJob<'_>, scratch: &mut ThreadScratch, tile: &Tile)
    by cover_layers
);
simd_dispatch!(
    fn count_layers_by(job: &BandJob<'_>, scratch: &mut ThreadScratch, tile: &Tile)
    by count_layers
);

/// Composites the pieces of a tile by descending draw rank, until nothing below can be seen.
#[inline(always)]
fn cover_layers(job: &BandJob<'_>, scratch: &mut ThreadScratch, tile: &Tile) {
    let ThreadScratch {
        layers: mask,
        caps: cap_tables,
        pieces,
        clusters,
        ..
    } = scratch;
    mask.begin_layers(tile.width_px, tile.height_px);
    pieces.clear();
    for (i, &key) in clusters.iter().enumerate() {
        prefetch_next(job, clusters, i);
        ClusterInTile::<LAYERED>::new(job, tile, key).collect_pieces(key, pieces);
    }
    for line_range in job.lists.line_ranges(tile.index).flatten() {
        ClusterInTile::<LAYERED>::new(job, tile, line_range.key).add_piece(line_range, pieces);
    }
    let mut layers = LayeredTile::new(job, tile, mask, cap_tables);
    let mut below = &mut pieces[..];
    let mut count = FIRST_SORTED;
    while !below.is_empty() && !layers.is_full() {
        if count < below.len() {
            below.select_nth_unstable_by_key(count, |piece| Reverse(piece.rank));
        }
        let top;
        (top, below) = below.split_at_mut(count.min(below.len()));
        top.sort_unstable_by_key(|piece| Reverse(piece.rank));
        for piece in top.iter() {
            layers.add(piece);
        }
        count *= 2;
    }
    layers.finish();
}

/// Counts the samples of a tile that each path covers.
#[inline(always)]
fn count_layers(job: &BandJob<'_>, scratch: &mut ThreadScratch, tile: &Tile) {
    let ThreadScratch {
        layers: mask,
        caps: cap_tables,
        pieces,
        counts,
        ends,
        clusters,
        ..
    } = scratch;
    mask.begin_layers(tile.width_px, tile.height_px);
    let mut counted = CountedTile::new(job, tile, mask, cap_tables, counts, ends);
    for (i, &key) in clusters.iter().enumerate() {
        prefetch_next(job, clusters, i);
        pieces.clear();
        ClusterInTile::<LAYERED>::new(job, tile, key).collect_pieces(key, pieces);
        // Runs of a path may lie apart, but its samples are to count once.
        pieces.sort_unstable_by_key(|piece| piece.rank);
        counted.add(pieces);
    }
    pieces.clear();
    for line_range in job.lists.line_ranges(tile.index).flatten() {
        ClusterInTile::<LAYERED>::new(job, tile, line_range.key).add_piece(line_range, pieces);
    }
    pieces.sort_unstable_by_key(|piece| piece.rank);
    counted.add(pieces);
    counted.finish();
}
