//! Decorations: what a picture shows besides paths and backdrop, as draw lists in its pixels.
//!
//! | module | input | output |
//! |---|---|---|
//! | `grid` | view | lines at round coordinates, below the paths |
//! | `marks` | arrows, nodes, stations and labels of a document | shapes and texts over the paths |
//! | `scale_bar` | view | a bar of a round length, lower left |
//! | `legend` | colors of a scene | swatches and labels, upper left |
//! | `title` | a text | one line, top center |
//! | `place` | all of the above | draw lists that keep clear of each other |

mod grid;
mod legend;
mod marks;
mod options;
mod place;
mod scale_bar;
mod title;

pub use grid::grid;
pub use marks::marks_list;
pub use options::{DecorationStyle, Decorations};
pub(crate) use place::{PlacedDecorations, place};
pub use scale_bar::scale_bar;
