//! Arrays and heads of levels: splices removed and new objects, and changed members of the root,
//! the origins and the levels.

use super::changes::{ArrayChanges, Changes, Kind};
use super::places::Places;
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

    /// Splices the changes of levels and their arrays.
    pub(super) fn change_levels(&mut self, places: &Places) {
        let (old, new) = (self.old, self.new);
        let roots = (Self::root(old), Self::root(new));
        self.splices.change(places.root, &roots.0, &roots.1);
        for &(at, level) in &places.origins {
            let origins = (old.elements.origin(level), new.elements.origin(level));
            self.splices.change(at, &origins.0, &origins.1);
        }
        let arrays = std::mem::take(&mut self.arrays);
        for (level, (&at, arrays)) in places.levels.iter().zip(arrays).enumerate() {
            let heads = (old.elements.level(level), new.elements.level(level));
            self.splices.change(at, &heads.0, &heads.1);
            for ((_, name), changes) in ARRAYS.into_iter().zip(arrays) {
                self.change_array(at, name, changes);
            }
        }
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
        for start in changes.removed {
            let found = edit.items().binary_search_by_key(&start, |item| item.start);
            if let Ok(index) = found {
                edit.remove(index);
            }
        }
        changes
            .added
            .into_iter()
            .for_each(|object| edit.push(object));
        edit.apply(&mut self.splices);
    }
}
