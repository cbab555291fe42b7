//! Proposes the fixes of a finding.

use guideway_layout::Code;
use guideway_scene::Table;

use super::{Fix, ProposedFix};
use crate::PathSet;
use crate::document::Document;
use crate::element::Element;
use crate::elements::Elements;
use crate::text_format;

/// Widest gap that a weld is proposed for, in meters: a weld moves an end that far.
const WIDEST_WELD_M: f64 = 1.0;
/// Part by which the tolerance of a weld exceeds the gap that it closes.
const ROUNDING: f64 = 1e-6;

/// Returns `true` if findings of this kind may have fixes.
pub fn has_fixes(code: Code) -> bool {
    matches!(
        code,
        Code::NodeGap
            | Code::UnusedNode
            | Code::ZeroLength
            | Code::DuplicatePath
            | Code::DuplicateId
            | Code::DeadEnd
            | Code::HeadOn
            | Code::NotConnected
            | Code::OneWayPart
            | Code::UnreachableStation
    )
}

/// The edits that may resolve a finding about an element, the most likely one first.
pub fn fixes(document: &Document, code: Code, element: Element) -> Vec<ProposedFix> {
    if !document.contains(element) {
        return Vec::new();
    }
    let only = |label: &str, fix: Fix| {
        vec![ProposedFix {
            label: label.to_owned(),
            fix,
        }]
    };
    match (code, element) {
        (Code::NodeGap, Element::Path(path)) => only(
            "Move the ends of the path onto its nodes",
            Fix::AttachEnds(PathSet::from_iter([path])),
        ),
        (Code::UnusedNode, Element::Node(_)) => {
            only("Delete the node", Fix::Delete(Elements::of(element)))
        }
        (Code::ZeroLength | Code::DuplicatePath, Element::Path(_)) => {
            only("Delete the path", Fix::Delete(Elements::of(element)))
        }
        (Code::DuplicateId, _) => {
            let id = free_name(document, element);
            only(&format!("Rename it to {id}"), Fix::Rename { element, id })
        }
        (Code::DeadEnd, Element::Node(node)) => dead_end(document, node),
        (Code::HeadOn, Element::Node(node)) => reversals(document, node),
        (Code::HeadOn, Element::Path(path)) => {
            only("Reverse the path", Fix::Reverse(PathSet::from_iter([path])))
        }
        (Code::NotConnected, Element::Node(node)) => closures(document, node),
        (Code::OneWayPart, Element::Node(node)) => two_way(document, &[node]),
        (Code::UnreachableStation, Element::Station(station)) => {
            let nodes = document.layout().stations.nodes(station);
            two_way(document, nodes)
        }
        _ => Vec::new(),
    }
}

/// One edit that resolves all findings of a kind; `None` if each needs a decision.
pub fn fix_all(document: &Document, code: Code, elements: &[Element]) -> Option<ProposedFix> {
    let mut all = Elements::default();
    for &element in elements.iter().filter(|&&e| document.contains(e)) {
        all.insert(element);
    }
    let (label, fix) = match code {
        Code::NodeGap if !all.paths.is_empty() => (
            "Move the ends of all these paths onto their nodes",
            Fix::AttachEnds(all.paths),
        ),
        Code::UnusedNode if !all.nodes.is_empty() => ("Delete all these nodes", Fix::Delete(all)),
        Code::ZeroLength | Code::DuplicatePath if !all.paths.is_empty() => {
            ("Delete all these paths", Fix::Delete(all))
        }
        _ => return None,
    };
    let label = label.to_owned();
    Some(ProposedFix { label, fix })
}

/// A way back along the paths of a dead end, or on to the nearest node.
fn dead_end(document: &Document, node: u32) -> Vec<ProposedFix> {
    let mut found = two_way(document, &[node]);
    let mut known: PathSet = document.neighbors(node).into_iter().collect();
    known.insert(node);
    if let Some(gap) = document.gap_at(node, &known) {
        found.push(connection(document, gap.nodes, gap.distance_m));
    }
    found
}

/// The reversal of one of the one-way paths that end at a node.
fn reversals(document: &Document, node: u32) -> Vec<ProposedFix> {
    let reverse = |path: u32| ProposedFix {
        label: format!("Reverse {}", document.layout().paths.id(path as usize)),
        fix: Fix::Reverse(PathSet::from_iter([path])),
    };
    document.one_way_to(node).iter().map(reverse).collect()
}

/// A weld or a path over the smallest gap of a part.
fn closures(document: &Document, node: u32) -> Vec<ProposedFix> {
    let Some(gap) = document.gap_of_part(node) else {
        return Vec::new();
    };
    let mut found = Vec::new();
    let paths: PathSet = gap
        .nodes
        .into_iter()
        .flat_map(|node| document.paths_at(node))
        .collect();
    if gap.distance_m <= WIDEST_WELD_M && !paths.is_empty() {
        let [a, b] = gap.nodes.map(|node| document.layout().nodes.id(node));
        let length = text_format::length(gap.distance_m);
        found.push(ProposedFix {
            label: format!("Weld the gap of {length} between {a} and {b}"),
            fix: Fix::Weld {
                paths,
                tolerance_m: (gap.distance_m * (1.0 + ROUNDING)).max(ROUNDING),
            },
        });
    }
    if gap.distance_m > 0.0 {
        found.push(connection(document, gap.nodes, gap.distance_m));
    }
    found
}

fn connection(document: &Document, nodes: [u32; 2], distance_m: f64) -> ProposedFix {
    let [a, b] = nodes.map(|node| document.layout().nodes.id(node));
    let length = text_format::length(distance_m);
    ProposedFix {
        label: format!("Connect {a} and {b} by a two-way path of {length}"),
        fix: Fix::Connect {
            nodes,
            like: document.paths_at(nodes[0]).first().copied(),
        },
    }
}

/// The one-way paths at nodes as two-way ones.
fn two_way(document: &Document, nodes: &[u32]) -> Vec<ProposedFix> {
    let exists = |&&node: &&u32| document.has_row(Table::Nodes, node);
    let paths: PathSet = nodes
        .iter()
        .filter(exists)
        .flat_map(|&node| document.one_way_to(node))
        .collect();
    if paths.is_empty() {
        return Vec::new();
    }
    let label = match (paths.len(), paths.min()) {
        (1, Some(path)) => {
            let path = document.layout().paths.id(path as usize);
            format!("Make {path} two-way")
        }
        (count, _) => format!("Make the {count} paths that lead there two-way"),
    };
    let fix = Fix::MakeTwoWay(paths);
    vec![ProposedFix { label, fix }]
}

/// A name like that of the element which no other one has.
fn free_name(document: &Document, element: Element) -> String {
    let layout = document.layout();
    let (of, _) = element.table_row();
    let names: std::collections::HashSet<&str> = document
        .existing(of)
        .map(|row| of.id(layout, row))
        .collect();
    let id = element.id(layout);
    let numbered = (2..).map(|number| format!("{id}-{number}"));
    let mut free = numbered.filter(|name| !names.contains(&**name));
    free.next().unwrap_or_else(|| id.to_owned())
}
