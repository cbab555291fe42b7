//! [`TileRenderer`]: draws blocks of tiles by a render method, and cuts them into PNG tiles.

use std::sync::Arc;

use guideway_scene::density::ToneScale;
use guideway_scene::{Budget, Cancel, Frame, FrameSize, LineRule, Method, Prepared, Rgba};
use guideway_scene::{Scene, Shading, Style};
use rayon::prelude::*;

use crate::place::units_per_m;
use crate::png_tile::encode;
use crate::tile::TILE_PX;
use crate::{GridKind, Tile, TileError, TileGrid};

/// The bytes of a PNG file.
pub type Png = Vec<u8>;

/// A scene that a method has prepared, and the style of its tiles.
pub struct TileRenderer {
    prepared: Box<dyn Prepared>,
    method: &'static str,
    grid: TileGrid,
    style: Style,
    frame: Frame,
    counts: Vec<f32>,
}

impl TileRenderer {
    /// Prepares a scene, whose widths `style` gives in meters on the ground.
    ///
    /// # Errors
    /// When the scene does not fit the budget.
    pub fn new(
        method: &dyn Method,
        scene: Arc<Scene>,
        grid: TileGrid,
        mut style: Style,
        budget: &Budget,
    ) -> Result<Self, TileError> {
        if let LineRule::World { width_m, .. } = &mut style.line_rule {
            *width_m *= units_per_ground_m(&scene, &grid);
        }
        Ok(Self {
            prepared: method.prepare(scene, budget)?,
            method: method.info().name,
            grid,
            style,
            frame: Frame::new(FrameSize::new(1, 1)?),
            counts: Vec::new(),
        })
    }

    /// The color scale of density shading before it has seen any tile; `None` if tiles show colors.
    pub fn tones(&self) -> Option<ToneScale> {
        match self.style.shading {
            Shading::Color => None,
            Shading::Density(tone) => Some(ToneScale::new(tone, self.style.background)),
        }
    }

    /// Greatest distance from a center line at which a stroke of a zoom covers a pixel, in meters
    /// of the grid.
    pub(crate) fn reach_m(&self, scene: &Scene, zoom: u8) -> f64 {
        let px_per_m = self.grid.px_per_m(zoom);
        let radius_px = |width_m| self.style.line_rule.radius_px(width_m, px_per_m);
        let widths = scene.layout().paths.width_m().unwrap_or_default();
        let widest = widths.iter().copied().fold(0.0, f32::max);
        let radius_px = radius_px(None).max(radius_px(Some(widest)));
        (radius_px + 1.0) / px_per_m
    }

    /// Adds the counts of a tile, as the tiles some zooms below show it, to a color scale.
    ///
    /// # Errors
    /// When the method keeps no counts, fails or is cancelled.
    pub fn observe(
        &mut self,
        tile: Tile,
        zooms: u8,
        tones: &mut ToneScale,
        cancel: &Cancel,
    ) -> Result<(), TileError> {
        self.count(tile, zooms, cancel)?;
        tones.observe(&self.counts);
        Ok(())
    }

    /// Draws the tiles that cover a tile some zooms below, as PNG, in the order of their numbers.
    /// `None` stands for a tile of nothing but background. Density shading takes its colors from
    /// `tones`, so that neighbors have them in common.
    ///
    /// # Errors
    /// When the method fails or is cancelled.
    pub fn draw(
        &mut self,
        tile: Tile,
        zooms: u8,
        tones: Option<&ToneScale>,
        cancel: &Cancel,
    ) -> Result<Vec<(Tile, Option<Png>)>, TileError> {
        let view = self.grid.view(tile, zooms)?;
        match tones {
            Some(tones) => {
                self.count(tile, zooms, cancel)?;
                self.frame.resize(view.size());
                tones.shade(&self.counts, &mut self.frame);
            }
            None => {
                let Self {
                    prepared,
                    style,
                    frame,
                    ..
                } = self;
                prepared.render(&view, style, cancel, frame)?;
            }
        }
        let [first_x, first_y] = [tile.x << zooms, tile.y << zooms];
        let tiles = tile.descendants(zooms).into_par_iter();
        let encoded = tiles.map(|tile| {
            let corner = [tile.x - first_x, tile.y - first_y].map(|at| (at * TILE_PX) as usize);
            let encoded = encode_part(&self.frame, corner, self.style.background)?;
            Ok((tile, encoded))
        });
        encoded.collect()
    }

    fn count(&mut self, tile: Tile, zooms: u8, cancel: &Cancel) -> Result<(), TileError> {
        let view = self.grid.view(tile, zooms)?;
        let (style, counts) = (&self.style, &mut self.counts);
        let counted = self.prepared.count_paths(&view, style, cancel, counts)?;
        let method = self.method;
        counted.map(drop).ok_or(TileError::NoCounts { method })
    }
}

/// Units of the grid per meter on the ground, where the layout lies.
pub(crate) fn units_per_ground_m(scene: &Scene, grid: &TileGrid) -> f64 {
    match (grid.kind(), scene.layout().geo_origin) {
        (GridKind::Earth, Some(origin)) => units_per_m(origin.latitude_deg),
        _ => 1.0,
    }
}

/// Encodes the tile whose upper left corner is at a pixel of a frame; `None` if it is empty.
fn encode_part(
    frame: &Frame,
    [left, top]: [usize; 2],
    background: Rgba,
) -> Result<Option<Png>, TileError> {
    let background = background.to_u32().to_be_bytes();
    let (width, side) = (frame.size().width() as usize, TILE_PX as usize);
    let rows = (top..top + side).map(|row| &frame.pixels()[row * width + left..][..side]);
    match rows
        .clone()
        .all(|row| row == [background; TILE_PX as usize])
    {
        true => Ok(None),
        false => Ok(Some(encode(rows, background)?)),
    }
}
