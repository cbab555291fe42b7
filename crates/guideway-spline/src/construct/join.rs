//! Joins of two consecutive curves into one.

use super::ConstructError;
use crate::bezier::{move_start, unite};
use crate::{Point, Runs, uniform};

/// The curve that goes along the first and then along the second one, exactly. A gap of at most
/// `tolerance` is closed: the second one starts where the first one ends.
///
/// Two segments that are parts of one polynomial, as after a cut, become one again.
///
/// # Errors
/// When the gap is wider, or a curve has no runs.
pub fn join(first: &Runs, second: &Runs, tolerance: f64) -> Result<Runs, ConstructError> {
    let (Some(end), Some(start)) = (first.end(), second.start()) else {
        return Err(ConstructError::TooFewPoints { actual: 0 });
    };
    let gap = end.distance(start);
    if gap.is_nan() || gap > tolerance {
        return Err(ConstructError::Gap { gap, tolerance });
    }
    let mut segments: Vec<[Point<f64>; 4]> = first.segments().copied().collect();
    let mut rest = second.segments().copied();
    if let (Some(last), Some(next)) = (segments.pop(), rest.next()) {
        let last_bezier = uniform::to_bezier(&last);
        let mut next_bezier = uniform::to_bezier(&next);
        if gap > 0.0 {
            move_start(&mut next_bezier, end);
        }
        match unite(&last_bezier, &next_bezier) {
            Some(whole) => segments.push(uniform::from_bezier(&whole)),
            None if gap > 0.0 => segments.extend([last, uniform::from_bezier(&next_bezier)]),
            None => segments.extend([last, next]),
        }
    }
    segments.extend(rest);
    let mut joined = Runs::default();
    segments
        .iter()
        .for_each(|segment| joined.push_segment(segment));
    Ok(joined)
}
