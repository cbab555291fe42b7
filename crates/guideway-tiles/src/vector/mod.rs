//! Encodes the paths of a tile as a Mapbox vector tile: lines within an error of their curves, with
//! identifiers and attributes.
//!
//! | module | does |
//! |---|---|
//! | `lines` | flattens the curves of a path and clips them to a tile |
//! | `field` | the columns whose values features carry |
//! | `layer`, `value_table` | writes features and their attributes, equal values once |
//! | `extent` | the units of a tile |
//! | `message` | the encoding of protocol buffers |

mod extent;
mod field;
mod layer;
mod lines;
mod message;
mod value_table;

use std::cmp::Reverse;

use guideway_layout::Values;
use guideway_scene::Scene;
use guideway_spline::Bounds;

use crate::descent::Descent;
use crate::{Tile, TileGrid};
use extent::BUFFER_SHARE;
pub use extent::EXTENT;
use field::Field;
pub(crate) use layer::LAYER;
use layer::Layer;
use lines::TileLines;

/// Content of vector tiles.
#[derive(Clone, Debug, PartialEq)]
pub struct VectorOptions {
    /// Columns of the layout that features carry beside `id` and `level`; `None` for all but those
    /// with JSON.
    pub columns: Option<Vec<String>>,
    /// Most paths of a tile: with more, the longest ones. Map programs take about a second to show
    /// 100,000.
    pub max_paths: usize,
}

impl Default for VectorOptions {
    fn default() -> Self {
        Self {
            columns: None,
            max_paths: 20_000,
        }
    }
}

impl VectorOptions {
    /// Names and types of the fields, as the metadata of an archive has them.
    pub(crate) fn fields<'a>(&self, scene: &'a Scene) -> Vec<(&'a str, &'static str)> {
        let layout = scene.layout();
        let mut fields = vec![("id", "String")];
        if !layout.levels.is_empty() {
            fields.push(("level", "String"));
        }
        for name in layout.paths.column_names() {
            let is_wanted = |columns: &Vec<String>| columns.iter().any(|wanted| wanted == name);
            let column = layout.paths.column(name);
            let kind = match column.map(|column| &column.values) {
                Some(Values::Bool(_)) => "Boolean",
                Some(Values::Int(_) | Values::Float(_)) => "Number",
                Some(Values::Text(_)) => "String",
                Some(Values::Json(_)) | None => continue,
            };
            if self.columns.as_ref().is_none_or(is_wanted) && name != "id" && name != "level" {
                fields.push((name, kind));
            }
        }
        fields
    }

    /// The fields of features.
    pub(crate) fn features<'a>(&self, scene: &'a Scene) -> Vec<Field<'a>> {
        let names = self.fields(scene).into_iter();
        names
            .map(|(name, _)| Field::new(scene.layout(), name))
            .collect()
    }
}

/// A vector tile.
#[derive(Clone, Debug, PartialEq)]
pub struct VectorTile {
    /// The bytes, not compressed; `None` if the tile shows nothing.
    pub mvt: Option<Vec<u8>>,
    /// Paths that the tile leaves out: those above the limit, and those too small to show.
    pub omitted: u64,
}

/// Encodes a tile with all shown paths that touch it.
pub fn draw_vector_tile(
    scene: &Scene,
    grid: &TileGrid,
    tile: Tile,
    options: &VectorOptions,
) -> VectorTile {
    let reach_m = buffer_m(grid, tile.z);
    let descent = Descent {
        scene,
        grid,
        reach_m,
    };
    let rows = descent.touching(tile, scene.draw_order());
    let fields = options.features(scene);
    let mut encoder = TileEncoder::new(scene, grid, &fields, options);
    let (mvt, omitted) = encoder.encode(tile, &rows);
    VectorTile {
        mvt: mvt.map(<[u8]>::to_vec),
        omitted,
    }
}

/// Width of the buffer around the tiles of a zoom, in meters of the grid.
pub(crate) fn buffer_m(grid: &TileGrid, zoom: u8) -> f64 {
    BUFFER_SHARE * grid.side() / f64::from(zoom).exp2()
}

/// Encodes tiles of a scene, one after the other, in the same memory.
pub(crate) struct TileEncoder<'a> {
    scene: &'a Scene,
    grid: &'a TileGrid,
    fields: &'a [Field<'a>],
    max_paths: usize,
    lines: TileLines,
    layer: Layer,
}

impl<'a> TileEncoder<'a> {
    /// An encoder of features with some fields; see [`VectorOptions::features`].
    pub(crate) fn new(
        scene: &'a Scene,
        grid: &'a TileGrid,
        fields: &'a [Field<'a>],
        options: &VectorOptions,
    ) -> Self {
        Self {
            scene,
            grid,
            fields,
            max_paths: options.max_paths,
            lines: TileLines::new(grid.bounds(Tile::WORLD)),
            layer: Layer::default(),
        }
    }

    /// Encodes a tile. `rows` are the paths that may touch it, in draw order. Returns the bytes, if
    /// the tile shows anything, and the number of paths that it leaves out.
    pub(crate) fn encode(&mut self, tile: Tile, rows: &[u32]) -> (Option<&[u8]>, u64) {
        let longest = longest(self.scene, rows, self.max_paths);
        let shown = longest.as_deref().unwrap_or(rows);
        let mut omitted = (rows.len() - shown.len()) as u64;
        self.layer.clear();
        self.lines.begin(self.grid.bounds(tile));
        for &row in shown {
            let path = self.scene.layout().paths.get(row as usize);
            self.lines.clear();
            path.runs().for_each(|run| self.lines.push(run));
            match self.lines.commands() {
                Some(commands) => self.layer.push(self.fields, path, commands),
                None => omitted += u64::from(self.lines.is_in_tile()),
            }
        }
        (self.layer.finish(self.fields), omitted)
    }
}

/// The rows whose hulls are longest, in their order; `None` if there are no more than that.
fn longest(scene: &Scene, rows: &[u32], max: usize) -> Option<Vec<u32>> {
    if rows.len() <= max {
        return None;
    }
    let length = |row: u32| {
        let size = scene.hulls().of([row as usize]).map(Bounds::size);
        // Positive floats order as their bits do.
        size.map_or(0, |size| size.x.max(size.y).to_bits())
    };
    let mut all: Vec<(Reverse<u64>, usize)> = (0..rows.len())
        .map(|i| (Reverse(length(rows[i])), i))
        .collect();
    if max > 0 {
        all.select_nth_unstable(max - 1);
    }
    all.truncate(max);
    let mut kept: Vec<usize> = all.into_iter().map(|(_, i)| i).collect();
    kept.sort_unstable();
    Some(kept.into_iter().map(|i| rows[i]).collect())
}

#[cfg(test)]
mod tests;
