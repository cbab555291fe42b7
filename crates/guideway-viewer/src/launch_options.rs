//! Options of a new window.

use std::path::PathBuf;

/// Content and render method of a new window.
#[derive(Clone, Debug, Default)]
pub struct LaunchOptions {
    /// Layout files to open.
    pub files: Vec<PathBuf>,
    /// Floor plan, as for [`read_floor_plan`](crate::AppServices::read_floor_plan); empty for none.
    pub floor_plan: String,
    /// Name of the render method; `None` selects the best one that runs here.
    pub method: Option<String>,
}
