//! Parts: sets of nodes that no path connects with the largest set of their level.

use std::collections::HashMap;

use guideway_layout::{Code, Layout, Member};

use super::finding::{Detail, Findings};
use crate::arcs::Arcs;

/// A set of connected nodes.
#[derive(Clone, Copy)]
struct Part {
    first: u32,
    nodes: u32,
    paths: u32,
}

pub(super) fn check(layout: &Layout, arcs: &Arcs, findings: &mut Findings) {
    let mut parents: Vec<u32> = (0..arcs.node_count()).collect();
    for arc in &arcs.all {
        let (a, b) = (root(&mut parents, arc.from), root(&mut parents, arc.to));
        // The smaller row stands for the set, so that findings name its first node.
        parents[a.max(b) as usize] = a.min(b);
    }
    let mut parts: HashMap<u32, Part> = HashMap::new();
    for node in (0..arcs.node_count()).filter(|&node| arcs.has(node)) {
        let first = root(&mut parents, node);
        let part = parts.entry(first).or_insert(Part {
            first,
            nodes: 0,
            paths: 0,
        });
        part.nodes += 1;
    }
    for arc in arcs.all.iter().filter(|arc| !arc.is_backward) {
        if let Some(part) = parts.get_mut(&root(&mut parents, arc.from)) {
            part.paths += 1;
        }
    }
    let mut largest: HashMap<Option<u32>, Part> = HashMap::new();
    let mut sorted: Vec<Part> = parts.into_values().collect();
    sorted.sort_unstable_by_key(|part| part.first);
    for &part in &sorted {
        let known = largest
            .entry(layout.nodes.level(part.first))
            .or_insert(part);
        if part.nodes > known.nodes {
            *known = part;
        }
    }
    for part in sorted {
        if largest[&layout.nodes.level(part.first)].first != part.first {
            let Part {
                first,
                nodes,
                paths,
            } = part;
            findings.add(
                Code::NotConnected,
                Member::Node(first),
                Detail::Part { nodes, paths },
            );
        }
    }
}

/// The root of a set; halves the way to it.
fn root(parents: &mut [u32], mut node: u32) -> u32 {
    while parents[node as usize] != node {
        let above = parents[parents[node as usize] as usize];
        parents[node as usize] = above;
        node = above;
    }
    node
}
