//! [`AnalyzeOptions`]: thresholds of the findings about a network.

use guideway_layout::Limits;

/// Thresholds of [`analyze`](super::analyze).
#[derive(Clone, Debug, PartialEq)]
pub struct AnalyzeOptions {
    /// Largest jump of heading from path to path that needs no rotation.
    pub turn_angle_rad: f64,
    /// Largest lateral acceleration in m/s²; `None` skips the comparison of speeds and bends.
    pub lateral_acceleration_m_s2: Option<f64>,
    /// Findings stored per code and severity; further ones only count.
    pub diagnostics_per_code: usize,
}

impl Default for AnalyzeOptions {
    fn default() -> Self {
        Self {
            turn_angle_rad: 5f64.to_radians(),
            lateral_acceleration_m_s2: None,
            diagnostics_per_code: Limits::default().diagnostics_per_code,
        }
    }
}
