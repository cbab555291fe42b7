//! Edits as data: transforms, new curves, styles, states and insertions.

use std::sync::Arc;

use guideway_layout::{Direction, Geometry, OwnStyle, WrittenCurve, WrittenCurves};
use guideway_spline::{Affine, Runs};

use super::tables::TableEdit;
use crate::scene::PathState;

/// A change of a scene. Rows are stable: a removed path keeps its row, an inserted one gets the
/// next row.
#[derive(Clone, Debug)]
pub enum Edit {
    /// Maps the curves of paths: translates, rotates, mirrors or scales them.
    Transform {
        /// Rows of paths, each once.
        paths: Arc<[u32]>,
        /// The map of each control point.
        by: Affine,
    },
    /// Replaces the curves of paths. Fastest if the numbers of control points stay the same.
    Reshape {
        /// Rows of paths.
        paths: Arc<[u32]>,
        /// Their new curves, in the same order.
        curves: Arc<Geometry>,
        /// Those of them that are kept as written, by their places in this order.
        written: Arc<WrittenCurves>,
    },
    /// Replaces the own width and color of paths. A scene colored by a column keeps its colors.
    Restyle(Arc<[(u32, OwnStyle)]>),
    /// Shows, hides, removes or restores paths.
    SetStates(Arc<[(u32, PathState)]>),
    /// Appends paths after the last row, drawn above all others of their rank.
    Insert(Arc<[Insertion]>),
    /// Changes what no picture shows: identifiers, references, properties, nodes and stations.
    Tables(TableEdit),
}

/// A path to insert.
#[derive(Clone, Debug, Default)]
pub struct Insertion {
    /// Identifier.
    pub id: String,
    /// The curve, in meters.
    pub runs: Runs,
    /// Row of the node at its start.
    pub start_node: Option<u32>,
    /// Row of the node at its end.
    pub end_node: Option<u32>,
    /// Travel direction.
    pub direction: Direction,
    /// Index in [`guideway_layout::Layout::levels`].
    pub level: Option<u32>,
    /// Vehicle types that may use it; empty means all.
    pub vehicle_types: Vec<String>,
    /// Width and color of its own.
    pub style: OwnStyle,
    /// Row of the path whose attributes it copies, if any, those per vehicle type too.
    pub attributes_of: Option<u32>,
    /// Draw rank; `None` is that of the path whose attributes it copies, else the lowest of all.
    pub rank: Option<i32>,
    /// The curve as its file wrote it, which `runs` draw.
    pub written: Option<Arc<WrittenCurve>>,
}

impl Edit {
    /// Rows of the existing paths whose picture the edit changes.
    pub fn paths(&self) -> impl Iterator<Item = u32> {
        let (paths, styles, states): (&[u32], &[_], &[_]) = match self {
            Self::Transform { paths, .. } | Self::Reshape { paths, .. } => (paths, &[], &[]),
            Self::Restyle(styles) => (&[], styles, &[]),
            Self::SetStates(states) => (&[], &[], states),
            Self::Insert(_) | Self::Tables(_) => (&[], &[], &[]),
        };
        let styled = styles.iter().map(|(path, _)| *path);
        let set = states.iter().map(|(path, _)| *path);
        paths.iter().copied().chain(styled).chain(set)
    }

    /// Returns `true` if the edit changes the layout, and not only what the scene shows of it.
    pub(super) fn changes_layout(&self) -> bool {
        let keeps = matches!(
            self,
            Self::SetStates(_) | Self::Tables(TableEdit::SetExists { .. })
        );
        !keeps
    }

    /// Heap bytes held, shared with clones.
    pub fn heap_bytes(&self) -> usize {
        match self {
            Self::Transform { paths, .. } => size_of_val(&**paths),
            Self::Reshape {
                paths,
                curves,
                written,
            } => size_of_val(&**paths) + curves.heap_bytes() + written.heap_bytes(),
            Self::Restyle(styles) => size_of_val(&**styles),
            Self::SetStates(states) => size_of_val(&**states),
            Self::Insert(paths) => {
                let all = paths.iter().map(Insertion::heap_bytes).sum::<usize>();
                size_of_val(&**paths) + all
            }
            Self::Tables(edit) => edit.heap_bytes(),
        }
    }
}

impl Insertion {
    fn heap_bytes(&self) -> usize {
        let points: usize = self.runs.iter().map(size_of_val).sum();
        let types: usize = self.vehicle_types.iter().map(String::capacity).sum();
        let written = self.written.as_ref().map_or(0, |curve| curve.heap_bytes());
        self.id.capacity() + points + types + written
    }
}
