//! Spatial index: finds the paths and nodes near a place, and the paths at a node.
//!
//! Boxes of paths and nodes are in a [`BoxIndex`]; `node_paths` lists the paths at each node.

mod node_paths;

use guideway_layout::{Layout, PathRef};
use guideway_scene::cluster::BoxIndex;
use guideway_spline::{Bounds, Point};
use rayon::prelude::*;

use node_paths::NodePaths;
pub(crate) use node_paths::nodes_of;

/// Boxes per parallel task. Fewer stay on this thread: the pool may be busy with a picture for as
/// long as a frame takes.
const CHUNK: usize = 4096;

/// Index of the paths and nodes of a layout, by their rows. A path's box is that of its curve.
#[derive(Clone, Debug, Default)]
pub struct Index {
    paths: BoxIndex,
    nodes: BoxIndex,
    node_paths: NodePaths,
    path_count: u32,
}

impl Index {
    /// Indexes a whole layout, on all threads.
    pub fn new(layout: &Layout) -> Self {
        let paths = (0..layout.paths.len()).into_par_iter();
        let paths = paths.map(|row| curve_bounds(layout.paths.get(row)));
        let nodes = 0..layout.nodes.len() as u32;
        let nodes = nodes.map(|node| Some(point_box(layout.nodes.position_m(node))));
        Self {
            paths: BoxIndex::new(&paths.collect::<Vec<_>>()),
            nodes: BoxIndex::new(&nodes.collect::<Vec<_>>()),
            node_paths: NodePaths::new(layout),
            path_count: layout.paths.len() as u32,
        }
    }

    /// Updates the boxes of `changed` paths and adds the new rows of the layout.
    pub(crate) fn update(&mut self, changed: &[u32], layout: &Layout) {
        let path = |row: u32| layout.paths.get(row as usize);
        let new_rows = self.path_count..layout.paths.len() as u32;
        self.path_count = new_rows.end;
        new_rows
            .clone()
            .for_each(|row| self.node_paths.add(path(row)));
        let rows: Vec<u32> = changed.iter().copied().chain(new_rows).collect();
        let boxes = |rows: &[u32]| -> Vec<_> {
            let boxes = rows.iter().map(|&row| (row, curve_bounds(path(row))));
            boxes.collect()
        };
        if rows.len() <= CHUNK {
            self.paths.set(boxes(&rows).into_iter());
        } else {
            let chunks: Vec<_> = rows.par_chunks(CHUNK).map(boxes).collect();
            self.paths.set(chunks.into_iter().flatten());
        }
    }

    /// Updates the positions of nodes, in meters.
    pub(crate) fn move_nodes(&mut self, to: &[(u32, Point<f64>)]) {
        self.nodes
            .set(to.iter().map(|&(node, at_m)| (node, Some(point_box(at_m)))));
    }

    /// Bounding box of a path's curve, in meters; `None` without a curve.
    pub fn path_bounds(&self, path: u32) -> Option<Bounds<f64>> {
        self.paths.get(path)
    }

    /// Paths whose box intersects `bounds`, in no particular order.
    pub fn paths_in(&self, bounds: Bounds<f64>) -> impl Iterator<Item = u32> {
        self.boxes_in(bounds).map(|(path, _)| path)
    }

    /// Paths whose box intersects `bounds`, with the box, in no particular order.
    pub fn boxes_in(&self, bounds: Bounds<f64>) -> impl Iterator<Item = (u32, Bounds<f64>)> {
        self.paths.meeting(bounds)
    }

    /// Nodes inside `bounds`, in no particular order.
    pub fn nodes_in(&self, bounds: Bounds<f64>) -> impl Iterator<Item = u32> {
        self.nodes.meeting(bounds).map(|(node, _)| node)
    }

    /// Paths that start or end at a node, including removed paths.
    pub fn paths_at(&self, node: u32) -> impl Iterator<Item = u32> {
        self.node_paths.paths_at(node)
    }
}

/// Bounding box of a path's curve, in meters; `None` without a curve.
fn curve_bounds(path: PathRef<'_>) -> Option<Bounds<f64>> {
    path.runs()
        .flat_map(|run| run.segments())
        .map(|segment| Bounds::of_segment(&segment))
        .reduce(Bounds::union)
}

fn point_box(at_m: Point<f64>) -> Bounds<f64> {
    Bounds {
        min: at_m,
        max: at_m,
    }
}
