//! [`Plan`]: the parts of a step, collected in any order, as changes in the right one.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use guideway_layout::{Member, PathRef};
use guideway_scene::{Edit, Insertion, NewNode, PathState, Table, TableEdit};
use guideway_spline::{Point, Runs};

use crate::change::Change;
use crate::document::Document;
use crate::edit::lengths::{StatedLengths, set_lengths_m};
use crate::edit::names::Names;
use crate::edit::perform::{reshape, set_states};

/// A step being planned for a document, which it does not change.
pub(super) struct Plan<'d> {
    pub(super) document: &'d Document,
    pub(super) path_names: Names<'d>,
    pub(super) node_names: Names<'d>,
    nodes: Vec<NewNode>,
    paths: Vec<Insertion>,
    curves: BTreeMap<u32, Runs>,
    ends: BTreeMap<u32, [Option<u32>; 2]>,
    ids: BTreeMap<u32, String>,
    lengths_m: StatedLengths,
    moved: BTreeMap<u32, Point<f64>>,
    station_nodes: BTreeMap<u32, Box<[u32]>>,
    removed_paths: BTreeSet<u32>,
    removed_nodes: BTreeSet<u32>,
    /// Elements that take the place of a member of a block.
    in_place_of: BTreeMap<Member, Vec<Member>>,
}

impl<'d> Plan<'d> {
    pub(super) fn new(document: &'d Document) -> Self {
        Self {
            document,
            path_names: document.names(Table::Paths),
            node_names: document.names(Table::Nodes),
            nodes: Vec::new(),
            paths: Vec::new(),
            curves: BTreeMap::new(),
            ends: BTreeMap::new(),
            ids: BTreeMap::new(),
            lengths_m: StatedLengths::new(),
            moved: BTreeMap::new(),
            station_nodes: BTreeMap::new(),
            removed_paths: BTreeSet::new(),
            removed_nodes: BTreeSet::new(),
            in_place_of: BTreeMap::new(),
        }
    }

    /// A new node with the level and the vehicle types of a path.
    pub(super) fn add_node(&mut self, like: u32, position_m: Point<f64>) -> u32 {
        let layout = self.document.layout();
        let types = layout.paths.vehicle_types().of(like as usize);
        let node = NewNode {
            id: self.node_names.unique("node"),
            position_m,
            level: layout.paths.get(like as usize).level(),
            vehicle_types: types.map(str::to_owned).collect(),
            attributes_of: None,
        };
        self.nodes.push(node);
        (layout.nodes.len() + self.nodes.len() - 1) as u32
    }

    /// Position of a node, old, moved or new.
    pub(super) fn node_position_m(&self, node: u32) -> Point<f64> {
        let new = (node as usize).checked_sub(self.document.layout().nodes.len());
        match new {
            Some(new) => self.nodes[new].position_m,
            None => {
                let moved = self.moved.get(&node).copied();
                moved.unwrap_or_else(|| self.document.node_position_m(node))
            }
        }
    }

    /// Names of the pieces of a path.
    pub(super) fn piece_names(&mut self, path: u32, count: usize) -> Vec<String> {
        let id = self.document.layout().paths.id(path as usize);
        let id = if id.is_empty() { "path" } else { id };
        self.path_names.pieces(id, count)
    }

    /// A new path with the properties of another one. Returns its row.
    pub(super) fn add_path(
        &mut self,
        like: u32,
        id: String,
        runs: Runs,
        ends: [Option<u32>; 2],
    ) -> u32 {
        let new = properties_of(self.document, like);
        self.insert(Insertion {
            id,
            runs,
            start_node: ends[0],
            end_node: ends[1],
            ..new
        })
    }

    pub(super) fn insert(&mut self, path: Insertion) -> u32 {
        self.paths.push(path);
        (self.document.layout().paths.len() + self.paths.len() - 1) as u32
    }

    pub(super) fn set_curve(&mut self, path: u32, runs: Runs) {
        self.curves.insert(path, runs);
    }

    pub(super) fn set_ends(&mut self, path: u32, ends: [Option<u32>; 2]) {
        self.ends.insert(path, ends);
    }

    pub(super) fn set_id(&mut self, path: u32, id: String) {
        self.ids.insert(path, id);
    }

    /// Sets the stated length of a path, old or new, for all vehicle types or for one.
    pub(super) fn set_length_m(
        &mut self,
        path: u32,
        vehicle_type: Option<Arc<str>>,
        length_m: f64,
    ) {
        self.lengths_m.insert((vehicle_type, path), length_m);
    }

    pub(super) fn set_station_nodes(&mut self, station: u32, nodes: Box<[u32]>) {
        self.station_nodes.insert(station, nodes);
    }

    pub(super) fn remove_path(&mut self, path: u32) {
        self.removed_paths.insert(path);
    }

    pub(super) fn remove_node(&mut self, node: u32) {
        self.removed_nodes.insert(node);
    }

    /// Puts elements where a block has another one.
    pub(super) fn replace_member(&mut self, old: Member, new: Vec<Member>) {
        self.in_place_of.insert(old, new);
    }

    /// Puts an element into all blocks that have another one.
    pub(super) fn add_member(&mut self, with: Member, new: Member) {
        self.in_place_of
            .entry(with)
            .or_insert_with(|| vec![with])
            .push(new);
    }

    /// Moves a node whose paths get new curves.
    pub(super) fn place_node(&mut self, node: u32, at_m: Point<f64>) {
        self.moved.insert(node, at_m);
    }

    /// The first and the last node that a path will have.
    pub(super) fn ends_of(&self, path: u32) -> [Option<u32>; 2] {
        let row = self.document.layout().paths.get(path as usize);
        let old = [row.start_node(), row.end_node()];
        self.ends.get(&path).copied().unwrap_or(old)
    }

    /// The changes, each after those on which it depends.
    pub(super) fn changes(mut self) -> Vec<Change> {
        let curves = self.curves.iter().map(|(&path, runs)| (path, runs));
        for (of, length_m) in self.document.scaled_lengths_m(curves) {
            self.lengths_m.entry(of).or_insert(length_m);
        }
        let members = self.members();
        let when = |has_rows: bool, edit: TableEdit| has_rows.then(|| Change::from(edit));
        let (rows, curves): (Vec<u32>, Vec<Runs>) = self.curves.into_iter().unzip();
        let ids = self.ids.into_iter().map(|(row, id)| (row, id.into()));
        let gone = self.removed_nodes.into_iter().map(|node| (node, false));
        let (paths, nodes) = (Table::Paths, Table::Nodes);
        let first = [
            when(
                !self.nodes.is_empty(),
                TableEdit::InsertNodes(self.nodes.into()),
            ),
            when(
                !self.ends.is_empty(),
                TableEdit::SetEnds(self.ends.into_iter().collect()),
            ),
            (!self.moved.is_empty()).then(|| Change::MoveNodes(self.moved.into_iter().collect())),
            (!rows.is_empty()).then(|| reshape(rows, &curves)),
            (!self.paths.is_empty()).then(|| Edit::Insert(self.paths.into()).into()),
            when(
                ids.len() > 0,
                TableEdit::SetIds {
                    of: paths,
                    ids: ids.collect(),
                },
            ),
        ];
        let lengths = set_lengths_m(&self.lengths_m);
        let last = [
            when(
                !self.station_nodes.is_empty(),
                TableEdit::SetStationNodes(self.station_nodes.into_iter().collect()),
            ),
            when(!members.is_empty(), TableEdit::SetMembers(members.into())),
            when(
                gone.len() > 0,
                TableEdit::SetExists {
                    of: nodes,
                    rows: gone.collect(),
                },
            ),
            (!self.removed_paths.is_empty())
                .then(|| set_states(self.removed_paths.into_iter(), PathState::Removed)),
        ];
        let (first, last) = (first.into_iter().flatten(), last.into_iter().flatten());
        first.chain(lengths).chain(last).collect()
    }

    /// Members of the blocks that change.
    fn members(&self) -> Vec<(u32, Box<[Member]>)> {
        let mut changed = Vec::new();
        for (row, block) in self.document.layout().blocks.iter().enumerate() {
            let is_replaced = |member: &Member| self.in_place_of.contains_key(member);
            if !block.members.iter().any(is_replaced) {
                continue;
            }
            let mut members: Vec<Member> = Vec::with_capacity(block.members.len());
            let mut known = BTreeSet::new();
            for member in &block.members {
                let own = std::slice::from_ref(member);
                let new = self.in_place_of.get(member).map_or(own, Vec::as_slice);
                members.extend(new.iter().filter(|member| known.insert(**member)));
            }
            changed.push((row as u32, members.into()));
        }
        changed
    }
}

/// A path without name, curve and nodes that has the properties of another one.
pub(super) fn properties_of(document: &Document, like: u32) -> Insertion {
    let paths = &document.layout().paths;
    let path: PathRef<'_> = paths.get(like as usize);
    let types = paths.vehicle_types().of(like as usize);
    Insertion {
        direction: path.direction(),
        level: path.level(),
        vehicle_types: types.map(str::to_owned).collect(),
        style: paths.own_style(like as usize),
        attributes_of: Some(like),
        ..Insertion::default()
    }
}
