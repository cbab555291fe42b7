//! Selects the font of a character: the embedded fonts first, then the fonts of the system.

use std::borrow::Cow;
use std::collections::HashMap;
use std::sync::{Arc, LazyLock, Mutex, PoisonError};

use epaint_default_fonts::{HACK_REGULAR, NOTO_EMOJI_REGULAR, UBUNTU_LIGHT};
use harfrust::ShaperData;
use skrifa::{FontRef, MetadataProvider};

/// A font file, parsed once.
pub(super) struct Font {
    data: Cow<'static, [u8]>,
    /// Position in a font collection.
    index: u32,
    pub(super) shaper: ShaperData,
}

impl Font {
    fn new(data: Cow<'static, [u8]>, index: u32) -> Option<Self> {
        let shaper = ShaperData::new(&FontRef::from_index(&data, index).ok()?);
        Some(Self {
            data,
            index,
            shaper,
        })
    }

    /// The tables of the font. `None` never occurs after [`Font::new`] has parsed them.
    pub(super) fn tables(&self) -> Option<FontRef<'_>> {
        FontRef::from_index(&self.data, self.index).ok()
    }

    fn draws(&self, c: char) -> bool {
        self.tables().is_some_and(|tables| draws(&tables, c))
    }
}

/// Returns `true` if a font has an outline for a character; fonts of colored bitmaps have none.
fn draws(tables: &FontRef<'_>, c: char) -> bool {
    let glyph = tables.charmap().map(c);
    glyph.is_some_and(|glyph| c.is_whitespace() || tables.outline_glyphs().get(glyph).is_some())
}

/// The fonts of all texts. Fonts of the system load when the first character needs them.
pub(super) struct Fonts {
    embedded: Vec<Arc<Font>>,
    system: Option<LazyLock<Mutex<SystemFonts>>>,
}

/// The fonts that all pictures share.
pub(super) static FONTS: LazyLock<Fonts> = LazyLock::new(|| Fonts {
    system: Some(LazyLock::new(|| Mutex::new(SystemFonts::load()))),
    ..Fonts::embedded()
});

/// A font file of the system and the position of the font in it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SystemFont {
    /// The content of the file.
    pub data: Vec<u8>,
    /// Position in a font collection, 0 in other files.
    pub index: u32,
}

/// The font with which pictures show a character that no embedded font draws. `None` if the system
/// has none.
pub fn system_font(c: char) -> Option<SystemFont> {
    let font = FONTS.find(c, None)?;
    let (data, index) = (font.data.to_vec(), font.index);
    Some(SystemFont { data, index })
}

impl Fonts {
    /// The embedded fonts alone: monospaced Hack, Ubuntu Light for more letters, and symbols.
    pub(super) fn embedded() -> Self {
        let files = [HACK_REGULAR, UBUNTU_LIGHT, NOTO_EMOJI_REGULAR];
        let fonts = files
            .into_iter()
            .filter_map(|data| Font::new(Cow::Borrowed(data), 0));
        Self {
            embedded: fonts.map(Arc::new).collect(),
            system: None,
        }
    }

    /// The font that draws a character; `None` if no font does. A character that continues the one
    /// before, such as an accent, stays in `previous` where that font has it.
    pub(super) fn find(&self, c: char, previous: Option<&Arc<Font>>) -> Option<Arc<Font>> {
        if continues(c) && previous.is_some_and(|font| font.draws(c)) {
            return previous.cloned();
        }
        let embedded = self.embedded.iter().find(|font| font.draws(c));
        embedded.cloned().or_else(|| {
            let system = self.system.as_ref()?;
            // A cache of fonts is complete at any time, so a panic elsewhere does not spoil it.
            let mut system = system.lock().unwrap_or_else(PoisonError::into_inner);
            system.find(c)
        })
    }
}

/// Returns `true` if a character belongs to the one before: combining marks, joiners, variation
/// selectors.
fn continues(c: char) -> bool {
    matches!(c,
        '\u{300}'..='\u{36F}' | '\u{1AB0}'..='\u{1AFF}' | '\u{1DC0}'..='\u{1DFF}'
        | '\u{200C}'..='\u{200D}' | '\u{20D0}'..='\u{20FF}' | '\u{FE00}'..='\u{FE0F}'
        | '\u{FE20}'..='\u{FE2F}' | '\u{E0100}'..='\u{E01EF}')
}

/// The fonts of the system and the characters that were looked up in them.
struct SystemFonts {
    database: fontdb::Database,
    /// Upright fonts of regular weight first.
    faces: Vec<fontdb::ID>,
    loaded: HashMap<fontdb::ID, Option<Arc<Font>>>,
    by_char: HashMap<char, Option<Arc<Font>>>,
}

impl SystemFonts {
    fn load() -> Self {
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

    fn find(&mut self, c: char) -> Option<Arc<Font>> {
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn embedded_fonts_draw_european_scripts() {
        let fonts = Fonts::embedded();
        for c in "Größe Zürich Süd Αθήνα Склад № 5 łódź €".chars() {
            assert!(fonts.find(c, None).is_some(), "{c}");
        }
    }

    #[test]
    fn no_font_is_found_for_a_private_character() {
        assert!(Fonts::embedded().find('\u{10FFFD}', None).is_none());
    }

    #[test]
    fn accent_stays_in_font_of_its_letter() {
        let fonts = Fonts::embedded();
        let letter = fonts.find('e', None).unwrap();
        let accent = fonts.find('\u{301}', Some(&letter)).unwrap();
        assert!(Arc::ptr_eq(&letter, &accent));
    }
}
