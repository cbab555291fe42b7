//! The arguments and the result of the draw functions.

use std::ops::Range;

use guideway_scene::{RenderError, Stage};

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

/// Takes finished rows from the start of the pixel buffer; the range is theirs in the picture.
pub(crate) trait Deliver:
    FnMut(&Renderer<'_>, Range<usize>, &mut Vec<Stage>) -> Result<(), RenderError>
{
}

impl<F> Deliver for F where
    F: FnMut(&Renderer<'_>, Range<usize>, &mut Vec<Stage>) -> Result<(), RenderError>
{
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
