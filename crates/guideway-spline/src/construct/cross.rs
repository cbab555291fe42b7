//! Crossings of two curves.

use super::Parameter;
use crate::bezier::SAME_M;
use crate::{Overlap, Point, Runs, intersect, uniform};

/// A place where two curves cross or touch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossing {
    /// Parameters on both curves.
    pub at: [Parameter; 2],
    /// The place: that on the first curve.
    pub position: Point<f64>,
}

/// All places where two curves cross or touch, each one once. Costs one comparison of boxes per
/// pair of segments.
///
/// # Errors
/// [`Overlap`] if the curves share a part.
pub fn crossings(first: &Runs, second: &Runs) -> Result<Vec<Crossing>, Overlap> {
    let others = numbered_beziers(second);
    let mut found: Vec<Crossing> = Vec::new();
    let mut meetings = Vec::new();
    for (own_run, own_segment, own) in numbered_beziers(first) {
        for (run, segment, other) in &others {
            intersect(&own, other, &mut meetings)?;
            for meeting in meetings.drain(..) {
                let position = meeting.position_m;
                // A crossing at a joint of segments is found on both of them.
                if found
                    .iter()
                    .any(|known| known.position.distance(position) <= SAME_M)
                {
                    continue;
                }
                let parameter = |run, segment, t| Parameter { run, segment, t };
                found.push(Crossing {
                    at: [
                        parameter(own_run, own_segment, meeting.at[0]),
                        parameter(*run, *segment, meeting.at[1]),
                    ],
                    position,
                });
            }
        }
    }
    Ok(found)
}

/// All segments as Beziers, with the numbers of run and segment.
fn numbered_beziers(runs: &Runs) -> Vec<(usize, usize, [Point<f64>; 4])> {
    let of_run = |(run, points): (usize, &[Point<f64>])| -> Vec<_> {
        let segments = points.array_windows().map(uniform::to_bezier).enumerate();
        segments
            .map(|(segment, bezier)| (run, segment, bezier))
            .collect()
    };
    runs.iter().enumerate().flat_map(of_run).collect()
}
