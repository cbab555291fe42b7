//! Stations without a node, and stations that vehicles cannot reach or leave.

use guideway_layout::{Code, Layout, Member, PathRef, Severity};

use super::components::Components;
use super::finding::{Detail, Findings};
use crate::arcs::Arcs;

/// Reports stations without a node, and those whose nodes no path of any type reaches.
pub(super) fn check_nodes(layout: &Layout, findings: &mut Findings) {
    let mut has_path = vec![false; layout.nodes.len()];
    let driven = |path: &PathRef<'_>| layout.paths.is_driven(path.row());
    for path in layout.paths.iter().filter(driven) {
        for node in [path.start_node(), path.end_node()].into_iter().flatten() {
            has_path[node as usize] = true;
        }
    }
    for station in 0..layout.stations.len() as u32 {
        let nodes = layout.stations.nodes(station);
        let element = Member::Station(station);
        if nodes.is_empty() {
            // A location of openTCS may be a door or another device that no vehicle drives to.
            let severity = match layout.provenance.format.as_str() {
                "openTCS" => Severity::Info,
                _ => Code::StationWithoutNode.severity(),
            };
            findings.add_as(severity, Code::StationWithoutNode, element, Detail::NoNode);
        } else if nodes.iter().all(|&node| !has_path[node as usize]) {
            findings.add(Code::UnreachableStation, element, Detail::NoPath);
        }
    }
}

/// Reports stations that vehicles of a type serve, and cannot reach from the largest component of a
/// level or leave toward it. Without a component, each station needs a way in and a way out.
pub(super) fn check_access(
    layout: &Layout,
    arcs: &Arcs,
    components: &Components,
    findings: &mut Findings,
) {
    let stations = &layout.stations;
    if stations.is_empty() {
        return;
    }
    let starts: Vec<u32> = (0..arcs.node_count())
        .filter(|&node| components.is_in_main(node))
        .collect();
    let (reached, leading) = match components.has_circle() {
        true => (
            spread(
                &starts,
                arcs.node_count(),
                |node| arcs.leaving(node),
                |row| arcs.get(row).to,
            ),
            spread(
                &starts,
                arcs.node_count(),
                |node| arcs.entering(node),
                |row| arcs.get(row).from,
            ),
        ),
        false => {
            let nodes = 0..arcs.node_count();
            let has = |rows: &[u32]| !rows.is_empty();
            (
                nodes.clone().map(|node| has(arcs.entering(node))).collect(),
                nodes.map(|node| has(arcs.leaving(node))).collect(),
            )
        }
    };
    for station in 0..stations.len() as u32 {
        let nodes = stations.nodes(station);
        if !nodes.iter().any(|&node| arcs.has(node)) {
            continue;
        }
        let any = |flags: &[bool]| nodes.iter().any(|&node| flags[node as usize]);
        let (can_come, can_go) = (any(&reached), any(&leading));
        if !can_come || !can_go {
            let detail = Detail::Access { can_come, can_go };
            findings.add(Code::UnreachableStation, Member::Station(station), detail);
        }
    }
}

/// Flags the nodes that some nodes lead to.
fn spread<'a>(
    starts: &[u32],
    nodes: u32,
    arcs: impl Fn(u32) -> &'a [u32],
    far_end: impl Fn(u32) -> u32,
) -> Vec<bool> {
    let mut is_reached = vec![false; nodes as usize];
    starts
        .iter()
        .for_each(|&node| is_reached[node as usize] = true);
    let mut waiting = starts.to_vec();
    while let Some(node) = waiting.pop() {
        for &row in arcs(node) {
            let next = far_end(row);
            if !std::mem::replace(&mut is_reached[next as usize], true) {
                waiting.push(next);
            }
        }
    }
    is_reached
}
