//! Identifiers that occur more than once, in one layout or across several.

use std::collections::{HashMap, HashSet};
use std::mem::Discriminant;

use super::element::element_place;
use crate::{Code, Diagnostics, Layout, Member, Value};

/// Reports identifiers that several paths, nodes or stations of one layout share.
pub(super) fn check(layout: &Layout, found: &mut Diagnostics) {
    let paths = &layout.paths;
    // OpenStreetMap numbers ways and relations by themselves.
    let is_osm = layout.provenance.format == "Lanelet2";
    let kind = |row: usize| match paths.attributes.value(row, "element") {
        Some(Value::Text(kind)) if is_osm => kind,
        _ => "",
    };
    for ((_, id), rows) in repeated(paths.len(), |row| (kind(row), paths.id(row))) {
        report(Member::Path, "path", id, &rows, found);
    }
    let nodes = &layout.nodes;
    for ((_, id), rows) in repeated(nodes.len(), |row| ("", nodes.id(row as u32))) {
        report(Member::Node, "node", id, &rows, found);
    }
    let stations = &layout.stations;
    for ((_, id), rows) in repeated(stations.len(), |row| ("", stations.id(row as u32))) {
        report(Member::Station, "station", id, &rows, found);
    }
}

/// A kind of element that has identifiers of its own, and an identifier.
type Key<'a> = (&'a str, &'a str);

/// The rows of every identifier that several rows share, in order of their first row.
fn repeated<'a>(rows: usize, key: impl Fn(usize) -> Key<'a>) -> Vec<(Key<'a>, Vec<usize>)> {
    let mut first_rows = HashMap::with_capacity(rows);
    let mut groups: HashMap<Key<'a>, Vec<usize>> = HashMap::new();
    for row in (0..rows).filter(|&row| !key(row).1.is_empty()) {
        let first = *first_rows.entry(key(row)).or_insert(row);
        if first != row {
            let group = groups.entry(key(row)).or_insert_with(|| vec![first]);
            group.push(row);
        }
    }
    let mut groups: Vec<_> = groups.into_iter().collect();
    groups.sort_unstable_by_key(|(_, rows)| rows[0]);
    groups
}

fn report(
    member: fn(u32) -> Member,
    kind: &str,
    id: &str,
    rows: &[usize],
    found: &mut Diagnostics,
) {
    found.push(
        Code::DuplicateId,
        || element_place(member(rows[0] as u32), id),
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
    let mut first_layouts: HashMap<(Discriminant<Member>, &str), usize> = HashMap::new();
    let mut found = Vec::with_capacity(layouts.len());
    for (own, layout) in layouts.iter().enumerate() {
        let mut of_layout = Diagnostics::default();
        let mut reported = HashSet::new();
        for (member, id) in ids(layout).filter(|(_, id)| !id.is_empty()) {
            let kind = std::mem::discriminant(&member);
            let first = *first_layouts.entry((kind, id)).or_insert(own);
            if first != own && reported.insert((kind, id)) {
                let source = &layouts[first].provenance.source;
                of_layout.push(
                    Code::DuplicateId,
                    || element_place(member, id),
                    || format!("`{source}` has this identifier too"),
                    "Give each a unique identifier",
                );
            }
        }
        layout.locate(&mut of_layout);
        found.push(of_layout);
    }
    found
}

/// Every element with its identifier.
fn ids(layout: &Layout) -> impl Iterator<Item = (Member, &str)> {
    let (paths, nodes, stations) = (&layout.paths, &layout.nodes, &layout.stations);
    let paths = (0..paths.len() as u32).map(|row| (Member::Path(row), paths.id(row as usize)));
    let nodes = (0..nodes.len() as u32).map(|row| (Member::Node(row), nodes.id(row)));
    let stations = 0..stations.len() as u32;
    let stations = stations.map(|row| (Member::Station(row), layout.stations.id(row)));
    paths.chain(nodes).chain(stations)
}
