//! Junctions: ends that meet the middle of a curve cut it there.

use guideway_spline::Point;
use guideway_spline::bezier::{SAME_M, nearest, split};
use rayon::prelude::*;

use super::box_index::{BoxIndex, Part};
use super::clusters::Clusters;
use super::drawn::{Curve, Drawn, polygon_m};
use super::weld::{Nodes, WALK};
use super::{BuildError, BuildOptions, BuildReport};

/// A place where a curve is cut.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Cut {
    pub(super) part: Part,
    pub(super) t: f64,
    /// The node between the pieces.
    pub(super) node: u32,
}

/// An end near a curve.
#[derive(Clone, Copy, Debug)]
struct Foot {
    node: u32,
    part: Part,
    t: f64,
    position_m: Point<f64>,
    distance_m: f64,
}

pub(super) fn find(
    drawn: &Drawn,
    index: &BoxIndex,
    options: &BuildOptions,
    (nodes, clusters): (&mut Nodes, &Clusters),
    cuts: &mut Vec<Cut>,
    report: &mut BuildReport,
) -> Result<(), BuildError> {
    let reach_m = options.weld_m.max(SAME_M);
    let of_node = |node: u32| feet(node, drawn, index, (nodes, clusters), reach_m);
    let rows = 0..nodes.positions_m.len() as u32;
    let feet: Vec<Foot> = rows.into_par_iter().flat_map_iter(of_node).collect();
    let limit = options.max_pieces;
    if feet.len() + drawn.curves.len() > limit {
        return Err(BuildError::Pieces { limit });
    }
    for feet in feet.chunk_by(|a, b| a.node == b.node) {
        let by_distance = |a: &&Foot, b: &&Foot| a.distance_m.total_cmp(&b.distance_m);
        let Some(best) = feet.iter().min_by(by_distance) else {
            continue;
        };
        report.cut_at_junction(best.position_m);
        if best.distance_m > SAME_M {
            // The curve keeps its shape, and the ends move onto it.
            nodes.positions_m[best.node as usize] = best.position_m;
            report.largest_move_m = report.largest_move_m.max(best.distance_m);
        }
        cuts.extend(feet.iter().map(|foot| Cut {
            part: foot.part,
            t: foot.t,
            node: foot.node,
        }));
    }
    Ok(())
}

/// The nearest foot of a node on each curve that passes by.
fn feet(
    node: u32,
    drawn: &Drawn,
    index: &BoxIndex,
    (nodes, clusters): (&Nodes, &Clusters),
    reach_m: f64,
) -> impl Iterator<Item = Foot> {
    let at = nodes.positions_m[node as usize];
    let mut parts: Vec<Part> = index.near(at, reach_m).collect();
    parts.sort_unstable();
    let mut best: Vec<Foot> = Vec::new();
    for part in parts {
        let curve = &drawn.curves[part.curve as usize];
        if curve.level != nodes.levels[node as usize] {
            continue;
        }
        let found = nearest(&curve.beziers[part.bezier as usize], at);
        let foot = Foot {
            node,
            part,
            t: found.t,
            position_m: found.point,
            distance_m: found.distance,
        };
        if found.distance > reach_m || !is_junction(&foot, drawn, (nodes, clusters), reach_m) {
            continue;
        }
        match best.last_mut() {
            Some(last) if last.part.curve == part.curve => {
                if foot.distance_m < last.distance_m {
                    *last = foot;
                }
            }
            _ => best.push(foot),
        }
    }
    best.into_iter()
}

/// Returns `true` if a foot is in the middle of its curve, and not beside an end that is the same
/// node, or that short lines join with it.
fn is_junction(
    foot: &Foot,
    drawn: &Drawn,
    (nodes, clusters): (&Nodes, &Clusters),
    reach_m: f64,
) -> bool {
    let curve = &drawn.curves[foot.part.curve as usize];
    let at = nodes.positions_m[foot.node as usize];
    (0..2).all(|side| {
        let end = 2 * foot.part.curve + side;
        let to_end_m = curve.end(side).distance(foot.position_m);
        if nodes.of_end[end as usize] == foot.node {
            return along_m(curve, foot, side) > WALK * reach_m;
        }
        if to_end_m <= SAME_M {
            return false;
        }
        let other = nodes.positions_m[nodes.of_end[end as usize] as usize];
        if other.distance(at) <= reach_m {
            return false;
        }
        let walk_m = WALK * reach_m;
        to_end_m > walk_m || !clusters.has_walk(nodes.ends[foot.node as usize], end, walk_m)
    })
}

/// Length of the control polygons between a foot and an end of its curve.
fn along_m(curve: &Curve, foot: &Foot, side: u32) -> f64 {
    let row = foot.part.bezier as usize;
    let [left, right] = split(&curve.beziers[row], foot.t);
    let (part, others) = match side {
        0 => (left, &curve.beziers[..row]),
        _ => (right, &curve.beziers[row + 1..]),
    };
    polygon_m(&part) + others.iter().map(polygon_m).sum::<f64>()
}
