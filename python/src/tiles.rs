//! [`Tiler`] and [`tiles`]: tiles of a layout by their addresses, one or many at a time.

use std::sync::{Arc, Mutex, PoisonError};

use arrow_array::{UInt8Array, UInt32Array};
use guideway::cpu::Cpu;
use guideway::layout::Layout;
use guideway::scene::{Budget, Cancel, ColorBy, Scene, SceneOptions, Style};
use guideway::spline::Point;
use guideway::tiles::{
    Content, GridKind, MAX_ZOOM, Tile, TileError, TileGrid, TileRenderer, Tiler as TileDrawer,
    VectorOptions, place,
};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict, PyList};

use crate::error::{bad_argument, exception};
use crate::items::{Numbers, numbers};
use crate::layout::PyLayout;
use crate::tables::{Columns, Table};

/// Tiles between two looks at signals: a block of 8 x 8.
const CHUNK: usize = 64;
/// Most rows of a table of addresses: 90 MB.
const MAX_ADDRESSES: usize = 10_000_000;

/// Draws tiles of a layout by their addresses: a worker makes one and keeps it.
///
/// `source` is a `Layout`, or a table or batches with the Arrow C stream interface. `content` is
/// `"raster"` (PNG of 256 x 256 pixels) or `"vector"` (Mapbox vector tiles, not compressed).
/// `color_by` names the column that colors raster tiles, `level` the only level to show, `columns`
/// and `max_paths` limit the attributes and lines of vector tiles. A layout with a place on earth
/// gets the tiles of the Web Mercator map, any other one, or all with `plane=True`, those of a
/// square around it. A worker that has only a part of the layout gets that square as `grid`.
#[pyclass(frozen, module = "guideway")]
pub(crate) struct Tiler {
    tiler: Mutex<TileDrawer>,
    grid: TileGrid,
}

/// The content of tiles, checked.
enum Kind {
    Raster { color_by: Option<ColorBy> },
    Vector(VectorOptions),
}

impl Kind {
    fn new(
        content: &str,
        color_by: Option<String>,
        columns: Option<Vec<String>>,
        max_paths: Option<usize>,
    ) -> PyResult<Self> {
        match content {
            "raster" if columns.is_some() || max_paths.is_some() => Err(bad_argument(
                "columns and max_paths apply to vector tiles only",
                "Add content=\"vector\", or omit them",
            )),
            "vector" if color_by.is_some() => Err(bad_argument(
                "color_by applies to raster tiles only: the map program colors vector tiles",
                "Omit color_by, or name the column in `columns`",
            )),
            "raster" => Ok(Self::Raster {
                color_by: color_by.map(|column| ColorBy { column }),
            }),
            "vector" => {
                let default = VectorOptions::default();
                Ok(Self::Vector(VectorOptions {
                    columns,
                    max_paths: max_paths.unwrap_or(default.max_paths),
                }))
            }
            other => Err(bad_argument(
                format!("no content of tiles is called `{other}`"),
                "Choose \"raster\" or \"vector\"",
            )),
        }
    }

    /// The tiler of a layout; `grid` is the upper left corner and the side of the square of zoom 0.
    fn tiler(
        self,
        layout: Arc<Layout>,
        level: Option<String>,
        plane: bool,
        grid: Option<(f64, f64, f64)>,
    ) -> PyResult<TileDrawer> {
        let (layout, mut placed) = place(layout, plane);
        if let Some((left, top, side)) = grid {
            if placed.kind() == GridKind::Earth {
                let remedy = "Omit grid, or add plane=True";
                return Err(bad_argument(
                    "the layout lies on earth, whose grid is fixed",
                    remedy,
                ));
            }
            placed = TileGrid::plane(Point::new(left, top), side).ok_or_else(|| {
                let message = format!("({left}, {top}, {side}) is no grid of tiles");
                bad_argument(message, "Pass the `grid` of a Tiler of the whole layout")
            })?;
        }
        let color_by = match &self {
            Self::Raster { color_by } => color_by.clone(),
            Self::Vector(_) => None,
        };
        let options = SceneOptions {
            color_by,
            level,
            has_gray_structure: true,
            ..SceneOptions::default()
        };
        let scene = Arc::new(Scene::new(layout, &options).map_err(exception)?);
        let content = match self {
            Self::Vector(options) => Content::Vector(options),
            Self::Raster { .. } => {
                let (style, budget) = (Style::default(), Budget::default());
                let shared = Arc::clone(&scene);
                let renderer = TileRenderer::new(&Cpu, shared, placed, style, &budget);
                Content::Raster(Box::new(renderer.map_err(exception)?))
            }
        };
        TileDrawer::new(scene, placed, content).map_err(exception)
    }
}

#[pymethods]
impl Tiler {
    #[new]
    #[pyo3(signature = (
        source, *, content = "raster", color_by = None, level = None, columns = None,
        max_paths = None, plane = false, grid = None
    ))]
    #[expect(clippy::too_many_arguments, reason = "keyword arguments of Python")]
    fn new(
        py: Python<'_>,
        source: &Bound<'_, PyAny>,
        content: &str,
        color_by: Option<String>,
        level: Option<String>,
        columns: Option<Vec<String>>,
        max_paths: Option<usize>,
        plane: bool,
        grid: Option<(f64, f64, f64)>,
    ) -> PyResult<Self> {
        let kind = Kind::new(content, color_by, columns, max_paths)?;
        let layout = match source.cast::<PyLayout>() {
            Ok(layout) => layout.get().shared(),
            Err(_) => PyLayout::from_arrow(py, source, None)?.shared(),
        };
        let tiler = py.detach(|| kind.tiler(layout, level, plane, grid))?;
        Ok(Self {
            grid: *tiler.grid(),
            tiler: Mutex::new(tiler),
        })
    }

    /// Upper left corner (x, y) and side in meters of the square that the tile of zoom 0 shows;
    /// `None` for the map of the earth.
    #[getter]
    fn grid(&self) -> Option<(f64, f64, f64)> {
        let corner = self.grid.corner();
        let is_plane = self.grid.kind() == GridKind::Plane;
        is_plane.then_some((corner.x, corner.y, self.grid.side()))
    }

    /// The tiles of some zooms that paths may touch, as a table with the columns `z`, `x` and `y`,
    /// neighbors side by side.
    fn addresses(&self, py: Python<'_>, first_zoom: u8, last_zoom: u8) -> PyResult<Table> {
        if first_zoom > last_zoom || last_zoom > MAX_ZOOM {
            return Err(bad_argument(
                format!("no zooms from {first_zoom} to {last_zoom}"),
                format!("Give the first and the last one, from 0 to {MAX_ZOOM}"),
            ));
        }
        let touched = py.detach(|| {
            let tiler = self.tiler.lock().unwrap_or_else(PoisonError::into_inner);
            let mut all = Vec::new();
            for zoom in first_zoom..=last_zoom {
                all.extend(tiler.touched(zoom, MAX_ADDRESSES - all.len())?);
            }
            Ok::<_, TileError>(all)
        });
        let touched = touched.map_err(exception)?;
        let mut columns = Columns::default();
        let zooms = touched.iter().map(|tile| tile.z);
        columns.push("z", UInt8Array::from_iter_values(zooms));
        let across = touched.iter().map(|tile| tile.x);
        columns.push("x", UInt32Array::from_iter_values(across));
        let down = touched.iter().map(|tile| tile.y);
        columns.push("y", UInt32Array::from_iter_values(down));
        columns.table()
    }

    /// The bytes of a tile, `None` if it shows nothing; of lists of numbers, a list of such.
    ///
    /// Rows count from the top. Neighbors in one call save work.
    fn draw<'py>(
        &self,
        py: Python<'py>,
        z: &Bound<'py, PyAny>,
        x: &Bound<'py, PyAny>,
        y: &Bound<'py, PyAny>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let [z, x, y] = [numbers("z", z)?, numbers("x", x)?, numbers("y", y)?];
        let is_single = [&z, &x, &y]
            .iter()
            .all(|numbers| matches!(numbers, Numbers::One(_)));
        let addresses = addresses(&z, &x, &y)?;
        // Blocks are drawn at once, so that those of a chunk come together.
        let mut order: Vec<usize> = (0..addresses.len()).collect();
        order.sort_by_key(|&i| addresses[i].id());
        let mut drawn: Vec<Option<Py<PyBytes>>> = addresses.iter().map(|_| None).collect();
        for chunk in order.chunks(CHUNK) {
            let wanted: Vec<Tile> = chunk.iter().map(|&i| addresses[i]).collect();
            let tiles = py.detach(|| {
                let mut tiler = self.tiler.lock().unwrap_or_else(PoisonError::into_inner);
                tiler.draw(&wanted, &Cancel::default())
            });
            for (&i, tile) in chunk.iter().zip(tiles.map_err(exception)?) {
                drawn[i] = tile.map(|bytes| PyBytes::new(py, &bytes).unbind());
            }
            py.check_signals()?;
        }
        match (is_single, drawn.pop()) {
            (true, Some(one)) => Ok(one.into_pyobject(py)?),
            (_, last) => {
                drawn.extend(last);
                Ok(PyList::new(py, drawn)?.into_any())
            }
        }
    }
}

/// The tiles of numbers, of which a single one counts for all of a list.
fn addresses(z: &Numbers, x: &Numbers, y: &Numbers) -> PyResult<Vec<Tile>> {
    let lengths = [z, x, y].map(Numbers::len);
    let length = lengths.iter().flatten().copied().max();
    if lengths.iter().flatten().any(|of| Some(*of) != length) {
        let lengths = lengths.map(|of| of.map_or("1".to_owned(), |of| of.to_string()));
        return Err(bad_argument(
            format!("z, x and y have lengths of {}", lengths.join(", ")),
            "Give lists of the same length, or single numbers",
        ));
    }
    let tile = |i| {
        let (z, x, y) = (z.get(i), x.get(i), y.get(i));
        let tile = u8::try_from(z).ok().and_then(|z| Tile::new(z, x, y));
        tile.ok_or_else(|| {
            let remedy = match z <= u32::from(MAX_ZOOM) {
                true => format!(
                    "Zoom {z} has columns and rows from 0 to {}",
                    (1_u32 << z) - 1
                ),
                false => format!("Zooms are 0 to {MAX_ZOOM}"),
            };
            bad_argument(format!("no tile is at zoom {z}, ({x}, {y})"), remedy)
        })
    };
    (0..length.unwrap_or(1)).map(tile).collect()
}

/// The bytes of a tile of a layout, or of many tiles: `Tiler(source, **options).draw(z, x, y)`.
#[pyfunction]
#[pyo3(signature = (source, z, x, y, **options))]
pub(crate) fn tiles<'py>(
    py: Python<'py>,
    source: &Bound<'py, PyAny>,
    z: &Bound<'py, PyAny>,
    x: &Bound<'py, PyAny>,
    y: &Bound<'py, PyAny>,
    options: Option<&Bound<'py, PyDict>>,
) -> PyResult<Bound<'py, PyAny>> {
    let tiler = py.get_type::<Tiler>().call((source,), options)?;
    tiler.cast::<Tiler>()?.get().draw(py, z, x, y)
}
