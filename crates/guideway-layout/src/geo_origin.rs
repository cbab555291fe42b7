//! [`GeoOrigin`]: the place of a layout on earth, and the plane in meters about it.

use guideway_spline::{Affine, Point};

/// The point on earth where a layout has its origin; x points east, y north (WGS 84).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GeoOrigin {
    /// Longitude in degrees, east positive.
    pub longitude_deg: f64,
    /// Latitude in degrees, north positive.
    pub latitude_deg: f64,
}

impl GeoOrigin {
    /// Half of the longer axis of the WGS 84 ellipsoid, and the radius of the sphere of Web
    /// Mercator, in meters.
    pub const SEMI_MAJOR_M: f64 = 6_378_137.0;
    /// Square of the first eccentricity of the WGS 84 ellipsoid.
    pub const ECCENTRICITY_SQUARED: f64 = 6.694_379_990_141_32e-3;

    /// Returns the meters per degree of longitude and of latitude.
    ///
    /// The scale is that of the WGS 84 ellipsoid, from its radii of curvature: along the meridian a
    /// (1 - e^2) / (1 - e^2 sin^2)^(3/2), across it a / (1 - e^2 sin^2)^(1/2).
    pub fn meters_per_degree(self) -> Point<f64> {
        let (sin, cos) = self.latitude_deg.to_radians().sin_cos();
        let root = (1.0 - Self::ECCENTRICITY_SQUARED * sin * sin).sqrt();
        let meridian_m = Self::SEMI_MAJOR_M * (1.0 - Self::ECCENTRICITY_SQUARED) / root.powi(3);
        let across_m = Self::SEMI_MAJOR_M / root;
        Point::new(across_m * cos, meridian_m) * 1_f64.to_radians()
    }

    /// Returns the map of positions in meters about this origin to longitude and latitude, in
    /// degrees. The longitude exceeds 180 beyond the antimeridian, so that lines stay connected.
    pub fn to_degrees(self) -> impl Fn(Point<f64>) -> Point<f64> {
        let center = Point::new(self.longitude_deg, self.latitude_deg);
        let scale = self.meters_per_degree();
        move |at_m| center + Point::new(at_m.x / scale.x, at_m.y / scale.y)
    }

    /// Returns the map of meters about this origin to meters about another one, which keeps every
    /// place on earth. Of the two ways around the earth it takes the shorter one.
    pub fn to_origin(self, other: Self) -> Affine {
        let east_deg = self.longitude_deg - other.longitude_deg;
        let east_deg = east_deg - 360.0 * (east_deg / 360.0).round();
        let north_deg = self.latitude_deg - other.latitude_deg;
        let [from, to] = [self, other].map(Self::meters_per_degree);
        let about = Point::new(0.0, 0.0);
        let offset = Point::new(east_deg * to.x, north_deg * to.y);
        Affine::scale(to.x / from.x, to.y / from.y, about).then(Affine::translation(offset))
    }
}
