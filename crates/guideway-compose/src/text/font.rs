//! [`Font`]: a font file that is parsed once.

use std::borrow::Cow;

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
    pub(super) fn new(data: Cow<'static, [u8]>, index: u32) -> Option<Self> {
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

    /// The content of the font file, and the position of the font in it.
    pub(super) fn file(&self) -> (&[u8], u32) {
        (&self.data, self.index)
    }

    pub(super) fn draws(&self, c: char) -> bool {
        self.tables().is_some_and(|tables| draws(&tables, c))
    }
}

/// Returns `true` if a font has an outline for a character; fonts of colored bitmaps have none.
pub(super) fn draws(tables: &FontRef<'_>, c: char) -> bool {
    let glyph = tables.charmap().map(c);
    glyph.is_some_and(|glyph| c.is_whitespace() || tables.outline_glyphs().get(glyph).is_some())
}
