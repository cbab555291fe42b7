//! Changes of a document as data: edits of the scene and moves of nodes.

use std::sync::Arc;

use guideway_scene::Edit;
use guideway_spline::Point;

/// A change of a document; one or more form an undoable step.
#[derive(Clone, Debug)]
pub enum Change {
    /// An edit of the scene.
    Scene(Edit),
    /// New positions of nodes, in meters.
    MoveNodes(NodeMoves),
}

/// Rows of nodes and their new positions, in meters.
pub type NodeMoves = Arc<[(u32, Point<f64>)]>;

impl Change {
    /// Memory of the change, in bytes.
    pub(crate) fn heap_bytes(&self) -> usize {
        size_of::<Self>()
            + match self {
                Self::Scene(edit) => edit.heap_bytes(),
                Self::MoveNodes(nodes) => size_of_val(&**nodes),
            }
    }
}
