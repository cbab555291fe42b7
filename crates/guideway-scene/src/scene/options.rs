//! [`SceneOptions`]: how a scene shows a layout.

use crate::color::Rgba;
use crate::color_by::ColorBy;
use crate::ramp::NumberColors;

/// Colors and visible level of a scene.
#[derive(Clone, Debug, Default)]
pub struct SceneOptions {
    /// Color of paths without a color of their own; black by default.
    pub color: Option<Rgba>,
    /// Colors every path by a column instead.
    pub color_by: Option<ColorBy>,
    /// Colors of the numbers of that column.
    pub numbers: NumberColors,
    /// Draws only the level with this name or id.
    pub level: Option<String>,
    /// Chooses the colors of a column by the paths of all levels, so that scenes of single levels
    /// have them in common.
    pub has_common_colors: bool,
    /// Draws walls, doors and lanes of humans in gray below the ways of vehicles, unless a column
    /// decides the colors.
    pub has_gray_structure: bool,
}
