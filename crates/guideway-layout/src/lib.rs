//! The layout model: what a layout file means, free of any file format and of any renderer.
//!
//! Meters, y up, `f64`. Paths are held in columns rather than as an object each, so that a million of
//! them load, hold and iterate cheaply. Every path of the input is either in [`Layout::paths`] or in
//! [`Layout::refused`] with its reason: nothing is lost in silence.
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
mod diagnostic;
mod geometry;
mod limits;
mod merge;
mod nodes;
mod paths;
mod refused;
mod run_points;
mod text;
mod vehicle_types;

use std::sync::Arc;

pub use attribute::{Attribute, Attributes, Value, Values};
pub use cells::Cells;
pub use check::{
    At, CheckOptions, check, check_across, name as element_name, place as element_place,
    same_curves,
};
pub use diagnostic::{Code, Diagnostic, Diagnostics, Place, Severity};
pub use geometry::{Geometry, Hulls, add_boxes};
pub use limits::Limits;
pub use merge::merge;
pub use nodes::{Level, Nodes, Stations};
pub use paths::{Direction, NewPath, OwnStyle, PathRef, Paths};
pub use refused::{Refused, RefusedPath};
pub use run_points::RunPoints;
pub use text::TextColumn;
pub use vehicle_types::VehicleTypes;

/// A whole layout, as read from one file.
#[derive(Clone, Debug, Default)]
pub struct Layout {
    /// Where it came from.
    pub provenance: Provenance,
    /// Everything that is drawn.
    pub paths: Paths,
    /// Paths of the input that cannot be drawn, each with its reason.
    pub refused: Refused,
    /// Points where paths meet.
    pub nodes: Nodes,
    /// Places where vehicles do something: stations, locations.
    pub stations: Stations,
    /// Floors of the building, or separate layouts of one file.
    pub levels: Vec<Level>,
    /// What was found wrong or odd while reading.
    pub diagnostics: Diagnostics,
}

impl Layout {
    /// Paths of the input: those that can be drawn and those refused.
    pub fn path_count(&self) -> usize {
        self.paths.len() + self.refused.len()
    }

    /// Index of the level of this name or id, if there is one.
    pub fn level_named(&self, name: &str) -> Option<u32> {
        let found = self
            .levels
            .iter()
            .position(|l| l.id == name || l.name.as_deref() == Some(name));
        found.map(|i| i as u32)
    }

    /// Heap bytes held, near enough to plan by.
    pub fn heap_bytes(&self) -> usize {
        self.paths.heap_bytes()
            + self.refused.heap_bytes()
            + self.nodes.heap_bytes()
            + self.stations.heap_bytes()
    }
}

/// Where a layout came from.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Provenance {
    /// Path of the file, or another name for the source, as given.
    pub source: String,
    /// Format found, such as `LIF` or `openTCS`.
    pub format: String,
    /// Version of the format, as found in the structure of the file.
    pub format_version: String,
    /// Elements counted in the source under the format's own names, such as `("edges", 12)`.
    pub counts: Vec<(String, u64)>,
    /// The text of the file, where a writer of its format keeps what of it the layout has not.
    pub text: Option<Arc<str>>,
}
