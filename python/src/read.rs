//! [`open`]: reads a layout of a path, bytes or a file; and the formats that are written, by name.

use std::path::PathBuf;

use guideway::formats::{Progress, ReadOptions, Target, read_bytes, read_file};
use guideway::spline::{Bounds, Point};
use pyo3::prelude::*;
use pyo3::types::PyBytes;

use crate::error::{bad_argument, exception};
use crate::layout::PyLayout;
use crate::signals::Watch;

/// Reads a layout of any format; the content decides which.
///
/// `source` is a path, `bytes`, or a file that was opened for reading bytes. `progress` is called
/// with the finished share, from 0 to 1, a few times per second; Ctrl-C stops. `area` is a box
/// `(min_x, min_y, max_x, max_y)` in meters: of an Arrow file that states its extents, only the
/// record batches that may have points in it are read. Edges lose nodes that are elsewhere.
#[pyfunction]
#[pyo3(signature = (source, *, area = None, progress = None))]
pub(crate) fn open(
    py: Python<'_>,
    source: Bound<'_, PyAny>,
    area: Option<[f64; 4]>,
    progress: Option<Py<PyAny>>,
) -> PyResult<PyLayout> {
    let watch = Watch::new(progress);
    let options = ReadOptions {
        area: area.map(bounds).transpose()?,
        ..options(&watch)
    };
    let read = if let Ok(bytes) = source.cast::<PyBytes>() {
        // The bytes cannot change, and live as long as `source`.
        let bytes = bytes.as_bytes();
        py.detach(|| read_bytes("bytes", bytes, &options))
    } else if source.hasattr("read")? {
        let name = source.getattr("name").ok();
        let name = name.and_then(|name| name.extract::<String>().ok());
        let bytes: Vec<u8> = source.call_method0("read")?.extract().map_err(|_| {
            let remedy = "Open it with mode \"rb\"";
            bad_argument("the file gives text, not bytes", remedy)
        })?;
        let name = name.unwrap_or_else(|| "file".to_owned());
        py.detach(|| read_bytes(&name, &bytes, &options))
    } else {
        let path: PathBuf = source.extract()?;
        py.detach(|| read_file(&path, &options))
    };
    let layout = watch.result(read.map_err(exception))?;
    Ok(PyLayout::of(layout))
}

/// The box of an area.
fn bounds([min_x, min_y, max_x, max_y]: [f64; 4]) -> PyResult<Bounds<f64>> {
    if min_x <= max_x && min_y <= max_y {
        return Ok(Bounds {
            min: Point::new(min_x, min_y),
            max: Point::new(max_x, max_y),
        });
    }
    Err(bad_argument(
        format!("the area ({min_x}, {min_y}, {max_x}, {max_y}) is no box"),
        "Write it as (min_x, min_y, max_x, max_y), in meters",
    ))
}

/// The options of a read that Python watches.
pub(crate) fn options(watch: &Watch) -> ReadOptions<'_> {
    ReadOptions {
        progress: Some(watch as &dyn Progress),
        ..ReadOptions::default()
    }
}

/// The format of an identifier, such as `lif`.
pub(crate) fn target(id: &str) -> PyResult<Target> {
    Target::from_id(id).ok_or_else(|| {
        let known: Vec<&str> = Target::ALL.iter().map(|target| target.id()).collect();
        bad_argument(
            format!("no format is called `{id}`"),
            format!("Choose one of {}", known.join(", ")),
        )
    })
}
