use std::collections::HashMap;
use std::hash::{BuildHasher, RandomState};

use guideway_spline::Point;

use super::curve::{Curve, Samples, Swing};
use crate::{PathRef, Paths};

/// Most leaders with ends in one cell: more different curves between two places are no layout, and
/// to compare all with all would take for ever.
const MAX_LEADERS: u32 = 64;

/// How closely curves are measured, as a part of the tolerance that decides.
const PRECISION: f64 = 0.05;

const NONE: u32 = u32::MAX;

/// A path that follows the curve of another, the first of its group.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Member {
    /// Row of the first path of the group.
    pub(super) first: usize,
    /// Row of this path.
    pub(super) row: usize,
    /// Whether it follows the curve from end to start.
    pub(super) reversed: bool,
}

/// The paths of the same curve and level as an earlier one, in order of group and row.
pub(super) fn members(paths: &Paths, tolerance_m: f64) -> Vec<Member> {
    let mut groups = Groups::new(paths, tolerance_m);
    let mut members: Vec<_> = (0..paths.len())
        .filter_map(|row| groups.place(row))
        .collect();
    members.sort_unstable();
    members
}

/// The first path of every group, found by the grid cells of its two ends.
struct Groups<'a> {
    paths: &'a Paths,
    tolerance_m: f64,
    cell_m: f64,
    hasher: RandomState,
    /// Latest leader of each cell; the others hang on it.
    heads: HashMap<u64, u32>,
    leaders: Vec<Leader>,
    samples: Vec<Samples>,
    own: Curve,
    other: Curve,
}

#[derive(Clone, Copy)]
struct Leader {
    row: u32,
    /// Index of the one before in the cell.
    next: u32,
    /// Number of leaders in the cell up to this one.
    depth: u32,
    ends: [Point<f64>; 2],
    swing: Swing,
    /// Index in `samples`, once they were needed.
    samples: u32,
}

impl<'a> Groups<'a> {
    fn new(paths: &'a Paths, tolerance_m: f64) -> Self {
        Self {
            paths,
            tolerance_m,
            // Wide enough that few ends are near a border, where two cells must be looked into.
            cell_m: (16.0 * tolerance_m).max(1e-6),
            hasher: RandomState::new(),
            heads: HashMap::with_capacity(paths.len()),
            leaders: Vec::with_capacity(paths.len()),
            samples: Vec::new(),
            own: Curve::default(),
            other: Curve::default(),
        }
    }

    /// Finds the group of a path, or lets it lead a new one.
    fn place(&mut self, row: usize) -> Option<Member> {
        let path = self.paths.get(row);
        self.own.load(path);
        let ends = self.own.ends()?;
        let swing = self.own.swing();
        let mut samples = None;
        for reversed in [false, true] {
            let ends = oriented(ends, reversed);
            for cell in cells_around(ends, self.cell_m, self.tolerance_m) {
                let key = self.key(path, cell);
                let mut next = self.heads.get(&key).copied().unwrap_or(NONE);
                while next != NONE {
                    let leader = self.leaders[next as usize];
                    if swing.may_match(leader.swing, reversed, self.tolerance_m)
                        && self.matches(next as usize, ends, reversed, &mut samples)
                    {
                        let first = leader.row as usize;
                        return Some(Member {
                            first,
                            row,
                            reversed,
                        });
                    }
                    next = leader.next;
                }
            }
        }
        self.lead(path, ends, swing);
        None
    }

    fn key(&self, path: PathRef<'_>, cell: Cell) -> u64 {
        self.hasher.hash_one((path.level(), cell))
    }

    fn lead(&mut self, path: PathRef<'_>, ends: [Point<f64>; 2], swing: Swing) {
        let key = self.key(path, cell_of(ends, self.cell_m));
        let head = self.heads.entry(key).or_insert(NONE);
        let depth = self.leaders.get(*head as usize).map_or(1, |l| l.depth + 1);
        if depth <= MAX_LEADERS {
            self.leaders.push(Leader {
                row: path.row() as u32,
                next: *head,
                depth,
                ends,
                swing,
                samples: NONE,
            });
            *head = (self.leaders.len() - 1) as u32;
        }
    }

    /// Whether the loaded curve is that of a leader. `samples` are its own, kept once taken.
    fn matches(
        &mut self,
        leader: usize,
        ends: [Point<f64>; 2],
        reversed: bool,
        samples: &mut Option<Samples>,
    ) -> bool {
        let near = |a: Point<f64>, b: Point<f64>| a.distance(b) <= self.tolerance_m;
        let Leader {
            row,
            ends: leader_ends,
            ..
        } = self.leaders[leader];
        if !(near(ends[0], leader_ends[0]) && near(ends[1], leader_ends[1])) {
            return false;
        }
        let path = self.paths.get(row as usize);
        if self.own.has_points_of(path, reversed, self.tolerance_m) {
            return true;
        }
        let precision_m = PRECISION * self.tolerance_m;
        let own = *samples.get_or_insert_with(|| self.own.samples(precision_m));
        if self.leaders[leader].samples == NONE {
            self.leaders[leader].samples = self.samples.len() as u32;
            self.other.load(path);
            self.samples.push(self.other.samples(precision_m));
        }
        let theirs = &self.samples[self.leaders[leader].samples as usize];
        let last = own.len() - 1;
        (0..own.len()).all(|i| near(own[if reversed { last - i } else { i }], theirs[i]))
    }
}

fn oriented([start, end]: [Point<f64>; 2], reversed: bool) -> [Point<f64>; 2] {
    if reversed { [end, start] } else { [start, end] }
}

/// A cell of the grid over both ends together.
type Cell = [i64; 4];

fn cell_of(ends: [Point<f64>; 2], cell_m: f64) -> Cell {
    coordinates(ends).map(|v| (v / cell_m).floor() as i64)
}

fn coordinates([start, end]: [Point<f64>; 2]) -> [f64; 4] {
    [start.x, start.y, end.x, end.y]
}

/// Every cell that ends within `margin_m` of these may be in, none of them twice.
fn cells_around(
    ends: [Point<f64>; 2],
    cell_m: f64,
    margin_m: f64,
) -> impl Iterator<Item = Cell> + use<> {
    let at = |offset_m: f64| {
        let moved = coordinates(ends).map(|v| v + offset_m);
        moved.map(|v| (v / cell_m).floor() as i64)
    };
    let (low, high) = (at(-margin_m), at(margin_m));
    // Bit i of the mask takes the upper cell of coordinate i, if there are two.
    let upper = |mask: usize, i: usize| mask >> i & 1 == 1;
    let masks = (0..16).filter(move |&m| (0..4).all(|i| !upper(m, i) || low[i] != high[i]));
    masks.map(move |m| std::array::from_fn(|i| if upper(m, i) { high[i] } else { low[i] }))
}
