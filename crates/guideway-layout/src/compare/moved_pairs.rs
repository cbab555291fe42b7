//! [`ElementPairs`]: matches the elements of two layouts by identifier and place, and those that
//! were renamed and moved by the elements around them.

use std::collections::{HashMap, HashSet};

use guideway_spline::Point;

use super::difference::CompareOptions;
use super::element_pairs::{
    PlaceKey, level_id, match_nodes, match_paths, match_stations, place_key,
};
use super::row_pairs::RowPairs;
use crate::Layout;

/// Largest distance by which an element moves that is known by its place only, in meters.
const REACH_M: f64 = 1.0;

/// Elements in a square of [`REACH_M`], or of one shape, beyond which none is known by its place.
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
            pairs.match_paths_by_shape(layouts, options);
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

    /// Matches paths without nodes of the same shape, on the same level, that are nearer to each
    /// other than they are long.
    fn match_paths_by_shape(&mut self, layouts: [&Layout; 2], options: &CompareOptions) {
        let mut rows: HashMap<ShapeKey<'_>, [Vec<u32>; 2]> = HashMap::new();
        for row in self.paths.removed() {
            let key = shape_key(layouts[0], row, options);
            key.into_iter()
                .for_each(|key| rows.entry(key).or_default()[0].push(row));
        }
        for &row in self.paths.added() {
            if let Some(rows) =
                shape_key(layouts[1], row, options).and_then(|key| rows.get_mut(&key))
            {
                rows[1].push(row);
            }
        }
        let mut candidates = Vec::new();
        for [of_a, of_b] in rows.into_values() {
            if of_a.len().max(of_b.len()) > MAX_IN_CELL {
                continue;
            }
            for &a in &of_a {
                let path = layouts[0].paths.get(a as usize);
                let reach_m = path.length_m().max(REACH_M);
                let is_near = |b: &&u32| {
                    let other = layouts[1].paths.get(**b as usize);
                    let starts = path.ends().zip(other.ends());
                    starts.is_some_and(|((p, _), (q, _))| p.distance(q) <= reach_m)
                };
                candidates.extend(of_b.iter().filter(is_near).map(|&b| (a, b)));
            }
        }
        self.paths.match_candidates(candidates);
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

/// The shape of a path, whatever its place: the lengths of its runs, its control points from the
/// first one on, and its level.
type ShapeKey<'a> = (Vec<usize>, Vec<PlaceKey>, Option<&'a str>);

/// The shape of a path; `None` if it has a node or no curve.
fn shape_key<'a>(layout: &'a Layout, row: u32, options: &CompareOptions) -> Option<ShapeKey<'a>> {
    let path = layout.paths.get(row as usize);
    if path.start_node().or(path.end_node()).is_some() {
        return None;
    }
    let first = path.runs().next()?.get(0);
    let points = path.runs().flat_map(|run| {
        let points: Vec<_> = run.iter().collect();
        points.into_iter().map(|p| place_key(p - first, options))
    });
    Some((
        path.runs().map(|run| run.len()).collect(),
        points.collect(),
        level_id(layout, path.level()),
    ))
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
