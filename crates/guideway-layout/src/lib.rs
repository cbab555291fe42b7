//! The layout model: the contents of a layout file, independent of file formats and renderers.
//!
//! Positions are in meters, y up, in `f64`. Tables store one column per property, so that a million
//! paths load, iterate and fit in memory cheaply. Every path of the input is either in
//! [`Layout::paths`] or, with its reason, in [`Layout::refused`].
//!
//! | module | defines |
//! |---|---|
//! | `layout` | the model as a whole: tables, levels, provenance |
//! | `path`, `paths`, `nodes`, `stations`, `level`, `refused` | its tables |
//! | `type_entries` | vehicle types of paths and nodes, with properties per type |
//! | `groups` | vehicle types, blocks, zones |
//! | `geometry`, `run_points` | the curves of all paths in flat buffers |
//! | `written_curve` | NURBS curves as their file wrote them |
//! | `source_text`, `line_index`, `locate` | place of each row in the text of its file, as a line |
//! | `text`, `cells`, `text_cells`, `optional_column` | columns |
//! | `attribute`, `values`, `quantity` | further columns, with units |
//! | `property` | names, kinds and units of the columns that several formats share |
//! | `code`, `place`, `diagnostic`, `limits` | findings and limits of readers |
//! | `user_error`, `near` | the error that the command and the window show, and names it suggests |
//! | `merge` | joins layouts |
//! | `row_visits` | visits the rows of a column that an edit names |
//! | [`text_format`] | text for people of counts, lengths, names |
//! | [`clock`] | the time, in a browser too |
//! | `compare` | differences between two layouts |
//! | `check` | finds defects of geometry and topology |
//!
//! ```
//! use guideway_layout::{Layout, NewPath};
//! use guideway_spline::{Point, Runs};
//!
//! let mut layout = Layout::default();
//! let mut runs = Runs::default();
//! runs.push_line(Point::new(0.0, 0.0), Point::new(12.0, 0.0));
//! layout.paths.push(&NewPath { id: "aisle-1", runs: &runs, ..NewPath::default() });
//! assert_eq!(layout.paths.len(), 1);
//! assert_eq!(layout.paths.id(0), "aisle-1");
//! ```

mod attribute;
mod cells;
mod check;
pub mod clock;
mod code;
mod compare;
mod diagnostic;
mod geo_origin;
mod geometry;
mod groups;
mod layout;
mod level;
mod limits;
mod line_index;
mod locate;
mod may_fail;
mod merge;
mod near;
mod nodes;
mod note;
mod optional_column;
mod path;
mod paths;
mod place;
mod property;
mod quantity;
mod reach;
mod refused;
mod row_visits;
mod run_points;
mod shown;
mod source_file;
mod source_text;
mod stations;
mod text;
mod text_cells;
pub mod text_format;
mod type_entries;
mod user_error;
mod values;
mod written_curve;

pub use attribute::{Attribute, Attributes};
pub use cells::Cells;
pub use check::{
    CheckOptions, DisplayPosition, check, check_across, check_watched, element_name, element_place,
    largest_angle_rad, same_curves,
};
pub use code::{Code, Severity};
pub use compare::{
    Change, ChangedTexts, ChangedValue, Changes, CompareOptions, Difference, ElementChange,
    ElementChanges, changes, differences,
};
pub use diagnostic::{Diagnostic, Diagnostics, FindingKind};
pub use geo_origin::GeoOrigin;
pub use geometry::{Geometry, Hulls, append_hulls};
pub use groups::{Block, Member, VehicleType, Zone};
pub use layout::{Layout, Provenance};
pub use level::Level;
pub use limits::Limits;
pub use line_index::{LineIndex, TextPosition};
pub use may_fail::{may_fail, try_reserve};
pub use merge::merge;
pub use near::near_names;
pub use nodes::Nodes;
pub use note::{Note, NoteKind};
pub use path::{Direction, NewPath, OwnStyle};
pub use paths::{PathRef, Paths, Sample};
pub use place::{Origin, Place};
pub use property::{ElementKind, PROPERTIES, Property, PropertyKind};
pub use quantity::Quantity;
pub use refused::{Refused, RefusedPath};
pub use row_visits::{for_each_row, rows_ascend};
pub use run_points::RunPoints;
pub use shown::{is_hidden, shown_lines, shown_path, shown_text};
pub use source_file::SourceFile;
pub use source_text::SourceSpans;
pub use stations::Stations;
pub use text::TextColumn;
pub use text_cells::TextCells;
pub use type_entries::TypeEntries;
pub use user_error::UserError;
pub use values::{Value, Values};
pub use written_curve::{WrittenCurve, WrittenCurves};
