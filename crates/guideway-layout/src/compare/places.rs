//! Differences of nodes and stations.

use guideway_spline::Point;

use super::columns::compare_row;
use super::difference::{CompareOptions, Differences};
use super::element_pairs::level_id;
use super::row_pairs::RowPairs;
use crate::Layout;

/// Compares the nodes of two layouts.
pub(super) fn compare_nodes(
    [a, b]: [&Layout; 2],
    pairs: &RowPairs,
    options: &CompareOptions,
    found: &mut Differences,
) {
    for row in pairs.removed() {
        found.add("nodes", || format!("node `{}` is lost", a.nodes.id(row)));
    }
    for &row in pairs.added() {
        found.add("new nodes", || format!("node `{}` is new", b.nodes.id(row)));
    }
    for (p, q) in pairs.pairs() {
        let name = || format!("node `{}`", a.nodes.id(p));
        if pairs.is_by_order() {
            found.add("identifiers", || {
                format!("{} is now `{}`", name(), b.nodes.id(q))
            });
        }
        let positions = [a.nodes.position_m(p), b.nodes.position_m(q)].map(Some);
        compare_positions(positions, name, options, found);
        compare_levels([a, b], [a.nodes.level(p), b.nodes.level(q)], name, found);
        let rows = [
            (&a.nodes.attributes, p as usize),
            (&b.nodes.attributes, q as usize),
        ];
        compare_row(rows, name, options, found);
        let [before, after] = [(a, p), (b, q)].map(|(layout, row)| {
            let types = layout.nodes.vehicle_types();
            let entries = types.entries(row as usize);
            let mut entries: Vec<_> = entries.map(|e| (types.type_of(e), e)).collect();
            entries.sort_unstable();
            entries
        });
        let type_names = |entries: &[(&str, usize)]| -> Vec<String> {
            entries.iter().map(|(name, _)| (*name).to_owned()).collect()
        };
        if type_names(&before) != type_names(&after) {
            found.add("vehicle types", name);
            continue;
        }
        for ((_, p), (_, q)) in before.into_iter().zip(after) {
            let attributes = [a, b].map(|layout| &layout.nodes.vehicle_types().attributes);
            compare_row(
                [(attributes[0], p), (attributes[1], q)],
                name,
                options,
                found,
            );
        }
    }
}

/// Compares the stations of two layouts.
pub(super) fn compare_stations(
    [a, b]: [&Layout; 2],
    pairs: &RowPairs,
    nodes: &RowPairs,
    options: &CompareOptions,
    found: &mut Differences,
) {
    for row in pairs.removed() {
        found.add("stations", || {
            format!("station `{}` is lost", a.stations.id(row))
        });
    }
    for &row in pairs.added() {
        found.add("new stations", || {
            format!("station `{}` is new", b.stations.id(row))
        });
    }
    for (p, q) in pairs.pairs() {
        let name = || format!("station `{}`", a.stations.id(p));
        if pairs.is_by_order() {
            found.add("identifiers", || {
                format!("{} is now `{}`", name(), b.stations.id(q))
            });
        }
        let positions = [a.stations.position_m(p), b.stations.position_m(q)];
        compare_positions(positions, name, options, found);
        compare_levels(
            [a, b],
            [a.stations.level(p), b.stations.level(q)],
            name,
            found,
        );
        let expected = a.stations.nodes(p).iter().map(|&node| nodes.partner(node));
        let actual = b.stations.nodes(q).iter().map(|&node| Some(node));
        if !expected.eq(actual) {
            found.add("ends", || format!("{} has other nodes", name()));
        }
        let rows = [
            (&a.stations.attributes, p as usize),
            (&b.stations.attributes, q as usize),
        ];
        compare_row(rows, name, options, found);
    }
}

fn compare_positions(
    positions: [Option<Point<f64>>; 2],
    name: impl Fn() -> String,
    options: &CompareOptions,
    found: &mut Differences,
) {
    let are_equal = match positions {
        [Some(p), Some(q)] => p.distance(q) <= options.tolerance_m,
        [p, q] => p.is_none() && q.is_none(),
    };
    if !are_equal {
        let [before, after] = positions;
        found.add("positions", || {
            format!("{} is at {after:?} instead of {before:?}", name())
        });
    }
}

fn compare_levels(
    layouts: [&Layout; 2],
    levels: [Option<u32>; 2],
    name: impl Fn() -> String,
    found: &mut Differences,
) {
    let [before, after] = [0, 1].map(|i| level_id(layouts[i], levels[i]));
    if before != after {
        found.add("levels", || {
            format!("{} is on {after:?} instead of {before:?}", name())
        });
    }
}
