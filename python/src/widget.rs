//! The parts of the widget for notebooks that the extension module holds: the engine and the module
//! for browsers, the bytes of a layout, and checks of its arguments.

use std::collections::HashSet;
use std::sync::Arc;

use guideway::arrow::{Precision, WriteOptions, write_layout};
use guideway::compose::PageFont;
use guideway::layout::PathRef;
use guideway::scene::{ColorBy, Scene, SceneOptions};
use pyo3::prelude::*;
use pyo3::types::PyBytes;

use crate::error::{bad_argument, exception};
use crate::layout::PyLayout;

/// The engine, as gzip: that of `guideway share`.
const ENGINE: &[u8] = include_bytes!("../../crates/guideway/page/engine-arrow.wasm.gz");
/// The module of the widget, as gzip: `cargo xtask web` makes both.
const MODULE: &[u8] = include_bytes!("../../crates/guideway/page/widget.js.gz");

/// The engine for browsers, as gzip.
#[pyfunction]
pub(crate) fn widget_engine(py: Python<'_>) -> Bound<'_, PyBytes> {
    PyBytes::new(py, ENGINE)
}

/// The font of rare letters, as gzip.
#[pyfunction]
pub(crate) fn widget_letters(py: Python<'_>) -> Bound<'_, PyBytes> {
    PyBytes::new(py, PageFont::Letters.packed())
}

/// The font of symbols, as gzip.
#[pyfunction]
pub(crate) fn widget_symbols(py: Python<'_>) -> Bound<'_, PyBytes> {
    PyBytes::new(py, PageFont::Symbols.packed())
}

/// The JavaScript module of the widget, as gzip.
#[pyfunction]
pub(crate) fn widget_module(py: Python<'_>) -> Bound<'_, PyBytes> {
    PyBytes::new(py, MODULE)
}

/// The bytes of an Arrow file with all of a layout. Control points keep their digits, so that the
/// browser draws what `render` draws.
#[pyfunction]
pub(crate) fn widget_layout<'py>(
    py: Python<'py>,
    source: &PyLayout,
) -> PyResult<Bound<'py, PyBytes>> {
    let layout = source.shared();
    let bytes = py.detach(|| {
        let options = WriteOptions {
            precision: Some(Precision::exact(&layout)),
        };
        let mut bytes = Vec::new();
        let written = write_layout(&layout, &mut bytes, &options);
        written.map(|_| bytes).map_err(|error| {
            let remedy = "Correct the layout: `check` lists faults";
            bad_argument(error.to_string(), remedy)
        })
    });
    Ok(PyBytes::new(py, &bytes?))
}

/// Fails if a layout has no such column or level.
#[pyfunction]
pub(crate) fn widget_check(
    py: Python<'_>,
    source: &PyLayout,
    color_by: Option<String>,
    level: Option<String>,
) -> PyResult<()> {
    if color_by.is_none() && level.is_none() {
        return Ok(());
    }
    let options = SceneOptions {
        color_by: color_by.map(|column| ColorBy { column }),
        level,
        ..SceneOptions::default()
    };
    let scene = py.detach(|| Scene::new(Arc::clone(&source.shared()), &options));
    scene.map(drop).map_err(exception)
}

/// The first of some names that no path, node or station of a layout has.
#[pyfunction]
pub(crate) fn widget_missing(
    py: Python<'_>,
    source: &PyLayout,
    names: Vec<String>,
) -> Option<String> {
    let layout = source.shared();
    py.detach(|| {
        let mut missing: HashSet<&str> = names.iter().map(String::as_str).collect();
        let paths = layout.paths.iter().map(PathRef::id);
        let nodes = (0..layout.nodes.len()).map(|row| layout.nodes.id(row as u32));
        let stations = (0..layout.stations.len()).map(|row| layout.stations.id(row as u32));
        for id in paths.chain(nodes).chain(stations) {
            if missing.is_empty() {
                break;
            }
            missing.remove(id);
        }
        let first = names.iter().find(|name| missing.contains(name.as_str()));
        first.cloned()
    })
}
