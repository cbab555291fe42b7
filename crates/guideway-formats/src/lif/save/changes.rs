//! Changes of a layout since it was read: finds the rows that differ from their objects, and
//! splices the differences.

use std::collections::{HashMap, HashSet};

use guideway_layout::Layout;

use super::compare::{LevelPairs, pair, same_types, same_values};
use super::entries::{self, Types};
use super::state::State;
use crate::Losses;
use crate::json::{Members, Splices, Tree};
use crate::lif::members::{META, OTHER};
use crate::lif::model::NODE_PROPERTIES;
use crate::lif::version::Version;
use crate::lif::write::{Edges, add_missing};

/// The changes, as splices and as rows to add and remove.
pub(super) struct Changes<'s, 't> {
    pub(super) old: &'s State<'s>,
    pub(super) new: &'s State<'s>,
    pub(super) edges: &'s Edges<'s>,
    pub(super) version: Version,
    pub(super) splices: Splices<'t>,
    pub(super) levels: LevelPairs,
    /// Vehicle types of the file that no path and no node names any more.
    gone_types: HashSet<&'s str>,
    /// Objects to remove and to add, per level as it is: nodes, edges, stations.
    pub(super) arrays: Vec<[ArrayChanges<'s>; 3]>,
    /// Vehicle types that nodes need for new or changed paths.
    pub(super) needed_types: HashMap<u32, Vec<&'s str>>,
    /// Straight edges whose nodes were moved without them.
    pub(super) following: usize,
    new_nodes: usize,
    without_level: usize,
    pub(super) for_any: usize,
}

/// Objects to remove from an array and to add to it.
#[derive(Default)]
pub(super) struct ArrayChanges<'a> {
    /// First bytes of the objects.
    pub(super) removed: Vec<usize>,
    pub(super) added: Vec<Tree<'a>>,
}

impl ArrayChanges<'_> {
    pub(super) fn is_empty(&self) -> bool {
        self.removed.is_empty() && self.added.is_empty()
    }
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
            levels: LevelPairs::of(old.layout, new.layout),
            gone_types: gone_types(old.layout, new.layout),
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

    pub(super) fn into_splices(self) -> Splices<'t> {
        self.splices
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

    pub(super) fn remove(&mut self, level: Option<u32>, kind: Kind, start: usize) {
        // An object of a removed level goes with it.
        if let Some(level) = self.levels.after(level.unwrap_or(0)) {
            let arrays = &mut self.arrays[level as usize];
            arrays[kind as usize].removed.push(start);
        }
    }

    pub(super) fn add(&mut self, level: Option<u32>, kind: Kind, object: Tree<'s>) {
        self.arrays_of(level, kind).added.push(object);
    }

    pub(super) fn collect_nodes(&mut self) {
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
            if self.levels.is_moved(level, of_new.level(b)) {
                self.remove(level, Kind::Nodes, object.start);
                self.add(of_new.level(b), Kind::Nodes, new.elements.whole_node(b));
            } else if differs((a, b)) || self.needed_types.contains_key(&b) || self.has_gone_type(a)
            {
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

    /// Returns whether paths of the file give a node a type that is gone.
    fn has_gone_type(&self, a: u32) -> bool {
        let mut types = self.old.network.types_of_node(a).iter();
        !self.gone_types.is_empty() && types.any(|name| self.gone_types.contains(name))
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
        let of_paths = self.old.network.types_of_node(a);
        add_missing(&mut of_old, of_paths);
        let is_left = |name: &&&str| !self.gone_types.contains(**name);
        let left: Vec<&str> = of_paths.iter().filter(is_left).copied().collect();
        add_missing(&mut of_new, &left);
        let needed = self.needed_types.get(&b);
        add_missing(&mut of_new, needed.map_or(&[], Vec::as_slice));
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

    pub(super) fn collect_stations(&mut self) {
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
            if self.levels.is_moved(level, of_new.level(b)) {
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
        let columns = state.elements.row_columns(attributes, META);
        columns.add_to(&mut meta, 0, None);
        let mut root = Tree::Object(vec![("metaInformation".into(), Tree::Object(meta))]);
        state.elements.merge_other(&mut root, attributes, 0, OTHER);
        root
    }
}

/// The vehicle types that paths or nodes of the first layout name, and none of the second.
fn gone_types<'s>(old: &'s Layout, new: &Layout) -> HashSet<&'s str> {
    let names = |layout: &'s Layout| {
        let (paths, nodes) = (layout.paths.vehicle_types(), layout.nodes.vehicle_types());
        paths.names().iter().chain(nodes.names())
    };
    let left = new.vehicle_type_names();
    let gone = names(old).map(String::as_str);
    gone.filter(|name| !left.contains(name)).collect()
}
