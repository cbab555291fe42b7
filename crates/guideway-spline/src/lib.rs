//! Curve mathematics for path layouts.
//!
//! Everything that Guideway draws is one primitive: a *run* of uniform cubic B-spline control points.
//! A run of n points (n >= 4) is n - 3 segments, each
//!
//! ```text
//! C(t) = 1/6 [t^3 t^2 t 1] | -1  3 -3  1 | | P0 |
//!                          |  3 -6  3  0 | | P1 |     0 <= t <= 1
//!                          | -3  0  3  0 | | P2 |
//!                          |  1  4  1  0 | | P3 |
//! ```
//!
//! Any other curve converts to runs: exactly where it is a non-rational curve up to degree 3, within a
//! stated tolerance otherwise.

mod affine;
mod arc;
pub mod basis;
mod bounds;
mod convert;
mod flatten;
mod hilbert;
pub mod knots;
mod length;
pub mod mem;
mod nearest;
mod nurbs;
mod point;
mod real;
mod runs;
pub mod uniform;

pub use affine::Affine;
pub use arc::{MAX_ARC_PIECES, arc_to_runs};
pub use bounds::Bounds;
pub use convert::{Conversion, MAX_HALVINGS, bezier_to_runs, nurbs_to_runs, polyline_to_runs};
pub use flatten::{MAX_LINES_PER_SEGMENT, flatten_run};
pub use hilbert::hilbert;
pub use length::{run_length, segment_length};
pub use nearest::{Nearest, nearest_on_run};
pub use nurbs::{MAX_DEGREE, Nurbs, NurbsError};
pub use point::Point;
pub use real::{Real, greater, lesser};
pub use runs::Runs;
