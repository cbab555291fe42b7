//! [`Tiler`]: draws tiles by their addresses, for workers that share neither a file nor an order.

use std::sync::Arc;

use guideway_scene::{Cancel, Scene};
use rayon::prelude::*;

use crate::descent::Descent;
use crate::pyramid::{BLOCK_ZOOMS, Content};
use crate::raster::TileRenderer;
use crate::vector::{TileEncoder, VectorOptions, buffer_m};
use crate::{Tile, TileError, TileGrid};

/// A wanted tile and its place in the answer.
type Wanted = (Tile, usize);
/// The bytes of tiles, or `None` for one that shows nothing, by their place in the answer.
type Drawn = [Option<Vec<u8>>];

/// Draws tiles of a scene by their addresses.
///
/// A tile has the same bytes alone, among others and in an archive, whose vector tiles are
/// compressed beside.
pub struct Tiler {
    scene: Arc<Scene>,
    grid: TileGrid,
    content: Content,
}

impl Tiler {
    /// A tiler of a scene that is placed on a grid.
    ///
    /// # Errors
    /// When the content is shaded by density: its colors depend on all tiles of a zoom.
    pub fn new(scene: Arc<Scene>, grid: TileGrid, content: Content) -> Result<Self, TileError> {
        match &content {
            Content::Raster(renderer) if renderer.tones().is_some() => {
                Err(TileError::SingleDensity)
            }
            _ => Ok(Self {
                scene,
                grid,
                content,
            }),
        }
    }

    /// The grid.
    pub fn grid(&self) -> &TileGrid {
        &self.grid
    }

    /// The tiles of a zoom that paths may touch, in the order of their numbers.
    ///
    /// # Errors
    /// [`TileError::TooMany`] if there are more than `limit`.
    pub fn touched(&self, zoom: u8, limit: usize) -> Result<Vec<Tile>, TileError> {
        let mut tiles = Vec::new();
        self.descent(zoom)
            .for_each(zoom, &|_| true, &mut |tile, _| {
                if tiles.len() == limit {
                    return Err(TileError::TooMany { zoom, limit });
                }
                tiles.push(tile);
                Ok(())
            })?;
        Ok(tiles)
    }

    /// Draws tiles, in their order; `None` stands for one that shows nothing. Tiles of one call are
    /// drawn together where that saves work: neighbors belong into one call.
    ///
    /// # Errors
    /// When a tile cannot be drawn or encoded, or `cancel` is set.
    pub fn draw(
        &mut self,
        tiles: &[Tile],
        cancel: &Cancel,
    ) -> Result<Vec<Option<Vec<u8>>>, TileError> {
        let mut wanted: Vec<Wanted> = tiles.iter().copied().zip(0..).collect();
        wanted.sort_unstable_by_key(|(tile, place)| (tile.id(), *place));
        let mut drawn = vec![None; tiles.len()];
        for of_zoom in wanted.chunk_by(|(a, _), (b, _)| a.z == b.z) {
            let zooms = of_zoom[0].0.z.min(BLOCK_ZOOMS);
            for of_block in of_zoom.chunk_by(|a, b| a.0.above(zooms) == b.0.above(zooms)) {
                cancel.check()?;
                let block = of_block[0].0.above(zooms);
                if let Content::Raster(renderer) = &mut self.content {
                    draw_block(renderer, block, zooms, of_block, &mut drawn, cancel)?;
                } else if let Content::Vector(options) = &self.content {
                    self.encode_block(options, of_block, &mut drawn)?;
                }
            }
        }
        Ok(drawn)
    }

    fn descent(&self, zoom: u8) -> Descent<'_> {
        let reach_m = match &self.content {
            Content::Raster(renderer) => renderer.reach_m(&self.scene, zoom),
            Content::Vector(_) => buffer_m(&self.grid, zoom),
        };
        Descent {
            scene: &self.scene,
            grid: &self.grid,
            reach_m,
        }
    }

    /// Encodes the wanted vector tiles of a block, sorted by their numbers.
    fn encode_block(
        &self,
        options: &VectorOptions,
        wanted: &[Wanted],
        drawn: &mut Drawn,
    ) -> Result<(), TileError> {
        let zoom = wanted[0].0.z;
        let mut touched = Vec::new();
        let holds_wanted = |tile: Tile| !within(wanted, tile, zoom - tile.z).is_empty();
        self.descent(zoom)
            .for_each(zoom, &holds_wanted, &mut |tile, rows| {
                touched.push((tile, rows.to_vec()));
                Ok::<_, TileError>(())
            })?;
        let (scene, grid) = (&*self.scene, &self.grid);
        let fields = options.features(scene);
        let encoder = || TileEncoder::new(scene, grid, &fields, options);
        let encoded = touched
            .into_par_iter()
            .map_init(encoder, |encoder, (tile, rows)| {
                let (mvt, _) = encoder.encode(tile, &rows);
                (tile, mvt.map(<[u8]>::to_vec))
            });
        for (tile, mvt) in encoded.collect::<Vec<_>>() {
            for (_, place) in within(wanted, tile, 0) {
                drawn[*place].clone_from(&mvt);
            }
        }
        Ok(())
    }
}

/// Draws the wanted raster tiles below a tile, sorted by their numbers: at once if they are a
/// quarter of all or more, else by quarters.
fn draw_block(
    renderer: &mut TileRenderer,
    block: Tile,
    zooms: u8,
    wanted: &[Wanted],
    drawn: &mut Drawn,
    cancel: &Cancel,
) -> Result<(), TileError> {
    if wanted.is_empty() {
        return Ok(());
    }
    if 4 * wanted.len() < 1 << (2 * zooms) {
        return block.children().into_iter().try_for_each(|child| {
            let wanted = within(wanted, child, zooms - 1);
            draw_block(renderer, child, zooms - 1, wanted, drawn, cancel)
        });
    }
    for (tile, png) in renderer.draw(block, zooms, None, cancel)? {
        for (_, place) in within(wanted, tile, 0) {
            drawn[*place].clone_from(&png);
        }
    }
    Ok(())
}

/// The wanted tiles, sorted by their numbers, that lie some zooms below a tile.
fn within(wanted: &[Wanted], tile: Tile, zooms: u8) -> &[Wanted] {
    let last = tile.last_id(zooms);
    let count = 1 << (2 * zooms);
    let first = wanted.partition_point(|(of, _)| of.id() + count <= last);
    let end = wanted.partition_point(|(of, _)| of.id() <= last);
    &wanted[first..end]
}
