//! Selects the font of a character: the embedded fonts first, then those that were added, then the
//! fonts of the system.

use std::borrow::Cow;
use std::io::Read;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, LazyLock, Mutex, MutexGuard, OnceLock, PoisonError};

use flate2::read::GzDecoder;

use super::font::Font;
use super::system_fonts::SystemFonts;

/// First bytes of gzip.
const GZIP: &[u8] = &[0x1F, 0x8B];

/// The embedded fonts: monospaced Hack, and those that pages get apart.
const EMBEDDED: &[&[u8]] = &[
    include_bytes!(concat!(env!("OUT_DIR"), "/hack.ttf")),
    #[cfg(not(target_arch = "wasm32"))]
    PageFont::Letters.packed(),
    #[cfg(not(target_arch = "wasm32"))]
    PageFont::Symbols.packed(),
];

/// An embedded font that few names need: a page has it in a part of its own.
#[cfg(not(target_arch = "wasm32"))]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PageFont {
    /// Ubuntu Light: polytonic Greek, rare Latin and Cyrillic letters.
    Letters,
    /// Symbols.
    Symbols,
}

#[cfg(not(target_arch = "wasm32"))]
impl PageFont {
    /// All, in the order in which a letter is sought in them.
    pub const ALL: [Self; 2] = [Self::Letters, Self::Symbols];

    /// The name of the part.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Letters => "letters",
            Self::Symbols => "symbols",
        }
    }

    /// The font as gzip.
    pub const fn packed(self) -> &'static [u8] {
        match self {
            Self::Letters => include_bytes!(concat!(env!("OUT_DIR"), "/letters.ttf")),
            Self::Symbols => include_bytes!(concat!(env!("OUT_DIR"), "/symbols.ttf")),
        }
    }

    /// Returns `true` if this font, and none before it, draws a letter of a text.
    pub fn is_needed(self, text: &str) -> bool {
        let (before, from_own) = FONTS.embedded.split_at(1 + self as usize);
        let own = from_own.first();
        let draws = |c| own.is_some_and(|font| font.draws(c));
        let is_own = |c| draws(c) && !before.iter().any(|font| font.draws(c));
        text.chars().any(|c| !c.is_ascii() && is_own(c))
    }
}

/// An embedded font, unpacked and parsed when a character first needs it.
struct EmbeddedFont {
    file: &'static [u8],
    font: OnceLock<Option<Arc<Font>>>,
}

impl EmbeddedFont {
    /// `None` never occurs: the build wrote the file.
    fn font(&self) -> Option<&Arc<Font>> {
        let parsed = || Font::new(unpacked(self.file)?, 0).map(Arc::new);
        self.font.get_or_init(parsed).as_ref()
    }

    #[cfg(not(target_arch = "wasm32"))]
    fn draws(&self, c: char) -> bool {
        self.font().is_some_and(|font| font.draws(c))
    }
}

/// The fonts of all texts. Fonts of the system load when the first character needs them.
pub(super) struct Fonts {
    embedded: Vec<EmbeddedFont>,
    given: Mutex<Vec<Arc<Font>>>,
    system: Option<LazyLock<Mutex<SystemFonts>>>,
    has_missed: AtomicBool,
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
    let (data, index) = font.file();
    Some(SystemFont {
        data: data.to_vec(),
        index,
    })
}

/// Adds a font file for letters that the embedded fonts lack. Returns `false` if it is none.
pub fn add_font(data: Vec<u8>) -> bool {
    FONTS.add(data)
}

/// Returns `true` if a picture since the last call showed a box in place of a letter.
pub fn has_missed_letters() -> bool {
    FONTS.has_missed.swap(false, Ordering::Relaxed)
}

impl Fonts {
    /// The embedded fonts alone.
    pub(super) fn embedded() -> Self {
        let fonts = EMBEDDED.iter().map(|file| EmbeddedFont {
            file,
            font: OnceLock::new(),
        });
        Self {
            embedded: fonts.collect(),
            given: Mutex::default(),
            system: None,
            has_missed: AtomicBool::new(false),
        }
    }

    /// The font that draws a character; `None` if no font does. A character that continues the one
    /// before, such as an accent, stays in `previous` where that font has it.
    pub(super) fn find(&self, c: char, previous: Option<&Arc<Font>>) -> Option<Arc<Font>> {
        if continues(c) && previous.is_some_and(|font| font.draws(c)) {
            return previous.cloned();
        }
        let draws = |font: &&Arc<Font>| font.draws(c);
        let mut embedded = self.embedded.iter().filter_map(EmbeddedFont::font);
        let found = embedded.find(draws).cloned();
        let found = found.or_else(|| self.given().iter().find(draws).cloned());
        let found = found.or_else(|| {
            let system = self.system.as_ref()?;
            // A cache of fonts is complete at any time, so a panic elsewhere does not spoil it.
            let mut system = system.lock().unwrap_or_else(PoisonError::into_inner);
            system.find(c)
        });
        if found.is_none() {
            self.has_missed.store(true, Ordering::Relaxed);
        }
        found
    }

    fn add(&self, data: Vec<u8>) -> bool {
        let font = Font::new(Cow::Owned(data), 0).map(Arc::new);
        let is_font = font.is_some();
        self.given().extend(font);
        is_font
    }

    fn given(&self) -> MutexGuard<'_, Vec<Arc<Font>>> {
        self.given.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// The font in an embedded file, which is gzip but in pages. `None` if it is damaged.
fn unpacked(file: &'static [u8]) -> Option<Cow<'static, [u8]>> {
    if !file.starts_with(GZIP) {
        return Some(Cow::Borrowed(file));
    }
    let mut font = Vec::new();
    GzDecoder::new(file).read_to_end(&mut font).ok()?;
    Some(Cow::Owned(font))
}

/// Returns `true` if a character belongs to the one before: combining marks, joiners, variation
/// selectors.
fn continues(c: char) -> bool {
    matches!(c,
        '\u{300}'..='\u{36F}' | '\u{1AB0}'..='\u{1AFF}' | '\u{1DC0}'..='\u{1DFF}'
        | '\u{200C}'..='\u{200D}' | '\u{20D0}'..='\u{20FF}' | '\u{FE00}'..='\u{FE0F}'
        | '\u{FE20}'..='\u{FE2F}' | '\u{E0100}'..='\u{E01EF}')
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
    fn a_letter_is_missed_until_a_font_with_it_is_added() {
        let fonts = Fonts {
            embedded: Vec::new(),
            ..Fonts::embedded()
        };
        let has_missed = || fonts.has_missed.swap(false, Ordering::Relaxed);
        assert!(!has_missed());
        assert!(fonts.find('⚡', None).is_none() && has_missed());
        assert!(!fonts.add(b"no font".to_vec()));
        assert!(fonts.add(unpacked(PageFont::Symbols.packed()).unwrap().into_owned()));
        assert!(fonts.find('⚡', None).is_some() && !has_missed());
        assert!(fonts.find('\u{10FFFD}', None).is_none() && has_missed());
    }

    #[test]
    fn rare_letters_and_symbols_are_told_from_others() {
        for (text, expected) in [
            ("Größe → Αθήνα №5", &[][..]),
            ("Ἀθῆναι", &[PageFont::Letters]),
            ("⚡ charger", &[PageFont::Symbols]),
            ("⚡ Ἀθῆναι", &PageFont::ALL),
            ("漢", &[]),
        ] {
            let needed = PageFont::ALL
                .into_iter()
                .filter(|font| font.is_needed(text));
            assert_eq!(needed.collect::<Vec<_>>(), expected, "{text}");
        }
    }

    #[test]
    fn accent_stays_in_font_of_its_letter() {
        let fonts = Fonts::embedded();
        let letter = fonts.find('e', None).unwrap();
        let accent = fonts.find('\u{301}', Some(&letter)).unwrap();
        assert!(Arc::ptr_eq(&letter, &accent));
    }
}
