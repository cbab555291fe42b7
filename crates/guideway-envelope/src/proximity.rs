//! Finds the closest approach of two sweeps by a best-first search over their hierarchies.
//!
//! The queue holds pairs of parts, ordered by the distance of their polygons. The search halves the
//! pair with the smallest distance until its distance is known within the tolerance; no other pair
//! can then be closer. Exempt zones drop pairs near a common end of two paths.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use guideway_spline::{Bounds, Point};

use crate::Sweep;
use crate::sweep::SweepPart;

/// The closest approach of two sweeps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClosestApproach {
    /// A lower bound of their distance, within the tolerance; 0 if they overlap.
    pub distance_m: f64,
    /// The reference points of both at the closest approach, within the reach of the bodies.
    pub positions: [Point<f64>; 2],
}

/// A zone in which two sweeps may be near each other: while both reference points are within the
/// radius of their centers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ExemptZone {
    /// The center for each of the two sweeps, in meters.
    pub centers_m: [Point<f64>; 2],
    /// The radius around both centers, in meters.
    pub radius_m: f64,
}

/// A distance query about two sweeps.
#[derive(Clone, Copy, Debug)]
pub struct ProximityQuery<'q> {
    /// Largest distance of interest, in meters. Overlaps are always of interest.
    pub threshold_m: f64,
    /// Precision of the distance, in meters.
    pub tolerance_m: f64,
    /// Zones in which the sweeps may be near each other.
    pub exempt_zones: &'q [ExemptZone],
    /// Largest number of polygon distances, counted with those of earlier queries.
    pub max_tests: u64,
}

/// A query reached its largest number of polygon distances before it was decided.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Undecided;

/// The hierarchy of a sweep, refined lazily. Later queries reuse the refinement of earlier ones.
#[derive(Debug)]
pub struct SweepTree {
    sweep: Sweep,
    nodes: Vec<SweepPart>,
    /// Index of the first of two adjacent children per node; 0 for a leaf.
    halves: Vec<u32>,
}

impl SweepTree {
    /// A hierarchy of one node.
    pub fn new(sweep: Sweep) -> Self {
        Self {
            nodes: vec![SweepPart::whole(&sweep)],
            sweep,
            halves: vec![0],
        }
    }

    fn node(&self, node: u32) -> &SweepPart {
        &self.nodes[node as usize]
    }

    fn halves(&mut self, node: u32) -> [u32; 2] {
        let index = node as usize;
        if self.halves[index] == 0 {
            self.halves[index] = self.nodes.len() as u32;
            let halves = self.nodes[index].halves(&self.sweep);
            self.nodes.extend(halves);
            self.halves.extend([0; 2]);
        }
        [self.halves[index], self.halves[index] + 1]
    }

    /// The closest approach of two sweeps outside of exempt zones; `None` if it exceeds
    /// `threshold_m`. Finds every approach below `threshold_m`, and none above `threshold_m +
    /// tolerance_m`. Adds the number of polygon distances to `tests`.
    ///
    /// # Errors
    /// When `tests` reaches [`ProximityQuery::max_tests`].
    pub fn nearest(
        &mut self,
        other: &mut Self,
        question: &ProximityQuery<'_>,
        tests: &mut u64,
    ) -> Result<Option<ClosestApproach>, Undecided> {
        let mut search = Search {
            trees: [self, other],
            question,
            open: BinaryHeap::new(),
            tests,
        };
        search.add([0, 0]);
        while let Some(pair) = search.open.pop() {
            match search.side_to_halve(&pair) {
                _ if *search.tests >= question.max_tests => return Err(Undecided),
                Some(side) => search.halve(pair.nodes, side),
                None => return Ok(Some(search.closest_approach(pair))),
            }
        }
        Ok(None)
    }
}

/// A pair of nodes, one per sweep.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Pair {
    nodes: [u32; 2],
    distance_m: f64,
    error_m: f64,
}

impl Eq for Pair {}

impl PartialOrd for Pair {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Pair {
    /// The closest pair is the greatest; of equally close ones, the most precise.
    fn cmp(&self, other: &Self) -> Ordering {
        let by_distance = other.distance_m.total_cmp(&self.distance_m);
        by_distance
            .then(other.error_m.total_cmp(&self.error_m))
            .then(other.nodes.cmp(&self.nodes))
    }
}

struct Search<'t, 'q> {
    trees: [&'t mut SweepTree; 2],
    question: &'q ProximityQuery<'q>,
    open: BinaryHeap<Pair>,
    tests: &'t mut u64,
}

impl Search<'_, '_> {
    fn parts(&self, nodes: [u32; 2]) -> [&SweepPart; 2] {
        [0, 1].map(|side| self.trees[side].node(nodes[side]))
    }

    fn add(&mut self, nodes: [u32; 2]) {
        if let Some(pair) = self.pair(nodes) {
            self.open.push(pair);
        }
    }

    /// The pair of two nodes, unless it is beyond the threshold or exempt.
    fn pair(&mut self, nodes: [u32; 2]) -> Option<Pair> {
        let threshold_m = self.question.threshold_m;
        let [a, b] = self.parts(nodes).map(|part| &part.hull);
        let is_exempt = |parts: &[&SweepPart; 2]| {
            let exempt_zones = self.question.exempt_zones.iter();
            exempt_zones
                .copied()
                .any(|m| m.coverage(parts) == Coverage::All)
        };
        if box_distance_m(a.bounds, b.bounds) > threshold_m || is_exempt(&self.parts(nodes)) {
            return None;
        }
        let distance_m = a.outer.distance(&b.outer);
        let error_m = a.error_m + b.error_m;
        *self.tests += 1;
        let matters = distance_m < threshold_m || distance_m == 0.0;
        matters.then_some(Pair {
            nodes,
            distance_m,
            error_m,
        })
    }

    /// The side to halve for a precise answer; `None` if the pair is precise enough.
    fn side_to_halve(&self, pair: &Pair) -> Option<usize> {
        let parts = self.parts(pair.nodes);
        let [a, b] = parts.map(|part| part.hull.error_m);
        if a + b > self.question.tolerance_m {
            return Some(usize::from(b > a));
        }
        // A pair that is partly exempt is cut until its extent is negligible.
        let exempt_zones = self.question.exempt_zones.iter();
        let is_partly = exempt_zones
            .copied()
            .any(|m| m.coverage(&parts) == Coverage::Some);
        let finest_m = |side: usize| self.trees[side].sweep.finest_m(self.question.tolerance_m);
        let [a, b] = [0, 1].map(|side| parts[side].extent_m() / finest_m(side));
        (is_partly && a.max(b) > 1.0).then(|| usize::from(b > a))
    }

    fn halve(&mut self, nodes: [u32; 2], side: usize) {
        for half in self.trees[side].halves(nodes[side]) {
            let mut nodes = nodes;
            nodes[side] = half;
            self.add(nodes);
        }
    }

    /// The closest approach of a pair. Refines the pair until its positions are within the reach of
    /// the bodies.
    fn closest_approach(&mut self, pair: Pair) -> ClosestApproach {
        let reach_m = self
            .trees
            .each_ref()
            .map(|tree| tree.sweep.reach_m().max(self.question.tolerance_m));
        let mut nodes = pair.nodes;
        while let Some(side) = {
            let extents = self.parts(nodes).map(SweepPart::extent_m);
            let excess = [0, 1].map(|side| extents[side] / reach_m[side]);
            let side = usize::from(excess[1] > excess[0]);
            (excess[side] > 1.0).then_some(side)
        } {
            let halves = self.trees[side].halves(nodes[side]);
            let pairs = halves.map(|half| {
                let mut nodes = nodes;
                nodes[side] = half;
                self.pair(nodes)
            });
            match pairs.into_iter().flatten().max() {
                Some(nearest) => nodes = nearest.nodes,
                None => break,
            }
        }
        ClosestApproach {
            distance_m: pair.distance_m,
            positions: self.parts(nodes).map(SweepPart::position),
        }
    }
}

/// The share of reference points that a zone contains.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Coverage {
    None,
    Some,
    All,
}

impl ExemptZone {
    /// The share of the reference points of two parts that the zone contains.
    fn coverage(self, parts: &[&SweepPart; 2]) -> Coverage {
        let [a, b] = [0, 1].map(|side| {
            let (center, bounds) = (self.centers_m[side], parts[side].hull.reference_bounds);
            match self.radius_m {
                r if farthest_m(center, bounds) <= r => Coverage::All,
                r if nearest_m(center, bounds) <= r => Coverage::Some,
                _ => Coverage::None,
            }
        });
        match (a, b) {
            (Coverage::All, Coverage::All) => Coverage::All,
            (Coverage::None, _) | (_, Coverage::None) => Coverage::None,
            _ => Coverage::Some,
        }
    }
}

/// Distance of two boxes; 0 if they overlap.
fn box_distance_m(a: Bounds<f64>, b: Bounds<f64>) -> f64 {
    let gap = |low: f64, high: f64| (low - high).max(0.0);
    let x = gap(a.min.x, b.max.x).max(gap(b.min.x, a.max.x));
    let y = gap(a.min.y, b.max.y).max(gap(b.min.y, a.max.y));
    x.hypot(y)
}

fn nearest_m(p: Point<f64>, of: Bounds<f64>) -> f64 {
    box_distance_m(Bounds { min: p, max: p }, of)
}

fn farthest_m(p: Point<f64>, of: Bounds<f64>) -> f64 {
    let side = |p: f64, min: f64, max: f64| (p - min).abs().max((max - p).abs());
    let x = side(p.x, of.min.x, of.max.x);
    x.hypot(side(p.y, of.min.y, of.max.y))
}
