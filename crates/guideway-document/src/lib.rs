//! A layout that is being looked at and edited, free of any window.
//!
//! A [`Document`] holds what is shown, what is selected and what was done, so that it can be undone.
//! [`Index`] finds what is near a place, [`pick`] the path that a person points at, [`Query`] and [`search`]
//! paths by what is known of them; [`measure`] takes lengths and bends, and [`marks`] places what is drawn
//! over a picture by what a screen can show.

mod audience;
mod document;
mod edit;
mod index;
mod journal;
mod locate;
pub mod marks;
pub mod measure;
mod moved_nodes;
mod pick;
mod query;
mod save;
mod search;
mod snap;
mod steps;
mod trail;
mod twins;

pub use document::{Combine, Document};
pub use edit::{Change, NodeMoves, PointRef, Saved, drawn_path};
pub use index::Index;
pub use journal::{Act, Replayed, replay};
pub use locate::locate;
pub use pick::{Hit, nearest, pick};
pub use query::{Query, QueryError};
pub use roaring::RoaringBitmap as Rows;
pub use save::Snapshot;
pub use search::{Found, search};
pub use snap::Snap;
pub use steps::{grid_lines_px, round_step};
pub use trail::Trail;
pub use twins::Twins;
