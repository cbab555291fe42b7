//! Identifiers that occur more than once, in one layout or across several.

use std::collections::{HashMap, HashSet};

use super::element::element_place;
use crate::{Code, Diagnostics, Layout};

/// Reports identifiers that several paths, nodes or stations of one layout share.
pub(super) fn check(layout: &Layout, found: &mut Diagnostics) {
    let paths = &layout.paths;
    for (id, rows) in repeated(paths.len(), |row| paths.id(row)) {
        report("path", id, &rows, found);
    }
    let nodes = &layout.nodes;
    for (id, rows) in repeated(nodes.len(), |row| nodes.id(row as u32)) {
        report("node", id, &rows, found);
    }
    let stations = &layout.stations;
    for (id, rows) in repeated(stations.len(), |row| stations.id(row as u32)) {
        report("station", id, &rows, found);
    }
}

/// The rows of every identifier that several rows share, in order of their first row.
fn repeated<'a>(rows: usize, id: impl Fn(usize) -> &'a str) -> Vec<(&'a str, Vec<usize>)> {
    let mut first_rows = HashMap::with_capacity(rows);
    let mut groups: HashMap<&str, Vec<usize>> = HashMap::new();
    for row in (0..rows).filter(|&row| !id(row).is_empty()) {
        let first = *first_rows.entry(id(row)).or_insert(row);
        if first != row {
            let group = groups.entry(id(row)).or_insert_with(|| vec![first]);
            group.push(row);
        }
    }
    let mut groups: Vec<_> = groups.into_iter().collect();
    groups.sort_unstable_by_key(|(_, rows)| rows[0]);
    groups
}

fn report(kind: &str, id: &str, rows: &[usize], found: &mut Diagnostics) {
    found.push(
        Code::DuplicateId,
        || element_place(kind, rows[0], id),
        || {
            let (count, first, second) = (rows.len(), rows[0] + 1, rows[1] + 1);
            format!("{count} {kind}s share this identifier; the first are {first} and {second}")
        },
        "Give each a unique identifier",
    );
}

/// Checks identifiers across layouts: tools that read the layouts together treat equal identifiers
/// as one element.
///
/// Returns the findings of each layout: its identifiers that an earlier layout has too, each once.
pub fn check_across(layouts: &[&Layout]) -> Vec<Diagnostics> {
    if layouts.len() < 2 {
        return vec![Diagnostics::default(); layouts.len()];
    }
    let mut first_layouts: HashMap<(&str, &str), usize> = HashMap::new();
    let mut found = Vec::with_capacity(layouts.len());
    for (own, layout) in layouts.iter().enumerate() {
        let mut of_layout = Diagnostics::default();
        let mut reported = HashSet::new();
        for (kind, row, id) in ids(layout).filter(|(_, _, id)| !id.is_empty()) {
            let first = *first_layouts.entry((kind, id)).or_insert(own);
            if first != own && reported.insert((kind, id)) {
                let source = &layouts[first].provenance.source;
                of_layout.push(
                    Code::DuplicateId,
                    || element_place(kind, row, id),
                    || format!("`{source}` has this identifier too"),
                    "Give each a unique identifier",
                );
            }
        }
        found.push(of_layout);
    }
    found
}

/// Every identifier with its kind and row.
fn ids(layout: &Layout) -> impl Iterator<Item = (&'static str, usize, &str)> {
    let (paths, nodes, stations) = (&layout.paths, &layout.nodes, &layout.stations);
    let paths = (0..paths.len()).map(|row| ("path", row, paths.id(row)));
    let nodes = (0..nodes.len()).map(|row| ("node", row, nodes.id(row as u32)));
    let stations = (0..stations.len()).map(|row| ("station", row, stations.id(row as u32)));
    paths.chain(nodes).chain(stations)
}
