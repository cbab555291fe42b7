//! Decorations of a picture, placed so that they keep clear of each other.
//!
//! `guideway-document` draws grid, scale bar, legend, arrows, symbols and labels, as for the window.
//!
//! | module | input | output |
//! |---|---|---|
//! | `options` | | the selection of decorations |
//! | `title` | a text | one line, top center |
//! | `place` | scene, view, selection | draw lists that keep clear of each other |

mod options;
mod place;
mod title;

pub use options::Decorations;
pub(crate) use place::{PlacedDecorations, place};
pub(crate) use title::title_band_px;
