use std::collections::{HashMap, HashSet};

use super::place::place;
use crate::{Code, Diagnostics, Layout};

/// Identifiers that are used more than once.
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

/// The rows of every identifier that more than one row has, in order of the first.
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
        || place(kind, rows[0], id),
        || {
            let (count, first, second) = (rows.len(), rows[0] + 1, rows[1] + 1);
            format!("{count} {kind}s have this identifier, first numbers {first} and {second}")
        },
        "Give each an identifier of its own",
    );
}

/// What an earlier layout has too, for each; what one has several times is told once.
pub(super) fn check_across(layouts: &[&Layout]) -> Vec<Diagnostics> {
    if layouts.len() < 2 {
        return vec![Diagnostics::default(); layouts.len()];
    }
    let mut first_layouts: HashMap<(&str, &str), usize> = HashMap::new();
    let mut found = Vec::with_capacity(layouts.len());
    for (own, layout) in layouts.iter().enumerate() {
        let mut of_layout = Diagnostics::default();
        let mut told = HashSet::new();
        for (kind, row, id) in ids(layout).filter(|(_, _, id)| !id.is_empty()) {
            let first = *first_layouts.entry((kind, id)).or_insert(own);
            if first != own && told.insert((kind, id)) {
                let source = &layouts[first].provenance.source;
                of_layout.push(
                    Code::DuplicateId,
                    || place(kind, row, id),
                    || format!("`{source}` has this identifier too"),
                    "Give each an identifier of its own",
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
