//! Graph plan: decides which parts of a layout become levels, vertices, lanes, doors and lifts of a
//! navigation graph, and under which names.

use std::borrow::Cow;
use std::collections::HashMap;

use guideway_layout::{Direction, Layout, Member, PathRef, Value};

use crate::driven::driven_nodes;
use crate::unique_names::UniqueNames;

/// Name of the level of a layout without levels.
const ONLY_LEVEL: &str = "L1";

/// Kind of a path in a navigation graph.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum PathKind {
    Lane,
    Door,
    /// A wall, a lane of humans, or a path that no lane can hold.
    Absent,
}

/// The parts of a navigation graph, as rows of a layout.
pub(super) struct GraphPlan<'l> {
    pub(super) levels: Vec<LevelPlan<'l>>,
    /// Index of each node among the vertices of its level; `None` for a node that is not written.
    pub(super) vertices: Vec<Option<usize>>,
    pub(super) kinds: Vec<PathKind>,
    pub(super) doors: Vec<(usize, Cow<'l, str>)>,
    pub(super) lifts: Vec<(u32, Cow<'l, str>)>,
    /// Lift of each node in one.
    pub(super) lift_of: HashMap<u32, usize>,
    /// Block of each element that is in one, as its row.
    pub(super) mutex_of: HashMap<Member, usize>,
    /// Nodes without a level, which are written on the first one.
    pub(super) without_level: usize,
    /// Elements that have another name than in the layout, because an earlier one has theirs.
    pub(super) renamed: Renamed,
}

/// Numbers of renamed elements.
#[derive(Default)]
pub(super) struct Renamed {
    pub(super) levels: usize,
    pub(super) nodes: usize,
    pub(super) doors: usize,
    pub(super) lifts: usize,
}

/// A level of a navigation graph.
pub(super) struct LevelPlan<'l> {
    pub(super) key: Cow<'l, str>,
    /// Row of the level in the layout; `None` for the only level of a layout without levels.
    pub(super) row: Option<usize>,
    /// Rows of its vertices, with their names.
    pub(super) vertices: Vec<(u32, Cow<'l, str>)>,
    /// Rows of its lanes.
    pub(super) lanes: Vec<usize>,
}

impl<'l> GraphPlan<'l> {
    pub(super) fn new(layout: &'l Layout) -> Self {
        let kinds: Vec<_> = layout.paths.iter().map(|path| kind(layout, path)).collect();
        let mut renamed = Renamed::default();
        let mut levels = levels(layout, &mut renamed.levels);
        let mut vertices = vec![None; layout.nodes.len()];
        let is_written = written_nodes(layout);
        let ids = (0..layout.nodes.len() as u32).filter(|&node| is_written[node as usize]);
        let mut names = UniqueNames::new(ids.clone().map(|node| layout.nodes.id(node)));
        let mut without_level = 0;
        for node in ids {
            let id = layout.nodes.id(node);
            let level = &mut levels[level_of(layout, node)];
            let index = level.vertices.len();
            vertices[node as usize] = Some(index);
            // The reader gives this name to a vertex without one.
            let is_unnamed = id == format!("{}.vertices[{index}]", level.key);
            let name = match is_unnamed {
                true => Cow::Borrowed(""),
                false => names.take(id),
            };
            let is_kept = is_unnamed || name == id;
            without_level += usize::from(is_kept && layout.nodes.level(node).is_none());
            level.vertices.push((node, name));
        }
        renamed.nodes = names.renamed;
        for path in layout.paths.iter() {
            if let (PathKind::Lane, Some(node)) = (kinds[path.row()], path.start_node()) {
                levels[level_of(layout, node)].lanes.push(path.row());
            }
        }
        let doors = (0..layout.paths.len()).filter(|&row| kinds[row] == PathKind::Door);
        let doors = named(doors, |row| layout.paths.id(row), &mut renamed.doors);
        let lifts = (0..layout.stations.len() as u32).filter(|&row| is_lift(layout, row));
        let lifts = named(lifts, |row| layout.stations.id(row), &mut renamed.lifts);
        let mut lift_of = HashMap::new();
        for (lift, (station, _)) in lifts.iter().enumerate() {
            for &node in layout.stations.nodes(*station) {
                lift_of.entry(node).or_insert(lift);
            }
        }
        let mut mutex_of = HashMap::new();
        for (row, block) in layout.blocks.iter().enumerate() {
            for &member in block.members.iter().filter(|_| !block.id.is_empty()) {
                mutex_of.entry(member).or_insert(row);
            }
        }
        Self {
            levels,
            vertices,
            kinds,
            doors,
            lifts,
            lift_of,
            mutex_of,
            without_level,
            renamed,
        }
    }

    /// Indices of the vertices of a lane.
    pub(super) fn ends(&self, path: PathRef<'_>) -> Option<[usize; 2]> {
        let vertex = |node: Option<u32>| self.vertices[node? as usize];
        Some([vertex(path.start_node())?, vertex(path.end_node())?])
    }

    /// Identifiers of the lanes against the direction of two-way paths.
    pub(super) fn reverse_ids(&self, layout: &'l Layout) -> HashMap<usize, String> {
        let mut names = UniqueNames::new(layout.paths.iter().map(PathRef::id));
        let lanes = layout.paths.iter();
        let lanes = lanes.filter(|path| self.kinds[path.row()] == PathKind::Lane);
        let two_way = lanes.filter(|path| path.direction() == Direction::Both);
        two_way
            .map(|path| (path.row(), names.make_unique(path.id())))
            .collect()
    }
}

/// Gives each row a name of its own.
fn named<'l, R: Copy>(
    rows: impl Iterator<Item = R> + Clone,
    id: impl Fn(R) -> &'l str,
    renamed: &mut usize,
) -> Vec<(R, Cow<'l, str>)> {
    let mut names = UniqueNames::new(rows.clone().map(&id));
    let named = rows.map(|row| (row, names.take(id(row)))).collect();
    *renamed += names.renamed;
    named
}

fn kind(layout: &Layout, path: PathRef<'_>) -> PathKind {
    let element = layout.paths.attributes.value(path.row(), "element");
    if element == Some(Value::Text("door")) && path.ends().is_some() {
        return PathKind::Door;
    }
    let level = |node: Option<u32>| node.map(|node| level_of(layout, node));
    let levels = [path.start_node(), path.end_node()].map(level);
    let is_on_one_level = levels[0].is_some() && levels[0] == levels[1];
    match layout.paths.is_driven(path.row()) && path.runs().len() > 0 && is_on_one_level {
        true => PathKind::Lane,
        false => PathKind::Absent,
    }
}

/// Index of the level on which a node is written.
fn level_of(layout: &Layout, node: u32) -> usize {
    layout.nodes.level(node).unwrap_or(0) as usize
}

fn levels<'l>(layout: &'l Layout, renamed: &mut usize) -> Vec<LevelPlan<'l>> {
    let rows = 0..layout.levels.len();
    let named = named(rows, |row| layout.levels[row].id.as_str(), renamed);
    let level = |(row, key)| LevelPlan {
        key,
        row: Some(row),
        vertices: Vec::new(),
        lanes: Vec::new(),
    };
    let mut levels: Vec<_> = named.into_iter().map(level).collect();
    if levels.is_empty() {
        levels.push(LevelPlan {
            key: Cow::Borrowed(ONLY_LEVEL),
            row: None,
            vertices: Vec::new(),
            lanes: Vec::new(),
        });
    }
    levels
}

/// Returns for each node whether it is a vertex: those that vehicles may reach, and those in lifts.
fn written_nodes(layout: &Layout) -> Vec<bool> {
    let mut is_written = driven_nodes(layout);
    let lifts = (0..layout.stations.len() as u32).filter(|&row| is_lift(layout, row));
    for &node in lifts.flat_map(|lift| layout.stations.nodes(lift)) {
        is_written[node as usize] = true;
    }
    is_written
}

/// Returns whether a station is a lift with place and size, which the fleet adapter requires.
pub(super) fn is_lift(layout: &Layout, station: u32) -> bool {
    let stations = &layout.stations;
    let value = |name| stations.attributes.value(station as usize, name);
    let is_number = |name| matches!(value(name), Some(Value::Float(_) | Value::Int(_)));
    value("kind") == Some(Value::Text("lift"))
        && stations.position_m(station).is_some()
        && is_number("width")
        && is_number("depth")
}
