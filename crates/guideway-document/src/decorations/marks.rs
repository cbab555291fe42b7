//! Marks as data: positions of arrows, symbols and labels in a view.

use guideway_scene::LineRule;
use guideway_spline::Point;

use super::labels::{Label, LabelSize};

/// Most paths, nodes or stations in a view that still get marks: more are indistinguishable.
pub const MAX_MARKED: usize = 2_000;

/// The kinds of elements that get marks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MarkedKinds {
    /// Arrows and names of paths.
    pub paths: bool,
    /// Symbols and names of nodes.
    pub nodes: bool,
    /// Symbols and names of stations.
    pub stations: bool,
}

impl Default for MarkedKinds {
    fn default() -> Self {
        Self {
            paths: true,
            nodes: true,
            stations: true,
        }
    }
}

/// Selection of marks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MarkOptions {
    /// Pixels per point, which sets the size of marks.
    pub px_per_point: f64,
    /// The widths of the lines, which arrows and nodes stand out from.
    pub line_rule: LineRule,
    /// Draws direction arrows.
    pub arrows: bool,
    /// Draws nodes and stations.
    pub symbols: bool,
    /// Draws identifiers of paths, nodes and stations in this size.
    pub labels: Option<LabelSize>,
    /// Kinds of elements that get marks at all.
    pub of: MarkedKinds,
}

/// A direction arrow on a path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Arrow {
    /// Position on the path, in pixels.
    pub at_px: Point<f64>,
    /// Unit vector of the direction, y down.
    pub direction: Point<f64>,
    /// True if it points both ways.
    pub is_two_way: bool,
    /// Half the width of the path's line, in pixels.
    pub line_radius_px: f64,
}

/// All marks of a view.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Marks {
    /// Arrows along paths.
    pub arrows: Vec<Arrow>,
    /// Positions of nodes, in pixels.
    pub nodes: Vec<Point<f64>>,
    /// Half the width of lines without a width of their own, in pixels.
    pub line_radius_px: f64,
    /// Positions of stations, in pixels.
    pub stations: Vec<Point<f64>>,
    /// From stations to the nodes that serve them, in pixels, where these are apart.
    pub links: Vec<[Point<f64>; 2]>,
    /// Labels, none over another.
    pub labels: Vec<Label>,
    /// True if marks are missing because the view has too many paths, nodes or stations.
    pub left_out: bool,
}
