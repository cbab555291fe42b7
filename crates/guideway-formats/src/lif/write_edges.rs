//! Paths as edges: LIF knows one-way edges only, so a two-way path is two.

use guideway_layout::{Direction, Layout, PathRef};

use super::write_columns::{Columns, Version};
use super::write_network::{Names, Network, path_types};
use super::write_objects::{EdgeObject, ForTypes, Trajectory};
use crate::Losses;
use crate::clamped::{ClampedCurve, POSITION_STEP_M};

/// Which edge of a path it is.
pub(super) struct EdgeRef<'a> {
    pub(super) id: &'a str,
    path: PathRef<'a>,
    is_back: bool,
}

pub(super) struct Edges<'a> {
    layout: &'a Layout,
    network: &'a Network<'a>,
    columns: Columns<'a>,
    version: Version,
    /// The names of the edges back, by path; none where a path leads one way.
    back: Vec<Option<String>>,
}

impl<'a> Edges<'a> {
    pub(super) fn of(
        layout: &'a Layout,
        network: &'a Network<'a>,
        version: Version,
        losses: &mut Losses,
    ) -> Self {
        let mut back = vec![None; layout.paths.len()];
        let is_both = |p: &PathRef<'_>| p.direction() == Direction::Both;
        if layout.paths.iter().any(|p| is_both(&p)) {
            let mut names = Names::among(layout.paths.iter().map(PathRef::id));
            for path in layout.paths.iter().filter(is_both) {
                back[path.row()] = Some(names.new_like(path.id()));
            }
        }
        let detail = "two-way paths: each becomes an edge there and one back";
        losses.add("directions", back.iter().flatten().count(), detail);
        Self {
            columns: Columns::of(layout, version, losses),
            layout,
            network,
            version,
            back,
        }
    }

    /// The edges of a path.
    pub(super) fn of_path(&self, path: u32) -> impl Iterator<Item = EdgeRef<'_>> {
        let path = self.layout.paths.get(path as usize);
        let edge = move |id, is_back| EdgeRef { id, path, is_back };
        let back = self.back[path.row()].as_deref();
        let back = back.map(|id| edge(id, true));
        std::iter::once(edge(path.id(), false)).chain(back)
    }

    /// What is written of an edge.
    pub(super) fn object<'e>(&'e self, edge: &EdgeRef<'e>) -> EdgeObject<'e> {
        let &EdgeRef { id, path, is_back } = edge;
        let mut nodes = self.network.ends(path.row());
        if is_back {
            nodes.reverse();
        }
        EdgeObject {
            id,
            ends: nodes.map(|node| self.network.node_id(node)),
            properties: ForTypes {
                version: self.version,
                types: path_types(self.layout, path.row()),
                columns: self.columns.json(path.row()),
                trajectory: self.trajectory(path, nodes, is_back),
            },
        }
    }

    /// The curve, but of the straight line from node to node, which needs none.
    fn trajectory(&self, path: PathRef<'_>, nodes: [u32; 2], is_back: bool) -> Option<Trajectory> {
        let mut curve = ClampedCurve::from_path(path)?;
        let last = *curve.knots.last()?;
        if is_back {
            curve.points.reverse();
            curve.knots.reverse();
            curve.knots.iter_mut().for_each(|knot| *knot = last - *knot);
        }
        let from_node_to_node = curve.as_line().is_some_and(|line| {
            let nodes = nodes.map(|node| self.network.position_m(node));
            let apart = line[0].distance(nodes[0]).max(line[1].distance(nodes[1]));
            apart <= POSITION_STEP_M
        });
        (!from_node_to_node).then(|| curve.into())
    }
}
