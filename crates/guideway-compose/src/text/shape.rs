//! Shapes a line of text: bidirectional runs, fonts per character, then glyphs in visual order.

use std::ops::Range;
use std::sync::Arc;

use guideway_scene::TextLine;
use harfrust::{Direction, GlyphId, ShapeOptions, UnicodeBuffer};
use unicode_bidi::{BidiInfo, Level};

use super::font::Font;
use super::fonts::{FONTS, Fonts};

/// Advance of the box of a letter that no font draws, in units of the font size: as Hack.
const BOX_ADVANCE: f64 = TextLine::CHAR_ASPECT;

/// A glyph at its position. Units: the font size; origin: the left end of the baseline, y up.
pub(super) struct PlacedGlyph {
    /// `None` for a letter that no font draws.
    pub(super) font: Option<Arc<Font>>,
    pub(super) id: GlyphId,
    pub(super) x: f64,
    pub(super) y: f64,
}

/// A line of text as glyphs in visual order.
pub(crate) struct ShapedLine {
    pub(super) glyphs: Vec<PlacedGlyph>,
    /// Width in units of the font size.
    pub(super) width: f64,
}

impl ShapedLine {
    /// Shapes a text with the embedded fonts and the fonts of the system.
    pub(crate) fn new(text: &str) -> Self {
        Self::with_fonts(text, &FONTS)
    }

    pub(super) fn with_fonts(text: &str, fonts: &Fonts) -> Self {
        let mut line = Self {
            glyphs: Vec::new(),
            width: 0.0,
        };
        let bidi = BidiInfo::new(text, None);
        for paragraph in &bidi.paragraphs {
            let (levels, runs) = bidi.visual_runs(paragraph, paragraph.range.clone());
            for run in runs {
                let level = levels.get(run.start).copied().unwrap_or(Level::ltr());
                line.push_run(&text[run], level.is_rtl(), fonts);
            }
        }
        line
    }

    /// Appends a run of one direction.
    fn push_run(&mut self, text: &str, is_rtl: bool, fonts: &Fonts) {
        let mut parts = font_parts(text, fonts);
        if is_rtl {
            parts.reverse();
        }
        for (range, font) in parts {
            match font {
                Some(font) => self.push_part(&text[range], is_rtl, &font),
                None => self.push_boxes(text[range].chars().count()),
            }
        }
    }

    /// Appends a part in one font.
    fn push_part(&mut self, text: &str, is_rtl: bool, font: &Arc<Font>) {
        let Some(tables) = font.tables() else {
            return;
        };
        let shaper = font.shaper.shaper(&tables).build();
        let mut buffer = UnicodeBuffer::new();
        buffer.push_str(text);
        buffer.guess_segment_properties();
        buffer.set_direction(match is_rtl {
            true => Direction::RightToLeft,
            false => Direction::LeftToRight,
        });
        let per_unit = 1.0 / f64::from(shaper.units_per_em().max(1));
        let shaped = shaper.shape(buffer, ShapeOptions::default());
        let positions = shaped.glyph_positions().iter();
        for (glyph, at) in shaped.glyph_infos().iter().zip(positions) {
            self.glyphs.push(PlacedGlyph {
                font: Some(Arc::clone(font)),
                id: GlyphId::new(glyph.glyph_id),
                x: self.width + f64::from(at.x_offset) * per_unit,
                y: f64::from(at.y_offset) * per_unit,
            });
            self.width += f64::from(at.x_advance) * per_unit;
        }
    }

    fn push_boxes(&mut self, count: usize) {
        for _ in 0..count {
            self.glyphs.push(PlacedGlyph {
                font: None,
                id: GlyphId::NOTDEF,
                x: self.width,
                y: 0.0,
            });
            self.width += BOX_ADVANCE;
        }
    }
}

/// Splits a text where the font changes.
fn font_parts(text: &str, fonts: &Fonts) -> Vec<(Range<usize>, Option<Arc<Font>>)> {
    let mut parts: Vec<(Range<usize>, Option<Arc<Font>>)> = Vec::new();
    for (start, c) in text.char_indices() {
        let end = start + c.len_utf8();
        let previous = parts.last().and_then(|(_, font)| font.as_ref());
        let font = fonts.find(c, previous);
        match parts.last_mut() {
            Some((range, last))
                if last.as_ref().map(Arc::as_ptr) == font.as_ref().map(Arc::as_ptr) =>
            {
                range.end = end;
            }
            _ => parts.push((start..end, font)),
        }
    }
    parts
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shaped(text: &str) -> ShapedLine {
        ShapedLine::with_fonts(text, &Fonts::embedded())
    }

    #[test]
    fn embedded_font_is_as_wide_as_its_columns() {
        for text in ["Größe", "Zürich Süd", "Αθήνα", "Склад"] {
            let line = shaped(text);
            let columns = text.chars().count() as f64;
            let width = columns * TextLine::CHAR_ASPECT;
            assert!((line.width / width - 1.0).abs() < 0.01, "{text}");
            assert!(line.glyphs.iter().all(|g| g.font.is_some()), "{text}");
            let missing = line.glyphs.iter().filter(|g| g.id == GlyphId::NOTDEF);
            assert_eq!(missing.count(), 0, "{text}");
        }
    }

    #[test]
    fn letters_that_no_font_draws_are_boxes() {
        let line = shaped("a\u{10FFFD}b");
        let has_font: Vec<bool> = line.glyphs.iter().map(|g| g.font.is_some()).collect();
        assert_eq!(has_font, [true, false, true]);
    }

    #[test]
    fn right_to_left_runs_are_reversed() {
        // No embedded font draws Hebrew: boxes, in visual order around the digits.
        let line = shaped("\u{5D0}\u{5D1} 12");
        let is_box: Vec<bool> = line.glyphs.iter().map(|g| g.font.is_none()).collect();
        assert_eq!(is_box, [false, false, false, true, true]);
    }

    #[test]
    fn combining_accent_takes_no_width() {
        let (composed, combined) = (shaped("\u{E9}"), shaped("e\u{301}"));
        assert_eq!(composed.width, combined.width);
    }

    #[test]
    fn system_fonts_draw_what_embedded_ones_lack() {
        let has_cjk = FONTS.find('漢', None).is_some();
        let line = ShapedLine::new("漢");
        assert_eq!(line.glyphs[0].font.is_some(), has_cjk);
    }
}
