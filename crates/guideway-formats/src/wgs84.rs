//! Map projection: converts longitude and latitude (WGS 84, degrees) to meters on a local plane.

use guideway_spline::{Bounds, Point};

/// Equirectangular projection about a center, which maps to the origin. It is true to scale near
/// the center only, which suffices for a site.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct LocalProjection {
    center: Point<f64>,
    meters_per_degree: Point<f64>,
}

impl LocalProjection {
    /// Makes the projection about the center of a box of degrees.
    ///
    /// The scale is that of the WGS 84 ellipsoid at the center, from its radii of curvature: along
    /// the meridian a (1 - e^2) / (1 - e^2 sin^2)^(3/2), across it a / (1 - e^2 sin^2)^(1/2).
    pub(crate) fn centered_on(bounds: Bounds<f64>) -> Self {
        const SEMI_MAJOR_M: f64 = 6_378_137.0;
        const ECCENTRICITY_SQUARED: f64 = 6.694_379_990_141_32e-3;
        let center = bounds.min.lerp(bounds.max, 0.5);
        let (sin, cos) = center.y.to_radians().sin_cos();
        let root = (1.0 - ECCENTRICITY_SQUARED * sin * sin).sqrt();
        let meridian_m = SEMI_MAJOR_M * (1.0 - ECCENTRICITY_SQUARED) / root.powi(3);
        let across_m = SEMI_MAJOR_M / root;
        Self {
            center,
            meters_per_degree: Point::new(across_m * cos, meridian_m) * 1_f64.to_radians(),
        }
    }

    /// Projects longitude and latitude (degrees) to meters.
    pub(crate) fn to_meters(self, position: Point<f64>) -> Point<f64> {
        let offset = position - self.center;
        let scale = self.meters_per_degree;
        Point::new(offset.x * scale.x, offset.y * scale.y)
    }
}

/// Returns whether a position is in the range of longitude and latitude.
pub(crate) fn is_lon_lat(position: Point<f64>) -> bool {
    position.x.abs() <= 180.0 && position.y.abs() <= 90.0
}
