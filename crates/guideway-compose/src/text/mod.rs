//! Text: shapes a line with fonts and rasterizes its glyphs.
//!
//! | module | input | output |
//! |---|---|---|
//! | `font` | a font file | its tables, parsed once |
//! | `system_fonts` | a character | the first font of the system that draws it |
//! | `fonts` | a character | the first font that draws it: embedded, added, then of the system |
//! | `shape` | a line of text | glyphs in visual order, in units of the font size |
//! | `rasterize` | glyphs, position and size | outlines, coverage per pixel |
//! | `halo` | coverage of the letters | coverage of the halo around them |
//!
//! A letter that no font draws shows as a box. Text that the embedded fonts cover (Latin, Greek,
//! Cyrillic and symbols) is the same on every computer; pages add what they need.

mod font;
mod fonts;
mod halo;
mod rasterize;
mod shape;
mod system_fonts;

#[cfg(not(target_arch = "wasm32"))]
pub use fonts::PageFont;
pub use fonts::{SystemFont, add_font, has_missed_letters, system_font};
pub(crate) use rasterize::{Curve, LinePlace};
pub(crate) use shape::ShapedLine;
