//! Arrays and heads of levels: splices removed and new objects, and changed members of the root,
//! the origins and the levels.

use super::changes::{ArrayChanges, Changes, Kind};
use super::places::{Owner, Places};
use crate::json::{ArrayEdit, Tree, member};

const ARRAYS: [(Kind, &str); 3] = [
    (Kind::Nodes, "nodes"),
    (Kind::Edges, "edges"),
    (Kind::Stations, "stations"),
];

impl<'s> Changes<'s, '_> {
    /// Returns whether a level, an origin, the root or an array changes, whose places in the text
    /// take a scan to find.
    pub(super) fn needs_places(&self) -> bool {
        let (old, new) = (self.old.layout, self.new.layout);
        old.attributes != new.attributes
            || old.levels != new.levels
            || !self.arrays.iter().flatten().all(ArrayChanges::is_empty)
    }

    /// Splices the changes of levels and their arrays. Returns `false`, and splices nothing, if the
    /// text has no place for a new origin.
    pub(super) fn change_levels(&mut self, places: &Places) -> bool {
        let (old, new) = (self.old, self.new);
        let homes = self.homes(places);
        let needs_origin = homes.iter().any(|(_, home)| home.is_none());
        let origins = member(self.splices.text(), places.root, "origins");
        if needs_origin && origins.is_none() {
            return false;
        }
        let roots = (Self::root(old), Self::root(new));
        self.splices.change(places.root, &roots.0, &roots.1);
        let mut arrays = std::mem::take(&mut self.arrays);
        for (before, &at) in places.levels.iter().enumerate() {
            let Some(after) = self.levels.after(before as u32) else {
                continue;
            };
            let heads = (
                old.elements.level(before),
                new.elements.level(after as usize),
            );
            self.splices.change(at, &heads.0, &heads.1);
            let arrays = std::mem::take(&mut arrays[after as usize]);
            for ((_, name), changes) in ARRAYS.into_iter().zip(arrays) {
                self.change_array(at, name, changes);
            }
        }
        let mut whole = |level: usize| {
            let arrays = std::mem::take(&mut arrays[level]);
            let lists = ARRAYS.into_iter().zip(arrays);
            let lists = lists.map(|((_, name), list)| (name.into(), Tree::Array(list.added)));
            match new.elements.level(level) {
                Tree::Object(head) => Tree::Object(head.into_iter().chain(lists).collect()),
                other => other,
            }
        };
        let mut new_origins: Vec<(Tree<'s>, Vec<Tree<'s>>)> = Vec::new();
        let mut added: Vec<Vec<Tree<'s>>> = places.owners.iter().map(|_| Vec::new()).collect();
        for &(level, home) in &homes {
            let object = whole(level);
            let origin = new.elements.origin(level);
            match home {
                Some(owner) => added[owner].push(object),
                None => match new_origins.iter_mut().find(|(known, _)| *known == origin) {
                    Some((_, levels)) => levels.push(object),
                    None => new_origins.push((origin, vec![object])),
                },
            }
        }
        let mut gone = Vec::new();
        for (owner, added) in places.owners.iter().zip(added) {
            if self.change_owner(owner, added) {
                gone.push(owner.at);
            }
        }
        if let Some(origins) = origins.filter(|_| !gone.is_empty() || !new_origins.is_empty()) {
            let mut edit = ArrayEdit::new(self.splices.text(), origins.start);
            remove_items(&mut edit, gone);
            for (origin, levels) in new_origins {
                let Tree::Object(mut members) = origin else {
                    continue;
                };
                members.push(("layouts".into(), Tree::Array(levels)));
                edit.push(Tree::Object(members));
            }
            edit.apply(&mut self.splices);
        }
        true
    }

    /// The new levels, each with the index of the object of the file that takes it: the root of
    /// 1.0; in 2.0 the origin that it states, or the first one if it states none.
    fn homes(&self, places: &Places) -> Vec<(usize, Option<usize>)> {
        let levels = 0..self.new.layout.levels.len();
        let added = levels.filter(|&level| self.levels.is_new(level as u32));
        let stays = |index: usize| {
            let mut levels = places.owners[index].levels.clone();
            levels.find_map(|level| self.levels.after(level as u32))
        };
        let home = |level: usize| {
            let mut owners = 0..places.owners.len();
            owners.find(|&index| match places.owners[index].is_origin {
                false => true,
                true if !self.has_origin(level) => stays(index).is_some(),
                true => stays(index).is_some_and(|other| {
                    let elements = &self.new.elements;
                    elements.origin(other as usize) == elements.origin(level)
                }),
            })
        };
        added.map(|level| (level, home(level))).collect()
    }

    /// Returns whether a level states its origin.
    fn has_origin(&self, level: usize) -> bool {
        let attributes = &self.new.layout.levels[level].attributes;
        attributes.value(0, "originId").is_some()
    }

    /// Splices the list of levels of the root or of an origin. Returns `true`, and splices
    /// nothing, for an origin that has no level any more.
    fn change_owner(&mut self, owner: &Owner, added: Vec<Tree<'s>>) -> bool {
        let (old, new) = (self.old, self.new);
        let levels = owner.levels.clone();
        let first = levels
            .clone()
            .find_map(|level| Some((level, self.levels.after(level as u32)?)));
        if owner.is_origin {
            match first {
                Some((before, after)) => {
                    let origins = (
                        old.elements.origin(before),
                        new.elements.origin(after as usize),
                    );
                    self.splices.change(owner.at, &origins.0, &origins.1);
                }
                None if added.is_empty() && !levels.is_empty() => return true,
                None => {}
            }
        }
        let text = self.splices.text();
        let is_gone = |index: &usize| self.levels.after((levels.start + index) as u32).is_none();
        let gone: Vec<usize> = (0..levels.len()).filter(is_gone).collect();
        let list =
            member(text, owner.at, "layouts").filter(|_| !gone.is_empty() || !added.is_empty());
        if let Some(list) = list {
            let mut edit = ArrayEdit::new(text, list.start);
            let objects = edit.items().iter().map(|item| item.start);
            let objects: Vec<usize> = objects.filter(|&at| text.as_bytes()[at] == b'{').collect();
            remove_items(&mut edit, gone.into_iter().map(|index| objects[index]));
            added.into_iter().for_each(|level| edit.push(level));
            edit.apply(&mut self.splices);
        }
        false
    }

    fn change_array(&mut self, level: usize, name: &'static str, changes: ArrayChanges<'s>) {
        if changes.is_empty() {
            return;
        }
        let text = self.splices.text();
        let array = member(text, level, name);
        let Some(array) = array.filter(|array| text.as_bytes()[array.start] == b'[') else {
            let list = Tree::Object(vec![(name.into(), Tree::Array(changes.added))]);
            return self.splices.change(level, &Tree::Object(Vec::new()), &list);
        };
        let mut edit = ArrayEdit::new(text, array.start);
        remove_items(&mut edit, changes.removed);
        changes
            .added
            .into_iter()
            .for_each(|object| edit.push(object));
        edit.apply(&mut self.splices);
    }
}

/// Removes the items of an array that begin at these bytes.
fn remove_items(edit: &mut ArrayEdit<'_>, starts: impl IntoIterator<Item = usize>) {
    for start in starts {
        let found = edit.items().binary_search_by_key(&start, |item| item.start);
        if let Ok(index) = found {
            edit.remove(index);
        }
    }
}
