//! Compares hulls, sums and distances of convex polygons with brute force.

use guideway_envelope::ConvexPolygon;
use proptest::prelude::*;

use crate::random::{P, p};

/// Points on a coarse grid, so that many are collinear or equal.
fn points() -> impl Strategy<Value = Vec<P>> {
    let point = (-4..5, -4..5).prop_map(|(x, y)| p(f64::from(x), f64::from(y)) * 0.5);
    prop::collection::vec(point, 1..9)
}

fn from_line(a: P, b: P, q: P) -> f64 {
    let way = b - a;
    let square = way.dot(way);
    let t = if square > 0.0 {
        ((q - a).dot(way) / square).clamp(0.0, 1.0)
    } else {
        0.0
    };
    q.distance(a + way * t)
}

/// Returns `true` if a point is inside a triangle of three of the points.
fn is_within(points: &[P], q: P) -> bool {
    let side = |a: P, b: P| (b - a).cross(q - a);
    points.iter().any(|&a| {
        points.iter().any(|&b| {
            from_line(a, b, q) < 1e-9
                || points.iter().any(|&c| {
                    let [u, v, w] = [side(a, b), side(b, c), side(c, a)];
                    (u > 0.0 && v > 0.0 && w > 0.0) || (u < 0.0 && v < 0.0 && w < 0.0)
                })
        })
    })
}

/// Distance of two hulls: the smallest one of all segments between points.
fn apart(a: &[P], b: &[P]) -> f64 {
    if a.iter().any(|&q| is_within(b, q)) || b.iter().any(|&q| is_within(a, q)) {
        return 0.0;
    }
    let lines = |points: &[P]| -> Vec<(P, P)> {
        points
            .iter()
            .flat_map(|&p| points.iter().map(move |&q| (p, q)))
            .collect()
    };
    let mut least = f64::INFINITY;
    for (p, q) in lines(a) {
        for (r, s) in lines(b) {
            let side = |a: P, b: P, c: P| (b - a).cross(c - a);
            let crosses =
                side(p, q, r) * side(p, q, s) < 0.0 && side(r, s, p) * side(r, s, q) < 0.0;
            let ends = [
                from_line(p, q, r),
                from_line(p, q, s),
                from_line(r, s, p),
                from_line(r, s, q),
            ];
            least = ends
                .into_iter()
                .fold(if crosses { 0.0 } else { least }, f64::min);
        }
    }
    least
}

proptest! {
    #[test]
    fn hull_contains_all_points_and_is_strictly_convex(points in points(), q in points()) {
        let hull = ConvexPolygon::hull(points.iter().copied()).unwrap();
        prop_assert!(points.iter().all(|&p| hull.contains(p)));
        for &q in &q {
            prop_assert_eq!(hull.contains(q), is_within(&points, q), "{:?}", q);
        }
        let corners = hull.points();
        let turns = |i: usize| {
            let at = |k: usize| corners[(i + k) % corners.len()];
            (at(1) - at(0)).cross(at(2) - at(1))
        };
        prop_assert!(corners.len() < 3 || (0..corners.len()).all(|i| turns(i) > 0.0));
    }

    #[test]
    fn sum_is_the_hull_of_all_sums(a in points(), b in points()) {
        let hull = |points: &[P]| ConvexPolygon::hull(points.iter().copied()).unwrap();
        let sums: Vec<P> = a.iter().flat_map(|&p| b.iter().map(move |&q| p + q)).collect();
        let (sum, all) = (hull(&a).sum(&hull(&b)), hull(&sums));
        prop_assert_eq!(sum, all);
    }

    #[test]
    fn distance_matches_brute_force(a in points(), b in points(), x in -6..7) {
        let moved: Vec<P> = b.iter().map(|&q| q + p(f64::from(x), 0.25)).collect();
        let hull = |points: &[P]| ConvexPolygon::hull(points.iter().copied()).unwrap();
        let (own, other) = (hull(&a), hull(&moved));
        let expected = apart(&a, &moved);
        prop_assert!((own.distance(&other) - expected).abs() < 1e-9, "{}", expected);
        prop_assert_eq!(own.distance(&other), other.distance(&own));
    }
}

#[test]
fn brute_force_distance_is_correct() {
    let square = [p(0.0, 0.0), p(1.0, 0.0), p(1.0, 1.0), p(0.0, 1.0)];
    assert!(is_within(&square, p(0.5, 0.5)) && !is_within(&square, p(1.1, 0.5)));
    let far = square.map(|q| q + p(3.0, 0.0));
    assert!((apart(&square, &far) - 2.0).abs() < 1e-12);
    assert_eq!(apart(&square, &square.map(|q| q + p(0.5, 0.5))), 0.0);
}
