//! [`Arcs`]: the paths that a vehicle type may drive, once per direction, by node.

use guideway_layout::{Direction, Layout, Value};

/// A path in one of its directions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Arc {
    /// Row of the path.
    pub(crate) path: u32,
    /// Row of the node where it begins.
    pub(crate) from: u32,
    /// Row of the node where it ends.
    pub(crate) to: u32,
    /// Vehicles drive from the end of the path to its start.
    pub(crate) is_backward: bool,
}

/// Arcs in the order of their paths, and by node.
pub(crate) struct Arcs {
    pub(crate) all: Vec<Arc>,
    leaving: Groups,
    entering: Groups,
}

/// Rows of arcs by node.
struct Groups {
    ends: Vec<u32>,
    arcs: Vec<u32>,
}

impl Groups {
    fn new(nodes: usize, arcs: &[Arc], node: impl Fn(&Arc) -> u32) -> Self {
        let mut ends = vec![0_u32; nodes + 1];
        arcs.iter()
            .for_each(|arc| ends[node(arc) as usize + 1] += 1);
        for row in 1..ends.len() {
            ends[row] += ends[row - 1];
        }
        let mut next = ends.clone();
        let mut rows = vec![0; arcs.len()];
        for (row, arc) in arcs.iter().enumerate() {
            let slot = &mut next[node(arc) as usize];
            rows[*slot as usize] = row as u32;
            *slot += 1;
        }
        Self { ends, arcs: rows }
    }

    fn of(&self, node: u32) -> &[u32] {
        let [start, end] = [0, 1].map(|i| self.ends[node as usize + i] as usize);
        &self.arcs[start..end]
    }
}

impl Arcs {
    /// The arcs of a vehicle type, or those open to all if it is `None`. Paths without nodes,
    /// locked paths, walls and doors have none.
    pub(crate) fn of(layout: &Layout, vehicle_type: Option<&str>) -> Self {
        let mut all = Vec::with_capacity(layout.paths.len());
        for path in layout.paths.iter() {
            let (Some(from), Some(to)) = (path.start_node(), path.end_node()) else {
                continue;
            };
            let is_driven = layout.paths.is_driven(path.row());
            if !is_driven || !is_open(layout, path.row(), vehicle_type) {
                continue;
            }
            let forward = Arc {
                path: path.row() as u32,
                from,
                to,
                is_backward: false,
            };
            all.push(forward);
            if path.direction() == Direction::Both {
                all.push(Arc {
                    from: to,
                    to: from,
                    is_backward: true,
                    ..forward
                });
            }
        }
        let nodes = layout.nodes.len();
        Self {
            leaving: Groups::new(nodes, &all, |arc| arc.from),
            entering: Groups::new(nodes, &all, |arc| arc.to),
            all,
        }
    }

    /// Rows of the arcs that begin at a node.
    pub(crate) fn leaving(&self, node: u32) -> &[u32] {
        self.leaving.of(node)
    }

    /// Rows of all arcs, in groups by the node where they begin.
    pub(crate) fn leaving_rows(&self) -> &[u32] {
        &self.leaving.arcs
    }

    /// Index of the first arc of a node in [`Self::leaving_rows`].
    pub(crate) fn first_leaving(&self, node: u32) -> usize {
        self.leaving.ends[node as usize] as usize
    }

    /// Rows of the arcs that end at a node.
    pub(crate) fn entering(&self, node: u32) -> &[u32] {
        self.entering.of(node)
    }

    /// The arc of a row.
    pub(crate) fn get(&self, row: u32) -> Arc {
        self.all[row as usize]
    }

    /// Number of nodes, with or without arcs.
    pub(crate) fn node_count(&self) -> u32 {
        self.leaving.ends.len() as u32 - 1
    }

    /// Returns `true` if an arc begins or ends at a node.
    pub(crate) fn has(&self, node: u32) -> bool {
        !self.leaving(node).is_empty() || !self.entering(node).is_empty()
    }
}

/// Returns `true` if a vehicle type may use a path, and the path is not locked for it.
fn is_open(layout: &Layout, path: usize, vehicle_type: Option<&str>) -> bool {
    let types = layout.paths.vehicle_types();
    let is_open = match vehicle_type {
        _ if types.entries(path).is_empty() => true,
        Some(name) => types.entry_for(path, name).is_some(),
        None => false,
    };
    is_open && value(layout, path as u32, vehicle_type, "locked") != Some(Value::Bool(true))
}

/// The value of a path for a vehicle type, else for all.
pub(crate) fn value<'a>(
    layout: &'a Layout,
    path: u32,
    vehicle_type: Option<&str>,
    name: &str,
) -> Option<Value<'a>> {
    match vehicle_type {
        Some(vehicle_type) => layout.paths.value_for(path as usize, vehicle_type, name),
        None => layout.paths.attributes.value(path as usize, name),
    }
}

/// A number of a path for a vehicle type.
pub(crate) fn number(
    layout: &Layout,
    path: u32,
    vehicle_type: Option<&str>,
    name: &str,
) -> Option<f64> {
    value(layout, path, vehicle_type, name)?.number()
}
