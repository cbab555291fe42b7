//! Pointer events of the canvas, in pixels of the picture.

use eframe::egui::Modifiers;
use guideway_spline::Point;

/// A pointer event. Positions are pixels from the upper left corner of the picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum PointerEvent {
    /// The pointer moved without a button; `None` outside the picture.
    Hover(Option<Point<f64>>),
    /// The primary button went down here and the pointer moved.
    DragStarted(Point<f64>),
    /// The pointer moved with the primary button down.
    Dragged(Point<f64>, Modifiers),
    /// The primary button went up after a drag.
    DragEnded(Modifiers),
    /// The other button went down during a drag.
    Cancelled,
    Clicked(Point<f64>, Modifiers),
    DoubleClicked,
    /// The secondary button went down and up without a drag.
    SecondaryClicked,
    /// The key that inserts a control point was pressed.
    InsertPoint(Point<f64>),
    /// The key that removes a control point was pressed.
    RemovePoint(Point<f64>),
}
