//! A layout that is being looked at and edited, free of any window.
//!
//! A [`Document`] holds what is shown, what is selected and what was done, so that it can be undone.
//! [`Index`] finds what is near a place, [`pick`] the path that a person points at, [`Query`] and [`search`]
//! paths by what is known of them; [`measure`] takes lengths and bends, and [`decorations`] places what is drawn
//! over a picture by what a screen can show.

pub mod decorations;
mod document;
mod edit;
mod edit_observer;
mod index;
mod journal;
mod locate;
pub mod measure;
mod moved_nodes;
mod pick;
mod query;
mod reverse_pairs;
mod save;
mod search;
mod snap;
mod steps;
mod view_history;

pub use document::{Document, SelectMode};
pub use edit::{Change, NodeMoves, PointRef, SavedState, drawn_path};
pub use index::Index;
pub use journal::{JournalEntry, ReplayProgress, replay};
pub use locate::locate;
pub use pick::{Hit, nearest, pick};
pub use query::{Query, QueryError};
pub use reverse_pairs::ReversePairs;
pub use roaring::RoaringBitmap as PathSet;
pub use save::Snapshot;
pub use search::{Element, search};
pub use snap::SnapOptions;
pub use steps::{grid_lines_px, round_step};
pub use view_history::ViewHistory;
