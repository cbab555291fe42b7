//! The gesture in progress.

use eframe::egui::Modifiers;
use guideway_document::{Document, PointRef};
use guideway_spline::Point;

/// The gesture in progress. Places are those of the world: the view may change meanwhile.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) enum Gesture {
    #[default]
    None,
    /// Drags without effect: there is no document.
    Idle,
    /// Drags a selection box.
    Box {
        from_m: Point<f64>,
        to_m: Point<f64>,
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
        progress: DragProgress,
    },
    /// Moves a control point; the layout follows at once.
    Handle {
        point: PointRef,
        from_m: Point<f64>,
        progress: DragProgress,
    },
    /// Points of a path that is drawn or measured.
    Points(Vec<Point<f64>>),
}

/// The edits of a drag that the layout follows at once.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct DragProgress {
    /// The state of the document before the drag. Each edit of the drag starts from it, so that the
    /// whole drag is one step to undo.
    pub(super) before: u64,
    /// The last place of the pointer, in meters, while an earlier edit had the document.
    pub(super) missed: Option<(Point<f64>, Modifiers)>,
}

impl DragProgress {
    pub(super) fn begin(document: &Document) -> Self {
        Self {
            before: document.state(),
            missed: None,
        }
    }

    /// Takes back what the drag did so far.
    pub(super) fn take_back(self, document: &mut Document) {
        if document.state() != self.before {
            document.undo();
        }
    }
}
