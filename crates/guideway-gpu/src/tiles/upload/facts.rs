//! Properties of a scene that the host needs for every frame.

use guideway_scene::{Rgba, Scene};

use super::pack::device_color;
use crate::tiles::paint_mode::PaintMode;

/// Properties of a scene and of its buffers.
#[derive(Clone, Copy)]
pub(crate) struct SceneFacts {
    /// Number of clusters.
    pub(crate) clusters: u32,
    /// Number of styles on the device.
    pub(crate) styles: u32,
    /// Greatest distance of a control point from its cluster's origin, along an axis.
    pub(crate) reach_m: f64,
    /// Greatest quantization step of a cluster.
    pub(crate) greatest_step_m: f32,
    /// Images of the vectors (1, 0) and (0, 1) in the map of a gesture.
    pub(crate) map: [[f32; 2]; 2],
    /// Greatest width of a path; `None` if no path has its own.
    pub(crate) widest_m: Option<f32>,
    /// True if all paths have one color, and none a width of its own.
    pub(crate) is_plain: bool,
    /// The color of all paths, as in the device's pixels, if it is one.
    pub(crate) color: u32,
    /// Paint mode of its tiles.
    pub(crate) paint: PaintMode,
}

impl SceneFacts {
    /// Facts of a scene without buffers.
    pub(crate) fn of(scene: &Scene) -> Self {
        Self {
            clusters: 0,
            styles: 0,
            reach_m: 0.0,
            greatest_step_m: 0.0,
            map: [[1.0, 0.0], [0.0, 1.0]],
            widest_m: scene.widest_m(),
            is_plain: scene.is_plain(),
            color: device_color(scene.common_color().unwrap_or(Rgba::BLACK)),
            paint: PaintMode::of(scene),
        }
    }

    /// The facts that affect every pixel of a picture.
    pub(crate) fn appearance(&self) -> (PaintMode, bool, Option<f32>, u32) {
        (self.paint, self.is_plain, self.widest_m, self.color)
    }

    /// Updates the facts that colors, widths and states of paths determine.
    pub(crate) fn refresh_appearance(&mut self, scene: &Scene) {
        let facts = Self::of(scene);
        (self.paint, self.is_plain, self.widest_m, self.color) = facts.appearance();
    }
}
