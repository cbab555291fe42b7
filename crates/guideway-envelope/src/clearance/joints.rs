//! Finds where paths meet: joins coinciding path ends, and follows short paths between joints.

use std::collections::HashMap;

use guideway_layout::{Layout, PathRef};
use guideway_spline::Point;

use crate::ExemptZone;

type P = Point<f64>;

/// The joints of a layout: path ends at the same position share one, with or without a node.
pub(super) struct Joints {
    /// Both ends per path; `None` for a path without a curve.
    ends: Vec<Option<[End; 2]>>,
    /// Per joint, the joints at the other ends of its paths, and the path lengths in meters.
    ways: Vec<Vec<(u32, f64)>>,
}

#[derive(Clone, Copy)]
struct End {
    joint: u32,
    at: P,
}

/// A joint that is reachable from an end of a path.
#[derive(Clone, Copy)]
pub(super) struct ReachableJoint {
    from: P,
    joint: u32,
    way_m: f64,
}

impl Joints {
    /// Joins all path ends within a tolerance, in meters.
    pub(super) fn new(layout: &Layout, tolerance_m: f64) -> Self {
        let mut places = JointGrid::new(tolerance_m);
        let mut joints = Self {
            ends: Vec::with_capacity(layout.paths.len()),
            ways: Vec::new(),
        };
        for path in layout.paths.iter() {
            let ends = path.ends().map(|(start, end)| {
                let joint = |at: P, node: Option<u32>| {
                    let node_at = node.map(|node| layout.nodes.position_m(node));
                    End {
                        joint: places.joint(node_at.unwrap_or(at), path.level()),
                        at,
                    }
                };
                let mut joint = joint;
                [joint(start, path.start_node()), joint(end, path.end_node())]
            });
            joints.ways.resize_with(places.count as usize, Vec::new);
            if let Some([start, end]) = ends {
                let length_m = polygon_m(path);
                joints.ways[start.joint as usize].push((end.joint, length_m));
                joints.ways[end.joint as usize].push((start.joint, length_m));
            }
            joints.ends.push(ends);
        }
        joints
    }

    /// The joints within a path length of the ends of a path, the ends themselves first.
    pub(super) fn reached(&self, path: usize, most_m: f64) -> Vec<ReachableJoint> {
        let mut all = Vec::new();
        for end in self.ends[path].iter().flatten() {
            let first = all.len();
            all.push(ReachableJoint {
                from: end.at,
                joint: end.joint,
                way_m: 0.0,
            });
            // Few joints are in reach, so a linear search is fastest.
            let mut next = first;
            while let Some(&ReachableJoint { joint, way_m, .. }) = all.get(next) {
                next += 1;
                for &(joint, length_m) in self.ways[joint as usize].iter().take(MOST_WAYS) {
                    let way_m = way_m + length_m;
                    if way_m > most_m || all.len() >= MOST_REACHED {
                        continue;
                    }
                    let known = all[first..].iter().position(|r| r.joint == joint);
                    let is_nearer = known.is_none_or(|known| way_m < all[first + known].way_m);
                    if is_nearer {
                        all.push(ReachableJoint {
                            from: end.at,
                            joint,
                            way_m,
                        });
                    }
                }
            }
        }
        all
    }

    /// The exempt zones of two paths, from the joints in reach of the first one.
    pub(super) fn exempt_zones(
        &self,
        reached: &[ReachableJoint],
        other: usize,
        near_joint_m: f64,
        most_way_m: f64,
    ) -> Vec<ExemptZone> {
        let ends = self.ends[other].iter().flatten();
        let pairs = ends.flat_map(|end| {
            let here = reached.iter().filter(|r| r.joint == end.joint);
            here.map(move |r| (r, end.at))
        });
        let meeting = |(reached, at): (&ReachableJoint, P)| ExemptZone {
            centers_m: [reached.from, at],
            radius_m: match reached.way_m {
                0.0 => near_joint_m,
                _ => most_way_m,
            },
        };
        pairs.map(meeting).collect()
    }
}

/// Joints in reach of one path end; bounds the search in a dense network. Farther ones do not count
/// as connected.
const MOST_REACHED: usize = 256;
/// Paths at one joint that the search follows.
const MOST_WAYS: usize = 4096;

/// Length of the control polygons of a path, an upper bound of its length.
fn polygon_m(path: PathRef<'_>) -> f64 {
    let legs = path.runs().flat_map(|run| run.segments());
    legs.map(|p| {
        let b = guideway_spline::uniform::to_bezier(&p);
        b.windows(2).map(|leg| leg[0].distance(leg[1])).sum::<f64>()
    })
    .sum()
}

/// Column, row and level of a grid cell.
type Cell = (i64, i64, Option<u32>);

/// Joints in the cells of a grid.
struct JointGrid {
    tolerance_m: f64,
    cells: HashMap<Cell, Vec<(P, u32)>>,
    count: u32,
}

impl JointGrid {
    fn new(tolerance_m: f64) -> Self {
        Self {
            tolerance_m,
            cells: HashMap::new(),
            count: 0,
        }
    }

    /// The joint within the tolerance of a position, or a new one.
    fn joint(&mut self, at: P, level: Option<u32>) -> u32 {
        let cell_m = self.tolerance_m.max(1e-6);
        let cell = |v: f64| (v / cell_m).floor() as i64;
        let (x, y) = (cell(at.x), cell(at.y));
        for (i, j) in (-1..=1).flat_map(|i| (-1..=1).map(move |j| (i, j))) {
            let there = self.cells.get(&(x + i, y + j, level));
            let known = there.into_iter().flatten();
            for &(other, joint) in known {
                if other.distance(at) <= self.tolerance_m {
                    return joint;
                }
            }
        }
        let joint = self.count;
        self.count += 1;
        self.cells
            .entry((x, y, level))
            .or_default()
            .push((at, joint));
        joint
    }
}
