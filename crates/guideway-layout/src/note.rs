//! [`Note`]: a mark of a drawing that is no path, such as a text beside a line.

use std::fmt;

use guideway_spline::{Affine, Point};

/// Kind of a note.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum NoteKind {
    /// A text.
    #[default]
    Text,
    /// A placed block.
    Block,
    /// A point.
    Point,
    /// A circle, which the layout has as a path too.
    Circle,
}

impl fmt::Display for NoteKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Text => "text",
            Self::Block => "block",
            Self::Point => "point",
            Self::Circle => "circle",
        })
    }
}

/// A mark of a drawing that is no path. It has no meaning in a network until it becomes a station
/// or the name of a node, so writers omit it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Note {
    /// Kind of the mark.
    pub kind: NoteKind,
    /// The text; of a block, the first text that belongs to the placement. May be empty.
    pub text: String,
    /// Name of the placed block; empty for other kinds.
    pub block: String,
    /// Layer of the drawing.
    pub layer: String,
    /// Position in meters.
    pub position_m: Point<f64>,
}

impl Note {
    /// Maps the position.
    pub(crate) fn transform(&mut self, by: Affine) {
        self.position_m = by.apply(self.position_m);
    }
}
