//! [`CheckOptions`]: thresholds of the findings.

use crate::Limits;

/// Thresholds that decide what counts as a finding.
#[derive(Clone, Debug, PartialEq)]
pub struct CheckOptions {
    /// Largest distance between the end of a path and its node, and between consecutive runs of a
    /// path, that is no gap. `None` is [`Self::LARGEST_GAP_M`], and less in a layout of short
    /// paths.
    pub gap_tolerance_m: Option<f64>,
    /// Largest jump of direction that still counts as smooth.
    pub kink_angle_rad: f64,
    /// Two paths have the same curve if no point of one is farther than this from the other. `None`
    /// is [`Self::LARGEST_COINCIDENCE_M`], and less in a layout of short paths.
    pub coincidence_tolerance_m: Option<f64>,
    /// Smallest radius that is allowed; `None` skips the measurement of curvature.
    pub min_radius_m: Option<f64>,
    /// A layout wider or higher than this has a wrong unit, however short its paths are.
    pub largest_extent_m: f64,
    /// A layout narrower and lower than this has a wrong unit, however long its paths are.
    pub smallest_extent_m: f64,
    /// A coordinate beyond this probably has a wrong unit.
    pub largest_coordinate_m: f64,
    /// Findings stored per code and severity; further ones only count.
    pub diagnostics_per_code: usize,
}

impl CheckOptions {
    /// The gap tolerance of a layout of ordinary size.
    pub const LARGEST_GAP_M: f64 = 0.01;
    /// The coincidence tolerance of a layout of ordinary size.
    pub const LARGEST_COINCIDENCE_M: f64 = 0.001;
}

impl Default for CheckOptions {
    fn default() -> Self {
        Self {
            gap_tolerance_m: None,
            kink_angle_rad: 5f64.to_radians(),
            coincidence_tolerance_m: None,
            min_radius_m: None,
            largest_extent_m: 100_000.0,
            smallest_extent_m: 0.01,
            largest_coordinate_m: 1e7,
            diagnostics_per_code: Limits::default().diagnostics_per_code,
        }
    }
}
