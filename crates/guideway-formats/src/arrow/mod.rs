//! Tables of paths in Apache Arrow IPC files (also called Feather V2) and streams.
//!
//! The columns are described in `docs/arrow-format.md`. What is read is not trusted: lengths and
//! positions that a file declares are compared with the bytes there are before anything is decoded,
//! and what a few bytes may swell to is budgeted.

mod attributes;
mod batch;
mod body;
mod budget;
mod container;
mod decode;
mod gather;
mod guard;
mod ids;
mod look;
mod points;
mod polygons;
mod read;
mod schema;
mod table;
mod text;
mod text_sink;
mod write;
mod write_columns;
mod write_layout;

pub(crate) use read::read;
pub use write::{ArrowWriter, Precision, WriteError, WriteProblem};
pub use write_columns::{Column, ColumnType};
pub use write_layout::{WriteOptions, write_layout};

/// Name of the column of identifiers.
const ID: &str = "id";
/// Name of the column of control polygons.
const CONTROL_POINTS: &str = "control_points";
/// Name of the column that joins several rows to one path.
const PART: &str = "guideway.part";
/// Name of the column of levels.
const LEVEL: &str = "level";
/// Name of the column of stroke widths.
const WIDTH: &str = "width_m";
/// Name of the column of colors.
const COLOR: &str = "color";
/// Name of the column of draw ranks.
const RANK: &str = "rank";
/// Key of the schema's metadata that holds the version of the table.
const VERSION_KEY: &str = "guideway.version";
/// Newest version of the table that is known.
const VERSION: u32 = 1;
