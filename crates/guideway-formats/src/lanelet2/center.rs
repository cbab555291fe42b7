//! The middle between the two bounds of a lanelet.

use guideway_spline::Point;

/// Lines within this of each other have the same length, in meters.
const SHORT_M: f64 = 1e-9;

/// Puts two bounds into one direction, in which the left one is to the left.
pub(super) fn align(left: &mut [Point<f64>], right: &mut [Point<f64>]) {
    let (Some(&l0), Some(&l1), Some(&r0), Some(&r1)) =
        (left.first(), left.last(), right.first(), right.last())
    else {
        return;
    };
    if l0.distance(r1) + l1.distance(r0) < l0.distance(r0) + l1.distance(r1) {
        right.reverse();
    }
    // Up the left one and down the right one is clockwise.
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

/// The middle between points that are at the same share of the length of each line, wherever one of the two
/// has a vertex.
pub(super) fn middle(left: &[Point<f64>], right: &[Point<f64>]) -> Vec<Point<f64>> {
    let (left, right) = (Walk::new(left), Walk::new(right));
    let mut shares: Vec<f64> = left.shares.iter().chain(&right.shares).copied().collect();
    shares.sort_unstable_by(f64::total_cmp);
    let mut points: Vec<Point<f64>> = Vec::with_capacity(shares.len());
    for share in shares {
        let point = left.at(share).lerp(right.at(share), 0.5);
        // Vertices opposite each other make one.
        if points
            .last()
            .is_none_or(|last| last.distance(point) > SHORT_M)
        {
            points.push(point);
        }
    }
    points
}

/// A line with the share of its length at every vertex.
struct Walk<'l> {
    line: &'l [Point<f64>],
    shares: Vec<f64>,
}

impl<'l> Walk<'l> {
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

    fn at(&self, share: f64) -> Point<f64> {
        let after = self.shares.partition_point(|&s| s < share);
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
    fn the_middle_has_the_vertices_of_both() {
        let left = line(&[(0.0, 2.0), (4.0, 2.0), (8.0, 2.0)]);
        let right = line(&[(0.0, 0.0), (6.0, 0.0), (8.0, 0.0)]);
        let middle = middle(&left, &right);
        assert_eq!(
            middle,
            line(&[(0.0, 1.0), (4.0, 1.0), (6.0, 1.0), (8.0, 1.0)])
        );
    }

    #[test]
    fn bounds_come_into_one_direction_with_the_left_one_left() {
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
    fn a_bound_that_is_a_point_is_met_by_the_whole_of_the_other() {
        let middle = middle(&line(&[(0.0, 2.0)]), &line(&[(0.0, 0.0), (4.0, 0.0)]));
        assert_eq!(middle, line(&[(0.0, 1.0), (2.0, 1.0)]));
    }
}
