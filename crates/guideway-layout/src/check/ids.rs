use std::collections::HashMap;

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
