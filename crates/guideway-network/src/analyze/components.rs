//! Strongly connected components: sets of nodes each of which vehicles reach from every other one.
//!
//! Tarjan's algorithm with a stack of its own: a recursion would overflow on long ways. Source:
//! Tarjan, Depth-first search and linear graph algorithms, 1972.

use std::collections::HashMap;

use guideway_layout::{Code, Layout, Member};

use super::finding::{Detail, Findings};
use crate::arcs::Arcs;

/// Number of a node or component that has none yet.
const NONE: u32 = u32::MAX;

/// The component of each node, and their sizes.
pub(super) struct Components {
    pub(super) of_node: Vec<u32>,
    pub(super) sizes: Vec<u32>,
    /// The component is the largest one of a level.
    is_main: Vec<bool>,
}

impl Components {
    pub(super) fn of(layout: &Layout, arcs: &Arcs) -> Self {
        let nodes = arcs.node_count();
        let mut search = Search {
            arcs,
            found: Self {
                of_node: vec![NONE; nodes as usize],
                sizes: Vec::new(),
                is_main: Vec::new(),
            },
            order: vec![NONE; nodes as usize],
            low: vec![0; nodes as usize],
            open: Vec::new(),
            next: 0,
        };
        for node in 0..nodes {
            if search.order[node as usize] == NONE && arcs.has(node) {
                search.visit(node);
            }
        }
        let mut found = search.found;
        found.is_main = found.largest(layout);
        found
    }

    /// Flags the largest component of each level, if it has at least two nodes. Where several are
    /// of one size, it is the one with the first node.
    fn largest(&self, layout: &Layout) -> Vec<bool> {
        let mut best: HashMap<Option<u32>, u32> = HashMap::new();
        for (node, &row) in self.of_node.iter().enumerate() {
            if row == NONE || self.sizes[row as usize] < 2 {
                continue;
            }
            let known = best.entry(layout.nodes.level(node as u32)).or_insert(row);
            if self.sizes[row as usize] > self.sizes[*known as usize] {
                *known = row;
            }
        }
        let mut flags = vec![false; self.sizes.len()];
        best.into_values()
            .for_each(|row| flags[row as usize] = true);
        flags
    }

    /// Returns `true` if ways lead in a circle.
    pub(super) fn has_circle(&self) -> bool {
        self.is_main.contains(&true)
    }

    /// Returns `true` if a node is in the largest component of a level.
    pub(super) fn is_in_main(&self, node: u32) -> bool {
        let row = self.of_node[node as usize];
        row != NONE && self.is_main[row as usize]
    }
}

struct Search<'a> {
    arcs: &'a Arcs,
    found: Components,
    /// Order of discovery.
    order: Vec<u32>,
    /// The earliest open node that is reached.
    low: Vec<u32>,
    open: Vec<u32>,
    next: u32,
}

impl Search<'_> {
    fn visit(&mut self, start: u32) {
        // Nodes on the way, with the number of arcs that have been followed.
        let mut way = vec![(start, 0)];
        self.discover(start);
        while let Some((node, followed)) = way.last_mut() {
            let node = *node;
            if let Some(&arc) = self.arcs.leaving(node).get(*followed) {
                *followed += 1;
                let to = self.arcs.get(arc).to;
                if self.order[to as usize] == NONE {
                    self.discover(to);
                    way.push((to, 0));
                } else if self.found.of_node[to as usize] == NONE {
                    self.lower(node, self.order[to as usize]);
                }
                continue;
            }
            way.pop();
            let low = self.low[node as usize];
            if let Some(&(before, _)) = way.last() {
                self.lower(before, low);
            }
            if low == self.order[node as usize] {
                self.close(node);
            }
        }
    }

    fn discover(&mut self, node: u32) {
        self.order[node as usize] = self.next;
        self.low[node as usize] = self.next;
        self.next += 1;
        self.open.push(node);
    }

    fn lower(&mut self, node: u32, to: u32) {
        let low = &mut self.low[node as usize];
        *low = (*low).min(to);
    }

    /// The open nodes from `node` on are one component.
    fn close(&mut self, node: u32) {
        let row = self.found.sizes.len() as u32;
        let mut size = 0;
        while let Some(member) = self.open.pop() {
            self.found.of_node[member as usize] = row;
            size += 1;
            if member == node {
                break;
            }
        }
        self.found.sizes.push(size);
    }
}

/// Reports components of several nodes that have only arcs in, or only arcs out. Single nodes are
/// dead ends.
pub(super) fn check(arcs: &Arcs, components: &Components, findings: &mut Findings) {
    let count = components.sizes.len();
    let (mut entered, mut left, mut first) =
        (vec![false; count], vec![false; count], vec![NONE; count]);
    for arc in &arcs.all {
        let [from, to] = [arc.from, arc.to].map(|node| components.of_node[node as usize] as usize);
        if from != to {
            left[from] = true;
            entered[to] = true;
        }
    }
    for (node, &row) in components.of_node.iter().enumerate().rev() {
        if row != NONE {
            first[row as usize] = node as u32;
        }
    }
    for row in 0..count {
        let nodes = components.sizes[row];
        if nodes >= 2 && entered[row] != left[row] && !components.is_main[row] {
            let can_enter = entered[row];
            let detail = Detail::OneWay { nodes, can_enter };
            findings.add(Code::OneWayPart, Member::Node(first[row]), detail);
        }
    }
}
