//! The project that is open: its file, and the parts that wait for files to arrive.

use std::path::PathBuf;

use guideway_spline::Point;

/// The open project, if any.
#[derive(Default)]
pub(super) struct OpenProject {
    /// The file that the project was read from or written to.
    pub(super) path: Option<PathBuf>,
    /// Center and scale to show instead of the bounds of the first file.
    pub(super) view: Option<(Point<f64>, f64)>,
    /// Level to show once the active file is loaded.
    pub(super) level: Option<String>,
}
