//! Checks the clearance of paths to the walls of a floor plan.

use guideway_layout::{
    Code, Diagnostics, DisplayPosition, Layout, Member, RunPoints, TextColumn, element_name,
    element_place,
};
use guideway_spline::{Bounds, Point, flatten_run};
use rayon::prelude::*;
use rstar::primitives::{GeomWithData, Rectangle};
use rstar::{AABB, RTree};

use super::report::{ClearanceOptions, ClearanceWork};
use crate::{
    ClosestApproach, ConvexPolygon, EnvelopeSource, ProximityQuery, Sweep, SweepTree, Undecided,
};

type P = Point<f64>;
type Entry = GeomWithData<Rectangle<[f64; 2]>, u32>;

/// Largest distance of wall lines from the curves of the floor plan, in meters.
const FLATNESS_M: f64 = 1e-3;

/// The wall lines of a floor plan, with a spatial index.
#[derive(Clone, Debug)]
pub struct Walls {
    lines: Vec<[P; 2]>,
    /// Path of the floor plan per line.
    paths: Vec<u32>,
    ids: TextColumn,
    index: RTree<Entry>,
}

/// The violation of a path by its closest wall.
struct Violation {
    row: usize,
    line: u32,
    nearest: ClosestApproach,
    /// Number of paths of the floor plan that violate the clearance.
    walls: usize,
}

impl Walls {
    /// Flattens the paths of a floor plan for which `is_wall(row)` holds.
    pub fn new(plan: &Layout, is_wall: impl Fn(usize) -> bool) -> Self {
        let (mut lines, mut paths, mut ids) = (Vec::new(), Vec::new(), TextColumn::default());
        for path in plan.paths.iter() {
            ids.push(path.id());
            if !is_wall(path.row()) {
                continue;
            }
            for run in path.runs() {
                let mut last: Option<P> = None;
                let mut line = |p: P| {
                    lines.extend(last.map(|last| [last, p]));
                    last = Some(p);
                };
                match run {
                    RunPoints::F64(points) => flatten_run(points, FLATNESS_M, &mut line),
                    RunPoints::F32(points) => {
                        let points: Vec<P> = points.iter().map(|p| p.to_f64()).collect();
                        flatten_run(&points, FLATNESS_M, &mut line);
                    }
                }
            }
            paths.resize(lines.len(), path.row() as u32);
        }
        let entry = |(i, line): (usize, &[P; 2])| {
            let [from, to] = line.map(|p| [p.x, p.y]);
            Entry::new(Rectangle::from_corners(from, to), i as u32)
        };
        Self {
            index: RTree::bulk_load(lines.iter().enumerate().map(entry).collect()),
            lines,
            paths,
            ids,
        }
    }

    /// Number of lines.
    pub fn len(&self) -> usize {
        self.lines.len()
    }

    /// Returns `true` if there are no lines.
    pub fn is_empty(&self) -> bool {
        self.lines.is_empty()
    }

    pub(super) fn check(
        &self,
        layout: &Layout,
        source: EnvelopeSource,
        options: &ClearanceOptions,
        found: &mut Diagnostics,
    ) -> ClearanceWork {
        let rows = (0..layout.paths.len()).into_par_iter();
        let of_rows: Vec<_> = rows
            .map(|row| {
                let mut work = ClearanceWork::default();
                let sweep = source.sweep(layout, row).ok();
                let violation = sweep.and_then(|s| {
                    let of_all = (row, layout.paths.len());
                    self.violation(of_all, s, options, &mut work)
                });
                (violation, work)
            })
            .collect();
        let mut work = ClearanceWork::default();
        for (violation, of_row) in of_rows {
            work = work.plus(of_row);
            if let Some(violation) = violation {
                self.report(&violation, layout, found);
            }
        }
        work
    }

    fn violation(
        &self,
        (row, paths): (usize, usize),
        sweep: Sweep,
        options: &ClearanceOptions,
        work: &mut ClearanceWork,
    ) -> Option<Violation> {
        let lines = self.lines_near(&sweep, options.clearance_m + FLATNESS_M);
        work.candidates += lines.len() as u64;
        let question = ProximityQuery {
            threshold_m: options.clearance_m,
            tolerance_m: options.tolerance_m,
            exempt_zones: &[],
            // The pairs of paths have a share of their own.
            max_tests: options.tests_per_path(paths),
        };
        let mut tree = SweepTree::new(sweep);
        let mut best: Option<Violation> = None;
        let mut walls = Vec::new();
        for line in lines {
            let ends = self.lines[line as usize];
            let Some(wall) = Sweep::of_areas(ConvexPolygon::hull(ends), ends[0].distance(ends[1]))
            else {
                continue;
            };
            let mut wall = SweepTree::new(wall);
            work.tests += 1;
            let nearest = match tree.nearest(&mut wall, &question, &mut work.tests) {
                Ok(Some(nearest)) => nearest,
                Ok(None) => continue,
                Err(Undecided) => {
                    work.incomplete = 1;
                    break;
                }
            };
            walls.push(self.paths[line as usize]);
            if best
                .as_ref()
                .is_none_or(|b| nearest.distance_m < b.nearest.distance_m)
            {
                best = Some(Violation {
                    row,
                    line,
                    nearest,
                    walls: 0,
                });
            }
        }
        walls.sort_unstable();
        walls.dedup();
        best.map(|best| Violation {
            walls: walls.len(),
            ..best
        })
    }

    /// The lines whose boxes are within a distance of some part of a sweep, without duplicates.
    fn lines_near(&self, sweep: &Sweep, within_m: f64) -> Vec<u32> {
        let mut lines = Vec::new();
        let coarsely_m = sweep.reach_m();
        sweep.polygons(coarsely_m, None, &mut |polygon| {
            let Bounds { min, max } = polygon.bounds().inflated(within_m);
            let near = AABB::from_corners([min.x, min.y], [max.x, max.y]);
            let found = self.index.locate_in_envelope_intersecting(near);
            lines.extend(found.map(|entry| entry.data));
        });
        lines.sort_unstable();
        lines.dedup();
        lines
    }

    fn report(&self, violation: &Violation, layout: &Layout, found: &mut Diagnostics) {
        let Violation {
            row,
            line,
            nearest,
            walls,
        } = *violation;
        let id = layout.paths.id(row);
        found.push(
            Code::WallClearance,
            || element_place(Member::Path(row as u32), id),
            || {
                let wall = self.paths[line as usize] as usize;
                let wall = element_name("path", wall, self.ids.get(wall));
                let approach = approach(nearest.distance_m);
                let here = DisplayPosition(nearest.positions[0]);
                let others = match walls {
                    1 => String::new(),
                    2 => ", and another line is too close".to_owned(),
                    n => format!(", and {} other lines are too close", n - 1),
                };
                format!("vehicles {approach} {wall} of the floor plan, at {here}{others}")
            },
            "Move the path away from it; if it is not a wall, check against the wall layers of the \
             floor plan only",
        );
    }
}

/// `overlap with`, or the distance of vehicles to something.
pub(super) fn approach(distance_m: f64) -> String {
    if distance_m == 0.0 {
        "overlap with".to_owned()
    } else {
        format!("come within {distance_m:.2} m of")
    }
}
