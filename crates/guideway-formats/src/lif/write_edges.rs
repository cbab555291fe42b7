//! Paths as edges: LIF knows one-way edges only, so a two-way path is two.

use guideway_layout::{Direction, Layout, PathRef};
use serde_json::{Value, json};

use super::model::EDGE_PROPERTIES;
use super::write::position_json;
use super::write_columns::{Columns, Version};
use super::write_network::{Names, Network, path_types, types_json};
use crate::Losses;
use crate::clamped::{Clamped, SAME_POSITION_M};

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
    pub(super) fn json(&self, path: u32) -> impl Iterator<Item = Value> + use<'_, 'a> {
        let path = self.layout.paths.get(path as usize);
        let there = self.edge(path, path.id(), false);
        let back = self.back[path.row()].as_deref();
        let back = back.map(|id| self.edge(path, id, true));
        std::iter::once(there).chain(back)
    }

    fn edge(&self, path: PathRef<'_>, id: &str, is_back: bool) -> Value {
        let mut nodes = self.network.ends(path.row());
        if is_back {
            nodes.reverse();
        }
        let mut properties = self.columns.json(path.row());
        if let Some(trajectory) = self.trajectory(path, nodes, is_back) {
            properties.insert("trajectory".into(), trajectory);
        }
        let types = path_types(self.layout, path.row());
        let key = self.version.one_of(EDGE_PROPERTIES);
        json!({
            "edgeId": id,
            "startNodeId": self.network.node_id(nodes[0]),
            "endNodeId": self.network.node_id(nodes[1]),
            key: types_json(&types, self.version, &properties),
        })
    }

    /// The curve, but of the straight line from node to node, which needs none.
    fn trajectory(&self, path: PathRef<'_>, nodes: [u32; 2], is_back: bool) -> Option<Value> {
        let mut curve = Clamped::whole(path)?;
        let last = *curve.knots.last()?;
        if is_back {
            curve.points.reverse();
            curve.knots.reverse();
            curve.knots.iter_mut().for_each(|knot| *knot = last - *knot);
        }
        let from_node_to_node = curve.as_line().is_some_and(|line| {
            let nodes = nodes.map(|node| self.network.position_m(node));
            let apart = line[0].distance(nodes[0]).max(line[1].distance(nodes[1]));
            apart <= SAME_POSITION_M
        });
        if from_node_to_node {
            return None;
        }
        let knots = curve.knots.iter().map(|knot| knot / last);
        let points = curve.points.iter().map(|&p| position_json(p));
        Some(json!({
            "degree": curve.degree,
            "knotVector": knots.collect::<Vec<f64>>(),
            "controlPoints": points.collect::<Vec<Value>>(),
        }))
    }
}
