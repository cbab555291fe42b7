//! Which paths are too near to each other, or to walls.

mod joints;
mod pairs;
mod walls;

use guideway_layout::{CheckOptions, Diagnostics, Layout, Limits};

pub use walls::Walls;

use crate::{Source, Without};

/// What counts as too near.
#[derive(Clone, Debug, PartialEq)]
pub struct ClearanceOptions {
    /// Least distance of vehicles on different paths, and of a vehicle from a wall. With zero only what overlaps is
    /// found.
    pub clearance_m: f64,
    /// How closely distances are known: nothing nearer than the clearance is missed, and nothing is told that is
    /// not nearer than the clearance and this.
    pub tolerance_m: f64,
    /// Where paths meet, vehicles on both are near each other: no distance counts while both are this near to
    /// the common end. Unless given, six times the reach of the vehicle from its reference point.
    pub near_joint_m: Option<f64>,
    /// Ends of paths that are not farther apart are one.
    pub gap_tolerance_m: f64,
    /// Paths whose curves are not farther apart are one road.
    pub coincidence_tolerance_m: f64,
    /// Findings kept whole for each code; beyond that they are counted.
    pub diagnostics_per_code: usize,
}

impl Default for ClearanceOptions {
    fn default() -> Self {
        let check = CheckOptions::default();
        Self {
            clearance_m: 0.0,
            tolerance_m: 0.01,
            near_joint_m: None,
            gap_tolerance_m: check.gap_tolerance_m,
            coincidence_tolerance_m: check.coincidence_tolerance_m,
            diagnostics_per_code: Limits::default().diagnostics_per_code,
        }
    }
}

/// What was found, and what it took.
#[derive(Clone, Debug)]
pub struct Clearance {
    /// A finding for each two paths, and for each path that is too near to a wall.
    pub found: Diagnostics,
    /// What it took.
    pub work: ClearanceWork,
}

/// What a check took, in numbers that any computer would give.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ClearanceWork {
    /// Paths with an envelope.
    pub paths: u64,
    /// Paths without one, for each of [`Without::ALL`].
    pub without: [u64; Without::ALL.len()],
    /// Pairs of paths, or of a path and a line of a wall, whose boxes are near enough.
    pub candidates: u64,
    /// Distances of two convex polygons.
    pub tests: u64,
}

impl ClearanceWork {
    fn plus(self, other: Self) -> Self {
        Self {
            paths: self.paths + other.paths,
            without: std::array::from_fn(|i| self.without[i] + other.without[i]),
            candidates: self.candidates + other.candidates,
            tests: self.tests + other.tests,
        }
    }
}

/// Looks for paths whose envelopes come nearer to each other, or to walls, than the clearance.
///
/// Paths of different levels are never compared, nor are paths along the same curve: they are one road. Two paths
/// that meet at an end are compared, but not where both are near it; the same holds for paths whose ends are joined
/// by a way so short that vehicles at both ends of it would be too near. What is near in spite of that, a crossing
/// without a node, say, or lanes too close, is found.
pub fn check_clearance(
    layout: &Layout,
    source: Source,
    walls: Option<&Walls>,
    options: &ClearanceOptions,
) -> Clearance {
    let mut found = Diagnostics::with_limit(options.diagnostics_per_code);
    let mut work = pairs::check(layout, source, options, &mut found);
    if let Some(walls) = walls {
        work = work.plus(walls.check(layout, source, options, &mut found));
    }
    Clearance { found, work }
}
