//! Ends of paths, where strokes with butt caps stop.

use guideway_layout::{PathRef, RunPoints};
use guideway_spline::{Affine, Point, bezier, uniform};

/// Distance of start and end, in meters, up to which a path is closed. Derived: the tolerance of
/// converted curves.
pub const CLOSED_M: f64 = 1e-4;

/// One end of an open path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PathEnd {
    /// Its place, in meters.
    pub at: Point<f64>,
    /// Unit vector in which the curve leaves the path there.
    pub outward: Point<f64>,
}

impl PathEnd {
    /// The end where a map shows it.
    #[must_use]
    pub fn mapped(self, by: Affine) -> Self {
        let at = by.apply(self.at);
        let outward = by.apply(self.at + self.outward) - at;
        Self {
            at,
            outward: bezier::unit(outward).unwrap_or(self.outward),
        }
    }
}

/// The start and the end of a path. `None` if they are within [`CLOSED_M`] of each other, for then
/// they join, and for a path without segments.
///
/// Cost: the number of runs, and of segments without length at the ends.
pub fn open_ends(path: PathRef<'_>) -> Option<[PathEnd; 2]> {
    let (first, last) = (path.runs().next()?, path.runs().last()?);
    let bezier =
        |run: RunPoints<'_>, i| uniform::to_bezier(&[0, 1, 2, 3].map(|point| run.get(i + point)));
    let mut from_start = 0..first.len().checked_sub(3)?;
    let from_end = 0..last.len().checked_sub(3)?;
    let start = bezier(first, from_start.start)[0];
    let end = bezier(last, from_end.end.checked_sub(1)?)[3];
    if start.distance(end) <= CLOSED_M {
        return None;
    }
    let forward = from_start.find_map(|i| bezier::start_direction(&bezier(first, i)))?;
    let onward = from_end
        .rev()
        .find_map(|i| bezier::end_direction(&bezier(last, i)))?;
    let ends = [(start, forward * -1.0), (end, onward)];
    Some(ends.map(|(at, outward)| PathEnd { at, outward }))
}
