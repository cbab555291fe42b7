//! Fits cubics to a chain of short lines within a tolerance.
//!
//! The curve goes through both ends of the chain in given directions. Two lengths, along these
//! directions, make the sum of squared distances from the vertices least; the parameters are the
//! shares of the length of the chain. A chain that does not fit is divided at its farthest vertex.
//! Source: Schneider, An algorithm for automatically fitting digitized curves, Graphics Gems 1990.

use guideway_spline::Point;
use guideway_spline::bezier::{Bezier, line, point, unit};

/// Samples per line where a curve is compared with its chain.
const SAMPLES: usize = 4;

/// Appends cubics that are nowhere farther than `tolerance_m` from a chain of at least two
/// vertices, and nowhere leave a part of the chain farther than that. A line that fits no curve
/// stays a line.
pub(super) fn fit(
    chain: &[Point<f64>],
    directions: [Point<f64>; 2],
    tolerance_m: f64,
    out: &mut Vec<Bezier>,
) {
    // Parts that wait, the first one on top: chains may be long, and a stack overflow is no error.
    let mut parts = vec![(0, chain.len() - 1, directions)];
    while let Some((from, to, directions)) = parts.pop() {
        let part = &chain[from..=to];
        if part.len() == 2 {
            out.push(line(part[0], part[1]));
            continue;
        }
        let shares = shares(part);
        let fitted = fit_one(part, &shares, directions);
        match worst_vertex(&fitted, part, &shares, tolerance_m) {
            None => out.push(fitted),
            Some(vertex) => {
                let between = unit(part[vertex + 1] - part[vertex - 1]).unwrap_or(directions[0]);
                parts.push((from + vertex, to, [between, directions[1]]));
                parts.push((from, from + vertex, [directions[0], between]));
            }
        }
    }
}

/// Shares of the length at the vertices, from 0 to 1.
fn shares(chain: &[Point<f64>]) -> Vec<f64> {
    let mut length = 0.0;
    let mut lengths = vec![0.0];
    for pair in chain.windows(2) {
        length += pair[0].distance(pair[1]);
        lengths.push(length);
    }
    lengths.iter().map(|at| at / length).collect()
}

/// The cubic with the least squared distances from the vertices.
fn fit_one(chain: &[Point<f64>], shares: &[f64], [start, end]: [Point<f64>; 2]) -> Bezier {
    let (first, last) = (chain[0], chain[chain.len() - 1]);
    // Unknown lengths p, q: the inner control points are first + p start and last - q end.
    let (mut pp, mut pq, mut qq, mut pr, mut qr) = (0.0, 0.0, 0.0, 0.0, 0.0);
    for (vertex, &t) in chain.iter().zip(shares) {
        let s = 1.0 - t;
        let (near_first, b1, b2) = (s * s * (s + 3.0 * t), 3.0 * s * s * t, 3.0 * s * t * t);
        let (u, v) = (start * b1, end * -b2);
        let rest = *vertex - first.lerp(last, 1.0 - near_first);
        pp += u.dot(u);
        pq += u.dot(v);
        qq += v.dot(v);
        pr += u.dot(rest);
        qr += v.dot(rest);
    }
    let chord = first.distance(last);
    let determinant = pp * qq - pq * pq;
    let (p, q) = if determinant.abs() > 1e-12 * pp * qq {
        (
            (pr * qq - qr * pq) / determinant,
            (pp * qr - pq * pr) / determinant,
        )
    } else {
        (chord / 3.0, chord / 3.0)
    };
    let sound = |length: f64| {
        let is_sound = length > 1e-3 * chord && length.is_finite();
        if is_sound { length } else { chord / 3.0 }
    };
    [first, first + start * sound(p), last - end * sound(q), last]
}

/// The inner vertex nearest to where curve and chain are farthest apart, if that is beyond the
/// tolerance.
fn worst_vertex(
    curve: &Bezier,
    chain: &[Point<f64>],
    shares: &[f64],
    tolerance_m: f64,
) -> Option<usize> {
    let (mut worst_m, mut at) = (tolerance_m, None);
    for i in 0..chain.len() - 1 {
        for sample in 0..SAMPLES {
            let share = (sample as f64 + 0.5) / SAMPLES as f64;
            let on_curve = point(curve, shares[i] + (shares[i + 1] - shares[i]) * share);
            let to_chain_m = distance_to_lines(chain, i, on_curve);
            let vertex_m = chain[i].distance(point(curve, shares[i]));
            let far_m = to_chain_m.max(vertex_m);
            if far_m > worst_m {
                worst_m = far_m;
                at = Some(if share < 0.5 { i } else { i + 1 });
            }
        }
    }
    at.map(|vertex| vertex.clamp(1, chain.len() - 2))
}

/// Distance of a point from line `i` of a chain and its neighbors.
fn distance_to_lines(chain: &[Point<f64>], i: usize, to: Point<f64>) -> f64 {
    let lines = i.saturating_sub(1)..(i + 2).min(chain.len() - 1);
    let distances = lines.map(|i| {
        let vector = chain[i + 1] - chain[i];
        let t = (to - chain[i]).dot(vector) / vector.dot(vector);
        chain[i].lerp(chain[i + 1], t.clamp(0.0, 1.0)).distance(to)
    });
    distances.fold(f64::INFINITY, f64::min)
}
