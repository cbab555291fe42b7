//! Everything that an exported picture shows, as typed values.

use std::sync::Arc;

use guideway_compose::{FloorPlan, OtherScene};
use guideway_envelope::EnvelopeSource;
use guideway_scene::{DrawList, Scene, Style, View};

/// The content of a picture, from the bottom: floor plan, grid, swept areas, other scenes, the
/// scene, marks.
#[derive(Clone)]
pub struct PictureRequest {
    /// The topmost scene.
    pub scene: Arc<Scene>,
    /// Opacity of its paths, from 0 to 1.
    pub opacity: f64,
    /// The scenes below it, from the bottom.
    pub others: Vec<OtherScene>,
    /// Center, scale and size of the picture.
    pub view: View,
    /// Pixels of the picture per point of the screen: the scale of texts.
    pub px_per_point: f64,
    /// Line widths of the topmost scene, shading and background.
    pub style: Style,
    /// Floor plan at the bottom, as returned by [`AppServices::read_floor_plan`].
    ///
    /// [`AppServices::read_floor_plan`]: super::AppServices::read_floor_plan
    pub floor_plan: Option<FloorPlan>,
    /// Opacity of the floor plan, from 0 to 1.
    pub floor_plan_opacity: f64,
    /// Swept areas of paths of [`Self::scene`].
    pub swept: Option<SweptAreas>,
    /// The grid, below all paths.
    pub grid: DrawList,
    /// Arrows, symbols, names and scale bar, above all paths; the legends of several scenes too.
    pub marks: DrawList,
    /// True if the colors of the topmost scene get a legend.
    pub has_legend: bool,
}

/// The areas that one vehicle sweeps along some paths.
#[derive(Clone, Debug, PartialEq)]
pub struct SweptAreas {
    /// The vehicle, or the areas that the file itself gives.
    pub vehicle: EnvelopeSource,
    /// Rows of the paths.
    pub rows: Vec<u32>,
}
