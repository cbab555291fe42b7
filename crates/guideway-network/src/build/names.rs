//! Names: makes stations of the notes of a drawing, and gives nodes the names of notes.
//!
//! A note belongs to the nearest node within its reach, else to the nearest line, which is cut
//! there.

use std::collections::hash_map::Entry;
use std::collections::{BTreeSet, HashMap};

use guideway_layout::{Layout, Note, NoteKind};
use guideway_spline::Point;
use guideway_spline::bezier::nearest;
use rstar::primitives::GeomWithData;
use rstar::{PointDistance, RTree};

use super::box_index::{BoxIndex, Part};
use super::drawn::Drawn;
use super::junctions::Cut;
use super::weld::Nodes;
use super::{BuildError, BuildOptions, BuildReport, NoteSource, UnmatchedSource};

/// Layers or blocks that are told where no note fits a source.
const MAX_PRESENT: usize = 5;

/// A station to make.
#[derive(Clone, Debug)]
pub(super) struct NewStation {
    pub(super) id: String,
    pub(super) position_m: Point<f64>,
    pub(super) node: u32,
    pub(super) layer: String,
}

/// Stations and names of nodes.
#[derive(Default)]
pub(super) struct Named {
    pub(super) stations: Vec<NewStation>,
    pub(super) nodes: HashMap<u32, String>,
    /// Node of each name.
    names: HashMap<String, u32>,
}

type Tree = RTree<GeomWithData<[f64; 2], u32>>;

/// The nodes and lines near which notes lie.
struct Places<'a> {
    drawn: &'a Drawn,
    index: &'a BoxIndex,
    reach_m: f64,
    tree: Tree,
}

pub(super) fn find(
    drawing: &Layout,
    drawn: &Drawn,
    index: &BoxIndex,
    options: &BuildOptions,
    nodes: &mut Nodes,
    cuts: &mut Vec<Cut>,
    report: &mut BuildReport,
) -> Result<Named, BuildError> {
    let mut named = Named::default();
    if options.stations.is_empty() && options.names.is_empty() {
        return Ok(named);
    }
    let notes = notes(drawing, drawn);
    let sources = options.stations.iter().chain(&options.names);
    report
        .unmatched_sources
        .extend(sources.filter_map(|source| unmatched(source, &notes)));
    let mut places = Places {
        drawn,
        index,
        reach_m: options.reach_m,
        tree: tree(nodes.positions_m.iter().copied()),
    };
    let texts: Vec<&Note> = notes.iter().filter(|n| n.kind == NoteKind::Text).collect();
    let text_tree = tree(texts.iter().map(|note| note.position_m));
    let mut known = HashMap::new();
    for (row, note) in notes.iter().enumerate() {
        let is_in = |sources: &[NoteSource]| sources.iter().any(|s| s.has(note));
        let (is_station, is_name) = (is_in(&options.stations), is_in(&options.names));
        if !is_station && !is_name {
            continue;
        }
        let id = name_of(note, row, &texts, &text_tree, options.reach_m);
        let level = options.rule_of(&note.layer);
        let level = level.and_then(|rule| drawn.rule_levels[rule as usize]);
        let Some(node) = places.node_of(note.position_m, level, nodes, cuts) else {
            report.leave_note(&id, note.position_m);
            continue;
        };
        if is_name {
            name_node(&mut named, nodes, node, &id, report)?;
        }
        if is_station {
            add_station(&mut named, &mut known, note, node, id)?;
        }
    }
    Ok(named)
}

fn tree(points: impl Iterator<Item = Point<f64>>) -> Tree {
    let entries = points
        .zip(0..)
        .map(|(p, row)| GeomWithData::new([p.x, p.y], row));
    RTree::bulk_load(entries.collect())
}

/// The notes of the drawing, and its circles that mark stations.
fn notes(drawing: &Layout, drawn: &Drawn) -> Vec<Note> {
    let circles = drawn.circles.iter().map(|circle| Note {
        kind: NoteKind::Circle,
        layer: circle.layer.clone(),
        position_m: circle.center_m,
        ..Note::default()
    });
    drawing.notes.iter().cloned().chain(circles).collect()
}

/// The source and what there is instead, if no note fits it.
fn unmatched(source: &NoteSource, notes: &[Note]) -> Option<UnmatchedSource> {
    if notes.iter().any(|note| source.has(note)) {
        return None;
    }
    let of_kind = notes.iter().filter(|note| note.kind == source.kind);
    let names: BTreeSet<&str> = of_kind.map(NoteSource::name_of).collect();
    Some(UnmatchedSource {
        source: source.clone(),
        present: names
            .into_iter()
            .take(MAX_PRESENT)
            .map(Into::into)
            .collect(),
    })
}

/// The text of a note, else the nearest text, else its kind and number.
fn name_of(note: &Note, row: usize, texts: &[&Note], tree: &Tree, reach_m: f64) -> String {
    if !note.text.trim().is_empty() {
        return note.text.trim().to_owned();
    }
    let at = [note.position_m.x, note.position_m.y];
    let near = tree.nearest_neighbor(at);
    let near = near.filter(|entry| entry.distance_2(&at) <= reach_m * reach_m);
    let text = near.map(|entry| texts[entry.data as usize].text.trim());
    match text.filter(|text| !text.is_empty()) {
        Some(text) => text.to_owned(),
        None if note.block.is_empty() => format!("{}-{}", note.kind, row + 1),
        None => format!("{}-{}", note.block, row + 1),
    }
}

impl Places<'_> {
    /// The node of a note: the nearest one in reach, else a new one on the nearest curve.
    fn node_of(
        &mut self,
        at: Point<f64>,
        level: Option<u32>,
        nodes: &mut Nodes,
        cuts: &mut Vec<Cut>,
    ) -> Option<u32> {
        if let Some(node) = self.node_near(at, level, nodes) {
            return Some(node);
        }
        let fits = |own: Option<u32>| level.is_none() || own == level;
        let curve = |part: Part| &self.drawn.curves[part.curve as usize];
        let parts = self.index.near(at, self.reach_m);
        let parts = parts.filter(|&part| fits(curve(part).level));
        let feet = parts.map(|part| {
            let foot = nearest(&curve(part).beziers[part.bezier as usize], at);
            (foot.distance, part, foot)
        });
        let best = feet.min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let (_, part, foot) = best.filter(|(distance_m, ..)| *distance_m <= self.reach_m)?;
        let node = nodes.add(foot.point, curve(part).level);
        self.tree
            .insert(GeomWithData::new([foot.point.x, foot.point.y], node));
        cuts.push(Cut {
            part,
            t: foot.t,
            node,
        });
        Some(node)
    }
}

impl Places<'_> {
    /// The nearest node in reach that is on a level, or on any.
    fn node_near(&self, at: Point<f64>, level: Option<u32>, nodes: &Nodes) -> Option<u32> {
        let at = [at.x, at.y];
        let reach_2 = self.reach_m * self.reach_m;
        let near = self.tree.nearest_neighbor_iter(at);
        let near = near.take_while(|entry| entry.distance_2(&at) <= reach_2);
        let mut near = near.map(|entry| entry.data);
        near.find(|&node| level.is_none() || nodes.levels[node as usize] == level)
    }
}

fn name_node(
    named: &mut Named,
    nodes: &Nodes,
    node: u32,
    id: &str,
    report: &mut BuildReport,
) -> Result<(), BuildError> {
    let position = |node: u32| nodes.positions_m[node as usize];
    if let Some(&first) = named.names.get(id)
        && first != node
    {
        return Err(BuildError::Name {
            kind: "nodes",
            name: id.to_owned(),
            first: position(first),
            second: position(node),
        });
    }
    match named.nodes.entry(node) {
        Entry::Occupied(_) => report.leave_note(id, position(node)),
        Entry::Vacant(entry) => {
            entry.insert(id.to_owned());
            named.names.insert(id.to_owned(), node);
            report.named += 1;
        }
    }
    Ok(())
}

/// Adds a station. Two notes of one name at one node, such as a circle and its text, are one.
fn add_station(
    named: &mut Named,
    known: &mut HashMap<String, usize>,
    note: &Note,
    node: u32,
    id: String,
) -> Result<(), BuildError> {
    if let Some(&row) = known.get(&id) {
        let first = &named.stations[row];
        if first.node == node {
            return Ok(());
        }
        return Err(BuildError::Name {
            kind: "stations",
            name: id,
            first: first.position_m,
            second: note.position_m,
        });
    }
    known.insert(id.clone(), named.stations.len());
    named.stations.push(NewStation {
        id,
        position_m: note.position_m,
        node,
        layer: note.layer.clone(),
    });
    Ok(())
}
