use guideway_layout::{
    Code, Diagnostics, DisplayPosition, Layout, element_name, element_place, same_curves,
};
use guideway_spline::Bounds;
use rayon::prelude::*;
use rstar::primitives::{GeomWithData, Rectangle};
use rstar::{AABB, RTree};

use super::joints::Joints;
use super::{ClearanceOptions, ClearanceWork};
use crate::{Nearest, Question, Source, Tree};

type Entry = GeomWithData<Rectangle<[f64; 2]>, u32>;

/// Two paths that are too near to each other.
struct TooNear {
    paths: [usize; 2],
    nearest: Nearest,
}

/// Paths that are too near to each other.
pub(super) fn check(
    layout: &Layout,
    source: Source,
    options: &ClearanceOptions,
    found: &mut Diagnostics,
) -> ClearanceWork {
    let paths = Paths::new(layout, source, options);
    let rows = (0..layout.paths.len()).into_par_iter();
    let of_rows: Vec<_> = rows.map(|row| paths.too_near(row)).collect();
    let mut work = ClearanceWork::default();
    for (too_near, of_row) in of_rows {
        work = work.plus(of_row);
        too_near.iter().for_each(|pair| pair.report(layout, found));
    }
    work
}

/// All paths, made ready to find those that are near.
struct Paths<'a> {
    layout: &'a Layout,
    source: Source,
    options: &'a ClearanceOptions,
    boxes: Vec<Option<(Bounds<f64>, f64)>>,
    index: RTree<Entry>,
    joints: Joints,
    curves: Vec<u32>,
}

impl<'a> Paths<'a> {
    fn new(layout: &'a Layout, source: Source, options: &'a ClearanceOptions) -> Self {
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

    /// The paths behind a row that are too near to it.
    fn too_near(&self, row: usize) -> (Vec<TooNear>, ClearanceWork) {
        let mut work = ClearanceWork::default();
        let sweep = match self.source.sweep(self.layout, row) {
            Ok(sweep) => sweep,
            Err(why) => {
                work.without[why as usize] = 1;
                return (Vec::new(), work);
            }
        };
        let (bounds, reach_m) = (sweep.bounds(), sweep.reach_m());
        work.paths = 1;
        let others = self.others(row, bounds);
        work.candidates = others.len() as u64;
        let reaches_m = others.iter().filter_map(|&other| self.boxes[other]);
        let most_m = reaches_m.map(|(_, other_m)| other_m).fold(0.0, f64::max);
        let reached = self.joints.reached(row, self.way_m(reach_m, most_m));
        let mut tree = Tree::new(sweep);
        let mut too_near = Vec::new();
        for other in others {
            let (Some((_, other_m)), Ok(other_sweep)) =
                (self.boxes[other], self.source.sweep(self.layout, other))
            else {
                continue;
            };
            let near_joint_m = self.options.near_joint_m;
            let meetings = self.joints.meetings(
                &reached,
                other,
                near_joint_m.unwrap_or(REACHES_NEAR_JOINT * reach_m.max(other_m)),
                self.way_m(reach_m, other_m),
            );
            let question = Question {
                below_m: self.options.clearance_m,
                tolerance_m: self.options.tolerance_m,
                meetings: &meetings,
            };
            let mut other_tree = Tree::new(other_sweep);
            let nearest = tree.nearest(&mut other_tree, &question, &mut work.tests);
            too_near.extend(nearest.map(|nearest| TooNear {
                paths: [row, other],
                nearest,
            }));
        }
        (too_near, work)
    }

    /// The longest way between two vehicles that are too near to each other.
    fn way_m(&self, reach_m: f64, other_m: f64) -> f64 {
        reach_m + other_m + self.options.clearance_m
    }

    /// Paths behind a row that may be too near to it, by rising row.
    fn others(&self, row: usize, bounds: Bounds<f64>) -> Vec<usize> {
        let Bounds { min, max } = bounds.inflated(self.options.clearance_m);
        let near = AABB::from_corners([min.x, min.y], [max.x, max.y]);
        let level = |row| self.layout.paths.get(row).level();
        let is_apart = |a: Option<u32>, b: Option<u32>| a.is_some() && b.is_some() && a != b;
        let near = self.index.locate_in_envelope_intersecting(near);
        let others = near.map(|entry| entry.data as usize).filter(|&other| {
            other > row
                && !is_apart(level(row), level(other))
                && self.curves[row] != self.curves[other]
        });
        let mut others: Vec<usize> = others.collect();
        others.sort_unstable();
        others
    }
}

/// Unless said otherwise, how many times the reach of a vehicle is near a joint: about three lengths of a vehicle,
/// within which lanes of usual bends have come apart.
const REACHES_NEAR_JOINT: f64 = 6.0;

impl TooNear {
    fn report(&self, layout: &Layout, found: &mut Diagnostics) {
        let ([row, other], nearest) = (self.paths, self.nearest);
        let id = |row| layout.paths.id(row);
        found.push(
            Code::Clearance,
            || element_place("path", row, id(row)),
            || {
                let other = element_name("path", other, id(other));
                let how = how_near(nearest.distance_m);
                let [here, there] = nearest.places.map(DisplayPosition);
                format!("vehicles {how} those on {other}, while they are at {here} here and at {there} there")
            },
            "Move the paths apart, or never let vehicles be on both at a time",
        );
    }
}

/// `overlap with`, or how near they come.
pub(super) fn how_near(distance_m: f64) -> String {
    if distance_m == 0.0 {
        "overlap with".to_owned()
    } else {
        format!("come within {distance_m:.2} m of")
    }
}
