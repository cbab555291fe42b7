//! Everything that an exported picture shows, as typed values.

use std::any::Any;
use std::sync::Arc;

use guideway_envelope::EnvelopeSource;
use guideway_layout::UserError;
use guideway_scene::{DrawList, Frame, Scene, Style, View};
use guideway_spline::Bounds;

/// The content of a picture, from the bottom: floor plan, grid, swept areas, other scenes, the
/// scene, marks.
#[derive(Clone)]
pub struct PictureRequest {
    /// The topmost scene.
    pub scene: Arc<Scene>,
    /// The scenes below it, from the bottom.
    pub others: Vec<Arc<Scene>>,
    /// Center, scale and size of the picture.
    pub view: View,
    /// Line widths, shading and background.
    pub style: Style,
    /// Floor plan at the bottom, as returned by [`AppServices::read_floor_plan`].
    ///
    /// [`AppServices::read_floor_plan`]: super::AppServices::read_floor_plan
    pub floor_plan: Option<Arc<dyn FloorPlan>>,
    /// Swept areas of paths of [`Self::scene`].
    pub swept: Option<SweptAreas>,
    /// The grid, below all paths.
    pub grid: DrawList,
    /// Arrows, symbols, names and scale bar, above all paths.
    pub marks: DrawList,
}

/// The areas that one vehicle sweeps along some paths.
#[derive(Clone, Debug, PartialEq)]
pub struct SweptAreas {
    /// The vehicle, or the areas that the file itself gives.
    pub vehicle: EnvelopeSource,
    /// Rows of the paths.
    pub rows: Vec<u32>,
}

/// A floor plan, parsed and ready to render.
///
/// The implementation of [`AppServices`](super::AppServices) downcasts it (through [`Any`]) to the
/// type that it returned, so that an export does not read the file again.
pub trait FloorPlan: Any + Send + Sync {
    /// Bounding box in meters; `None` for an empty plan.
    fn bounds(&self) -> Option<Bounds<f64>>;

    /// Renders the plan on a transparent background.
    ///
    /// # Errors
    /// When the frame does not fit in memory.
    fn draw(&self, view: &View) -> Result<Frame, UserError>;
}
