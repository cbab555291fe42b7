//! The layout model: the contents of a layout file, independent of file formats and renderers.
//!
//! Positions are in meters, y up, in `f64`. Tables store one column per property, so that a million
//! paths load, iterate and fit in memory cheaply. Every path of the input is either in
//! [`Layout::paths`] or, with its reason, in [`Layout::refused`].
//!
//! | module | defines |
//! |---|---|
//! | `layout` | the model as a whole: tables, levels, provenance |
//! | `path`, `paths`, `nodes`, `vehicle_types`, `refused` | its tables |
//! | `geometry`, `run_points` | the curves of all paths in flat buffers |
//! | `text`, `cells`, `attribute` | columns of texts, optional values and attributes |
//! | `code`, `diagnostic`, `limits` | findings and limits of readers |
//! | `user_error` | the error that the command and the window show |
//! | `merge` | joins layouts |
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
mod code;
mod diagnostic;
mod geometry;
mod layout;
mod limits;
mod merge;
mod nodes;
mod path;
mod paths;
mod refused;
mod run_points;
mod text;
mod user_error;
mod vehicle_types;

pub use attribute::{Attribute, Attributes, Value, Values};
pub use cells::Cells;
pub use check::{
    CheckOptions, DisplayPosition, check, check_across, element_name, element_place, same_curves,
};
pub use code::{Code, Severity};
pub use diagnostic::{Diagnostic, Diagnostics, Place};
pub use geometry::{Geometry, Hulls, append_hulls};
pub use layout::{Layout, Provenance};
pub use limits::Limits;
pub use merge::merge;
pub use nodes::{Level, Nodes, Stations};
pub use path::{Direction, NewPath, OwnStyle};
pub use paths::{PathRef, Paths};
pub use refused::{Refused, RefusedPath};
pub use run_points::RunPoints;
pub use text::TextColumn;
pub use user_error::UserError;
pub use vehicle_types::VehicleTypes;
