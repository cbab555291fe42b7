//! A* over arcs: a state is the arc on which a vehicle arrives, because its heading decides which
//! turns are permitted, and how long they take.
//!
//! The estimate of the remaining time is the straight distance to the nearest goal times the least
//! time per meter of any arc. It never exceeds the time of an arc plus the estimate after it, so
//! the first arrival at a goal is the fastest one.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use guideway_spline::Point;

use super::Place;
use super::router::Router;

/// No arc before this one.
const START: u32 = u32::MAX;

/// A way, and the work of its search.
pub(super) struct Found {
    /// Rows of its arcs in order.
    pub(super) arcs: Vec<u32>,
    /// Turns that were compared.
    pub(super) turns: u64,
}

/// An arc that waits, with the time when its end is reached.
struct Waiting {
    estimate_s: f64,
    time_s: f64,
    arc: u32,
}

impl Ord for Waiting {
    /// The earliest is the greatest, for a heap that pops the greatest.
    fn cmp(&self, other: &Self) -> Ordering {
        let by_time = other.estimate_s.total_cmp(&self.estimate_s);
        by_time.then(other.arc.cmp(&self.arc))
    }
}

impl PartialOrd for Waiting {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Waiting {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Waiting {}

impl Router<'_> {
    /// The arcs from one place to another one, or the number of nodes that are reached.
    /// With `any_turn`, rotation rules do not count.
    pub(super) fn search(&self, from: &Place, to: &Place, any_turn: bool) -> Result<Found, u32> {
        let arcs = &self.arcs;
        let nodes = arcs.node_count() as usize;
        let mut is_goal = vec![false; nodes];
        to.nodes
            .iter()
            .for_each(|&node| is_goal[node as usize] = true);
        let goals: Vec<Point<f64>> = to
            .nodes
            .iter()
            .map(|&n| self.layout.nodes.position_m(n))
            .collect();
        let rest_s = |node: u32| {
            let at = self.layout.nodes.position_m(node);
            let nearest = goals
                .iter()
                .map(|goal| goal.distance(at))
                .fold(f64::INFINITY, f64::min);
            nearest * self.costs.least_s_per_m
        };
        let mut times_s = vec![f64::INFINITY; arcs.all.len()];
        let mut before = vec![START; arcs.all.len()];
        // Arcs by node whose time may still improve: the first `open` of each node.
        let mut pending = arcs.leaving_rows().to_vec();
        let mut open: Vec<usize> = (0..nodes as u32).map(|n| arcs.leaving(n).len()).collect();
        let mut heap = BinaryHeap::new();
        let mut reach = |heap: &mut BinaryHeap<Waiting>, arc: u32, from: u32, time_s: f64| {
            let time_s = time_s + self.costs.of_arc[arc as usize].drive_s;
            if time_s < times_s[arc as usize] {
                times_s[arc as usize] = time_s;
                before[arc as usize] = from;
                let estimate_s = time_s + rest_s(arcs.get(arc).to);
                heap.push(Waiting {
                    estimate_s,
                    time_s,
                    arc,
                });
            }
        };
        for &node in &from.nodes {
            for &arc in arcs.leaving(node) {
                reach(&mut heap, arc, START, 0.0);
            }
        }
        let (mut arrived, mut turns) = (None, 0);
        let mut done = vec![false; arcs.all.len()];
        while let Some(Waiting { time_s, arc, .. }) = heap.pop() {
            if std::mem::replace(&mut done[arc as usize], true) {
                continue;
            }
            let node = arcs.get(arc).to;
            if is_goal[node as usize] {
                arrived = Some(arc);
                break;
            }
            let first = arcs.first_leaving(node);
            let mut row = 0;
            while row < open[node as usize] {
                let next = pending[first + row];
                if done[next as usize] {
                    // No later arrival improves it.
                    open[node as usize] -= 1;
                    pending.swap(first + row, first + open[node as usize]);
                    continue;
                }
                row += 1;
                turns += 1;
                let turn = self.costs.turn(arc, next);
                let turn = if any_turn {
                    turn.or(Some((0.0, 0.0)))
                } else {
                    turn
                };
                if let Some((_, turn_s)) = turn {
                    reach(&mut heap, next, arc, time_s + turn_s);
                }
            }
        }
        let Some(mut arc) = arrived else {
            let mut is_reached = vec![false; nodes];
            let reached = arcs.all.iter().zip(&done).filter(|(_, done)| **done);
            reached.for_each(|(arc, _)| is_reached[arc.to as usize] = true);
            return Err(is_reached.into_iter().filter(|reached| *reached).count() as u32);
        };
        let mut found = vec![arc];
        while before[arc as usize] != START {
            arc = before[arc as usize];
            found.push(arc);
        }
        found.reverse();
        Ok(Found { arcs: found, turns })
    }
}
