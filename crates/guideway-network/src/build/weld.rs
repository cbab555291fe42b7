//! Weld: joins ends that lie within a distance to nodes.
//!
//! Pairs of ends are joined from the nearest to the farthest, so the result does not depend on
//! their order. Two ends stay apart if short lines lead from one to the other: see
//! [`Clusters::has_walk`].

use guideway_spline::Point;
use guideway_spline::bezier::SAME_M;
use rayon::prelude::*;

use super::clusters::Clusters;
use super::drawn::Drawn;
use super::grid::Grid;
use super::{BuildError, BuildOptions, BuildReport};

/// Most ends within the weld distance of one end.
const MAX_NEAR: usize = 1000;

/// Weld distances that a walk between two ends must exceed before they are joined.
pub(super) const WALK: f64 = 3.0;

/// Nodes: where ends meet, and where curves will be cut.
pub(super) struct Nodes {
    /// Node of each end.
    pub(super) of_end: Vec<u32>,
    pub(super) positions_m: Vec<Point<f64>>,
    pub(super) levels: Vec<Option<u32>>,
    /// An end of each node; nodes from cuts have none.
    pub(super) ends: Vec<u32>,
}

impl Nodes {
    /// Adds a node where curves are cut.
    pub(super) fn add(&mut self, position_m: Point<f64>, level: Option<u32>) -> u32 {
        self.positions_m.push(position_m);
        self.levels.push(level);
        (self.positions_m.len() - 1) as u32
    }
}

pub(super) fn weld(
    drawn: &Drawn,
    options: &BuildOptions,
    report: &mut BuildReport,
) -> Result<(Nodes, Clusters), BuildError> {
    let curves = &drawn.curves;
    if curves.len() > options.max_pieces {
        let limit = options.max_pieces;
        return Err(BuildError::Pieces { limit });
    }
    let lengths_m = curves.iter().map(|curve| curve.polygon_m()).collect();
    let mut clusters = Clusters::new(lengths_m);
    let position = |end: u32| curves[end as usize / 2].end(end % 2);
    let level = |end: u32| curves[end as usize / 2].level;
    let firsts = join_equal(2 * curves.len() as u32, &position, &level, &mut clusters);
    let pairs = near_pairs(&firsts, &position, &level, drawn, options)?;
    for (_, a, b) in pairs {
        if clusters.root(a) != clusters.root(b) && !clusters.has_walk(a, b, WALK * options.weld_m) {
            clusters.join(a, b);
        }
    }
    Ok((number(&clusters, &position, &level, report), clusters))
}

/// Joins ends at the same place, and returns the first end of each place.
fn join_equal(
    ends: u32,
    position: &(impl Fn(u32) -> Point<f64> + Sync),
    level: &(impl Fn(u32) -> Option<u32> + Sync),
    clusters: &mut Clusters,
) -> Vec<u32> {
    let place = |end: u32| {
        let cell = |v: f64| (v / SAME_M).round() as i64;
        let p = position(end);
        (cell(p.x), cell(p.y), level(end), end)
    };
    let mut places: Vec<_> = (0..ends).into_par_iter().map(place).collect();
    places.par_sort_unstable();
    let mut firsts = Vec::new();
    for same in places.chunk_by(|a, b| (a.0, a.1, a.2) == (b.0, b.1, b.2)) {
        let first = same[0].3;
        firsts.push(first);
        for &(.., end) in &same[1..] {
            clusters.join(first, end);
        }
    }
    firsts.sort_unstable();
    firsts
}

/// Pairs of ends within the weld distance, the nearest first.
fn near_pairs(
    firsts: &[u32],
    position: &impl Fn(u32) -> Point<f64>,
    level: &impl Fn(u32) -> Option<u32>,
    drawn: &Drawn,
    options: &BuildOptions,
) -> Result<Vec<(f64, u32, u32)>, BuildError> {
    let weld_m = options.weld_m.max(SAME_M);
    let mut grid = Grid::new(weld_m, firsts.len());
    let mut pairs = Vec::new();
    let mut mixed: Option<(u64, u32, u32)> = None;
    for &end in firsts {
        let at = position(end);
        for (near, (row, distance_m)) in grid.near(at).enumerate() {
            if near == MAX_NEAR {
                return Err(BuildError::Crowded {
                    limit: MAX_NEAR,
                    weld_m,
                    at,
                });
            }
            let other = firsts[row as usize];
            if level(other) == level(end) {
                pairs.push((distance_m, other, end));
            } else {
                mixed.get_or_insert((0, other, end)).0 += 1;
            }
        }
        grid.add(at);
    }
    if let Some((count, first, second)) = mixed.filter(|_| !options.levels_apart) {
        return Err(BuildError::Levels {
            count,
            first: drawn.level_name(level(first)),
            second: drawn.level_name(level(second)),
            at: position(second),
        });
    }
    pairs.sort_by(|a, b| a.0.total_cmp(&b.0).then((a.1, a.2).cmp(&(b.1, b.2))));
    Ok(pairs)
}

/// Numbers the nodes in the order of their first ends, and places each at the end that is nearest
/// to the mean of its ends.
fn number(
    clusters: &Clusters,
    position: &impl Fn(u32) -> Point<f64>,
    level: &impl Fn(u32) -> Option<u32>,
    report: &mut BuildReport,
) -> Nodes {
    const NONE: u32 = u32::MAX;
    let ends = clusters.len();
    let mut nodes = Nodes {
        of_end: vec![NONE; ends as usize],
        positions_m: Vec::new(),
        levels: Vec::new(),
        ends: Vec::new(),
    };
    for end in 0..ends {
        if nodes.of_end[end as usize] != NONE {
            continue;
        }
        let node = nodes.positions_m.len() as u32;
        let members: Vec<u32> = clusters.members(end).collect();
        let at = middle(&members, position);
        let far_m = members.iter().map(|&m| position(m).distance(at));
        let far_m = far_m.fold(0.0, f64::max);
        if far_m > SAME_M {
            report.join(at);
        }
        report.largest_move_m = report.largest_move_m.max(far_m);
        for member in members {
            nodes.of_end[member as usize] = node;
        }
        nodes.add(at, level(end));
        nodes.ends.push(end);
    }
    nodes
}

fn middle(members: &[u32], position: &impl Fn(u32) -> Point<f64>) -> Point<f64> {
    let first = position(members[0]);
    let offsets = members.iter().map(|&m| position(m) - first);
    let sum = offsets.fold(Point::new(0.0, 0.0), |a, b| a + b);
    let mean = first + sum * (1.0 / members.len() as f64);
    let mut best = (first.distance(mean), members[0], first);
    for &member in &members[1..] {
        let at = position(member);
        let distance_m = at.distance(mean);
        // Rounding must not decide between two ends at the same distance: the first one stays.
        if distance_m < best.0 - 1e-9 || (distance_m <= best.0 + 1e-9 && member < best.1) {
            best = (distance_m, member, at);
        }
    }
    best.2
}
