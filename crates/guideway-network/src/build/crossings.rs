//! Crossings: cuts curves where they cross, and makes one node of crossings that lie together.

use std::sync::atomic::{AtomicU64, Ordering};

use guideway_spline::bezier::SAME_M;
use guideway_spline::{Overlap, Point, intersect};
use rayon::prelude::*;

use super::box_index::{BoxIndex, Part};
use super::drawn::{Curve, Drawn};
use super::grid::Grid;
use super::junctions::Cut;
use super::weld::Nodes;
use super::{BuildError, BuildOptions, BuildReport};

/// Pairs of cubics with overlapping boxes that may be compared, per piece that is allowed.
const PAIRS_PER_PIECE: u64 = 20;

/// Curves that a task of a thread compares with others.
const TASK_CURVES: usize = 256;

/// A place where two curves cross.
struct Crossing {
    parts: [Part; 2],
    at: [f64; 2],
    position_m: Point<f64>,
}

pub(super) fn find(
    drawn: &Drawn,
    index: &BoxIndex,
    options: &BuildOptions,
    nodes: &mut Nodes,
    cuts: &mut Vec<Cut>,
    report: &mut BuildReport,
) -> Result<(), BuildError> {
    let (found, overlaps) = crossings(drawn, index, options, nodes)?;
    report.overlaps += overlaps;
    if 2 * found.len() + cuts.len() + drawn.curves.len() > options.max_pieces {
        return Err(pieces(options));
    }
    let reach_m = options.weld_m.max(SAME_M);
    cuts.reserve(2 * found.len());
    let mut grid = Grid::new(reach_m, nodes.positions_m.len());
    nodes.positions_m.iter().for_each(|&p| grid.add(p));
    for crossing in found {
        let level = drawn.curves[crossing.parts[0].curve as usize].level;
        let same_level = |&(node, _): &(u32, f64)| nodes.levels[node as usize] == level;
        let near = grid.near(crossing.position_m).filter(same_level);
        let nearest = near.min_by(|a, b| a.1.total_cmp(&b.1).then(a.0.cmp(&b.0)));
        let node = match nearest {
            Some((node, distance_m)) => {
                report.largest_move_m = report.largest_move_m.max(distance_m);
                node
            }
            None => {
                grid.add(crossing.position_m);
                report.cut_at_crossing(crossing.position_m);
                nodes.add(crossing.position_m, level)
            }
        };
        for (part, t) in crossing.parts.into_iter().zip(crossing.at) {
            cuts.push(Cut { part, t, node });
        }
    }
    Ok(())
}

fn pieces(options: &BuildOptions) -> BuildError {
    let limit = options.max_pieces;
    BuildError::Pieces { limit }
}

/// All crossings in the order of the curves, and the number of pairs that lie on each other.
fn crossings(
    drawn: &Drawn,
    index: &BoxIndex,
    options: &BuildOptions,
    nodes: &Nodes,
) -> Result<(Vec<Crossing>, u64), BuildError> {
    let limit = PAIRS_PER_PIECE * options.max_pieces as u64;
    let (pairs, found, overlaps) = (AtomicU64::new(0), AtomicU64::new(0), AtomicU64::new(0));
    let of_curve = |curve: usize, own: &mut Vec<Crossing>| {
        let beziers = drawn.curves[curve].beziers.iter().enumerate();
        for (row, bezier) in beziers {
            let part = Part {
                curve: curve as u32,
                bezier: row as u32,
            };
            let mut others: Vec<Part> = Vec::new();
            for other in index.overlapping(bezier) {
                if pairs.fetch_add(1, Ordering::Relaxed) >= limit {
                    return Err(BuildError::Pairs { limit });
                }
                if other > part && can_cross(part, other, drawn) {
                    others.push(other);
                }
            }
            others.sort_unstable();
            for other in others {
                let before = own.len();
                if compare([part, other], drawn, nodes, options, own).is_err() {
                    overlaps.fetch_add(1, Ordering::Relaxed);
                }
                let new = (own.len() - before) as u64;
                let all = new + found.fetch_add(new, Ordering::Relaxed);
                if all > options.max_pieces as u64 {
                    return Err(pieces(options));
                }
            }
        }
        Ok(())
    };
    let of_task = |(task, curves): (usize, &[Curve])| {
        let mut own = Vec::new();
        let first = task * TASK_CURVES;
        let mut rows = first..first + curves.len();
        rows.try_for_each(|curve| of_curve(curve, &mut own))?;
        Ok(own)
    };
    let tasks = drawn.curves.par_chunks(TASK_CURVES).enumerate();
    let lists: Result<Vec<Vec<Crossing>>, BuildError> = tasks.map(of_task).collect();
    let lists = lists?;
    let mut crossings = Vec::with_capacity(lists.iter().map(Vec::len).sum());
    lists.into_iter().for_each(|list| crossings.extend(list));
    Ok((crossings, overlaps.into_inner()))
}

/// Returns `true` if two cubics are of one level, and not neighbors on one curve.
fn can_cross(a: Part, b: Part, drawn: &Drawn) -> bool {
    let curve = |part: Part| &drawn.curves[part.curve as usize];
    if a.curve != b.curve {
        return curve(a).level == curve(b).level;
    }
    let last = curve(a).beziers.len() as u32 - 1;
    let are_neighbors = b.bezier - a.bezier <= 1 || (a.bezier == 0 && b.bezier == last);
    !are_neighbors
}

/// Appends the crossings of two cubics, except those beside an end: they are junctions.
fn compare(
    parts: [Part; 2],
    drawn: &Drawn,
    nodes: &Nodes,
    options: &BuildOptions,
    found: &mut Vec<Crossing>,
) -> Result<(), Overlap> {
    let curves = parts.map(|part| &drawn.curves[part.curve as usize]);
    let bezier = |side: usize| &curves[side].beziers[parts[side].bezier as usize];
    let mut meetings = Vec::new();
    intersect(bezier(0), bezier(1), &mut meetings)?;
    let reach_m = options.weld_m.max(SAME_M);
    for meeting in meetings {
        let at = meeting.position_m;
        let is_beside_end = (0..2).any(|side| {
            let part = parts[side];
            (0..2).any(|end| {
                let node = nodes.of_end[(2 * part.curve + end) as usize];
                let moved = nodes.positions_m[node as usize];
                curves[side].end(end).distance(at) <= reach_m || moved.distance(at) <= SAME_M
            })
        });
        if !is_beside_end {
            found.push(Crossing {
                parts,
                at: meeting.at,
                position_m: at,
            });
        }
    }
    Ok(())
}
