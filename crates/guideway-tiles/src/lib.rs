//! Tiles of a scene for maps in browsers, and the one file that holds them.
//!
//! Input: a [`Scene`](guideway_scene::Scene), a [`TileGrid`] and a [`Content`]. Output: tiles as
//! PNG or Mapbox vector tiles, and an archive of them in the format PMTiles 3.
//!
//! ```text
//!   layout --place--> scene, grid --descent--> blocks of 8 x 8 tiles --raster--> PNG  --> archive
//!                                              that paths meet       --vector--> MVT
//! ```
//!
//! | module | does |
//! |---|---|
//! | `tile` | [`Tile`]: zoom, column, row; its number along the Hilbert curve |
//! | `grid`, `place` | [`TileGrid`]: from meters to tiles, on a plane or on earth |
//! | `descent` | finds the blocks of a zoom that paths meet |
//! | `raster`, `png_tile` | draws a block and cuts it into PNG tiles |
//! | `vector` | flattens the paths of a tile within an error, and encodes them |
//! | `gzip` | compresses vector tiles |
//! | `tiler` | [`Tiler`]: draws tiles by their addresses |
//! | `pyramid` | makes all tiles of some zooms, with progress and cancellation |
//! | `archive` | the journal of finished tiles, and the PMTiles file |
//!
//! **Exact.** Scales are powers of two, and tiles begin at whole pixels, so that a tile has the
//! same bits as the window of one large picture, whatever is drawn with it: on one machine or on
//! many.

mod archive;
mod descent;
mod error;
mod grid;
mod gzip;
mod place;
mod png_tile;
mod pyramid;
mod raster;
mod tile;
mod tiler;
mod vector;

pub use archive::{ArchiveInfo, ArchiveSize, Journal};
pub use error::TileError;
pub use grid::{GridKind, TileGrid};
pub use place::place;
pub use pyramid::{Content, Made, Pyramid};
pub use raster::{Png, TileRenderer};
pub use tile::{MAX_ZOOM, TILE_PX, Tile};
pub use tiler::Tiler;
pub use vector::{EXTENT, VectorOptions, VectorTile, draw_vector_tile};
