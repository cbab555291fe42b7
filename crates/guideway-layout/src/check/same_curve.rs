//! Groups of paths with the same curve, found by leader clustering over a grid of end points.
//!
//! The first path of a group is its leader. A hash table maps the grid cell of both end points
//! (four coordinates) to the leaders there; each path is compared with the leaders of the cells
//! around its ends, in both directions, and joins the first match or leads a new group.

use std::collections::HashMap;
use std::hash::{BuildHasher, RandomState};

use guideway_spline::Point;

use super::curve::{ChordArea, Curve, Samples};
use crate::{PathRef, Paths};

/// Most leaders per cell. No real layout has more distinct curves between two places, and the limit
/// keeps the cost of hostile input linear.
const MAX_LEADERS: u32 = 64;

/// Precision of sampled points, as a fraction of the tolerance.
const PRECISION: f64 = 0.05;

/// Index that means "none" in the lists of leaders.
const NONE: u32 = u32::MAX;

/// A path with the curve of its leader, the first path of the group.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Member {
    /// Row of the first path of the group.
    pub(super) first: usize,
    /// Row of this path.
    pub(super) row: usize,
    /// Whether it runs from the end of that curve to its start.
    pub(super) reversed: bool,
}

/// Row of the first path with the same curve and level, in either direction, for each path; its own
/// row if there is none.
///
/// Two curves are the same if no point of one is farther than `tolerance_m` from the other.
pub fn same_curves(paths: &Paths, tolerance_m: f64) -> Vec<u32> {
    let mut first: Vec<u32> = (0..paths.len() as u32).collect();
    for member in members(paths, tolerance_m) {
        first[member.row] = member.first as u32;
    }
    first
}

/// The paths with the curve and level of an earlier path, in order of group and row.
pub(super) fn members(paths: &Paths, tolerance_m: f64) -> Vec<Member> {
    let mut groups = Groups::new(paths, tolerance_m);
    let mut members: Vec<_> = (0..paths.len()).filter_map(|row| groups.add(row)).collect();
    members.sort_unstable();
    members
}

/// The leaders so far, by the grid cells of their ends.
struct Groups<'a> {
    paths: &'a Paths,
    tolerance_m: f64,
    cell_m: f64,
    hasher: RandomState,
    /// Latest leader of each cell; `Leader::next` links the others.
    heads: HashMap<u64, u32>,
    leaders: Vec<Leader>,
    samples: Vec<Samples>,
    own: Curve,
    other: Curve,
}

#[derive(Clone, Copy)]
struct Leader {
    row: u32,
    /// Index of the previous leader in the cell.
    next: u32,
    /// Number of leaders in the cell up to this one.
    depth: u32,
    ends: [Point<f64>; 2],
    area: ChordArea,
    /// Index in `Groups::samples`, from the first comparison that needs them.
    samples: u32,
}

impl<'a> Groups<'a> {
    fn new(paths: &'a Paths, tolerance_m: f64) -> Self {
        Self {
            paths,
            tolerance_m,
            // Wide enough that few ends are near a border, where the search visits two cells.
            cell_m: (16.0 * tolerance_m).max(1e-6),
            hasher: RandomState::new(),
            heads: HashMap::with_capacity(paths.len()),
            leaders: Vec::with_capacity(paths.len()),
            samples: Vec::new(),
            own: Curve::default(),
            other: Curve::default(),
        }
    }

    /// Adds a path to the group with its curve, or makes it the leader of a new one.
    fn add(&mut self, row: usize) -> Option<Member> {
        let path = self.paths.get(row);
        self.own.load(path);
        let ends = self.own.ends()?;
        let area = self.own.chord_area();
        let mut samples = None;
        for reversed in [false, true] {
            let ends = oriented(ends, reversed);
            for cell in cells_around(ends, self.cell_m, self.tolerance_m) {
                let key = self.key(path, cell);
                let mut next = self.heads.get(&key).copied().unwrap_or(NONE);
                while next != NONE {
                    let leader = self.leaders[next as usize];
                    if area.may_match(leader.area, reversed, self.tolerance_m)
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
        self.add_leader(path, ends, area);
        None
    }

    fn key(&self, path: PathRef<'_>, cell: Cell) -> u64 {
        self.hasher.hash_one((path.level(), cell))
    }

    fn add_leader(&mut self, path: PathRef<'_>, ends: [Point<f64>; 2], area: ChordArea) {
        let key = self.key(path, cell_of(ends, self.cell_m));
        let head = self.heads.entry(key).or_insert(NONE);
        let depth = self.leaders.get(*head as usize).map_or(1, |l| l.depth + 1);
        if depth <= MAX_LEADERS {
            self.leaders.push(Leader {
                row: path.row() as u32,
                next: *head,
                depth,
                ends,
                area,
                samples: NONE,
            });
            *head = (self.leaders.len() - 1) as u32;
        }
    }

    /// Whether the loaded curve is that of a leader. `samples` caches the points of the loaded
    /// curve.
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

/// A cell of the four-dimensional grid over the coordinates of both ends.
type Cell = [i64; 4];

fn cell_of(ends: [Point<f64>; 2], cell_m: f64) -> Cell {
    coordinates(ends).map(|v| (v / cell_m).floor() as i64)
}

fn coordinates([start, end]: [Point<f64>; 2]) -> [f64; 4] {
    [start.x, start.y, end.x, end.y]
}

/// All cells that may contain ends within `margin_m` of these, each once.
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
