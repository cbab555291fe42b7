//! [`Context`]: the parts of a file under construction that all elements share.

use guideway_layout::Layout;

use super::drawn_paths::DrawnPaths;
use super::plant::Plant;
use super::version::Version;
use super::write_elements::PropertyColumns;

/// Parts of a file that all elements share.
pub(super) struct Context<'a> {
    pub(super) layout: &'a Layout,
    pub(super) version: Version,
    pub(super) plant: &'a Plant<'a>,
    pub(super) drawn: &'a DrawnPaths,
    pub(super) properties: PropertyColumns,
}
