//! GeoJSON unit: decides whether positions are degrees, as the standard requires, or meters, as
//! many applications write.

use guideway_layout::{Code, GeoOrigin, Place};
use guideway_spline::{Bounds, Point};

use crate::builder::Builder;
use crate::wgs84::LocalProjection;

/// Unit of the positions of a file.
pub(super) enum Unit {
    Meters,
    /// Longitude and latitude.
    Degrees(LocalProjection),
}

/// Returns whether the name of a coordinate reference system stands for degrees.
pub(super) fn is_degrees(crs: &str) -> bool {
    crs.ends_with("CRS84") || crs.ends_with(":4326")
}

impl Unit {
    /// Detects the unit from the coordinate reference system, if the file names one, and from the
    /// bounding box of its positions. Reports an assumption.
    pub(super) fn detect<I: Iterator<Item = Point<f64>>>(
        builder: &mut Builder<'_>,
        crs: Option<&str>,
        positions: impl Fn() -> I,
    ) -> Self {
        let Some(bounds) = Bounds::of_points(positions()) else {
            return Self::Meters;
        };
        let x = bounds.min.x.abs().max(bounds.max.x.abs());
        let y = bounds.min.y.abs().max(bounds.max.y.abs());
        let can_be_degrees = x <= 180.0 && y <= 90.0;
        let degrees = || {
            Self::Degrees(LocalProjection::centered_on(shorter_way(
                bounds,
                positions(),
            )))
        };
        let (message, unit) = match (crs.map(is_degrees), can_be_degrees) {
            (Some(true), true) => return degrees(),
            (Some(false), _) => return Self::Meters,
            (Some(true), false) => (
                "the `crs` states degrees, but some positions are beyond 180 or 90: they are read \
                 as meters",
                Self::Meters,
            ),
            (None, true) => (
                "the file names no `crs`, and all positions are within 180 and 90: they are read \
                 as degrees",
                degrees(),
            ),
            (None, false) => (
                "the file names no `crs`, and some positions are beyond 180 or 90: they are read \
                 as meters",
                Self::Meters,
            ),
        };
        let at = || Place::element("the root");
        let remedy =
            "If this is wrong, add a `crs`: CRS84 or EPSG:4326 for degrees, any other for meters";
        builder.report(Code::AssumedUnit, &at, || message.to_owned(), remedy);
        unit
    }

    /// Converts a position to meters.
    pub(super) fn to_meters(&self, position: Point<f64>) -> Point<f64> {
        match self {
            Self::Meters => position,
            Self::Degrees(degrees) => degrees.to_meters(position),
        }
    }

    /// Returns the place on earth of the origin, for degrees.
    pub(super) fn origin(&self) -> Option<GeoOrigin> {
        match self {
            Self::Meters => None,
            Self::Degrees(degrees) => Some(degrees.origin()),
        }
    }
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
