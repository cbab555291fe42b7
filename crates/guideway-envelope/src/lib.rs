//! Computes the area that a vehicle sweeps along its paths, and the distances of swept areas to
//! each other and to walls.
//!
//! | Stage | Input | Output | File |
//! |---|---|---|---|
//! | parse | text such as `2x1.2,0.5` or `file` | source | `source_text` |
//! | source | layout, vehicle or columns | headings, areas | `source`, `heading`, `file_area` |
//! | follow | path and heading | curve pieces with headings | `path_follower`, `curve_piece` |
//! | bound | curve pieces and body | convex polygons | `sweep`, `hull`, `body`, `convex` |
//! | compare | two sweeps | their closest approach | `proximity` |
//! | check | layout, walls | findings | `clearance` |
//!
//! The reference point of a [`Body`] follows a path at a [`Heading`]: a [`Sweep`]. A distance query
//! halves the parts of two sweeps only where that matters, so that an answer within a centimeter
//! does not need polygons within a centimeter everywhere.
//!
//! ```
//! use guideway_envelope::{Body, Heading, Sweep};
//! use guideway_layout::{Layout, NewPath};
//! use guideway_spline::{Point, Runs};
//!
//! let mut layout = Layout::default();
//! let mut runs = Runs::default();
//! runs.push_line(Point::new(0.0, 0.0), Point::new(12.0, 0.0));
//! layout.paths.push(&NewPath { id: "aisle-1", runs: &runs, ..NewPath::default() });
//!
//! let vehicle = Body::vehicle(2.0, 1.2, 0.5);
//! let headings = [Heading::Tangential(0.0)];
//! let sweep = Sweep::new(layout.paths.get(0), vehicle, &headings).expect("a path with a length");
//! let bounds = sweep.bounds();
//! assert_eq!((bounds.min.x, bounds.max.x), (-0.5, 13.5));
//! assert_eq!((bounds.min.y, bounds.max.y), (-0.6, 0.6));
//! ```

mod body;
mod clearance;
mod convex;
mod curve_piece;
mod file_area;
mod heading;
mod hull;
mod no_envelope;
mod path_follower;
mod proximity;
mod source;
mod source_text;
mod sweep;

pub use body::Body;
pub use clearance::{ClearanceOptions, ClearanceReport, ClearanceWork, Walls, check_clearance};
pub use convex::ConvexPolygon;
pub use heading::{Heading, doubtful_headings, headings};
pub use no_envelope::NoEnvelope;
pub use proximity::{ClosestApproach, ExemptZone, ProximityQuery, SweepTree, Undecided};
pub use source::EnvelopeSource;
pub use source_text::SourceError;
pub use sweep::{MIN_TOLERANCE_M, Sweep};
