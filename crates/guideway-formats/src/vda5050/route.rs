//! Routes: orders the paths of a layout as one walk from node to node, as an order needs it.

use std::borrow::Cow;
use std::collections::{HashMap, HashSet};

use guideway_layout::{Layout, PathRef, Value};
use guideway_spline::Point;

use super::members::{DERIVED, ORDER, PASSES, SEQUENCE};
use super::version::Version;
use crate::WriteProblem;
use crate::json::items_at;
use crate::unique_names::UniqueNames;

/// Largest distance of path ends without nodes that meet, in meters.
const JOIN_TOLERANCE_M: f64 = 1e-3;

/// Map of nodes without a level.
const MAP: &str = "map";

/// The paths of a layout as one walk.
pub(super) struct Route<'a> {
    pub(super) edges: Vec<RouteEdge>,
    /// One place more than edges.
    pub(super) places: Vec<RoutePlace<'a>>,
    /// Nodes that were renamed because another one has their name.
    pub(super) renamed: usize,
}

/// A path of a route.
pub(super) struct RouteEdge {
    pub(super) row: usize,
    pub(super) sequence: u64,
}

/// A node of a route, once per pass.
pub(super) struct RoutePlace<'a> {
    /// Row of the node; `None` for a path end without a node.
    pub(super) node: Option<usize>,
    pub(super) id: Cow<'a, str>,
    pub(super) position_m: Point<f64>,
    pub(super) map: Option<&'a str>,
    pub(super) sequence: u64,
    /// True if the route passed the node before.
    pub(super) is_repeated: bool,
    /// Members of this pass, if they are not those of the row.
    pub(super) pass: Option<&'a str>,
    /// True if the position follows from a trajectory.
    pub(super) is_derived: bool,
}

/// An end of a path.
#[derive(Clone, Copy)]
struct End {
    node: Option<u32>,
    position_m: Point<f64>,
}

impl End {
    fn of(layout: &Layout, node: Option<u32>, end: Point<f64>) -> Self {
        let position_m = node.map_or(end, |node| layout.nodes.position_m(node));
        Self { node, position_m }
    }

    fn joins(self, next: Self) -> bool {
        match (self.node, next.node) {
            (Some(node), Some(next)) => node == next,
            _ => self.position_m.distance(next.position_m) <= JOIN_TOLERANCE_M,
        }
    }

    fn describe(self, layout: &Layout) -> String {
        match self.node {
            Some(node) => format!("at the node `{}`", layout.nodes.id(node)),
            None => format!("at ({}, {})", self.position_m.x, self.position_m.y),
        }
    }
}

impl<'a> Route<'a> {
    /// Orders the paths by `sequenceId`, else in the order of the table.
    ///
    /// # Errors
    /// When the paths do not form one walk.
    pub(super) fn of(layout: &'a Layout, version: Version) -> Result<Self, WriteProblem> {
        let drawn = layout.paths.iter().filter(|path| path.ends().is_some());
        let rows: Vec<usize> = drawn.map(PathRef::row).collect();
        // The orders of a log keep their headers in columns of their paths.
        let is_order = Version::of_layout(layout).is_some();
        let mut orders = rows.iter().map(|&row| layout.paths.value(row, ORDER));
        if is_order && orders.any(|order| order.is_some()) {
            return Err(WriteProblem::NotARoute {
                detail: "the paths are of several orders; a file holds one".to_owned(),
            });
        }
        let mut error = None;
        for rows in [by_sequence(layout, &rows), Some(rows)]
            .into_iter()
            .flatten()
        {
            match walk(layout, &rows) {
                Ok(ends) => return Ok(Self::new(layout, version, &rows, &ends)),
                Err(found) => error = error.or(Some(found)),
            }
        }
        Err(error.unwrap_or_else(no_paths))
    }

    fn new(layout: &'a Layout, version: Version, rows: &[usize], ends: &[End]) -> Self {
        let is_order = Version::of_layout(layout).is_some();
        let mut passed = HashSet::new();
        let is_repeated = ends
            .iter()
            .map(|end| end.node.is_some_and(|node| !passed.insert(node)));
        let is_repeated: Vec<bool> = is_repeated.collect();
        let sequence = kept_sequence(layout, version, rows, ends);
        let sequence = sequence.unwrap_or_else(|| (0..=2 * rows.len() as u64).collect());
        let firsts = ends.iter().zip(&is_repeated).filter(|(_, again)| !**again);
        let nodes = firsts.filter_map(|(end, _)| end.node);
        let mut names = UniqueNames::new(nodes.map(|node| layout.nodes.id(node)));
        let mut ids: HashMap<u32, Cow<'a, str>> = HashMap::new();
        // A node that is passed again stays on its map: on another one it would be another node.
        let mut maps: HashMap<u32, Option<&'a str>> = HashMap::new();
        let mut new_nodes = 0;
        let mut places = Vec::with_capacity(ends.len());
        for (i, end) in ends.iter().enumerate() {
            let id = match end.node {
                Some(node) if is_order => Cow::Borrowed(layout.nodes.id(node)),
                Some(node) => {
                    let name = || names.take(layout.nodes.id(node));
                    ids.entry(node).or_insert_with(name).clone()
                }
                None => {
                    new_nodes += 1;
                    names.make_unique(&format!("node {new_nodes}")).into()
                }
            };
            let around = [rows.get(i), i.checked_sub(1).and_then(|i| rows.get(i))];
            let around = around.map(|row| Some(layout.paths.get(*row?)));
            let map = || map_of(layout, end.node, around, is_order);
            let map = match end.node {
                Some(node) => *maps.entry(node).or_insert_with(map),
                None => map(),
            };
            places.push(RoutePlace {
                node: end.node.map(|node| node as usize),
                id,
                position_m: end.position_m,
                map,
                sequence: sequence[2 * i],
                is_repeated: is_repeated[i],
                pass: end
                    .node
                    .and_then(|node| pass_with(layout, node, sequence[2 * i])),
                is_derived: is_order && is_derived(layout, end, around),
            });
        }
        let edges = rows.iter().enumerate();
        Self {
            edges: edges
                .map(|(i, &row)| RouteEdge {
                    row,
                    sequence: sequence[2 * i + 1],
                })
                .collect(),
            places,
            renamed: if is_order { 0 } else { names.renamed },
        }
    }

    /// Returns whether an edge connects two maps.
    pub(super) fn is_between_maps(&self, edge: usize) -> bool {
        let [from, to] = [&self.places[edge], &self.places[edge + 1]].map(|place| place.map);
        from.zip(to).is_some_and(|(from, to)| from != to)
    }
}

/// Sorts the paths by `sequenceId`; `None` if one has none, or two have the same.
fn by_sequence(layout: &Layout, rows: &[usize]) -> Option<Vec<usize>> {
    let mut keyed = Vec::with_capacity(rows.len());
    for &row in rows {
        keyed.push((sequence_of(layout.paths.value(row, SEQUENCE))?, row));
    }
    keyed.sort_unstable();
    let is_unique = keyed.windows(2).all(|pair| pair[0].0 != pair[1].0);
    is_unique.then(|| keyed.into_iter().map(|(_, row)| row).collect())
}

fn sequence_of(value: Option<Value<'_>>) -> Option<u64> {
    match value {
        Some(Value::Int(number)) => u64::try_from(number).ok(),
        _ => None,
    }
}

/// Returns the ends that the paths pass, in order.
fn walk(layout: &Layout, rows: &[usize]) -> Result<Vec<End>, WriteProblem> {
    let mut ends: Vec<End> = Vec::with_capacity(rows.len() + 1);
    let mut before = None;
    for path in rows.iter().map(|&row| layout.paths.get(row)) {
        let Some((from, to)) = path.ends() else {
            continue;
        };
        let start = End::of(layout, path.start_node(), from);
        match (ends.last_mut(), before) {
            (Some(last), Some(before)) => {
                if !last.joins(start) {
                    return Err(gap(layout, before, path, *last, start));
                }
                if last.node.is_none() {
                    *last = start;
                }
            }
            _ => ends.push(start),
        }
        ends.push(End::of(layout, path.end_node(), to));
        before = Some(path);
    }
    if ends.is_empty() && layout.nodes.len() == 1 {
        ends.push(End::of(layout, Some(0), layout.nodes.position_m(0)));
    }
    match ends.is_empty() {
        true => Err(no_paths()),
        false => Ok(ends),
    }
}

fn no_paths() -> WriteProblem {
    WriteProblem::NotARoute {
        detail: "the layout has no path that is drawn".to_owned(),
    }
}

fn gap(
    layout: &Layout,
    before: PathRef<'_>,
    path: PathRef<'_>,
    end: End,
    start: End,
) -> WriteProblem {
    WriteProblem::NotARoute {
        detail: format!(
            "path `{}` ends {}, but the next path `{}` begins {}",
            before.id(),
            end.describe(layout),
            path.id(),
            start.describe(layout)
        ),
    }
}

/// Returns the numbers of the layout, node and edge by turns, if they rise. From 3.0 on they must
/// be consecutive, because they connect edges and nodes.
fn kept_sequence(
    layout: &Layout,
    version: Version,
    rows: &[usize],
    ends: &[End],
) -> Option<Vec<u64>> {
    let mut all: Vec<u64> = Vec::with_capacity(2 * rows.len() + 1);
    let is_next = |last: Option<&u64>, number: u64| match (last, version) {
        (None, _) => true,
        (Some(&last), Version::V2) => number > last,
        (Some(&last), Version::V3) => number == last + 1,
    };
    for (i, end) in ends.iter().enumerate() {
        let node = end.node?;
        let own = sequence_of(layout.nodes.attributes.value(node as usize, SEQUENCE));
        let passes = passes(layout, node).into_iter();
        let numbers = own
            .into_iter()
            .chain(passes.filter_map(|(number, _)| number));
        let number = numbers.filter(|&number| is_next(all.last(), number)).min();
        all.push(number?);
        if let Some(&row) = rows.get(i) {
            let number = sequence_of(layout.paths.value(row, SEQUENCE))?;
            if !is_next(all.last(), number) {
                return None;
            }
            all.push(number);
        }
    }
    Some(all)
}

/// Returns the further passes of a node, each with its `sequenceId`.
pub(super) fn passes(layout: &Layout, node: u32) -> Vec<(Option<u64>, &str)> {
    let Some(Value::Json(text)) = layout.nodes.attributes.value(node as usize, PASSES) else {
        return Vec::new();
    };
    let passes = items_at(text, 0).into_iter().map(|item| &text[item]);
    let with_number = |pass| {
        let range = crate::json::member(pass, 0, SEQUENCE);
        let number = range.and_then(|range| pass[range].parse().ok());
        (number, pass)
    };
    passes.map(with_number).collect()
}

fn pass_with(layout: &Layout, node: u32, sequence: u64) -> Option<&str> {
    let mut passes = passes(layout, node).into_iter();
    passes
        .find(|(number, _)| *number == Some(sequence))
        .map(|(_, pass)| pass)
}

fn map_of<'a>(
    layout: &'a Layout,
    node: Option<u32>,
    around: [Option<PathRef<'a>>; 2],
    is_order: bool,
) -> Option<&'a str> {
    let id = |level: u32| layout.levels.get(level as usize).map(|l| l.id.as_str());
    let row = node.map(|node| node as usize);
    if let Some(Value::Text(map)) = row.and_then(|r| layout.nodes.attributes.value(r, "mapId")) {
        return Some(map);
    }
    let own = node.and_then(|node| layout.nodes.level(node)).and_then(id);
    if own.is_some() || is_order {
        return own;
    }
    let of_paths = around.into_iter().flatten().find_map(PathRef::level);
    of_paths.and_then(id).or(Some(MAP))
}

/// Returns whether the position of a node without one in its file is still the end of a path.
fn is_derived(layout: &Layout, end: &End, [next, before]: [Option<PathRef<'_>>; 2]) -> bool {
    let row = end.node.map(|node| node as usize);
    let value = row.and_then(|row| layout.nodes.attributes.value(row, DERIVED));
    let ends = [
        next.and_then(|path| Some(path.ends()?.0)),
        before.and_then(|path| Some(path.ends()?.1)),
    ];
    let mut ends = ends.into_iter().flatten();
    value == Some(Value::Bool(true))
        && ends.any(|p| p.distance(end.position_m) <= crate::clamped::POSITION_STEP_M)
}
