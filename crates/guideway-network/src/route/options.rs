//! [`RouteOptions`]: what is assumed where a layout states no speed.

/// Assumptions of a [`Router`](super::Router).
#[derive(Clone, Debug, PartialEq)]
pub struct RouteOptions {
    /// Speed in m/s on paths without a limit.
    pub speed_m_s: f64,
    /// Rotation speed in rad/s where none is stated.
    pub rotation_speed_rad_s: f64,
    /// Largest lateral acceleration in m/s², which slows vehicles in bends; `None` for no limit.
    pub lateral_acceleration_m_s2: Option<f64>,
    /// Largest jump of heading that takes no time.
    pub turn_angle_rad: f64,
}

impl Default for RouteOptions {
    fn default() -> Self {
        Self {
            speed_m_s: 1.0,
            rotation_speed_rad_s: 0.5,
            lateral_acceleration_m_s2: None,
            turn_angle_rad: 5f64.to_radians(),
        }
    }
}
