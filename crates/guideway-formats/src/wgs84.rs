//! Longitude and latitude as meters on a plane.

use guideway_spline::{Bounds, Point};

/// Longitude and latitude in degrees about a middle, which becomes the origin. Only its neighborhood is
/// true to scale, which a layout does not leave.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct LocalProjection {
    middle: Point<f64>,
    meters_per_degree: Point<f64>,
}

impl LocalProjection {
    /// About the middle of a box.
    ///
    /// Meters a degree are those at the middle, on the ellipsoid of WGS 84: the radii of curvature along the
    /// meridian, a (1 - e^2) / (1 - e^2 sin^2)^(3/2), and across it, a / (1 - e^2 sin^2)^(1/2).
    pub(crate) fn centered_on(bounds: Bounds<f64>) -> Self {
        const SEMI_MAJOR_M: f64 = 6_378_137.0;
        const ECCENTRICITY_SQUARED: f64 = 6.694_379_990_141_32e-3;
        let middle = bounds.min.lerp(bounds.max, 0.5);
        let (sin, cos) = middle.y.to_radians().sin_cos();
        let root = (1.0 - ECCENTRICITY_SQUARED * sin * sin).sqrt();
        let meridian_m = SEMI_MAJOR_M * (1.0 - ECCENTRICITY_SQUARED) / root.powi(3);
        let across_m = SEMI_MAJOR_M / root;
        Self {
            middle,
            meters_per_degree: Point::new(across_m * cos, meridian_m) * 1_f64.to_radians(),
        }
    }

    pub(crate) fn to_meters(self, position: Point<f64>) -> Point<f64> {
        let offset = position - self.middle;
        let scale = self.meters_per_degree;
        Point::new(offset.x * scale.x, offset.y * scale.y)
    }
}

/// Whether a position can be longitude and latitude.
pub(crate) fn is_lon_lat(position: Point<f64>) -> bool {
    position.x.abs() <= 180.0 && position.y.abs() <= 90.0
}
