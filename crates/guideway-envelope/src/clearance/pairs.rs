//! Clearances between pairs of paths.

use guideway_layout::{
    Code, Diagnostics, DisplayPosition, Layout, Member, element_name, element_place, same_curves,
};
use guideway_spline::Bounds;
use rayon::prelude::*;
use rstar::primitives::{GeomWithData, Rectangle};
use rstar::{AABB, RTree};

use super::joints::Joints;
use super::report::{ClearanceOptions, ClearanceWork};
use super::walls::approach;
use crate::{ClosestApproach, EnvelopeSource, ProximityQuery, SweepTree};

type Entry = GeomWithData<Rectangle<[f64; 2]>, u32>;

/// A pair of paths that violates the clearance.
struct Violation {
    paths: [usize; 2],
    nearest: ClosestApproach,
}

/// Checks all pairs of paths. Adds a finding per violation, and returns the work.
pub(super) fn check(
    layout: &Layout,
    source: EnvelopeSource,
    options: &ClearanceOptions,
    found: &mut Diagnostics,
) -> ClearanceWork {
    let paths = Paths::new(layout, source, options);
    let rows = (0..layout.paths.len()).into_par_iter();
    let of_rows: Vec<_> = rows.map(|row| paths.violations(row)).collect();
    let mut work = ClearanceWork::default();
    for (violations, of_row) in of_rows {
        work = work.plus(of_row);
        violations
            .iter()
            .for_each(|pair| pair.report(layout, found));
    }
    work
}

/// All paths, indexed by the bounds of their envelopes.
struct Paths<'a> {
    layout: &'a Layout,
    source: EnvelopeSource,
    options: &'a ClearanceOptions,
    boxes: Vec<Option<(Bounds<f64>, f64)>>,
    index: RTree<Entry>,
    joints: Joints,
    curves: Vec<u32>,
}

impl<'a> Paths<'a> {
    fn new(layout: &'a Layout, source: EnvelopeSource, options: &'a ClearanceOptions) -> Self {
        let rows = (0..layout.paths.len()).into_par_iter();
        let with_box = |row| {
            let sweep = source.sweep(layout, row).ok()?;
            Some((sweep.bounds(), sweep.reach_m()))
        };
        let boxes: Vec<_> = rows.map(with_box).collect();
        let entries = boxes.iter().enumerate().filter_map(|(row, with_box)| {
            let (bounds, _) = (*with_box)?;
            let (min, max) = (bounds.min, bounds.max);
            let shape = Rectangle::from_corners([min.x, min.y], [max.x, max.y]);
            Some(Entry::new(shape, row as u32))
        });
        Self {
            index: RTree::bulk_load(entries.collect()),
            joints: Joints::new(layout, options.gap_tolerance_m),
            curves: same_curves(&layout.paths, options.coincidence_tolerance_m),
            boxes,
            layout,
            source,
            options,
        }
    }

    /// The violations between a path and all later ones.
    fn violations(&self, row: usize) -> (Vec<Violation>, ClearanceWork) {
        let mut work = ClearanceWork::default();
        let sweep = match self.source.sweep(self.layout, row) {
            Ok(sweep) => sweep,
            Err(reason) => {
                work.no_envelope[reason as usize] = 1;
                return (Vec::new(), work);
            }
        };
        let (bounds, reach_m) = (sweep.bounds(), sweep.reach_m());
        work.paths = 1;
        let (others, is_cut) = self.others(row, bounds);
        work.candidates = others.len() as u64;
        work.incomplete = u64::from(is_cut);
        let max_tests = self.options.tests_per_path(self.layout.paths.len());
        let reaches_m = others.iter().filter_map(|&other| self.boxes[other]);
        let most_m = reaches_m.map(|(_, other_m)| other_m).fold(0.0, f64::max);
        let reached = self.joints.reached(row, self.max_path_m(reach_m, most_m));
        let mut tree = SweepTree::new(sweep);
        let mut violations = Vec::new();
        for other in others {
            let (Some((_, other_m)), Ok(other_sweep)) =
                (self.boxes[other], self.source.sweep(self.layout, other))
            else {
                continue;
            };
            let near_joint_m = self.options.near_joint_m;
            let exempt_zones = self.joints.exempt_zones(
                &reached,
                other,
                near_joint_m.unwrap_or(REACHES_NEAR_JOINT * reach_m.max(other_m)),
                self.max_path_m(reach_m, other_m),
            );
            let question = ProximityQuery {
                threshold_m: self.options.clearance_m,
                tolerance_m: self.options.tolerance_m,
                exempt_zones: &exempt_zones,
                max_tests,
            };
            let mut other_tree = SweepTree::new(other_sweep);
            // A pair whose boxes touch takes time even where no polygons are compared.
            work.tests += 1;
            let Ok(nearest) = tree.nearest(&mut other_tree, &question, &mut work.tests) else {
                work.incomplete = 1;
                break;
            };
            violations.extend(nearest.map(|nearest| Violation {
                paths: [row, other],
                nearest,
            }));
        }
        (violations, work)
    }

    /// Largest path length between the reference points of two vehicles that violate the clearance.
    fn max_path_m(&self, reach_m: f64, other_m: f64) -> f64 {
        reach_m + other_m + self.options.clearance_m
    }

    /// The later paths whose bounds are within the clearance, by ascending row. Also returns `true`
    /// if there may be more.
    fn others(&self, row: usize, bounds: Bounds<f64>) -> (Vec<usize>, bool) {
        let Bounds { min, max } = bounds.inflated(self.options.clearance_m);
        let near = AABB::from_corners([min.x, min.y], [max.x, max.y]);
        let level = |row| self.layout.paths.get(row).level();
        let is_apart = |a: Option<u32>, b: Option<u32>| a.is_some() && b.is_some() && a != b;
        let near = self.index.locate_in_envelope_intersecting(near);
        let mut found = 0;
        let near = near.inspect(|_| found += 1).take(MOST_NEIGHBORS);
        let others = near.map(|entry| entry.data as usize).filter(|&other| {
            other > row
                && !is_apart(level(row), level(other))
                && self.curves[row] != self.curves[other]
        });
        let mut others: Vec<usize> = others.collect();
        others.sort_unstable();
        (others, found == MOST_NEIGHBORS)
    }
}

/// Paths near another one that are looked at.
const MOST_NEIGHBORS: usize = 20_000;

/// Default radius of the exempt zone at a joint, in reaches of the vehicle. Derived: about three
/// vehicle lengths, after which lanes with usual bends have separated.
const REACHES_NEAR_JOINT: f64 = 6.0;

impl Violation {
    fn report(&self, layout: &Layout, found: &mut Diagnostics) {
        let ([row, other], nearest) = (self.paths, self.nearest);
        let id = |row| layout.paths.id(row);
        found.push(
            Code::Clearance,
            || element_place(Member::Path(row as u32), id(row)),
            || {
                let other = element_name("path", other, id(other));
                let approach = approach(nearest.distance_m);
                let [here, there] = nearest.positions.map(DisplayPosition);
                format!(
                    "vehicles {approach} those on {other}, at {here} on this path and at \
                     {there} on the other"
                )
            },
            "Move the paths apart, or do not allow vehicles on both at the same time",
        );
    }
}
