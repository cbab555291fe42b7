//! Options and results of a clearance check.

use guideway_layout::{CheckOptions, Diagnostics, Limits};

use crate::no_envelope::NoEnvelope;

/// Options of a clearance check.
#[derive(Clone, Debug, PartialEq)]
pub struct ClearanceOptions {
    /// Smallest allowed distance of vehicles on different paths, and of a vehicle from a wall, in
    /// meters. 0 finds overlaps only.
    pub clearance_m: f64,
    /// Precision of distances, in meters. The check finds everything closer than the clearance, and
    /// nothing farther than the clearance plus this.
    pub tolerance_m: f64,
    /// Distance from the common end of two paths within which vehicles on both may be near each
    /// other, in meters. `None` is six times the reach of the vehicle from its reference point.
    pub near_joint_m: Option<f64>,
    /// Ends of paths within this distance are joined, in meters.
    pub gap_tolerance_m: f64,
    /// Paths whose curves are within this distance are one road, in meters.
    pub coincidence_tolerance_m: f64,
    /// Polygon distances that are computed at most. Each path has an equal share, but not less than
    /// `least_tests_per_path`.
    pub most_tests: u64,
    /// Least share of a path.
    pub least_tests_per_path: u64,
    /// Findings stored per code; the rest are only counted.
    pub diagnostics_per_code: usize,
}

impl Default for ClearanceOptions {
    fn default() -> Self {
        Self {
            clearance_m: 0.0,
            tolerance_m: 0.01,
            near_joint_m: None,
            gap_tolerance_m: CheckOptions::LARGEST_GAP_M,
            coincidence_tolerance_m: CheckOptions::LARGEST_COINCIDENCE_M,
            // Measured: 1.5 us each on a core of 2 GHz.
            most_tests: 5_000_000,
            // Measured: 60 to 140 on average over the paths of real sites and of D1.
            least_tests_per_path: 3_000,
            diagnostics_per_code: Limits::default().diagnostics_per_code,
        }
    }
}

/// The result of a clearance check.
#[derive(Clone, Debug)]
pub struct ClearanceReport {
    /// A finding per pair of paths, and per path that is too close to walls.
    pub findings: Diagnostics,
    /// The work of the check.
    pub work: ClearanceWork,
}

/// The work of a clearance check, in numbers that do not depend on the machine.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ClearanceWork {
    /// Paths with an envelope.
    pub paths: u64,
    /// Paths without an envelope, per reason of [`NoEnvelope::ALL`].
    pub no_envelope: [u64; NoEnvelope::ALL.len()],
    /// Paths whose envelope is in doubt: their orientation is probably in degrees.
    pub doubtful: u64,
    /// Pairs of paths, or of a path and a wall line, whose boxes are close enough.
    pub candidates: u64,
    /// Computed distances of two convex polygons.
    pub tests: u64,
    /// Paths that were compared with a part of what is near them only, because their share of the
    /// distances was used up.
    pub incomplete: u64,
}

impl ClearanceOptions {
    /// The polygon distances that one of `paths` paths may take.
    pub(super) fn tests_per_path(&self, paths: usize) -> u64 {
        (self.most_tests / (paths as u64).max(1)).max(self.least_tests_per_path)
    }
}

impl ClearanceWork {
    pub(super) fn plus(self, other: Self) -> Self {
        Self {
            paths: self.paths + other.paths,
            no_envelope: std::array::from_fn(|i| self.no_envelope[i] + other.no_envelope[i]),
            doubtful: self.doubtful + other.doubtful,
            candidates: self.candidates + other.candidates,
            tests: self.tests + other.tests,
            incomplete: self.incomplete + other.incomplete,
        }
    }
}
