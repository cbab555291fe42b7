//! The arguments and the result of the draw functions.

use guideway_scene::Stage;

use super::target::TargetState;
use crate::tiles::device_context::DeviceContext;
use crate::tiles::kernels::Kernels;
use crate::tiles::upload::uploaded_scene::UploadedScene;
use crate::tiles::work::WorkTotals;

/// A scene, a target, and the device that draws the one into the other.
pub(crate) struct Renderer<'a> {
    pub(crate) device: &'a mut DeviceContext,
    pub(crate) kernels: &'a Kernels,
    pub(crate) scene: &'a mut UploadedScene,
    pub(crate) target: &'a mut TargetState,
    /// True if each stage is timed.
    pub(crate) times_stages: bool,
}

/// Result of drawing a picture.
#[derive(Default)]
pub(crate) struct DrawResult {
    pub(crate) stages: Vec<Stage>,
    pub(crate) lines: u64,
    /// Paths that the device counted in the last window, if it did.
    pub(crate) drawn_paths: Option<u32>,
    /// Number of windows drawn.
    pub(crate) windows: u32,
    /// True if other parts of the picture were reused.
    pub(crate) is_part: bool,
    /// Work, if the kernels count.
    pub(crate) work: WorkTotals,
}
