//! The fonts of the system: a character in, the first font that draws it out.

use std::borrow::Cow;
use std::collections::HashMap;
use std::sync::Arc;

use skrifa::FontRef;

use super::font::{Font, draws};

/// The fonts of the system and the characters that were looked up in them.
pub(super) struct SystemFonts {
    database: fontdb::Database,
    /// Upright fonts of regular weight first.
    faces: Vec<fontdb::ID>,
    loaded: HashMap<fontdb::ID, Option<Arc<Font>>>,
    by_char: HashMap<char, Option<Arc<Font>>>,
}

impl SystemFonts {
    pub(super) fn load() -> Self {
        let mut database = fontdb::Database::new();
        database.load_system_fonts();
        let mut faces: Vec<_> = database.faces().collect();
        faces.sort_by_key(|face| {
            let is_slanted = face.style != fontdb::Style::Normal;
            let off_regular = face.weight.0.abs_diff(fontdb::Weight::NORMAL.0);
            (is_slanted, off_regular, face.post_script_name.clone())
        });
        let faces = faces.into_iter().map(|face| face.id).collect();
        Self {
            database,
            faces,
            loaded: HashMap::new(),
            by_char: HashMap::new(),
        }
    }

    pub(super) fn find(&mut self, c: char) -> Option<Arc<Font>> {
        if let Some(known) = self.by_char.get(&c) {
            return known.clone();
        }
        let has = |&id: &fontdb::ID| {
            let found = self.database.with_face_data(id, |data, index| {
                FontRef::from_index(data, index).is_ok_and(|tables| draws(&tables, c))
            });
            found == Some(true)
        };
        let id = self.faces.iter().copied().find(has);
        let font = id.and_then(|id| self.font(id));
        self.by_char.insert(c, font.clone());
        font
    }

    fn font(&mut self, id: fontdb::ID) -> Option<Arc<Font>> {
        let database = &self.database;
        let font = self.loaded.entry(id).or_insert_with(|| {
            let copy = |data: &[u8], index| Font::new(Cow::Owned(data.to_vec()), index);
            database.with_face_data(id, copy).flatten().map(Arc::new)
        });
        font.clone()
    }
}
