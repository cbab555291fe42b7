//! The tools that the user can select.

/// A pointer tool.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Tool {
    /// Selects paths and moves them.
    #[default]
    Select,
    /// Moves nodes and control points.
    Points,
    /// Draws a path, one point per click.
    Draw,
    /// Measures a polyline, one point per click.
    Measure,
}

impl Tool {
    /// Returns `true` if clicks add points. Such a tool pans by the primary button.
    pub(crate) fn adds_points(self) -> bool {
        matches!(self, Self::Draw | Self::Measure)
    }
}
