//! The tools that the user can select.

use guideway_document::DrawnCurve;

/// A pointer tool.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Tool {
    /// Selects elements and moves them.
    #[default]
    Select,
    /// Moves nodes and control points.
    Points,
    /// Draws lines, one point per click.
    Line,
    /// Draws an arc by start, end and a point between, or a radius.
    Arc,
    /// Draws a curve through the clicked points.
    Curve,
    /// Draws Bezier curves: ends and the two control points between them, one per click.
    Bezier,
    /// Creates a node per click, and splits paths there.
    Node,
    /// Creates a station per click.
    Station,
    /// Measures a polyline, one point per click.
    Measure,
}

impl Tool {
    /// Returns `true` if clicks add points or places. Such a tool pans by the primary button.
    pub(crate) fn adds_points(self) -> bool {
        !matches!(self, Self::Select | Self::Points)
    }

    /// The curve that the tool draws; `None` if it draws none.
    pub(crate) fn curve(self) -> Option<DrawnCurve> {
        match self {
            Self::Line => Some(DrawnCurve::Lines),
            Self::Arc => Some(DrawnCurve::Arc),
            Self::Curve => Some(DrawnCurve::Smooth),
            Self::Bezier => Some(DrawnCurve::Bezier),
            _ => None,
        }
    }
}
