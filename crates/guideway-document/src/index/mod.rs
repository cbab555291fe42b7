//! Spatial index: finds the paths and nodes near a place, and the paths at a node.
//!
//! Boxes of paths and nodes are in a [`BoxIndex`]; `node_lists` lists the paths and the stations at
//! each node.

mod node_lists;

use guideway_layout::{Layout, PathRef};
use guideway_scene::cluster::BoxIndex;
use guideway_scene::{Scene, Table, TableEdit};
use guideway_spline::{Bounds, Point};
use rayon::prelude::*;

use node_lists::NodeLists;

/// Boxes per parallel task. Fewer stay on this thread: the pool may be busy with a picture for as
/// long as a frame takes.
const CHUNK: usize = 4096;

/// Index of the paths and nodes of a layout, by their rows. A path's box is that of its curve.
#[derive(Clone, Debug, Default)]
pub struct Index {
    paths: BoxIndex,
    nodes: BoxIndex,
    node_paths: NodeLists,
    node_stations: NodeLists,
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
            node_paths: NodeLists::new(layout.nodes.len(), || {
                (0..layout.paths.len() as u32).flat_map(|row| path_pairs(layout, row))
            }),
            node_stations: NodeLists::new(layout.nodes.len(), || {
                (0..layout.stations.len() as u32).flat_map(|row| station_pairs(layout, row))
            }),
            path_count: layout.paths.len() as u32,
        }
    }

    /// Indexes the layout of a scene; removed nodes have no boxes.
    pub(crate) fn of_scene(scene: &Scene) -> Self {
        let mut index = Self::new(scene.layout());
        index.set_nodes(scene.removed(Table::Nodes), scene);
        index
    }

    /// Updates the boxes of `changed` paths and adds the new rows of the layout.
    pub(crate) fn update(&mut self, changed: &[u32], layout: &Layout) {
        let path = |row: u32| layout.paths.get(row as usize);
        let new_rows = self.path_count..layout.paths.len() as u32;
        self.path_count = new_rows.end;
        let pairs = new_rows.clone().flat_map(|row| path_pairs(layout, row));
        self.node_paths.add(pairs);
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

    /// Updates nodes and references to them after an edit of the tables of `scene`; `undo` is its
    /// inverse.
    pub(crate) fn update_tables(&mut self, edit: &TableEdit, undo: &TableEdit, scene: &Scene) {
        let layout = scene.layout();
        match (edit, undo) {
            (TableEdit::MoveNodes(to), _) => {
                self.set_nodes(to.iter().map(|(node, _)| *node), scene);
            }
            (
                TableEdit::SetExists {
                    of: Table::Nodes,
                    rows,
                },
                _,
            ) => {
                self.set_nodes(rows.iter().map(|(node, _)| *node), scene);
            }
            (TableEdit::InsertNodes(new), _) => {
                let end = layout.nodes.len() as u32;
                self.set_nodes(end - new.len() as u32..end, scene);
            }
            (TableEdit::SetEnds(after), TableEdit::SetEnds(before)) => {
                let pairs = |&(row, ends): &(u32, [Option<u32>; 2])| {
                    ends.into_iter().flatten().map(move |node| (node, row))
                };
                let before: Vec<_> = before.iter().flat_map(pairs).collect();
                self.node_paths.remove(&before);
                let rows = sorted(after.iter().map(|(row, _)| *row));
                let pairs = rows.into_iter().flat_map(|row| path_pairs(layout, row));
                self.node_paths.add(pairs);
            }
            (TableEdit::SetStationNodes(after), TableEdit::SetStationNodes(before)) => {
                let pairs = |(row, nodes): &(u32, Box<[u32]>)| {
                    let row = *row;
                    nodes.clone().into_iter().map(move |node| (node, row))
                };
                let before: Vec<_> = before.iter().flat_map(pairs).collect();
                self.node_stations.remove(&before);
                let rows = sorted(after.iter().map(|(row, _)| *row));
                let pairs = rows.into_iter().flat_map(|row| station_pairs(layout, row));
                self.node_stations.add(pairs);
            }
            (TableEdit::InsertStations(new), _) => {
                let end = layout.stations.len() as u32;
                let rows = end - new.len() as u32..end;
                let pairs = rows.flat_map(|row| station_pairs(layout, row));
                self.node_stations.add(pairs);
            }
            _ => {}
        }
    }

    /// Updates the boxes of nodes; removed ones have none.
    fn set_nodes(&mut self, rows: impl Iterator<Item = u32>, scene: &Scene) {
        let at_m = |node| point_box(scene.layout().nodes.position_m(node));
        let place = |node| scene.exists(Table::Nodes, node).then(|| at_m(node));
        self.nodes.set(rows.map(|node| (node, place(node))));
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

    /// Nodes inside `bounds`, without removed ones, in no particular order.
    pub fn nodes_in(&self, bounds: Bounds<f64>) -> impl Iterator<Item = u32> {
        self.nodes.meeting(bounds).map(|(node, _)| node)
    }

    /// Paths that start or end at a node, including removed paths.
    pub fn paths_at(&self, node: u32) -> impl Iterator<Item = u32> {
        self.node_paths.at(node).iter().copied()
    }

    /// Stations that a node serves, including removed stations.
    pub fn stations_at(&self, node: u32) -> impl Iterator<Item = u32> {
        self.node_stations.at(node).iter().copied()
    }
}

/// Bounding box of a path's curve, in meters; `None` without a curve.
fn curve_bounds(path: PathRef<'_>) -> Option<Bounds<f64>> {
    path.runs()
        .flat_map(|run| run.segments())
        .map(|segment| Bounds::of_segment(&segment))
        .reduce(Bounds::union)
}

/// The distinct end nodes of a path.
pub(crate) fn nodes_of(path: PathRef<'_>) -> impl Iterator<Item = u32> {
    let end = path
        .end_node()
        .filter(|_| path.end_node() != path.start_node());
    path.start_node().into_iter().chain(end)
}

/// The distinct end nodes of a path, each with the row of the path.
fn path_pairs(layout: &Layout, row: u32) -> impl Iterator<Item = (u32, u32)> {
    nodes_of(layout.paths.get(row as usize)).map(move |node| (node, row))
}

/// The distinct nodes of a station, each with the row of the station.
fn station_pairs(layout: &Layout, row: u32) -> impl Iterator<Item = (u32, u32)> {
    let nodes = sorted(layout.stations.nodes(row).iter().copied());
    nodes.into_iter().map(move |node| (node, row))
}

/// Rows in increasing order, each once.
fn sorted(rows: impl Iterator<Item = u32>) -> Vec<u32> {
    let mut rows: Vec<u32> = rows.collect();
    rows.sort_unstable();
    rows.dedup();
    rows
}

fn point_box(at_m: Point<f64>) -> Bounds<f64> {
    Bounds {
        min: at_m,
        max: at_m,
    }
}
