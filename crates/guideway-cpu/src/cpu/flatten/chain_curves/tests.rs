//! Chains of a few curves, and of many that share end points.

use guideway_scene::cluster::Members;

use super::*;
use crate::cpu::flatten::simplify::DouglasPeucker;

const TOLERANCE: f32 = 6.5;

/// A straight run of control points whose curve goes from one place to another.
fn straight([a, b]: [[f32; 2]; 2]) -> Vec<Point<f32>> {
    let [a, b] = [a, b].map(|[x, y]| Point::new(x, y));
    let step = (b - a) * (1.0 / 8.0);
    (-1..=9).map(|i| a + step * i as f32).collect()
}

/// Members and vertices of each chain, in drawing order.
fn drawn(curves: &[Vec<Point<f32>>], joins: bool) -> Vec<(Members, Vec<Point<f32>>)> {
    let mut points = curves.concat();
    let ends = curves.iter().scan(0, |end, curve| {
        *end += curve.len();
        Some(*end - curve.len()..*end)
    });
    let runs = ends
        .enumerate()
        .map(|(i, points)| CurveRun::new(i % GROUP_LEN, points).unwrap());
    let runs: Vec<CurveRun> = runs.collect();
    let (mut knots, mut curve_chains, mut chains) =
        (Knots::default(), CurveChains::default(), Vec::new());
    knots.reset(&mut points);
    curve_chains.link_runs(&runs, &points, joins);
    curve_chains.append_knots((&runs, &points), &mut knots, &mut chains);
    knots.find_slack(TOLERANCE);
    let mut simplifier = DouglasPeucker::default();
    simplifier.simplify(&knots, &chains);
    let lines = chains.into_iter().map(|chain| {
        let mut vertices = Vec::new();
        let emit = |vertex| vertices.push(vertex);
        simplifier.vertices(&knots, &chain.knots, &points, TOLERANCE, emit);
        (chain.members, vertices)
    });
    lines.collect()
}

#[test]
fn chains_the_pieces_of_a_road_straight_on() {
    // In random order; one turn leaves the road, and one joins it.
    let curves = [
        straight([[300.0, 0.0], [400.0, 0.0]]),
        straight([[200.0, 0.0], [250.0, 90.0]]),
        straight([[100.0, 0.0], [200.0, 0.5]]),
        straight([[150.0, 90.0], [200.0, 0.0]]),
        straight([[0.0, 0.0], [100.0, 0.0]]),
        straight([[200.0, 0.0], [300.0, 0.0]]),
        straight([[200.0, 2.0], [210.0, 2.0]]),
    ];
    let joined = drawn(&curves, true);
    let members: Vec<Members> = joined.iter().map(|(members, _)| *members).collect();
    assert_eq!(members, [0b1010, 0b11_0101, 0b100_0000]);
    let [(_, turns), (_, road), _] = &joined[..] else {
        panic!("{joined:?}");
    };
    assert_eq!((road.len(), turns.len()), (2, 3));
    assert_eq!((road[0].x, road[1].x), (0.0, 400.0));
    assert_eq!(drawn(&curves, false).len(), curves.len());
}

#[test]
fn chains_curves_within_one_unit() {
    for at in (0..400).map(|i| i as f32 * 0.37 - 70.0) {
        let road = |gap| {
            let before = straight([[at - 90.0, at], [at, at]]);
            drawn(&[straight([[at + gap, at], [at + 90.0, at]]), before], true).len()
        };
        assert_eq!((road(0.9), road(1.1), road(-0.9)), (1, 2, 1), "{at}");
    }
}

#[test]
fn opens_rings() {
    let corners = [[0.0, 0.0], [90.0, 0.0], [90.0, 90.0], [0.0, 90.0]];
    let sides: Vec<_> = (0..4)
        .map(|i| straight([corners[i], corners[(i + 1) % 4]]))
        .collect();
    let ring = drawn(&sides, true);
    assert_eq!(ring.len(), 1);
    let (members, vertices) = &ring[0];
    assert_eq!((*members, vertices.len()), (0b1111, 5));
    assert!(vertices[0].distance(vertices[4]) < 0.01);
    // A curve that ends where it begins.
    let point = straight([[7.0, 7.0], [7.0, 7.0]]);
    assert_eq!(drawn(&[point], true)[0].1.len(), 2);
}

#[test]
fn draws_each_curve_once_within_the_tolerance() {
    let mut state = 5_u32;
    let mut next = move || {
        state = state.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
        (state >> 8) as f32 / (1 << 24) as f32
    };
    // Near the nodes of a lattice, so that many meet; more than one group.
    let mut node = |off: f32| {
        let [x, y] = [next(), next()].map(|v| (v * 6.0).floor() * 40.0);
        [x + next() * off, y + next() * off]
    };
    let curves: Vec<_> = (0..150).map(|_| straight([node(0.5), node(0.5)])).collect();
    let chains = drawn(&curves, true);
    assert!((20..120).contains(&chains.len()), "{}", chains.len());
    let lines = chains
        .iter()
        .flat_map(|(_, vertices)| vertices.array_windows());
    let lines: Vec<[Point<f32>; 2]> = lines.copied().collect();
    let distance = |p: Point<f32>, [a, b]: [Point<f32>; 2]| {
        let along = b - a;
        let t = (p - a).dot(along) / along.dot(along).max(1e-30);
        p.distance(a + along * t.clamp(0.0, 1.0))
    };
    for curve in &curves {
        for i in 0..=32 {
            let at = curve[1] + (curve[9] - curve[1]) * (i as f32 / 32.0);
            let near = lines.iter().map(|&line| distance(at, line));
            assert!(near.fold(f32::INFINITY, f32::min) <= TOLERANCE + 0.01);
        }
    }
    // No line is drawn elsewhere.
    for [a, b] in lines {
        let at = (a + b) * 0.5;
        let near = curves
            .iter()
            .map(|curve| distance(at, [curve[1], curve[9]]));
        assert!(near.fold(f32::INFINITY, f32::min) <= TOLERANCE + 0.01);
    }
}
