//! Map projection: converts longitude and latitude (WGS 84, degrees) to meters on a local plane,
//! and back.

use guideway_layout::GeoOrigin;
use guideway_spline::{Bounds, Point};

/// Equirectangular projection about a center, which maps to the origin. It is true to scale near
/// the center only, which suffices for a site.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct LocalProjection {
    center: Point<f64>,
    meters_per_degree: Point<f64>,
}

impl LocalProjection {
    /// Makes the projection about the center of positions in degrees; `None` without any. If the
    /// antimeridian splits them, the center is that of the shorter way around the earth.
    pub(crate) fn centered_on<I: Iterator<Item = Point<f64>>>(
        positions: impl Fn() -> I,
    ) -> Option<Self> {
        let bounds = Bounds::of_points(positions())?;
        let center = shorter_way(bounds, positions()).center();
        Some(Self::about(GeoOrigin {
            longitude_deg: center.x,
            latitude_deg: center.y,
        }))
    }

    /// Makes the projection about a point on earth.
    pub(crate) fn about(center: GeoOrigin) -> Self {
        Self {
            center: Point::new(wrapped(center.longitude_deg), center.latitude_deg),
            meters_per_degree: center.meters_per_degree(),
        }
    }

    /// Returns the point on earth that maps to the origin.
    pub(crate) fn origin(self) -> GeoOrigin {
        GeoOrigin {
            longitude_deg: self.center.x,
            latitude_deg: self.center.y,
        }
    }

    /// Projects longitude and latitude (degrees) to meters. Of the two ways around the earth it
    /// takes the shorter one, so a site may lie on the antimeridian.
    pub(crate) fn to_meters(self, position: Point<f64>) -> Point<f64> {
        let offset = position - self.center;
        let scale = self.meters_per_degree;
        Point::new(wrapped(offset.x) * scale.x, offset.y * scale.y)
    }

    /// Returns the longitude and latitude (degrees) of a position in meters. The longitude exceeds
    /// 180 beyond the antimeridian, so that lines stay connected.
    pub(crate) fn to_degrees(self, position: Point<f64>) -> Point<f64> {
        let scale = self.meters_per_degree;
        self.center + Point::new(position.x / scale.x, position.y / scale.y)
    }
}

/// Returns longitude and latitude (degrees) of a position in Mercator's projection of the whole
/// earth, in meters from latitude and longitude 0.
///
/// The latitude of an ellipsoid is found by iteration; that of a sphere, whose eccentricity is 0,
/// at once. Web Mercator maps the latitudes of the ellipsoid as if it were a sphere.
pub(crate) fn from_mercator(position_m: Point<f64>, eccentricity_squared: f64) -> Point<f64> {
    // Each step shrinks the error by the eccentricity squared: ten reach the last bit.
    const STEPS: usize = 10;
    let eccentricity = eccentricity_squared.sqrt();
    let [longitude, height] = [position_m.x, position_m.y].map(|m| m / GeoOrigin::SEMI_MAJOR_M);
    let mut latitude = height.sinh().atan();
    if eccentricity > 0.0 {
        for _ in 0..STEPS {
            let flattened = eccentricity * (eccentricity * latitude.sin()).atanh();
            latitude = (height + flattened).sinh().atan();
        }
    }
    Point::new(longitude.to_degrees(), latitude.to_degrees())
}

/// Returns the box of positions that are split by the antimeridian around the other side of the
/// earth, if it is narrower there.
fn shorter_way(bounds: Bounds<f64>, positions: impl Iterator<Item = Point<f64>>) -> Bounds<f64> {
    if bounds.size().x <= 180.0 {
        return bounds;
    }
    let east = positions.map(|p| match p.x < 0.0 {
        true => Point::new(p.x + 360.0, p.y),
        false => p,
    });
    let around = Bounds::of_points(east);
    around
        .filter(|around| around.size().x < bounds.size().x)
        .unwrap_or(bounds)
}

/// Returns a longitude in the range from -180 to 180.
pub(crate) fn wrapped(longitude_deg: f64) -> f64 {
    if longitude_deg.abs() <= 180.0 {
        return longitude_deg;
    }
    longitude_deg - 360.0 * (longitude_deg / 360.0).round()
}

/// Returns whether a position is in the range of longitude and latitude.
pub(crate) fn is_lon_lat(position: Point<f64>) -> bool {
    position.x.abs() <= 180.0 && position.y.abs() <= 90.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn degrees_return_from_meters() {
        let origin = GeoOrigin {
            longitude_deg: 11.58,
            latitude_deg: 49.95,
        };
        let local = LocalProjection::about(origin);
        assert_eq!(local.origin(), origin);
        for (x, y) in [(0.0, 0.0), (1234.5, -876.25), (-1e5, 1e5)] {
            let meters = Point::new(x, y);
            assert!(local.to_meters(local.to_degrees(meters)).distance(meters) < 1e-8);
        }
    }

    #[test]
    fn mercator_is_undone() {
        // Values of PROJ for longitude 11, latitude 51: EPSG:3857 and EPSG:3395.
        for (y_m, eccentricity_squared) in [
            (6_621_293.722_740_17, 0.0),
            (6_588_066.570_105_61, 6.694_379_990_141_32e-3),
        ] {
            let position = Point::new(1_224_514.398_726_27, y_m);
            let degrees = from_mercator(position, eccentricity_squared);
            assert!(
                degrees.distance(Point::new(11.0, 51.0)) < 1e-9,
                "{degrees:?}"
            );
        }
    }

    #[test]
    fn the_center_lies_between_positions_that_the_antimeridian_splits() {
        let center = |longitudes: [f64; 2]| {
            let positions = longitudes.map(|x| Point::new(x, -17.0));
            let local = LocalProjection::centered_on(|| positions.into_iter()).unwrap();
            local.origin().longitude_deg
        };
        assert!((center([179.999, -179.997]) + 179.999).abs() < 1e-9);
        assert!((center([-89.0, 90.0]) - 0.5).abs() < 1e-9);
        assert!(LocalProjection::centered_on(std::iter::empty).is_none());
    }

    #[test]
    fn a_site_may_lie_on_the_antimeridian() {
        let origin = GeoOrigin {
            longitude_deg: 180.0,
            latitude_deg: -17.0,
        };
        let local = LocalProjection::about(origin);
        let [west, east] = [179.999, -179.999].map(|x| local.to_meters(Point::new(x, -17.0)));
        assert!((west.x + east.x).abs() < 1e-6, "{west:?} {east:?}");
        assert!(west.distance(east) < 220.0);
    }
}
