//! The ends of a path around which it counts half.

use guideway_layout::PathRef;
use guideway_spline::Point;

/// Distance of start and end, in meters, up to which a path is closed. Derived: the tolerance of
/// converted curves.
pub const CLOSED_M: f64 = 1e-4;

/// Start and end of a path, in meters. `None` if the path is closed or has no segments.
pub fn open_ends(path: PathRef<'_>) -> Option<[Point<f64>; 2]> {
    let (start, end) = path.ends()?;
    // The square: browsers have no instruction for the root of a sum of squares.
    let along = end - start;
    (along.dot(along) > CLOSED_M * CLOSED_M).then_some([start, end])
}
