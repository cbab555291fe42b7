//! The area that a vehicle sweeps along its paths, and how near vehicles come to each other and to walls.
//!
//! A [`Body`] follows a path with its reference point, at a [`Heading`]: a [`Sweep`]. It is cut into stretches of
//! the path, each held by a convex polygon that is as near to it as is asked for; questions about distances are
//! answered by halving the stretches for which it matters, so that an answer within a centimeter does not take
//! polygons within a centimeter everywhere.
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

mod area;
mod body;
mod clearance;
mod convex;
mod follow;
mod heading;
mod nearest;
mod source;
mod source_text;
mod step;
mod sweep;

pub use body::Body;
pub use clearance::{Clearance, ClearanceOptions, ClearanceWork, Walls, check_clearance};
pub use convex::Convex;
pub use heading::{Heading, headings};
pub use nearest::{Meeting, Nearest, Question, Tree};
pub use source::{Source, Without};
pub use source_text::SourceError;
pub use sweep::{LEAST_TOLERANCE_M, Sweep};
