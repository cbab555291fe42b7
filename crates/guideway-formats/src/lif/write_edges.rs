//! LIF edges of paths: LIF has one-way edges only, so a two-way path is written as two.

use guideway_layout::{Direction, Layout, PathRef};

use super::unique_names::UniqueNames;
use super::version::Version;
use super::write_columns::PropertyColumns;
use super::write_network::{Network, path_types};
use super::write_objects::{EdgeObject, Trajectory, TypeProperties};
use crate::Losses;
use crate::clamped::{ClampedCurve, POSITION_STEP_M};

/// One of the edges of a path.
pub(super) struct EdgeRef<'a> {
    pub(super) id: &'a str,
    path: PathRef<'a>,
    /// True for an edge against the direction of the path.
    is_reverse: bool,
}

/// The edges of all paths.
pub(super) struct Edges<'a> {
    layout: &'a Layout,
    network: &'a Network<'a>,
    columns: PropertyColumns<'a>,
    version: Version,
    /// Identifier of the reverse edge per path; `None` for a one-way path.
    reverse_ids: Vec<Option<String>>,
}

impl<'a> Edges<'a> {
    /// Collects the edges of a layout; adds columns and directions that LIF does not hold to the
    /// losses.
    pub(super) fn collect(
        layout: &'a Layout,
        network: &'a Network<'a>,
        version: Version,
        losses: &mut Losses,
    ) -> Self {
        let mut reverse_ids = vec![None; layout.paths.len()];
        let is_both = |p: &PathRef<'_>| p.direction() == Direction::Both;
        if layout.paths.iter().any(|p| is_both(&p)) {
            let mut names = UniqueNames::new(layout.paths.iter().map(PathRef::id));
            for path in layout.paths.iter().filter(is_both) {
                reverse_ids[path.row()] = Some(names.make_unique(path.id()));
            }
        }
        let detail = "two-way paths: written as two edges each";
        losses.add("directions", reverse_ids.iter().flatten().count(), detail);
        Self {
            columns: PropertyColumns::select(layout, version, losses),
            layout,
            network,
            version,
            reverse_ids,
        }
    }

    /// Returns the edges of a path.
    pub(super) fn of_path(&self, path: u32) -> impl Iterator<Item = EdgeRef<'_>> {
        let path = self.layout.paths.get(path as usize);
        let edge = move |id, is_reverse| EdgeRef {
            id,
            path,
            is_reverse,
        };
        let reverse_id = self.reverse_ids[path.row()].as_deref();
        let reverse = reverse_id.map(|id| edge(id, true));
        std::iter::once(edge(path.id(), false)).chain(reverse)
    }

    /// Returns an edge as written.
    pub(super) fn object<'e>(&'e self, edge: &EdgeRef<'e>) -> EdgeObject<'e> {
        let &EdgeRef {
            id,
            path,
            is_reverse,
        } = edge;
        let mut nodes = self.network.ends(path.row());
        if is_reverse {
            nodes.reverse();
        }
        EdgeObject {
            id,
            ends: nodes.map(|node| self.network.node_id(node)),
            properties: TypeProperties {
                version: self.version,
                types: path_types(self.layout, path.row()),
                columns: self.columns.json(path.row()),
                trajectory: self.trajectory(path, nodes, is_reverse),
            },
        }
    }

    /// Returns the curve of an edge, or `None` for the straight line between its nodes, which LIF
    /// implies.
    fn trajectory(
        &self,
        path: PathRef<'_>,
        nodes: [u32; 2],
        is_reverse: bool,
    ) -> Option<Trajectory> {
        let mut curve = ClampedCurve::from_path(path)?;
        let last = *curve.knots.last()?;
        if is_reverse {
            curve.points.reverse();
            curve.knots.reverse();
            curve.knots.iter_mut().for_each(|knot| *knot = last - *knot);
        }
        let is_node_line = curve.as_line().is_some_and(|line| {
            let nodes = nodes.map(|node| self.network.position_m(node));
            let apart = line[0].distance(nodes[0]).max(line[1].distance(nodes[1]));
            apart <= POSITION_STEP_M
        });
        (!is_node_line).then(|| curve.into())
    }
}
