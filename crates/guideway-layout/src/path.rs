//! Records of one path: the parts of a new path, its direction and its own style.

use guideway_spline::Runs;

/// Directions in which vehicles drive along a path.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Direction {
    /// From start to end only.
    #[default]
    Forward,
    /// In both directions.
    Both,
}

/// One path to append to [`Paths`](crate::Paths).
#[derive(Clone, Copy, Debug)]
pub struct NewPath<'a> {
    /// Identifier in the file. Need not be unique: `check` reports duplicates, readers accept them.
    pub id: &'a str,
    /// The curve, in meters.
    pub runs: &'a Runs,
    /// Row in [`crate::Nodes`] of its first node.
    pub start_node: Option<u32>,
    /// Row in [`crate::Nodes`] of its last node.
    pub end_node: Option<u32>,
    /// Directions in which vehicles drive.
    pub direction: Direction,
    /// Index of its level in [`crate::Layout::levels`].
    pub level: Option<u32>,
    /// Vehicle types that may use it; empty means all.
    pub vehicle_types: &'a [&'a str],
}

impl Default for NewPath<'_> {
    fn default() -> Self {
        static EMPTY: Runs = Runs::EMPTY;
        Self {
            id: "",
            runs: &EMPTY,
            start_node: None,
            end_node: None,
            direction: Direction::Forward,
            level: None,
            vehicle_types: &[],
        }
    }
}

/// Style that a path sets itself. The rule of the view decides the properties that are `None`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct OwnStyle {
    /// Stroke width in meters: zero or more.
    pub width_m: Option<f32>,
    /// Color 0xRRGGBBAA; not 0, which means `None` in
    /// [`Paths::color_rgba`](crate::Paths::color_rgba).
    pub color_rgba: Option<u32>,
}
