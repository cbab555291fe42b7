//! Changes of a document as data: edits of the scene, moves of nodes with their stations, copies.

use std::sync::Arc;

use guideway_scene::{Edit, TableEdit};
use guideway_spline::Point;

use crate::elements::Elements;

/// A change of a document; one or more form an undoable step.
#[derive(Clone, Debug)]
pub enum Change {
    /// An edit of the scene.
    Scene(Edit),
    /// New positions of nodes, in meters. A station with a position of its own moves along, by the
    /// mean of the moves of its nodes. Paths stay.
    MoveNodes(NodeMoves),
    /// Copies of elements. The journal of a million of them has their rows, not their points.
    Copy(CopiesOf),
}

/// Copies of elements, each a step from the one before.
#[derive(Clone, Debug)]
pub struct CopiesOf {
    /// Paths with all of their end nodes, nodes and stations.
    pub elements: Arc<Elements>,
    /// Number of copies.
    pub count: u32,
    /// Distance from one copy to the next one, in meters.
    pub step_m: Point<f64>,
}

impl CopiesOf {
    /// Most copies of one change: a slip of the keyboard must not fill the memory.
    pub const MAX_COUNT: u32 = 10_000;

    /// Most control points and elements of a document with its copies. A journal asks for copies in
    /// some bytes, so that nothing else bounds them. Derived: 2 GiB of control points.
    pub(crate) const MAX_SIZE: u64 = 1 << 27;
}

/// Rows of nodes and their new positions, in meters.
pub type NodeMoves = Arc<[(u32, Point<f64>)]>;

impl From<Edit> for Change {
    fn from(edit: Edit) -> Self {
        Self::Scene(edit)
    }
}

impl From<TableEdit> for Change {
    fn from(edit: TableEdit) -> Self {
        Self::Scene(Edit::Tables(edit))
    }
}

impl Change {
    /// Memory of the change, in bytes.
    pub(crate) fn heap_bytes(&self) -> usize {
        size_of::<Self>()
            + match self {
                Self::Scene(edit) => edit.heap_bytes(),
                Self::MoveNodes(nodes) => size_of_val(&**nodes),
                Self::Copy(copies) => copies.elements.heap_bytes(),
            }
    }
}
