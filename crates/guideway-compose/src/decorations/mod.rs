//! Selects and places the decorations of a picture, as draw lists in its pixels.
//!
//! | module | input | output |
//! |---|---|---|
//! | `options` | | [`Decorations`]: the selection |
//! | `title` | a text | draw list: one line at the top center |
//! | `place_legend` | scene, view, selection | legend and scale bar in the emptiest corners |
//! | `zones` | scene, view | draw list: outlines of zones with a tint |
//! | `route` | scene, view, rows of paths | draw list: a band along a route, its ends marked |
//! | `place` | scene, view, selection | draw lists that keep clear of each other |
//!
//! `guideway_document::decorations` draws grid, marks, scale bar and legend.

mod options;
mod place;
mod place_legend;
mod route;
mod title;
mod zones;

pub use options::Decorations;
pub(crate) use place::{PlacedDecorations, place};
pub(crate) use place_legend::{PlacedCorners, density_legend, place_corners};
pub use route::MarkedRoute;
