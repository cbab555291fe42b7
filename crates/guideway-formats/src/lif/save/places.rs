//! Places of the layouts and origins of a LIF file in its text.

use crate::json::{items_at, member};

/// Places of objects, by their first bytes.
pub(super) struct Places {
    pub(super) root: usize,
    /// One per level.
    pub(super) levels: Vec<usize>,
    /// The origins of 2.0, each with the index of its first level.
    pub(super) origins: Vec<(usize, usize)>,
}

impl Places {
    /// Finds the places; `None` if the text has another number of levels.
    pub(super) fn find(text: &str, levels: usize) -> Option<Self> {
        let mut places = Self {
            root: text.find('{')?,
            levels: Vec::new(),
            origins: Vec::new(),
        };
        places.add_layouts(text, places.root);
        if let Some(origins) = member(text, places.root, "origins") {
            for origin in objects(text, origins.start) {
                let first = places.levels.len();
                places.add_layouts(text, origin);
                if places.levels.len() > first {
                    places.origins.push((origin, first));
                }
            }
        }
        (places.levels.len() == levels).then_some(places)
    }

    fn add_layouts(&mut self, text: &str, at: usize) {
        if let Some(layouts) = member(text, at, "layouts") {
            self.levels.extend(objects(text, layouts.start));
        }
    }
}

/// Returns the first bytes of the objects of an array.
fn objects(text: &str, at: usize) -> impl Iterator<Item = usize> {
    let items = items_at(text, at).into_iter().map(|item| item.start);
    items.filter(|&item| text.as_bytes()[item] == b'{')
}
