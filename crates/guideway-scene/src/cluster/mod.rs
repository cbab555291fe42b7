//! The spatial index of Guideway: sorts rows along a Hilbert curve, cuts them into clusters of 64
//! neighbors and keeps a bounding box per cluster up to date while the rows are edited.
//!
//! A row is anything with a position: a path, a node, a stroke. The index knows nothing of how rows
//! are drawn or found; it stores row numbers and boxes.
//!
//! | file           | input                         | output                                      |
//! |----------------|-------------------------------|---------------------------------------------|
//! | `hilbert_sort` | a position per row            | rows in Hilbert order                       |
//! | `order`        | rows in Hilbert order         | [`ClusterOrder`]: clusters, place of a row  |
//! | `bounds`       | hulls of changed members      | [`ClusterBounds`]: box and origin, updated  |
//! | `index`        | an order, a hull per cluster  | [`ClusterIndex`]: bounds per cluster        |
//! | `edit`         | edited or appended rows       | updated bounds, the clusters that changed   |
//! | `dirty`        | cluster numbers               | [`DirtyClusters`]: a set of clusters        |
//! | `boxes`        | a box per row                 | [`BoxIndex`]: rows that meet a query box    |
//! | `sort_paths`   | a layout                      | [`sort_paths`]: its paths in Hilbert order  |
//!
//! ```text
//!   rows in file order        Hilbert order            clusters of 64 rows
//!   0 1 2 3 4 5 ...    ->     7 3 0 12 5 1 ...   ->    [7 3 0 12 ...][5 1 ...][...]
//!                                                        box, origin   box, ...
//! ```
//!
//! Sorting once and cutting into equal clusters replaces a tree: a query tests every cluster box
//! and then the boxes of few rows, and an edit updates only the clusters of the edited rows.

mod bounds;
mod boxes;
mod dirty;
mod edit;
mod hilbert_sort;
mod index;
mod order;
mod sort_paths;

pub use bounds::{ClusterBounds, MemberHull};
pub use boxes::BoxIndex;
pub use dirty::DirtyClusters;
pub use edit::{AppliedEdit, PendingEdit, RowHulls};
pub use hilbert_sort::hilbert_order;
pub use index::ClusterIndex;
pub use order::{CLUSTER_LEN, ClusterOrder, Members};
pub use sort_paths::sort_paths;
