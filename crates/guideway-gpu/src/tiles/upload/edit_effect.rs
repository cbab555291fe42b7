//! [`EditEffect`]: what an edit or a gesture means for cached frames.

use guideway_scene::cluster::DirtyClusters;

/// Consequences of an applied edit for cached frames.
#[derive(Default)]
pub(crate) struct EditEffect {
    /// Bytes sent to the device.
    pub(crate) moved_bytes: u64,
    /// Clusters with changed curves.
    pub(crate) dirty: DirtyClusters,
    /// The edit changed how all paths look.
    pub(crate) changes_appearance: bool,
    /// Line blocks of clusters are lost.
    pub(crate) loses_lines: bool,
    /// Bind groups refer to replaced buffers.
    pub(crate) replaces_buffers: bool,
}
