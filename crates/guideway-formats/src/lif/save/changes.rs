//! Changes of a layout since it was read: finds the rows that differ from their objects, and
//! splices the differences.

use std::collections::HashMap;

use guideway_layout::Direction;
use rayon::prelude::*;

use super::State;
use super::arrays::ArrayChanges;
use super::compare::{SameObject, pair, same_curve, same_types, same_values};
use super::entries::{self, Types};
use crate::Losses;
use crate::json::{Members, Splices, Tree};
use crate::lif::model::{EDGE_PROPERTIES, NODE_PROPERTIES};
use crate::lif::version::Version;
use crate::lif::write::{EdgeRef, Edges, level_of, path_types};

/// The changes, as splices and as rows to add and remove.
pub(super) struct Changes<'s, 't> {
    old: &'s State<'s>,
    new: &'s State<'s>,
    edges: &'s Edges<'s>,
    version: Version,
    pub(super) splices: Splices<'t>,
    /// Objects to remove and to add, per level: nodes, edges, stations.
    pub(super) arrays: Vec<[ArrayChanges<'s>; 3]>,
    /// Vehicle types that nodes need for new or changed paths.
    needed_types: HashMap<u32, Vec<&'s str>>,
    /// Straight edges whose nodes were moved without them.
    following: usize,
    new_nodes: usize,
    without_level: usize,
    for_any: usize,
}

/// Kinds of arrays of a layout.
#[derive(Clone, Copy)]
pub(super) enum Kind {
    Nodes,
    Edges,
    Stations,
}

impl<'s, 't> Changes<'s, 't> {
    pub(super) fn new(
        old: &'s State<'s>,
        new: &'s State<'s>,
        edges: &'s Edges<'s>,
        version: Version,
        splices: Splices<'t>,
    ) -> Self {
        Self {
            old,
            new,
            edges,
            version,
            splices,
            arrays: new
                .layout
                .levels
                .iter()
                .map(|_| Default::default())
                .collect(),
            needed_types: HashMap::new(),
            following: 0,
            new_nodes: 0,
            without_level: 0,
            for_any: 0,
        }
    }

    pub(super) fn old(&self) -> &'s State<'s> {
        self.old
    }

    pub(super) fn new_state(&self) -> &'s State<'s> {
        self.new
    }

    pub(super) fn into_splices(self) -> Splices<'t> {
        self.splices
    }

    /// Collects all changes but those of levels.
    pub(super) fn collect(&mut self) {
        self.collect_edges();
        self.collect_nodes();
        self.collect_stations();
    }

    /// Adds what a new reading of the text has in another form than the layout.
    pub(super) fn add_losses(&self, losses: &mut Losses) {
        let detail = "straight edges: they follow their moved nodes";
        losses.add("curves", self.following, detail);
        let detail = "new nodes: written at path ends without a node";
        losses.add("nodes", self.new_nodes, detail);
        let detail = "paths, nodes and stations without a level: written to the first one";
        losses.add("levels", self.without_level, detail);
        let detail = "new paths for all vehicle types: written for the type `any`";
        losses.add("vehicle types", self.for_any, detail);
    }

    fn arrays_of(&mut self, level: Option<u32>, kind: Kind) -> &mut ArrayChanges<'s> {
        self.without_level += usize::from(level.is_none());
        let last = self.arrays.len() - 1;
        let level = level.map_or(0, |level| last.min(level as usize));
        &mut self.arrays[level][kind as usize]
    }

    fn remove(&mut self, level: Option<u32>, kind: Kind, start: usize) {
        let level = level.unwrap_or(0) as usize;
        self.arrays[level][kind as usize].removed.push(start);
    }

    fn add(&mut self, level: Option<u32>, kind: Kind, object: Tree<'s>) {
        self.arrays_of(level, kind).added.push(object);
    }

    fn collect_nodes(&mut self) {
        let (old, new) = (self.old, self.new);
        let (of_old, of_new) = (&old.layout.nodes, &new.layout.nodes);
        let (pairs, added) = pair(&of_old.source, of_old.len(), &of_new.source, of_new.len());
        let differs = |(a, b): (u32, u32)| {
            let (row_a, row_b) = (a as usize, b as usize);
            old.network.node_id(a) != new.network.node_id(b)
                || of_old.position_m(a) != of_new.position_m(b)
                || !same_values(&of_old.attributes, row_a, &of_new.attributes, row_b)
                || !same_types(of_old.vehicle_types(), row_a, of_new.vehicle_types(), row_b)
        };
        for object in pairs {
            let (a, level) = (object.old[0], of_old.level(object.old[0]));
            let Some((&b, copies)) = object.new.split_first() else {
                self.remove(level, Kind::Nodes, object.start);
                continue;
            };
            for &copy in copies {
                self.add(
                    of_new.level(copy),
                    Kind::Nodes,
                    new.elements.whole_node(copy),
                );
            }
            if of_new.level(b) != level {
                self.remove(level, Kind::Nodes, object.start);
                self.add(of_new.level(b), Kind::Nodes, new.elements.whole_node(b));
            } else if differs((a, b)) || self.needed_types.contains_key(&b) {
                self.change_node(object.start, a, b);
            }
        }
        for node in added {
            self.add(
                of_new.level(node),
                Kind::Nodes,
                new.elements.whole_node(node),
            );
        }
        // Nodes that paths without one need; those of paths of the file are not in the file.
        let mut needed: Vec<u32> = self.needed_types.keys().copied().collect();
        needed.retain(|&node| node as usize >= of_new.len());
        needed.sort_unstable();
        for node in needed {
            self.new_nodes += 1;
            let level = Some(new.network.level_of_node(node) as u32);
            self.add(level, Kind::Nodes, new.elements.whole_node(node));
        }
    }

    fn change_node(&mut self, start: usize, a: u32, b: u32) {
        let (old, new) = (&self.old.elements, &self.new.elements);
        self.splices.change(start, &old.node(a), &new.node(b));
        // Types that only paths of the file need are in the text or never were.
        let own = |entries: &'s guideway_layout::TypeEntries, node: u32| {
            let rows = entries.entries(node as usize);
            rows.map(move |row| (entries.type_of(row), Some(row)))
        };
        let of_old = own(self.old.layout.nodes.vehicle_types(), a);
        let of_new = own(self.new.layout.nodes.vehicle_types(), b);
        let mut of_old: Vec<(&str, Option<usize>)> = of_old.collect();
        let mut of_new: Vec<(&str, Option<usize>)> = of_new.collect();
        for (types, network, node) in [
            (&mut of_old, self.old.network, a),
            (&mut of_new, self.old.network, a),
        ] {
            for &name in network.types_of_node(node) {
                if types.iter().all(|(known, _)| *known != name) {
                    types.push((name, None));
                }
            }
        }
        for &name in self.needed_types.get(&b).into_iter().flatten() {
            if of_new.iter().all(|(known, _)| *known != name) {
                of_new.push((name, None));
            }
        }
        let of_old: Types<'s> = of_old
            .into_iter()
            .map(|(name, entry)| (name, old.node_type(a, entry)))
            .collect();
        let of_new: Types<'s> = of_new
            .into_iter()
            .map(|(name, entry)| (name, new.node_type(b, entry)))
            .collect();
        let place = (start, self.version.select(NODE_PROPERTIES));
        entries::change(
            &mut self.splices,
            new,
            self.version,
            place,
            &of_old,
            &of_new,
        );
    }

    fn collect_edges(&mut self) {
        let (old, new) = (self.old, self.new);
        let (of_old, of_new) = (&old.layout.paths, &new.layout.paths);
        let (pairs, added) = pair(&of_old.source, of_old.len(), &of_new.source, of_new.len());
        let is_changed: Vec<bool> = pairs
            .par_iter()
            .map(|object| self.is_edge_changed(object))
            .collect();
        for (object, is_changed) in pairs.iter().zip(is_changed) {
            if is_changed {
                self.change_edge(object);
            }
        }
        for path in added {
            self.add_edge(path);
        }
        for path in new.layout.paths.iter() {
            if path.direction() == Direction::Both
                && let Some(edge) = self.edges.reverse_of(path.row() as u32)
            {
                let level = level_of(new.layout, path);
                self.need_types(path.row() as u32);
                self.add(level, Kind::Edges, new.elements.whole_edge(&edge));
            }
        }
        self.count_following(&pairs);
    }

    fn is_edge_changed(&self, object: &SameObject) -> bool {
        let (old, new) = (self.old, self.new);
        let same = |(&a, &b): (&u32, &u32)| {
            let (row_a, row_b) = (a as usize, b as usize);
            let (of_old, of_new) = (&old.layout.paths, &new.layout.paths);
            let (path_a, path_b) = (of_old.get(row_a), of_new.get(row_b));
            let is_id_same =
                path_a.id() == path_b.id() || old.groups.id(path_a) == new.groups.id(path_b);
            let ids = |state: &'s State<'s>, row| {
                let ends = state.network.ends(row);
                ends.map(|node| state.network.node_id(node))
            };
            let level = |state: &State<'_>, path| level_of(state.layout, path);
            is_id_same
                && (ids(old, row_a) == ids(new, row_b))
                && level(old, path_a) == level(new, path_b)
                && same_curve(old.layout, row_a, new.layout, row_b)
                && same_values(&of_old.attributes, row_a, &of_new.attributes, row_b)
                && same_types(of_old.vehicle_types(), row_a, of_new.vehicle_types(), row_b)
        };
        object.old.len() != object.new.len() || !object.old.iter().zip(&object.new).all(same)
    }

    fn change_edge(&mut self, object: &SameObject) {
        let (old, new) = (self.old, self.new);
        let first_old = old.layout.paths.get(object.old[0] as usize);
        let old_level = level_of(old.layout, first_old);
        let Some(&first) = object.new.first() else {
            return self.remove(old_level, Kind::Edges, object.start);
        };
        let key = |row: u32| {
            let path = new.layout.paths.get(row as usize);
            let ends = (path.start_node(), path.end_node());
            (new.groups.id(path), ends, level_of(new.layout, path))
        };
        let is_part = |row: &&u32| {
            let is_copy = object.new.len() > object.old.len() && object.old.len() == 1;
            key(**row) == key(first) && (!is_copy || **row == first)
        };
        let (parts, others): (Vec<&u32>, Vec<&u32>) = object.new.iter().partition(is_part);
        others.into_iter().for_each(|&row| self.add_edge(row));
        let level = key(first).2;
        let edge = |state: &State<'s>, row: u32| EdgeRef {
            id: state.groups.id(state.layout.paths.get(row as usize)).into(),
            path: row,
            others: &[],
            is_reverse: false,
        };
        if level != old_level {
            self.remove(old_level, Kind::Edges, object.start);
            parts.into_iter().for_each(|&row| self.add_edge(row));
            return;
        }
        let old_head = old.elements.edge(&edge(old, object.old[0]));
        let new_head = new.elements.edge(&edge(new, first));
        self.splices.change(object.start, &old_head, &new_head);
        let mut of_old: Types<'s> = Vec::new();
        for &row in &object.old {
            let curve = old.elements.trajectory(row, false);
            self.add_types(old, row, curve, &mut of_old);
        }
        let mut of_new: Types<'s> = Vec::new();
        for &row in parts {
            let before = object.old.iter().find(|&&before| {
                let is_alone = object.old.len() == 1;
                is_alone
                    || old.layout.paths.id(before as usize) == new.layout.paths.id(row as usize)
            });
            let is_same =
                |&&before: &&u32| same_curve(old.layout, before as usize, new.layout, row as usize);
            let curve = match before.filter(is_same) {
                Some(&before) => old.elements.trajectory(before, false),
                None => new.elements.trajectory(row, false),
            };
            self.need_types(row);
            self.add_types(new, row, curve, &mut of_new);
        }
        let place = (object.start, self.version.select(EDGE_PROPERTIES));
        let elements = &new.elements;
        entries::change(
            &mut self.splices,
            elements,
            self.version,
            place,
            &of_old,
            &of_new,
        );
    }

    /// Adds the vehicle types of a path, with its properties and curve.
    fn add_types(
        &self,
        state: &'s State<'s>,
        path: u32,
        curve: Option<Tree<'s>>,
        types: &mut Types<'s>,
    ) {
        let own = state.layout.paths.vehicle_types();
        let rows = own.entries(path as usize);
        let is_open = rows.is_empty();
        let names = rows.map(|row| (own.type_of(row), Some(row)));
        for (name, entry) in names.chain(is_open.then_some(("", None))) {
            let mut tree = state.elements.edge_type(path, entry, false);
            if let (Tree::Object(members), Some(curve)) = (&mut tree, &curve) {
                members.push(("trajectory".into(), curve.clone()));
            }
            types.push((name, tree));
        }
    }

    fn add_edge(&mut self, path: u32) {
        let row = self.new.layout.paths.get(path as usize);
        if row.ends().is_none() {
            return;
        }
        let edge = EdgeRef {
            id: row.id().into(),
            path,
            others: &[],
            is_reverse: false,
        };
        self.need_types(path);
        let types = self.new.layout.paths.vehicle_types().of(path as usize);
        self.for_any += usize::from(types.len() == 0);
        let level = level_of(self.new.layout, row);
        self.add(level, Kind::Edges, self.new.elements.whole_edge(&edge));
    }

    /// Notes that the nodes of a path need entries for its vehicle types.
    fn need_types(&mut self, path: u32) {
        for node in self.new.network.ends(path as usize) {
            let types = self.needed_types.entry(node).or_default();
            types.extend(path_types(self.new.layout, path as usize));
        }
    }

    /// Counts straight edges that were not edited while their nodes were moved.
    fn count_following(&mut self, pairs: &[SameObject]) {
        let (old, new) = (self.old, self.new);
        let is_moved = |node: u32| {
            let was = old.layout.nodes.len() > node as usize;
            was && old.network.position_m(node) != new.network.position_m(node)
        };
        let may_follow = (0..new.layout.nodes.len() as u32).any(is_moved);
        if !may_follow {
            return;
        }
        let follows = |(&a, &b): (&u32, &u32)| {
            same_curve(old.layout, a as usize, new.layout, b as usize)
                && old.elements.trajectory(a, false).is_none()
                && new.elements.trajectory(b, false).is_some()
        };
        let count = |object: &SameObject| {
            let pairs = object.old.iter().zip(&object.new);
            pairs.filter(|&pair| follows(pair)).count()
        };
        self.following = pairs.par_iter().map(count).sum();
    }

    fn collect_stations(&mut self) {
        let (old, new) = (self.old, self.new);
        let (of_old, of_new) = (&old.layout.stations, &new.layout.stations);
        let (pairs, added) = pair(&of_old.source, of_old.len(), &of_new.source, of_new.len());
        for object in pairs {
            let (a, level) = (object.old[0], of_old.level(object.old[0]));
            let Some((&b, copies)) = object.new.split_first() else {
                self.remove(level, Kind::Stations, object.start);
                continue;
            };
            for &copy in copies {
                self.add(
                    of_new.level(copy),
                    Kind::Stations,
                    new.elements.station(copy),
                );
            }
            if of_new.level(b) != level {
                self.remove(level, Kind::Stations, object.start);
                self.add(of_new.level(b), Kind::Stations, new.elements.station(b));
                continue;
            }
            let (was, is) = (old.elements.station(a), new.elements.station(b));
            self.splices.change(object.start, &was, &is);
        }
        for station in added {
            self.add(
                of_new.level(station),
                Kind::Stations,
                new.elements.station(station),
            );
        }
    }

    /// The members of the root that the layout holds.
    pub(super) fn root(state: &'s State<'s>) -> Tree<'s> {
        let mut meta: Members<'s> = Vec::new();
        let attributes = &state.layout.attributes;
        let columns = state
            .elements
            .row_columns(attributes, crate::lif::members::META);
        columns.add_to(&mut meta, 0, None);
        let mut root = Tree::Object(vec![("metaInformation".into(), Tree::Object(meta))]);
        let other = crate::lif::members::OTHER;
        state.elements.merge_other(&mut root, attributes, 0, other);
        root
    }
}
