//! [`Pyramid`]: makes all tiles of some zooms, block by block, and keeps each in a journal.

use std::ops::RangeInclusive;
use std::sync::Arc;

use guideway_scene::{Cancel, RenderError, Scene};
use rayon::prelude::*;

use crate::archive::{BlockCounts, Journal};
use crate::descent::Descent;
use crate::gzip::Gzip;
use crate::raster::TileRenderer;
use crate::vector::{TileEncoder, VectorOptions, buffer_m};
use crate::{Tile, TileError, TileGrid};

/// Zooms from a block to its tiles: 8 x 8 tiles, or 2048 x 2048 pixels, are drawn at once. Larger
/// ones take more memory, smaller ones visit the scene more often.
pub(crate) const BLOCK_ZOOMS: u8 = 3;
/// Least vector tiles that a thread encodes with one encoder, whose memory it clears first.
const MIN_TILES: usize = 8;

/// Kind of the tiles.
pub enum Content {
    /// PNG.
    Raster(Box<TileRenderer>),
    /// Mapbox vector tiles.
    Vector(VectorOptions),
}

/// All tiles of some zooms.
pub struct Pyramid<'a> {
    /// The scene, placed on the grid.
    pub scene: Arc<Scene>,
    /// The grid.
    pub grid: TileGrid,
    /// The zooms, from the first to the last one.
    pub zooms: RangeInclusive<u8>,
    /// Called with the share of the work that is done, from 0 to 1.
    pub progress: &'a dyn Fn(f64),
    /// Stops the work after the block at hand.
    pub cancel: &'a Cancel,
}

/// The outcome of [`Pyramid::make`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Made {
    /// All tiles are in the journal.
    All,
    /// Cancelled: the finished tiles are in the journal, and a later call makes the others.
    Stopped,
}

impl Pyramid<'_> {
    /// Makes the tiles that the journal lacks, in the order of their numbers.
    ///
    /// # Errors
    /// When a tile cannot be drawn or encoded, or the journal cannot be written.
    pub fn make(&self, content: &mut Content, journal: &mut Journal) -> Result<Made, TileError> {
        let made = self.zooms.clone().try_for_each(|zoom| match content {
            Content::Raster(renderer) => self.make_raster(zoom, renderer, journal),
            Content::Vector(options) => self.make_vector(zoom, options, journal),
        });
        match made {
            Ok(()) => Ok(Made::All),
            Err(TileError::Render(RenderError::Cancelled)) => Ok(Made::Stopped),
            Err(error) => Err(error),
        }
    }

    fn make_raster(
        &self,
        zoom: u8,
        renderer: &mut TileRenderer,
        journal: &mut Journal,
    ) -> Result<(), TileError> {
        let below = zoom.min(BLOCK_ZOOMS);
        let descent = self.descent(renderer.reach_m(&self.scene, zoom));
        let next_id = journal.next_id();
        let is_left = |tile: Tile| tile.last_id(zoom - tile.z) >= next_id;
        let mut tones = renderer.tones().filter(|_| is_left(Tile::WORLD));
        let begins_at = if tones.is_some() { 0.5 } else { 0.0 };
        if let Some(tones) = &mut tones {
            // Tiles have their colors in common only if all have been counted before.
            descent.for_each(zoom - below, &|_| true, &mut |block, _| {
                self.advance(zoom, block, [0.0, 0.5])?;
                renderer.observe(block, below, tones, self.cancel)
            })?;
        }
        let max_count = tones.as_ref().map(|tones| tones.max_count());
        descent.for_each(zoom - below, &is_left, &mut |block, _| {
            self.advance(zoom, block, [begins_at, 1.0])?;
            let tiles = renderer.draw(block, below, tones.as_ref(), self.cancel)?;
            let tiles = tiles
                .into_iter()
                .filter_map(|(tile, png)| Some((tile, png?)));
            let counts = BlockCounts {
                omitted: 0,
                max_count,
            };
            journal.push((zoom, block.last_id(below)), counts, tiles.collect())
        })
    }

    fn make_vector(
        &self,
        zoom: u8,
        options: &VectorOptions,
        journal: &mut Journal,
    ) -> Result<(), TileError> {
        let below = zoom.min(BLOCK_ZOOMS);
        let descent = self.descent(buffer_m(&self.grid, zoom));
        let next_id = journal.next_id();
        let is_left = |tile: Tile| tile.last_id(zoom - tile.z) >= next_id;
        let (scene, grid) = (&*self.scene, &self.grid);
        let fields = options.features(scene);
        descent.for_each(zoom - below, &is_left, &mut |block, rows| {
            self.advance(zoom, block, [0.0, 1.0])?;
            let mut tiles = Vec::new();
            descent.descend(block, rows, zoom, &|_| true, &mut |tile, rows| {
                tiles.push((tile, rows.to_vec()));
                Ok::<_, TileError>(())
            })?;
            let encoder = || {
                let encoder = TileEncoder::new(scene, grid, &fields, options);
                (encoder, Gzip::fast())
            };
            let tiles = tiles.into_par_iter().with_min_len(MIN_TILES);
            let encoded = tiles.map_init(encoder, |(encoder, gzip), (tile, rows)| {
                let (mvt, omitted) = encoder.encode(tile, &rows);
                (tile, omitted, mvt.map(|mvt| gzip.compress(mvt)))
            });
            let encoded: Vec<_> = encoded.collect();
            let counts = BlockCounts {
                omitted: encoded.iter().map(|(_, omitted, _)| omitted).sum(),
                max_count: None,
            };
            let tiles = encoded
                .into_iter()
                .filter_map(|(tile, _, mvt)| Some((tile, mvt?)));
            journal.push((zoom, block.last_id(below)), counts, tiles.collect())
        })
    }

    fn descent(&self, reach_m: f64) -> Descent<'_> {
        Descent {
            scene: &self.scene,
            grid: &self.grid,
            reach_m,
        }
    }

    /// Reports progress: a block of a zoom, whose part of that zoom's work is some of its share.
    fn advance(&self, zoom: u8, block: Tile, [from, to]: [f64; 2]) -> Result<(), TileError> {
        self.cancel.check()?;
        let tiles = |zoom: u8| (2.0 * f64::from(zoom)).exp2();
        let before: f64 = (*self.zooms.start()..zoom).map(tiles).sum();
        let all: f64 = self.zooms.clone().map(tiles).sum();
        let within = block.index() as f64 / tiles(block.z);
        (self.progress)((before + tiles(zoom) * (from + (to - from) * within)) / all);
        Ok(())
    }
}
