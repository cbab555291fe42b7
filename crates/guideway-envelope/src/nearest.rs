use std::cmp::Ordering;
use std::collections::BinaryHeap;

use guideway_spline::{Bounds, Point};

use crate::Sweep;
use crate::sweep::Stretch;

/// How near two sweeps come to each other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClosestApproach {
    /// Their distance, or up to the tolerance less; zero if they overlap.
    pub distance_m: f64,
    /// Where the reference points of the two are there, within the reach of the bodies.
    pub positions: [Point<f64>; 2],
}

/// Where two sweeps may be near each other: while the reference point of each is within the radius of its center.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ExemptZone {
    /// The center for each of the two, in meters.
    pub centers_m: [Point<f64>; 2],
    /// The radius, in meters.
    pub radius_m: f64,
}

/// A question about two sweeps.
#[derive(Clone, Copy, Debug)]
pub struct ProximityQuery<'q> {
    /// They matter if they come nearer than this, or overlap.
    pub threshold_m: f64,
    /// How closely it is answered.
    pub tolerance_m: f64,
    /// Where they may be near each other.
    pub exempt_zones: &'q [ExemptZone],
}

/// A sweep that is halved where it is looked at closely. What was halved stays so for the next look.
#[derive(Debug)]
pub struct SweepTree {
    sweep: Sweep,
    nodes: Vec<Stretch>,
    /// Of each node, the first of its two halves; 0 if it was not halved yet.
    halves: Vec<u32>,
}

impl SweepTree {
    /// Nothing is halved yet.
    pub fn new(sweep: Sweep) -> Self {
        Self {
            nodes: vec![Stretch::whole(&sweep)],
            sweep,
            halves: vec![0],
        }
    }

    fn node(&self, node: u32) -> &Stretch {
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

    /// How near two sweeps come to each other, if that matters: less than `threshold_m` apart in polygons that hold
    /// them, and are within `tolerance_m` of them, where they may not be. So nothing nearer than `threshold_m` is
    /// missed, and whatever is told is nearer than `threshold_m + tolerance_m`. `tests` counts distances of polygons.
    ///
    /// Best first: of all pairs of stretches, the one whose polygons are nearest is halved, until it is known
    /// within the tolerance; no other pair can then be nearer.
    pub fn nearest(
        &mut self,
        other: &mut Self,
        question: &ProximityQuery<'_>,
        tests: &mut u64,
    ) -> Option<ClosestApproach> {
        let mut search = Search {
            trees: [self, other],
            question,
            open: BinaryHeap::new(),
            tests,
        };
        search.add([0, 0]);
        while let Some(pair) = search.open.pop() {
            match search.side_to_halve(&pair) {
                Some(side) => search.halve(pair.nodes, side),
                None => return Some(search.answer(pair)),
            }
        }
        None
    }
}

/// Two stretches of which the first is of one sweep and the second of the other.
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
    /// The nearest is the greatest; of several as near, the one that is known best.
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
    fn stretches(&self, nodes: [u32; 2]) -> [&Stretch; 2] {
        [0, 1].map(|side| self.trees[side].node(nodes[side]))
    }

    fn add(&mut self, nodes: [u32; 2]) {
        if let Some(pair) = self.pair(nodes) {
            self.open.push(pair);
        }
    }

    /// The pair, if it can matter.
    fn pair(&mut self, nodes: [u32; 2]) -> Option<Pair> {
        let threshold_m = self.question.threshold_m;
        let [a, b] = self.stretches(nodes).map(|stretch| &stretch.hull);
        let may_be = |stretches: &[&Stretch; 2]| {
            let exempt_zones = self.question.exempt_zones.iter();
            exempt_zones.copied().any(|m| m.has(stretches) == Has::All)
        };
        if apart_m(a.bounds, b.bounds) > threshold_m || may_be(&self.stretches(nodes)) {
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

    /// Which of the two has to be looked at more closely.
    fn side_to_halve(&self, pair: &Pair) -> Option<usize> {
        let stretches = self.stretches(pair.nodes);
        let [a, b] = stretches.map(|stretch| stretch.hull.error_m);
        if a + b > self.question.tolerance_m {
            return Some(usize::from(b > a));
        }
        // What may be near in part only is cut until it hardly matters which part it is.
        let exempt_zones = self.question.exempt_zones.iter();
        let is_partly = exempt_zones
            .copied()
            .any(|m| m.has(&stretches) == Has::Some);
        let finest_m = |side: usize| self.trees[side].sweep.finest_m(self.question.tolerance_m);
        let [a, b] = [0, 1].map(|side| stretches[side].extent_m() / finest_m(side));
        (is_partly && a.max(b) > 1.0).then(|| usize::from(b > a))
    }

    fn halve(&mut self, nodes: [u32; 2], side: usize) {
        for half in self.trees[side].halves(nodes[side]) {
            let mut nodes = nodes;
            nodes[side] = half;
            self.add(nodes);
        }
    }

    /// What is known of the nearest pair, and where it is.
    fn answer(&mut self, pair: Pair) -> ClosestApproach {
        let reach_m = self
            .trees
            .each_ref()
            .map(|tree| tree.sweep.reach_m().max(self.question.tolerance_m));
        let mut nodes = pair.nodes;
        while let Some(side) = {
            let extents = self.stretches(nodes).map(Stretch::extent_m);
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
            positions: self.stretches(nodes).map(Stretch::place),
        }
    }
}

/// How much of something is so.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Has {
    None,
    Some,
    All,
}

impl ExemptZone {
    /// Which of the pairs of places of two stretches are within it.
    fn has(self, stretches: &[&Stretch; 2]) -> Has {
        let [a, b] = [0, 1].map(|side| {
            let (center, places) = (self.centers_m[side], stretches[side].hull.places);
            match self.radius_m {
                r if farthest_m(center, places) <= r => Has::All,
                r if nearest_m(center, places) <= r => Has::Some,
                _ => Has::None,
            }
        });
        match (a, b) {
            (Has::All, Has::All) => Has::All,
            (Has::None, _) | (_, Has::None) => Has::None,
            _ => Has::Some,
        }
    }
}

/// The distance of two boxes.
fn apart_m(a: Bounds<f64>, b: Bounds<f64>) -> f64 {
    let gap = |low: f64, high: f64| (low - high).max(0.0);
    let x = gap(a.min.x, b.max.x).max(gap(b.min.x, a.max.x));
    let y = gap(a.min.y, b.max.y).max(gap(b.min.y, a.max.y));
    x.hypot(y)
}

fn nearest_m(p: Point<f64>, of: Bounds<f64>) -> f64 {
    apart_m(Bounds { min: p, max: p }, of)
}

fn farthest_m(p: Point<f64>, of: Bounds<f64>) -> f64 {
    let side = |p: f64, min: f64, max: f64| (p - min).abs().max((max - p).abs());
    let x = side(p.x, of.min.x, of.max.x);
    x.hypot(side(p.y, of.min.y, of.max.y))
}
