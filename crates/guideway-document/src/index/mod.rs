//! Where things are, to find those near a place without looking at all.

mod boxes;
mod joints;

use guideway_layout::{Layout, PathRef};
use guideway_spline::{Bounds, Point};
use rayon::prelude::*;

use boxes::Boxes;
use joints::Joints;

pub(crate) use joints::nodes_of;

/// Boxes found by one thread. Few are not shared with others, which may be at work on a picture for as long as that takes.
const AT_ONCE: usize = 4096;

/// Where the paths and nodes of a layout are, and which paths are at which node.
///
/// PathSet are those of the layout it was made of. Paths are held by the box of their curve.
#[derive(Clone, Debug, Default)]
pub struct Index {
    paths: Boxes,
    nodes: Boxes,
    joints: Joints,
    path_count: u32,
}

impl Index {
    /// The index of a whole layout.
    pub fn new(layout: &Layout) -> Self {
        let nodes = &layout.nodes;
        let node_rows = 0..nodes.len() as u32;
        let paths = (0..layout.paths.len()).into_par_iter();
        let paths = paths.map(|row| curve_bounds(layout.paths.get(row)));
        Self {
            paths: Boxes::new(paths.collect()),
            nodes: Boxes::new(
                node_rows
                    .map(|node| Some(spot(nodes.position_m(node))))
                    .collect(),
            ),
            joints: Joints::new(layout),
            path_count: layout.paths.len() as u32,
        }
    }

    /// After the curves of paths have changed, or rows were added.
    pub(crate) fn update(&mut self, changed: &[u32], layout: &Layout) {
        let path = |row: u32| layout.paths.get(row as usize);
        let new_rows = self.path_count..layout.paths.len() as u32;
        self.path_count = new_rows.end;
        new_rows.clone().for_each(|row| self.joints.add(path(row)));
        let rows: Vec<u32> = changed.iter().copied().chain(new_rows).collect();
        let boxes = |rows: &[u32]| -> Vec<_> {
            let boxes = rows.iter().map(|&row| (row, curve_bounds(path(row))));
            boxes.collect()
        };
        if rows.len() <= AT_ONCE {
            self.paths.set(boxes(&rows).into_iter());
        } else {
            let chunks: Vec<_> = rows.par_chunks(AT_ONCE).map(boxes).collect();
            self.paths.set(chunks.into_iter().flatten());
        }
    }

    pub(crate) fn move_nodes(&mut self, to: &[(u32, Point<f64>)]) {
        self.nodes
            .set(to.iter().map(|&(node, at_m)| (node, Some(spot(at_m)))));
    }

    /// The box of a path's curve; none if it has no curve.
    pub fn path_bounds(&self, path: u32) -> Option<Bounds<f64>> {
        self.paths.get(path)
    }

    /// Paths whose box meets `bounds`, in no order.
    pub fn paths_in(&self, bounds: Bounds<f64>) -> impl Iterator<Item = u32> {
        self.boxes_in(bounds).map(|(path, _)| path)
    }

    /// The same, with their boxes.
    pub fn boxes_in(&self, bounds: Bounds<f64>) -> impl Iterator<Item = (u32, Bounds<f64>)> {
        self.paths.meeting(bounds)
    }

    /// Nodes inside `bounds`, in no order.
    pub fn nodes_in(&self, bounds: Bounds<f64>) -> impl Iterator<Item = u32> {
        self.nodes.meeting(bounds).map(|(node, _)| node)
    }

    /// Paths that begin or end at a node, removed ones among them.
    pub fn paths_at(&self, node: u32) -> impl Iterator<Item = u32> {
        self.joints.paths_at(node)
    }
}

/// The box of a path's curve; none if it has no curve.
fn curve_bounds(path: PathRef<'_>) -> Option<Bounds<f64>> {
    path.runs()
        .flat_map(|run| run.segments())
        .map(|segment| Bounds::of_segment(&segment))
        .reduce(Bounds::union)
}

fn spot(at_m: Point<f64>) -> Bounds<f64> {
    Bounds {
        min: at_m,
        max: at_m,
    }
}
