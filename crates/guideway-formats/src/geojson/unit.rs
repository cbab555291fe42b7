//! GeoJSON unit: finds the unit of the positions of a file by its coordinate reference system, or
//! by their range, because many applications state none.

use guideway_layout::{Code, GeoOrigin, Place};
use guideway_spline::{Bounds, Point};

use super::crs::System;
use crate::builder::Builder;
use crate::wgs84::{LocalProjection, from_mercator, is_lon_lat, wrapped};

/// Largest distance from the origin of Mercator's projection, which lies in the sea, at which
/// positions are taken for those of a local plane: applications without a system of their own write
/// the code of Web Mercator.
const LOCAL_PLANE_M: f64 = 10_000.0;

/// Largest longitude where a file states degrees. Some applications count from 0 to 360 or go on
/// beyond 180, so that lines across the antimeridian stay connected; others do both.
const WIDEST_DEG: f64 = 540.0;

/// Largest distance from the center of a site, up to which longitudes beyond 180 are taken for
/// degrees: others are meters under a wrong system.
const SITE_M: f64 = 100_000.0;

/// Unit of the positions of a file.
pub(super) enum Unit {
    Meters,
    /// A plane in units of this many meters.
    Plane(f64),
    /// Longitude and latitude.
    Degrees(LocalProjection),
    /// Longitude and latitude of a system.
    Earth(System, LocalProjection),
}

/// Statements of a file about its positions.
pub(super) struct Statement<'a> {
    /// The `crs`, if the file has one.
    pub(super) crs: Option<&'a str>,
    /// True for a file that a writer of plane meters wrote, whatever its `crs`.
    pub(super) is_plane: bool,
}

impl Unit {
    /// Detects the unit from the coordinate reference system, if the file names one, and from the
    /// bounding box of its positions. Reports an assumption.
    pub(super) fn detect<I: Iterator<Item = Point<f64>>>(
        builder: &mut Builder<'_>,
        statement: &Statement<'_>,
        positions: impl Fn() -> I,
    ) -> Self {
        let Some(bounds) = Bounds::of_points(positions().filter(|p| p.is_finite())) else {
            return Self::Meters;
        };
        let system = statement.crs.map(System::of_name);
        let on_earth = |system: System, most_deg: f64| {
            let degrees = |p: Point<f64>| {
                let p = to_degrees(system, p).filter(|p| p.x.abs() <= most_deg)?;
                let p = Point::new(wrapped(p.x), p.y);
                is_lon_lat(p).then_some(p)
            };
            let corners = [bounds.min, bounds.max];
            if !corners.iter().all(|&corner| degrees(corner).is_some()) {
                return None;
            }
            let projection = LocalProjection::centered_on(|| positions().filter_map(degrees))?;
            let is_beyond = |corner| to_degrees(system, corner).is_some_and(|p| p.x.abs() > 180.0);
            let is_near = |p| projection.to_meters(p).norm() <= SITE_M;
            let is_site = || positions().filter_map(degrees).all(is_near);
            (!corners.into_iter().any(is_beyond) || is_site()).then_some(projection)
        };
        let far = bounds.min.x.abs().max(bounds.max.x.abs());
        let far = far.max(bounds.min.y.abs()).max(bounds.max.y.abs());
        let (message, unit) = match system {
            Some(System::Mercator(_)) if statement.is_plane => return Self::Meters,
            Some(System::Mercator(_)) if far <= LOCAL_PLANE_M => (
                "the `crs` is a map of the earth, but all positions are near its origin in the \
                 sea: they are read as meters of a local plane"
                    .to_owned(),
                Self::Meters,
            ),
            Some(system @ (System::Degrees(_) | System::Mercator(_))) => match on_earth(
                system, WIDEST_DEG,
            ) {
                Some(projection) => return Self::Earth(system, projection),
                None => (
                    "some positions are outside the range of the `crs`: they are read as meters"
                        .to_owned(),
                    Self::Meters,
                ),
            },
            Some(System::Plane(1.0)) => return Self::Meters,
            Some(System::Plane(meters)) => return Self::Plane(meters),
            Some(System::Unknown) => {
                let name = statement.crs.unwrap_or_default();
                (
                    format!("the `crs` `{name}` is not known: positions are read as meters"),
                    Self::Meters,
                )
            }
            None => match on_earth(System::Degrees(1.0), 180.0) {
                Some(projection) => (
                    "the file names no `crs`, and all positions are within 180 and 90: they are \
                     read as degrees"
                        .to_owned(),
                    Self::Degrees(projection),
                ),
                None => (
                    "the file names no `crs`, and some positions are beyond 180 or 90: they are \
                     read as meters"
                        .to_owned(),
                    Self::Meters,
                ),
            },
        };
        let at = || Place::element("the root");
        let remedy = "If this is wrong, add a `crs`: CRS84 for degrees, the code of the EPSG \
                      registry of a system such as UTM for meters or feet";
        builder.report(Code::AssumedUnit, &at, || message, remedy);
        unit
    }

    /// Converts a position to meters.
    pub(super) fn to_meters(&self, position: Point<f64>) -> Point<f64> {
        match self {
            Self::Meters => position,
            Self::Plane(meters) => position * *meters,
            Self::Degrees(projection) => projection.to_meters(position),
            Self::Earth(system, projection) => {
                let degrees = to_degrees(*system, position);
                degrees.map_or(position, |degrees| projection.to_meters(degrees))
            }
        }
    }

    /// Returns the place on earth of the origin, for positions on earth.
    pub(super) fn origin(&self) -> Option<GeoOrigin> {
        match self {
            Self::Meters | Self::Plane(_) => None,
            Self::Degrees(projection) | Self::Earth(_, projection) => Some(projection.origin()),
        }
    }
}

/// Returns longitude and latitude in degrees of a position on earth.
fn to_degrees(system: System, position: Point<f64>) -> Option<Point<f64>> {
    match system {
        System::Degrees(degrees) => Some(position * degrees),
        System::Mercator(eccentricity_squared) => {
            Some(from_mercator(position, eccentricity_squared))
        }
        System::Plane(_) | System::Unknown => None,
    }
}
