//! A layout under inspection and editing, independent of any window.
//!
//! | module | input | output |
//! |---|---|---|
//! | [`Document`] | layout or scene | scene, selection, undo history, journal entries |
//! | `edit` | selection, pointer positions | [`Change`]s, applied as undoable steps |
//! | [`Index`] | layout | paths and nodes near a place, paths at a node |
//! | [`pick`], [`pick_element`], [`nearest`] | a point | the path or element under it |
//! | [`Query`], [`search`], [`locate`] | text | paths, nodes, stations |
//! | [`Group`] | a level, a vehicle type | the elements that belong to it |
//! | [`levels_by_height`] | layout | the order of its levels in lists |
//! | [`measure`] | a path | lengths and radii |
//! | [`decorations`] | document, view, settings | marks, outlines and draw lists |
//! | [`fixes()`] | a finding | edits that resolve it |
//! | `journal` | bytes | [`JournalEntry`]s, and the document that they recover |
//! | [`Snapshot`] | document | the layout to save, findings |
//! | [`text_format`] | counts, lengths, names | text for people |

mod change;
pub mod decorations;
mod document;
mod edit;
mod edit_observer;
mod element;
mod elements;
mod fixes;
mod group;
mod history;
mod index;
mod journal;
mod level_order;
mod locate;
pub mod measure;
mod pick;
mod pick_element;
mod query;
mod reverse_pairs;
mod search;
mod select_mode;
mod selection;
mod snap;
mod snapshot;
mod view_history;

pub use change::{Change, CopiesOf, NodeMoves};
pub use document::Document;
pub use edit::{
    AlignTo, Clip, Drawing, DrawnCurve, EdgeTemplate, LevelContent, LevelFact, LevelFacts,
    Neighbors, NewCells, NewEdge, OperationError, PointRef, PropertyRef, PropertyValues, Shape,
    ShapeError, TypeUse, Welded, drawn_path,
};
pub use edit_observer::SceneChange;
pub use element::Element;
pub use elements::Elements;
pub use fixes::{Fix, FixError, ProposedFix, fix_all, fixes, has_fixes};
pub use group::Group;
pub use guideway_layout::text_format;
pub use history::SavedState;
pub use index::Index;
pub use journal::{JournalEntry, ReplayProgress, count_records, replay};
pub use level_order::levels_by_height;
pub use locate::{locate, located};
pub use pick::{Hit, nearest, pick};
pub use pick_element::pick_element;
pub use query::{Column, Query, QueryError};
pub use reverse_pairs::ReversePairs;
pub use roaring::RoaringBitmap as PathSet;
pub use search::{search, search_groups};
pub use select_mode::SelectMode;
pub use snap::{SnapOptions, SnapTarget, Snapped};
pub use snapshot::Snapshot;
pub use view_history::ViewHistory;
