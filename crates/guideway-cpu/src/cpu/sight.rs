//! What a frame sees of each cluster.

use std::ops::Range;

use guideway_spline::{Bounds, Point};
use rayon::prelude::*;

use super::canvas::TILE_PX;
use super::cluster::MOST_UNITS;
use super::extent::Extent;
use super::fixed;
use super::shot::Shot;

/// Clusters that one thread looks at in one go.
const CHUNK: usize = 512;

/// What a frame sees of a cluster.
#[derive(Debug)]
pub(super) struct Sight {
    pub(super) cluster: u32,
    /// Where what its lines are measured from lies, in pixels.
    pub(super) middle_px: Point<f64>,
    /// Pixels that it may leave a mark on.
    pub(super) reach_px: Bounds<f32>,
    /// Whether all of it is within the picture.
    pub(super) is_whole: bool,
    /// Whether it is too large for its lines to be kept.
    pub(super) is_large: bool,
    /// Whether it is so small that 16 bits hold where its lines lie.
    pub(super) is_small: bool,
    /// Tiles that it may leave a mark on.
    columns: [u16; 2],
    rows: [u16; 2],
}

impl Sight {
    fn new(cluster: u32, extent: Extent, shot: &Shot<'_>) -> Option<Self> {
        let picture = shot.picture_px();
        let reach = shot.reach_px(extent.bounds);
        if !reach.intersects(picture) {
            return None;
        }
        let tiles = |min: f64, max: f64, side_px: f64| {
            let end = (max.min(side_px) / TILE_PX as f64).ceil();
            [(min.max(0.0) / TILE_PX as f64) as u16, (end as u16).max(1)]
        };
        Some(Self {
            cluster,
            middle_px: shot.place.pixel(extent.middle),
            reach_px: Bounds {
                min: reach.min.to_f32(),
                max: reach.max.to_f32(),
            },
            is_whole: picture.contains(reach.min) && picture.contains(reach.max),
            is_large: extent.reach_m() > MOST_UNITS * shot.unit_m(),
            is_small: fixed::fits(
                extent.reach_m() * shot.view.px_per_m(),
                shot.thinnest_px()..=shot.widest_px(),
            ),
            columns: tiles(reach.min.x, reach.max.x, picture.max.x),
            rows: tiles(reach.min.y, reach.max.y, picture.max.y),
        })
    }

    pub(super) fn columns(&self) -> Range<usize> {
        usize::from(self.columns[0])..usize::from(self.columns[1])
    }

    pub(super) fn rows(&self) -> Range<usize> {
        usize::from(self.rows[0])..usize::from(self.rows[1])
    }

    /// Whether it may leave a mark on some rows of tiles.
    pub(super) fn is_in(&self, rows: &Range<usize>) -> bool {
        self.rows().start < rows.end && rows.start < self.rows().end
    }
}

/// The clusters in sight, by ascending number.
#[derive(Default)]
pub(super) struct Sights {
    chunks: Vec<Vec<Sight>>,
}

impl Sights {
    /// Looks for the clusters, by where each lies.
    pub(super) fn look(&mut self, extents: &[Option<Extent>], shot: &Shot<'_>) {
        self.chunks
            .resize_with(extents.len().div_ceil(CHUNK), Vec::new);
        let chunks = self.chunks.par_iter_mut().zip(extents.par_chunks(CHUNK));
        chunks.enumerate().for_each(|(chunk, (sights, extents))| {
            sights.clear();
            let numbered = ((chunk * CHUNK) as u32..).zip(extents);
            sights.extend(
                numbered.filter_map(|(cluster, extent)| Sight::new(cluster, (*extent)?, shot)),
            );
        });
    }

    /// All of them.
    pub(super) fn iter(&self) -> impl Iterator<Item = &Sight> {
        self.chunks.iter().flatten()
    }

    /// All of them in chunks, in parallel.
    pub(super) fn par_chunks(&self) -> impl ParallelIterator<Item = &[Sight]> {
        self.chunks.par_iter().map(Vec::as_slice)
    }

    /// All of them with their keys.
    pub(super) fn with_keys(&self) -> impl Iterator<Item = (u32, &Sight)> {
        self.with_keys_of(0..self.chunks())
    }

    /// Those of some chunks with their keys.
    pub(super) fn with_keys_of(&self, chunks: Range<usize>) -> impl Iterator<Item = (u32, &Sight)> {
        let numbered = chunks.clone().zip(&self.chunks[chunks]);
        numbered.flat_map(|(chunk, sights)| (Self::first_key(chunk)..).zip(sights))
    }

    /// The least key in a chunk.
    pub(super) fn first_key(chunk: usize) -> u32 {
        (chunk * CHUNK) as u32
    }

    /// Number of clusters in sight.
    pub(super) fn len(&self) -> usize {
        self.chunks.iter().map(Vec::len).sum()
    }

    /// Number of chunks.
    pub(super) fn chunks(&self) -> usize {
        self.chunks.len()
    }

    /// The one of a key.
    #[inline(always)]
    pub(super) fn get(&self, key: u32) -> &Sight {
        &self.chunks[key as usize / CHUNK][key as usize % CHUNK]
    }

    pub(super) fn bytes(&self) -> u64 {
        let sights: usize = self.chunks.iter().map(Vec::capacity).sum();
        (sights * size_of::<Sight>() + self.chunks.capacity() * size_of::<Vec<Sight>>()) as u64
    }
}
