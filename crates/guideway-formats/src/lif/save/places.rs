//! Places of the layouts and origins of a LIF file in its text.

use std::ops::Range;

use crate::json::{items_at, member};

/// Places of objects, by their first bytes.
pub(super) struct Places {
    pub(super) root: usize,
    /// One per level.
    pub(super) levels: Vec<usize>,
    /// The objects with an array of levels.
    pub(super) owners: Vec<Owner>,
}

/// The root of 1.0, or an origin of 2.0.
pub(super) struct Owner {
    pub(super) at: usize,
    /// Its levels.
    pub(super) levels: Range<usize>,
    pub(super) is_origin: bool,
}

impl Places {
    /// Finds the places; `None` if the text has another number of levels.
    pub(super) fn find(text: &str, levels: usize) -> Option<Self> {
        let mut places = Self {
            root: text.find('{')?,
            levels: Vec::new(),
            owners: Vec::new(),
        };
        places.add_owner(text, places.root, false);
        if let Some(origins) = member(text, places.root, "origins") {
            for origin in objects(text, origins.start) {
                places.add_owner(text, origin, true);
            }
        }
        (places.levels.len() == levels).then_some(places)
    }

    fn add_owner(&mut self, text: &str, at: usize, is_origin: bool) {
        let Some(layouts) = member(text, at, "layouts") else {
            return;
        };
        let first = self.levels.len();
        self.levels.extend(objects(text, layouts.start));
        self.owners.push(Owner {
            at,
            levels: first..self.levels.len(),
            is_origin,
        });
    }
}

/// Returns the first bytes of the objects of an array.
fn objects(text: &str, at: usize) -> impl Iterator<Item = usize> {
    let items = items_at(text, at).into_iter().map(|item| item.start);
    items.filter(|&item| text.as_bytes()[item] == b'{')
}
