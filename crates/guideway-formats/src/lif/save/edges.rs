//! Changes of edges since the file was read.

use guideway_layout::Direction;
use rayon::prelude::*;

use super::changes::{Changes, Kind};
use super::compare::{SameObject, pair, same_curve, same_types, same_values};
use super::entries::{self, Types};
use super::state::State;
use crate::json::Tree;
use crate::lif::model::EDGE_PROPERTIES;
use crate::lif::write::{EdgeRef, level_of, path_types};

impl<'s> Changes<'s, '_> {
    /// Collects the edges that changed.
    pub(super) fn collect_edges(&mut self) {
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
                && !self.levels.is_moved(level(old, path_a), level(new, path_b))
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
        if self.levels.is_moved(old_level, level) {
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
}
