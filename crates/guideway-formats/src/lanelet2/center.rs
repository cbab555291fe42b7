//! Computes the center line between the two bounds of a lanelet.
//!
//! ```text
//!   left   o-----o-----------o     vertices at the shares 0, 1/3, 1
//!   center x-----x-----x-----x     the midpoint at every share of either bound
//!   right  o-----------o-----o     vertices at the shares 0, 2/3, 1
//! ```
//!
//! Cost: O(n) for n vertices.

use guideway_spline::Point;

/// Points closer than this are equal, in meters.
const MIN_DISTANCE_M: f64 = 1e-9;

/// Reverses bounds until both have the same direction and the left one is on the left.
pub(super) fn align(left: &mut [Point<f64>], right: &mut [Point<f64>]) {
    let (Some(&l0), Some(&l1), Some(&r0), Some(&r1)) =
        (left.first(), left.last(), right.first(), right.last())
    else {
        return;
    };
    if l0.distance(r1) + l1.distance(r0) < l0.distance(r0) + l1.distance(r1) {
        right.reverse();
    }
    // The ring along the left bound and back along the right one has to be clockwise.
    let ring: Vec<Point<f64>> = left.iter().chain(right.iter().rev()).copied().collect();
    let next = ring.iter().skip(1).chain(&ring[..1]);
    let doubled_area: f64 = ring
        .iter()
        .zip(next)
        .map(|(&a, &b)| (a - l0).cross(b - l0))
        .sum();
    if doubled_area > 0.0 {
        left.reverse();
        right.reverse();
    }
}

/// The center line: at every share of length where either bound has a vertex, the midpoint of the
/// points at this share of both bounds.
pub(super) fn center_line(left: &[Point<f64>], right: &[Point<f64>]) -> Vec<Point<f64>> {
    let (left, right) = (MeasuredLine::new(left), MeasuredLine::new(right));
    let mut shares: Vec<f64> = left.shares.iter().chain(&right.shares).copied().collect();
    // A stable sort merges two runs that are in order.
    shares.sort_by(f64::total_cmp);
    let mut after = [0; 2];
    let mut points: Vec<Point<f64>> = Vec::with_capacity(shares.len());
    for share in shares {
        let [of_left, of_right] = &mut after;
        let point = left.at(share, of_left).lerp(right.at(share, of_right), 0.5);
        // Opposite vertices give the same point twice.
        if points
            .last()
            .is_none_or(|last| last.distance(point) > MIN_DISTANCE_M)
        {
            points.push(point);
        }
    }
    points
}

/// A polyline with the share of its length, 0 to 1, at every vertex.
struct MeasuredLine<'l> {
    line: &'l [Point<f64>],
    shares: Vec<f64>,
}

impl<'l> MeasuredLine<'l> {
    fn new(line: &'l [Point<f64>]) -> Self {
        let mut length = 0.0;
        let mut shares = vec![0.0; line.len().min(1)];
        for pair in line.windows(2) {
            length += pair[0].distance(pair[1]);
            shares.push(length);
        }
        for share in &mut shares {
            *share = if length > 0.0 { *share / length } else { 0.0 };
        }
        Self { line, shares }
    }

    /// The point at a share of the length, at or behind that of the call before; `after` is the
    /// first vertex that is not before it, and begins at 0.
    fn at(&self, share: f64, after: &mut usize) -> Point<f64> {
        while self.shares.get(*after).is_some_and(|&s| s < share) {
            *after += 1;
        }
        let after = *after;
        match (after.checked_sub(1), self.line.get(after)) {
            (None, Some(&first)) => first,
            (Some(before), Some(&next)) => {
                let width = self.shares[after] - self.shares[before];
                self.line[before].lerp(next, (share - self.shares[before]) / width)
            }
            (_, None) => self.line[self.line.len() - 1],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line(points: &[(f64, f64)]) -> Vec<Point<f64>> {
        points.iter().map(|&(x, y)| Point::new(x, y)).collect()
    }

    #[test]
    fn center_line_has_the_vertices_of_both_bounds() {
        let left = line(&[(0.0, 2.0), (4.0, 2.0), (8.0, 2.0)]);
        let right = line(&[(0.0, 0.0), (6.0, 0.0), (8.0, 0.0)]);
        assert_eq!(
            center_line(&left, &right),
            line(&[(0.0, 1.0), (4.0, 1.0), (6.0, 1.0), (8.0, 1.0)])
        );
    }

    #[test]
    fn align_gives_bounds_one_direction_with_the_left_one_left() {
        let (up, down) = (
            line(&[(0.0, 0.0), (0.0, 9.0)]),
            line(&[(3.0, 9.0), (3.0, 0.0)]),
        );
        for (l, r) in [(&up, &down), (&down, &up)] {
            let (mut left, mut right) = (l.clone(), r.clone());
            align(&mut left, &mut right);
            let ahead = left[1] - left[0];
            assert!(ahead.dot(right[1] - right[0]) > 0.0);
            assert!(ahead.cross(left[0] - right[0]) > 0.0);
        }
    }

    #[test]
    fn center_line_accepts_a_bound_of_one_point() {
        let center = center_line(&line(&[(0.0, 2.0)]), &line(&[(0.0, 0.0), (4.0, 0.0)]));
        assert_eq!(center, line(&[(0.0, 1.0), (2.0, 1.0)]));
    }
}
