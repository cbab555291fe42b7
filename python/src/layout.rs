//! [`PyLayout`]: a layout, which never changes: edits return another one.

use std::path::PathBuf;
use std::sync::{Arc, OnceLock};

use guideway::arrow::{collected_batches, read_batches};
use guideway::formats::ReadOptions;
use guideway::layout::{CompareOptions, Layout, changes};
use guideway::network::{RouteOptions, Router, build};
use guideway::scene::{Scene, SceneOptions};
use guideway::script::Script;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyCapsule, PyDict};

use crate::answers::{Change, Finding, Loss, Route, severity};
use crate::build_args::BuildArgs;
use crate::error::{bad_argument, exception};
use crate::features::features;
use crate::from_tables::joined;
use crate::picture::{PyPicture, RenderArgs};
use crate::read::{options, target};
use crate::signals::Watch;
use crate::stream::{from_object, to_capsule};
use crate::tables::{self, Table};

/// A network of edges, nodes and stations. It never changes: `edit` and `network` return another
/// one.
#[pyclass(frozen, name = "Layout", module = "guideway")]
pub(crate) struct PyLayout {
    layout: Arc<Layout>,
    /// The scene without options, for bounds.
    scene: OnceLock<Arc<Scene>>,
}

impl PyLayout {
    pub(crate) fn of(layout: Layout) -> Self {
        Self {
            layout: Arc::new(layout),
            scene: OnceLock::new(),
        }
    }

    /// The layout, shared.
    pub(crate) fn shared(&self) -> Arc<Layout> {
        Arc::clone(&self.layout)
    }

    fn scene(&self) -> PyResult<Arc<Scene>> {
        if let Some(scene) = self.scene.get() {
            return Ok(Arc::clone(scene));
        }
        let scene = Scene::new(Arc::clone(&self.layout), &SceneOptions::default());
        let scene = Arc::new(scene.map_err(exception)?);
        Ok(Arc::clone(self.scene.get_or_init(|| scene)))
    }
}

#[pymethods]
impl PyLayout {
    /// A layout from an object with `__arrow_c_stream__`, such as a table of pyarrow, polars,
    /// DuckDB or pandas.
    ///
    /// The columns are those of `docs/arrow-format.md`; only `control_points` is required.
    #[staticmethod]
    #[pyo3(signature = (table, *, progress = None))]
    pub(crate) fn from_arrow(
        py: Python<'_>,
        table: &Bound<'_, PyAny>,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<Self> {
        let reader = from_object(table)?;
        let watch = Watch::new(progress);
        let read = py.detach(|| read_batches(reader, &options(&watch)));
        Ok(Self::of(watch.result(read.map_err(exception))?))
    }

    /// A layout of straight edges from a table of edges (`id`, `start_node`, `end_node`) and one of
    /// nodes (`id`, and `x_m`, `y_m` or `x`, `y`), as CSV files have them. `direction`, `level` and
    /// other columns are kept.
    #[staticmethod]
    fn from_tables(
        py: Python<'_>,
        edges: &Bound<'_, PyAny>,
        nodes: &Bound<'_, PyAny>,
    ) -> PyResult<Self> {
        let (edges, nodes) = (from_object(edges)?, from_object(nodes)?);
        let watch = Watch::new(None);
        let read = py.detach(|| {
            let joined = joined(edges, nodes)?;
            read_batches(joined, &options(&watch)).map_err(exception)
        });
        Ok(Self::of(watch.result(read)?))
    }

    /// The whole layout as one Arrow table, from which `from_arrow` makes it again.
    #[pyo3(signature = (requested_schema = None))]
    fn __arrow_c_stream__<'py>(
        &self,
        py: Python<'py>,
        requested_schema: Option<Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyCapsule>> {
        // The interface allows a producer to ignore the request.
        let _ = requested_schema;
        let batches = py
            .detach(|| collected_batches(&self.layout))
            .map_err(|error| {
                bad_argument(
                    error.to_string(),
                    "Correct the layout: `check` lists faults",
                )
            })?;
        to_capsule(py, batches)
    }

    /// Number of edges.
    fn __len__(&self) -> usize {
        self.layout.paths.len()
    }

    /// Format of the file, such as `LIF`.
    #[getter]
    fn format(&self) -> &str {
        &self.layout.provenance.format
    }

    /// Identifiers of the levels.
    #[getter]
    fn levels(&self) -> Vec<&str> {
        let levels = self.layout.levels.iter();
        levels.map(|level| level.id.as_str()).collect()
    }

    /// Names of the vehicle types, in alphabetical order.
    #[getter]
    fn vehicle_types(&self) -> Vec<&str> {
        self.layout.vehicle_type_names().into_iter().collect()
    }

    /// `True` if the layout has a place on earth.
    #[getter]
    fn on_earth(&self) -> bool {
        self.layout.geo_origin.is_some()
    }

    /// Length of all edges in meters.
    #[getter]
    fn length_m(&self, py: Python<'_>) -> f64 {
        let paths = &self.layout.paths;
        py.detach(|| paths.iter().map(|path| path.length_m()).sum())
    }

    /// The box around all edges in meters: (min x, min y, max x, max y); `None` without edges.
    #[getter]
    fn bounds(&self, py: Python<'_>) -> PyResult<Option<(f64, f64, f64, f64)>> {
        let bounds = py.detach(|| self.scene().map(|scene| scene.bounds()))?;
        Ok(bounds.map(|of| (of.min.x, of.min.y, of.max.x, of.max.y)))
    }

    /// The edges as a table: identifier, nodes, direction, level, vehicle types, length, and the
    /// properties in SI units.
    #[getter]
    fn edges(&self, py: Python<'_>) -> PyResult<Table> {
        py.detach(|| tables::edge_columns(&self.layout, None).table())
    }

    /// The edges that a vehicle type may use, with the values that hold for it.
    fn edges_for(&self, py: Python<'_>, vehicle_type: &str) -> PyResult<Table> {
        py.detach(|| tables::edge_columns_for(&self.layout, vehicle_type)?.table())
    }

    /// The nodes as a table: identifier, position, level, and the properties in SI units.
    #[getter]
    fn nodes(&self, py: Python<'_>) -> PyResult<Table> {
        py.detach(|| tables::node_columns(&self.layout).table())
    }

    /// The stations as a table: identifier, position, level, nodes, and the properties in SI units.
    #[getter]
    fn stations(&self, py: Python<'_>) -> PyResult<Table> {
        py.detach(|| tables::station_columns(&self.layout).table())
    }

    /// `"edges"`, `"nodes"` or `"stations"` as a table with a column `geometry` in the types of
    /// GeoArrow: lines within `tolerance_m` of the curves, or points. In meters of the layout, or
    /// with `on_earth=True` in degrees of longitude and latitude.
    #[pyo3(signature = (kind, *, tolerance_m = 0.01, on_earth = false))]
    fn features(
        &self,
        py: Python<'_>,
        kind: &str,
        tolerance_m: f64,
        on_earth: bool,
    ) -> PyResult<Table> {
        py.detach(|| features(&self.layout, kind, tolerance_m, on_earth)?.table())
    }

    /// Points along every edge as a table, at most `spacing_m` apart along the curve: row and
    /// identifier of the edge, distance from its start, position, heading in radians.
    ///
    /// Points are within 0.1 mm of their curve.
    fn sample(&self, py: Python<'_>, spacing_m: f64) -> PyResult<Table> {
        py.detach(|| tables::samples(&self.layout, spacing_m))
    }

    /// The findings of the reader, the geometry and the network, at least as severe as `at_least`:
    /// `"info"`, `"warning"` or `"error"`.
    #[pyo3(signature = (*, at_least = "info"))]
    fn check(&self, py: Python<'_>, at_least: &str) -> PyResult<Vec<Finding>> {
        let wanted = severity(at_least)?;
        let found = py.detach(|| guideway::check(&self.layout));
        let found = found.iter().filter(|finding| finding.severity >= wanted);
        Ok(found.map(Finding::of).collect())
    }

    /// The fastest way from one station or node to another one.
    ///
    /// `vehicle_type` is needed where the layout has several. `speed_m_s` holds on edges without a
    /// limit, `lateral_acceleration_m_s2` slows vehicles in bends.
    #[pyo3(signature = (
        start, goal, *, vehicle_type = None, speed_m_s = 1.0, lateral_acceleration_m_s2 = None
    ))]
    fn route(
        &self,
        py: Python<'_>,
        start: &str,
        goal: &str,
        vehicle_type: Option<&str>,
        speed_m_s: f64,
        lateral_acceleration_m_s2: Option<f64>,
    ) -> PyResult<Route> {
        let given = [Some(speed_m_s), lateral_acceleration_m_s2];
        for value in given.into_iter().flatten() {
            if !(value > 0.0 && value.is_finite()) {
                let message = format!("{value} is no speed or acceleration");
                return Err(bad_argument(message, "Give a number above 0"));
            }
        }
        let options = RouteOptions {
            speed_m_s,
            lateral_acceleration_m_s2,
            ..RouteOptions::default()
        };
        let only = self.layout.paths.vehicle_types().only_name();
        let route = py.detach(|| {
            let router = Router::new(&self.layout, vehicle_type.or(only), &options)?;
            router.route(&router.place(start)?, &router.place(goal)?)
        });
        Route::of(py, &route.map_err(exception)?, &self.layout)
    }

    /// The differences from this layout to another one, by element.
    fn diff(&self, py: Python<'_>, other: &Self) -> Vec<Change> {
        py.detach(|| {
            let found = changes(&self.layout, &other.layout, &CompareOptions::default());
            let elements = found.elements.iter().map(|of| Change::of(&found, &of));
            elements
                .chain(found.groups.iter().map(Change::of_group))
                .collect()
        })
    }

    /// Another layout, edited by a list of steps: all of them, or none.
    ///
    /// A step is a dict such as `{"do": "rename", "node": "N7", "to": "gate"}`; see
    /// `docs/edit-script.md`.
    fn edit(&self, py: Python<'_>, steps: &Bound<'_, PyAny>) -> PyResult<Self> {
        let script = PyDict::new(py);
        script.set_item("steps", steps)?;
        let json: String = py
            .import("json")?
            .call_method1("dumps", (script,))?
            .extract()?;
        let script = Script::from_json(json.as_bytes(), ".").map_err(exception)?;
        let layout = Arc::clone(&self.layout);
        let applied = py.detach(|| script.apply(layout, &ReadOptions::default()));
        Ok(Self::of(applied.map_err(exception)?.layout))
    }

    /// A network of the lines of a drawing, and a dict that says what was joined, cut and named.
    ///
    /// `weld_m` is the distance within which ends become one node; `split` cuts lines where others
    /// end on them or cross them; `stations` and `names` are sources such as `"text:STATION"`.
    /// `options` is the text of a TOML file as `guideway network --save-map` writes it.
    #[pyo3(signature = (
        *, weld_m = None, split = false, smooth_m = None, stations = Vec::new(),
        names = Vec::new(), one_way = false, options = None
    ))]
    #[expect(clippy::too_many_arguments, reason = "keyword arguments of Python")]
    fn network<'py>(
        &self,
        py: Python<'py>,
        weld_m: Option<f64>,
        split: bool,
        smooth_m: Option<f64>,
        stations: Vec<String>,
        names: Vec<String>,
        one_way: bool,
        options: Option<&str>,
    ) -> PyResult<(Self, Bound<'py, PyDict>)> {
        let chosen = BuildArgs {
            weld_m,
            split,
            smooth_m,
            stations,
            names,
            one_way,
            options,
        };
        let chosen = chosen.build_options()?;
        let made = py
            .detach(|| build(&self.layout, &chosen))
            .map_err(exception)?;
        let report = PyDict::new(py);
        for (name, count) in made.report.counts() {
            report.set_item(name, count)?;
        }
        report.set_item("largest_move_m", made.report.largest_move_m)?;
        report.set_item("lines", made.report.lines(&chosen))?;
        Ok((Self::of(made.layout), report))
    }

    /// Saves the layout in the format that the extension names, whole or not at all. Returns what
    /// the format cannot hold.
    #[pyo3(signature = (path, *, format = None))]
    fn save(&self, py: Python<'_>, path: PathBuf, format: Option<&str>) -> PyResult<Vec<Loss>> {
        let target = format.map(target).transpose()?;
        let losses = py.detach(|| match target {
            Some(target) => target.write_file(&self.layout, &path).map_err(exception),
            None => guideway::save(&self.layout, &path).map_err(exception),
        });
        Ok(Loss::list(&losses?))
    }

    /// The layout as the bytes of a file of a format, such as `"lif"`, `"geojson"` or `"opentcs"`.
    fn to_bytes<'py>(&self, py: Python<'py>, format: &str) -> PyResult<Bound<'py, PyBytes>> {
        let target = target(format)?;
        let bytes = py.detach(|| {
            let mut bytes = Vec::new();
            let written = guideway::write(&self.layout, target, &mut bytes);
            written.map(|_| bytes).map_err(|error| {
                let remedy = "Correct the layout: `check` lists faults";
                bad_argument(format!("{}: {error}", target.name()), remedy)
            })
        });
        Ok(PyBytes::new(py, &bytes?))
    }

    /// A picture of the layout.
    ///
    /// `size` is width and height in pixels; `view` the box to show in meters, (min x, min y, max
    /// x, max y); `color_by` a column of the edges; `level` the level to show; `site` adds arrows,
    /// nodes, stations, names and a scale bar.
    #[pyo3(signature = (
        *, size = (1280, 720), view = None, color_by = None, level = None, site = false,
        title = None
    ))]
    #[expect(clippy::too_many_arguments, reason = "keyword arguments of Python")]
    fn render(
        &self,
        py: Python<'_>,
        size: (u32, u32),
        view: Option<(f64, f64, f64, f64)>,
        color_by: Option<String>,
        level: Option<String>,
        site: bool,
        title: Option<String>,
    ) -> PyResult<PyPicture> {
        let of = RenderArgs {
            size,
            view,
            color_by,
            level,
            site,
            title,
        };
        let picture = py.detach(|| of.picture(&self.layout, || self.scene()))?;
        PyPicture::render(py, picture)
    }

    fn __repr__(&self) -> String {
        let Layout {
            paths,
            nodes,
            stations,
            ..
        } = &*self.layout;
        format!(
            "<Layout of {} edges, {} nodes, {} stations>",
            paths.len(),
            nodes.len(),
            stations.len()
        )
    }

    /// Jupyter shows the site.
    fn _repr_png_<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        let picture = self.render(py, (960, 540), None, None, None, true, None)?;
        picture.png(py)
    }
}
