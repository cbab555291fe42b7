//! End points: paths that miss their nodes, nodes without paths, and paths between levels.

use guideway_spline::Point;

use super::element::{DisplayPosition, element_name, element_place};
use super::scale::Tolerances;
use crate::{Code, Diagnostics, Layout, Member, PathRef};

/// Reports gaps between paths and their nodes, unused nodes, and paths between levels.
pub(super) fn check(layout: &Layout, tolerances: &Tolerances, found: &mut Diagnostics) {
    let mut used = vec![false; layout.nodes.len()];
    for path in layout.paths.iter() {
        for node in [path.start_node(), path.end_node()].into_iter().flatten() {
            used[node as usize] = true;
        }
        if let Some((start, end)) = path.ends() {
            let tolerance_m = tolerances.gap_m;
            let mut gap = |verb, node, at| {
                node_gap(layout, path, (verb, node, at), tolerance_m, found);
            };
            gap("begins", path.start_node(), start);
            gap("ends", path.end_node(), end);
        }
        cross_level(layout, path, found);
    }
    let mut served = vec![false; layout.nodes.len()];
    for station in 0..layout.stations.len() as u32 {
        for &node in layout.stations.nodes(station) {
            served[node as usize] = true;
        }
    }
    for node in (0..used.len()).filter(|&node| !used[node]) {
        let remedy = match served[node] {
            true => "Connect the node: a station uses it",
            false => "Connect the node, or remove it",
        };
        found.push(
            Code::UnusedNode,
            || element_place(Member::Node(node as u32), layout.nodes.id(node as u32)),
            || "no drawn path begins or ends here".to_owned(),
            remedy,
        );
    }
}

fn node_gap(
    layout: &Layout,
    path: PathRef<'_>,
    (verb, node, at): (&str, Option<u32>, Point<f64>),
    tolerance_m: f64,
    found: &mut Diagnostics,
) {
    let Some(node) = node else { return };
    let node_at = layout.nodes.position_m(node);
    let gap_m = at.distance(node_at);
    if gap_m > tolerance_m {
        found.push(
            Code::NodeGap,
            || element_place(Member::Path(path.row() as u32), path.id()),
            || {
                let node = element_name("node", node as usize, layout.nodes.id(node));
                let (at, node_at) = (DisplayPosition(at), DisplayPosition(node_at));
                format!("{verb} at {at}, {gap_m:.3} m from {node} at {node_at}")
            },
            "Move the node to the end of the curve, or the end of the curve to the node",
        );
    }
}

fn cross_level(layout: &Layout, path: PathRef<'_>, found: &mut Diagnostics) {
    let level = |node: Option<u32>| node.and_then(|node| layout.nodes.level(node));
    let levels = (level(path.start_node()), level(path.end_node()));
    if let (Some(start), Some(end)) = levels
        && start != end
    {
        found.push(
            Code::CrossLevel,
            || element_place(Member::Path(path.row() as u32), path.id()),
            || {
                let id = |level: u32| layout.levels.get(level as usize).map_or("", |l| &l.id);
                let from = element_name("level", start as usize, id(start));
                let to = element_name("level", end as usize, id(end));
                format!("leads from {from} to {to}, and is drawn in one plane")
            },
            "No action needed for a lift or a ramp; otherwise correct the level of the node",
        );
    }
}
