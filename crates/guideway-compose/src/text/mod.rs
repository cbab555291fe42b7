//! Text: shapes a line with fonts and rasterizes its glyphs.
//!
//! | module | input | output |
//! |---|---|---|
//! | `fonts` | a character | the first font that draws it: embedded, then of the system |
//! | `shape` | a line of text | glyphs in visual order, in units of the font size |
//! | `rasterize` | glyphs, position and size | outlines, coverage per pixel |
//! | `halo` | coverage of the letters | coverage of the halo around them |
//!
//! A letter that no font draws shows as a box. Text that the embedded fonts cover (Latin, Greek,
//! Cyrillic and symbols) is the same on every computer.

mod fonts;
mod halo;
mod rasterize;
mod shape;

pub use fonts::{SystemFont, system_font};
pub(crate) use rasterize::{Curve, LinePlace};
pub(crate) use shape::ShapedLine;
