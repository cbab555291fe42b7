//! Writes an archive of the tiles of a journal: header, directories, metadata, tiles.

use std::collections::HashMap;
use std::io::{self, Write};

use guideway_scene::Scene;
use guideway_spline::{Bounds, Point};
use serde_json::{Map, Value, json};

use super::directory::{Directories, Entry, HEADER_BYTES, gzip};
use super::journal::Journal;
use crate::vector::{EXTENT, LAYER, VectorOptions};
use crate::{GridKind, TileGrid};

/// Codes of the header.
const NOT_COMPRESSED: u8 = 1;
const GZIP: u8 = 2;
const TYPE_MVT: u8 = 1;
const TYPE_PNG: u8 = 2;

/// Description of an archive.
pub struct ArchiveInfo<'a> {
    /// Name for people.
    pub name: &'a str,
    /// The scene of the tiles.
    pub scene: &'a Scene,
    /// Its grid.
    pub grid: TileGrid,
    /// First and last zoom.
    pub zooms: [u8; 2],
    /// The content of vector tiles; `None` for raster tiles.
    pub vector: Option<&'a VectorOptions>,
}

/// Sizes of an archive.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ArchiveSize {
    /// Tiles.
    pub tiles: u64,
    /// Different contents of tiles.
    pub contents: u64,
    /// Paths that vector tiles leave out, once per tile.
    pub omitted: u64,
    /// Bytes of the file.
    pub bytes: u64,
}

impl Journal {
    /// Writes the archive.
    ///
    /// # Errors
    /// When the journal cannot be read, or the archive not be written.
    pub fn write_archive(
        &self,
        info: &ArchiveInfo<'_>,
        out: &mut impl Write,
    ) -> io::Result<ArchiveSize> {
        // Contents in the order in which tiles need them first.
        let mut places = Vec::new();
        let mut offsets: HashMap<u64, u64> = HashMap::new();
        let mut data_bytes = 0;
        let mut entries: Vec<Entry> = Vec::new();
        for tile in &self.entries {
            let offset = *offsets.entry(tile.offset).or_insert_with(|| {
                places.push((tile.offset, tile.length));
                data_bytes += u64::from(tile.length);
                data_bytes - u64::from(tile.length)
            });
            match entries.last_mut() {
                Some(last) if last.offset == offset && last.id + u64::from(last.run) == tile.id => {
                    last.run += 1;
                }
                _ => entries.push(Entry { offset, ..*tile }),
            }
        }
        let Directories { root, leaves } = Directories::new(&entries);
        let metadata = gzip(self.metadata(info).to_string().as_bytes());
        let mut header = Vec::with_capacity(HEADER_BYTES);
        header.extend_from_slice(b"PMTiles\x03");
        let mut at = HEADER_BYTES as u64;
        for length in [
            root.len(),
            metadata.len(),
            leaves.len(),
            data_bytes as usize,
        ] {
            header.extend(at.to_le_bytes());
            header.extend((length as u64).to_le_bytes());
            at += length as u64;
        }
        let size = ArchiveSize {
            tiles: self.len(),
            contents: places.len() as u64,
            omitted: self.zooms.values().map(|zoom| zoom.omitted).sum(),
            bytes: at,
        };
        for count in [size.tiles, entries.len() as u64, size.contents] {
            header.extend(count.to_le_bytes());
        }
        let tile_codes = match info.vector {
            Some(_) => [GZIP, TYPE_MVT],
            None => [NOT_COMPRESSED, TYPE_PNG],
        };
        // Tiles are in the order of their numbers.
        header.extend([1, GZIP]);
        header.extend(tile_codes);
        header.extend(info.zooms);
        let Bounds { min, max } = info.bounds_deg();
        let center = Point::new((min.x + max.x) / 2.0, (min.y + max.y) / 2.0);
        let degrees = |p: Point<f64>| [p.x, p.y].map(|angle| (angle * 1e7).round() as i32);
        for angle in degrees(min).into_iter().chain(degrees(max)) {
            header.extend(angle.to_le_bytes());
        }
        header.push(info.zooms[0]);
        for angle in degrees(center) {
            header.extend(angle.to_le_bytes());
        }
        for part in [&header, &root, &metadata, &leaves] {
            out.write_all(part)?;
        }
        self.copy(places.into_iter(), out)?;
        Ok(size)
    }

    /// The metadata: the keys of TileJSON that programs read, and the grid.
    fn metadata(&self, info: &ArchiveInfo<'_>) -> Value {
        let (corner, side) = (info.grid.corner(), info.grid.side());
        let zooms = self.zooms.iter().map(|(zoom, counts)| {
            let mut about = Map::new();
            about.insert("zoom".to_owned(), json!(zoom));
            about.insert("tiles".to_owned(), json!(counts.tiles));
            if info.vector.is_some() {
                about.insert("omitted_paths".to_owned(), json!(counts.omitted));
            }
            if let Some(max_count) = counts.max_count {
                about.insert("most_paths_per_pixel".to_owned(), json!(max_count));
            }
            Value::Object(about)
        });
        let mut metadata = json!({
            "name": info.name,
            "type": "overlay",
            "generator": format!("Guideway {}", env!("CARGO_PKG_VERSION")),
            "guideway": {
                "grid": match info.grid.kind() {
                    GridKind::Plane => "plane",
                    GridKind::Earth => "EPSG:3857",
                },
                "upper_left": [corner.x, corner.y],
                "side": side,
                "zooms": zooms.collect::<Vec<_>>(),
            },
        });
        if let Some(options) = info.vector {
            let fields = options.fields(info.scene).into_iter();
            let fields = fields.map(|(name, kind)| (name.to_owned(), json!(kind)));
            let fields: Map<String, Value> = fields.collect();
            metadata["vector_layers"] = json!([{
                "id": LAYER,
                "fields": fields,
                "minzoom": info.zooms[0],
                "maxzoom": info.zooms[1],
                "extent": EXTENT,
            }]);
        }
        metadata
    }
}

impl ArchiveInfo<'_> {
    /// Longitudes and latitudes of the layout, of the map that a browser shows.
    fn bounds_deg(&self) -> Bounds<f64> {
        let square = self.grid.bounds(crate::Tile::WORLD);
        let shown = self.scene.bounds().unwrap_or(square);
        let [a, b] = [shown.min, shown.max].map(|corner| self.grid.degrees(corner));
        Bounds { min: a, max: b }
    }
}
