//! Curve mathematics for path layouts.
//!
//! Guideway draws one primitive: a *run* of uniform cubic B-spline control points. A run of n
//! points (n >= 4) has n - 3 segments (thesis eq. 3.2), each
//!
//! ```text
//! C(t) = 1/6 [t^3 t^2 t 1] | -1  3 -3  1 | | P0 |
//!                          |  3 -6  3  0 | | P1 |     0 <= t <= 1
//!                          | -3  0  3  0 | | P2 |
//!                          |  1  4  1  0 | | P3 |
//! ```
//!
//! Other curves convert to runs: non-rational curves up to degree 3 exactly, all others within a
//! tolerance that the caller gives.
//!
//! | module | input | output |
//! |---|---|---|
//! | `point`, `real`, `bounds`, `affine` | | points, numbers, boxes and maps of the plane |
//! | [`uniform`], `runs` | control points | points and derivatives of a segment; a curve |
//! | [`basis`], [`knots`], `nurbs` | degree, knots, weights | a NURBS curve and its points |
//! | `convert`, `arc` | NURBS, Bezier curves, polylines, arcs | runs and an error bound |
//! | `exact`, `span` | a NURBS without weights, a span of any | one run of as many points; a Bezier curve |
//! | [`bezier`] | four points | points, parts and directions of a cubic Bezier curve |
//! | `intersect` | two cubic Beziers | where they cross |
//! | [`construct`] | points, directions, radii, curves | arcs, splines, fillets; parts and joins of curves |
//! | `flatten` | a run and a tolerance | a polyline |
//! | `length`, `nearest` | a run | its arc length; the point nearest to another |
//! | `hilbert` | a point of a box | its index along the Hilbert curve |
//! | [`mem`] | a slice | a prefetch into the cache |

mod affine;
mod arc;
pub mod basis;
pub mod bezier;
mod bounds;
pub mod construct;
mod convert;
mod exact;
mod flatten;
mod hilbert;
mod intersect;
pub mod knots;
mod length;
pub mod mem;
mod nearest;
mod nurbs;
mod point;
mod real;
mod runs;
mod span;
pub mod uniform;

pub use affine::Affine;
pub use arc::{MAX_ARC_PIECES, arc_to_runs};
pub use basis::MAX_DEGREE;
pub use bounds::Bounds;
pub use convert::{Conversion, MAX_HALVINGS, bezier_to_runs, nurbs_to_runs, polyline_to_runs};
pub use flatten::{MAX_LINES_PER_SEGMENT, flatten_run};
pub use hilbert::hilbert;
pub use intersect::{Meeting, Overlap, intersect};
pub use length::{run_length, segment_length};
pub use nearest::{Nearest, nearest_on_run};
pub use nurbs::{Nurbs, NurbsError};
pub use point::Point;
pub use real::{Real, greater, lesser};
pub use runs::Runs;
