//! Properties of a scene that the host needs for every frame.

use guideway_scene::Scene;
use rayon::prelude::*;

use crate::tiles::paint_mode::PaintMode;

/// Paths of a task.
const TASK_PATHS: usize = 1 << 14;

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
    /// Paint mode of its tiles.
    pub(crate) paint: PaintMode,
}

impl SceneFacts {
    /// Facts of a scene without buffers.
    pub(crate) fn of(scene: &Scene) -> Self {
        let drawn = scene.draw_order().par_iter().with_min_len(TASK_PATHS);
        let widths = drawn.filter_map(|&path| scene.width_m(path));
        Self {
            clusters: 0,
            styles: 0,
            reach_m: 0.0,
            greatest_step_m: 0.0,
            map: [[1.0, 0.0], [0.0, 1.0]],
            widest_m: widths.reduce_with(f32::max),
            is_plain: is_plain(scene),
            paint: PaintMode::of(scene),
        }
    }

    /// The facts that affect every pixel of a picture.
    pub(crate) fn appearance(&self) -> (PaintMode, bool, Option<f32>) {
        (self.paint, self.is_plain, self.widest_m)
    }

    /// Updates the facts that colors, widths and states of paths determine.
    pub(crate) fn refresh_appearance(&mut self, scene: &Scene) {
        let facts = Self::of(scene);
        (self.paint, self.is_plain, self.widest_m) = facts.appearance();
    }
}

/// Returns `true` if all paths have one color, and none a width of its own.
pub(crate) fn is_plain(scene: &Scene) -> bool {
    let paths = scene.draw_order().par_iter().with_min_len(TASK_PATHS);
    scene.common_color().is_some() && paths.all(|&path| scene.width_m(path).is_none())
}
