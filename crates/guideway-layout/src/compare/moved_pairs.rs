//! [`ElementPairs`]: matches the elements of two layouts by identifier and place, and those that
//! were renamed and moved by the elements around them.

use std::collections::{HashMap, HashSet};

use guideway_spline::Point;

use super::difference::CompareOptions;
use super::element_pairs::{level_id, match_nodes, match_paths, match_stations};
use super::row_pairs::RowPairs;
use crate::Layout;

/// Largest distance by which an element moves that is known by its place only, in meters.
const REACH_M: f64 = 1.0;

/// Elements in a square of [`REACH_M`] beyond which none is known by its place.
const MAX_IN_CELL: usize = 64;

/// Pairs of nodes, paths and stations.
pub(super) struct ElementPairs {
    pub(super) nodes: RowPairs,
    pub(super) paths: RowPairs,
    pub(super) stations: RowPairs,
}

impl ElementPairs {
    /// Matches the elements of two layouts.
    pub(super) fn of(layouts: [&Layout; 2], options: &CompareOptions) -> Self {
        let mut pairs = Self {
            nodes: match_nodes(layouts, options),
            paths: match_paths(layouts, options),
            stations: match_stations(layouts, options),
        };
        if pairs.nodes.has_rest() {
            pairs.match_nodes_by_paths(layouts);
            pairs.match_nodes_by_neighbors(layouts);
            match_near(&mut pairs.nodes, |i, row| {
                let nodes = &layouts[i].nodes;
                Some((
                    nodes.position_m(row),
                    level_id(layouts[i], nodes.level(row)),
                ))
            });
        }
        if pairs.paths.has_rest() {
            pairs.match_paths_by_nodes(layouts);
        }
        if pairs.stations.has_rest() {
            pairs.match_stations_by_nodes(layouts);
            match_near(&mut pairs.stations, |i, row| {
                let stations = &layouts[i].stations;
                let level = level_id(layouts[i], stations.level(row));
                Some((stations.position_m(row)?, level))
            });
        }
        pairs
    }

    /// Matches nodes at the same ends of the same paths.
    fn match_nodes_by_paths(&mut self, [a, b]: [&Layout; 2]) {
        let added: HashSet<u32> = self.nodes.added().iter().copied().collect();
        let mut candidates = Vec::new();
        for (p, q) in self.paths.pairs() {
            let (p, q) = (a.paths.get(p as usize), b.paths.get(q as usize));
            for ends in [
                [p.start_node(), q.start_node()],
                [p.end_node(), q.end_node()],
            ] {
                if let [Some(old), Some(new)] = ends
                    && self.nodes.partner(old).is_none()
                    && added.contains(&new)
                {
                    candidates.push((old, new));
                }
            }
        }
        self.nodes.match_candidates(candidates);
    }

    /// Matches nodes whose paths lead to the same nodes, two or more.
    fn match_nodes_by_neighbors(&mut self, [a, b]: [&Layout; 2]) {
        let added: HashSet<u32> = self.nodes.added().iter().copied().collect();
        let old_rows = self.nodes.inverse(b.nodes.len());
        let is_matched = |row: u32| self.nodes.partner(row).is_some();
        let of_a = neighbors(
            a,
            |row| !is_matched(row),
            |row| Some(row).filter(|&r| is_matched(r)),
        );
        let of_b = neighbors(b, |row| added.contains(&row), |row| old_rows[row as usize]);
        self.nodes
            .match_rest(|row| of_a.get(&row), |row| of_b.get(&row));
    }

    /// Matches paths on the same level between the same nodes.
    fn match_paths_by_nodes(&mut self, [a, b]: [&Layout; 2]) {
        let old_rows = self.nodes.inverse(b.nodes.len());
        let nodes = &self.nodes;
        let old_row = |row: u32| nodes.partner(row).map(|_| row);
        self.paths.match_rest(
            |row| {
                let path = a.paths.get(row as usize);
                let ends = (old_row(path.start_node()?)?, old_row(path.end_node()?)?);
                Some((ends, level_id(a, path.level())))
            },
            |row| {
                let path = b.paths.get(row as usize);
                let old = |node: u32| old_rows[node as usize];
                let ends = (old(path.start_node()?)?, old(path.end_node()?)?);
                Some((ends, level_id(b, path.level())))
            },
        );
    }

    /// Matches stations with the same nodes.
    fn match_stations_by_nodes(&mut self, [a, b]: [&Layout; 2]) {
        let old_rows = self.nodes.inverse(b.nodes.len());
        let nodes = &self.nodes;
        let key = |rows: &[u32], old: &dyn Fn(u32) -> Option<u32>| {
            let rows: Option<Vec<u32>> = rows.iter().map(|&row| old(row)).collect();
            rows.filter(|rows| !rows.is_empty())
        };
        self.stations.match_rest(
            |row| {
                key(a.stations.nodes(row), &|node| {
                    nodes.partner(node).map(|_| node)
                })
            },
            |row| key(b.stations.nodes(row), &|node| old_rows[node as usize]),
        );
    }
}

/// The old rows of the neighbors of each node of the rest, in order, each with the side of the path
/// at which the node is; those of nodes with two neighbors or more that all have a partner.
fn neighbors(
    layout: &Layout,
    is_rest: impl Fn(u32) -> bool,
    old_row: impl Fn(u32) -> Option<u32>,
) -> HashMap<u32, Vec<(u32, usize)>> {
    let mut of_nodes: HashMap<u32, Option<Vec<(u32, usize)>>> = HashMap::new();
    for path in layout.paths.iter() {
        let (Some(start), Some(end)) = (path.start_node(), path.end_node()) else {
            continue;
        };
        for (side, (node, other)) in [(start, end), (end, start)].into_iter().enumerate() {
            if node == other || !is_rest(node) {
                continue;
            }
            let list = of_nodes.entry(node).or_insert_with(|| Some(Vec::new()));
            match (old_row(other), &mut *list) {
                (Some(row), Some(list)) => list.push((row, side)),
                _ => *list = None,
            }
        }
    }
    let whole = of_nodes.into_iter().filter_map(|(node, list)| {
        let mut list = list?;
        list.sort_unstable();
        list.dedup();
        let is_between = list.iter().any(|(row, _)| *row != list[0].0);
        is_between.then_some((node, list))
    });
    whole.collect()
}

/// Matches elements on the same level within [`REACH_M`] of each other, where no other one is.
/// `place` returns the place of a row of the first or second table.
fn match_near<'a>(
    pairs: &mut RowPairs,
    place: impl Fn(usize, u32) -> Option<(Point<f64>, Option<&'a str>)>,
) {
    let cell = |at: Point<f64>| [at.x, at.y].map(|v| (v / REACH_M).floor() as i64);
    let mut cells: HashMap<[i64; 2], Vec<u32>> = HashMap::new();
    for &row in pairs.added() {
        if let Some((at, _)) = place(1, row) {
            cells.entry(cell(at)).or_default().push(row);
        }
    }
    let mut candidates = Vec::new();
    for row in pairs.removed() {
        let Some((at, level)) = place(0, row) else {
            continue;
        };
        let [x, y] = cell(at);
        let around = (-1..=1).flat_map(|dx| (-1..=1).map(move |dy| [dx, dy]));
        let around =
            around.filter_map(|[dx, dy]| cells.get(&[x.saturating_add(dx), y.saturating_add(dy)]));
        let sparse = around.filter(|rows| rows.len() <= MAX_IN_CELL);
        let near = sparse.flatten().filter(|&&other| {
            let other = place(1, other);
            other.is_some_and(|(to, of)| of == level && to.distance(at) <= REACH_M)
        });
        candidates.extend(near.map(|&other| (row, other)));
    }
    pairs.match_candidates(candidates);
}
