//! The gesture in progress.

use guideway_document::PointRef;
use guideway_spline::Point;

/// The gesture in progress. Screen positions are pixels from the upper left corner of the picture.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) enum Gesture {
    #[default]
    None,
    /// Drags without effect: there is no document.
    Idle,
    /// Drags a selection box.
    Box {
        from_px: Point<f64>,
        to_px: Point<f64>,
    },
    /// Moves the selection, shown as an outline until the button is released. Held by the end of a
    /// path, it snaps to nodes.
    Move {
        from_m: Point<f64>,
        by_m: Point<f64>,
        by_end: bool,
    },
    /// Moves a node; the layout follows at once.
    Node {
        node: u32,
        from_m: Point<f64>,
        has_moved: bool,
    },
    /// Moves a control point; the layout follows at once.
    Handle {
        point: PointRef,
        from_m: Point<f64>,
        has_moved: bool,
    },
    /// Points of a path that is drawn or measured.
    Points(Vec<Point<f64>>),
}
