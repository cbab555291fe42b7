//! Curves of Beziers by points with handles, as drawing programs have them.

use super::ConstructError;
use super::arc::check_distinct;
use crate::{Point, Runs};

/// A point of a curve with its handles: the inner Bezier points beside it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Anchor {
    /// The point on the curve.
    pub at: Point<f64>,
    /// The handle on the side of the point before. Unused at the first anchor.
    pub before: Point<f64>,
    /// The handle on the side of the next point. Unused at the last anchor.
    pub after: Point<f64>,
}

impl Anchor {
    /// An anchor of a smooth curve: `handle` leads from the point to the handle after it, and
    /// back to the one before it.
    pub fn smooth(at: Point<f64>, handle: Point<f64>) -> Self {
        Self {
            at,
            before: at - handle,
            after: at + handle,
        }
    }
}

/// The curve through all anchors, one cubic Bezier between two of them, exactly.
///
/// # Errors
/// When there are fewer than two anchors, one is at the place of the next one, or a number is not
/// finite.
pub fn curve_of_anchors(anchors: &[Anchor]) -> Result<Runs, ConstructError> {
    let actual = anchors.len();
    if actual < 2 {
        return Err(ConstructError::TooFewPoints { actual });
    }
    let points: Vec<_> = anchors.iter().map(|anchor| anchor.at).collect();
    check_distinct(&points)?;
    let mut handles = anchors
        .iter()
        .flat_map(|anchor| [anchor.before, anchor.after]);
    if !handles.all(Point::is_finite) {
        return Err(ConstructError::NotFinite);
    }
    let mut runs = Runs::default();
    for [from, to] in anchors.array_windows() {
        runs.push_bezier(&[from.at, from.after, to.before, to.at]);
    }
    Ok(runs)
}
