//! GeoJSON unit: decides whether positions are degrees, as the standard requires, or meters, as
//! many applications write.

use guideway_layout::{Code, Place};
use guideway_spline::{Bounds, Point};

use crate::builder::Builder;
use crate::wgs84::LocalProjection;

/// Unit of the positions of a file.
pub(super) enum Unit {
    Meters,
    /// Longitude and latitude.
    Degrees(LocalProjection),
}

impl Unit {
    /// Detects the unit from the coordinate reference system, if the file names one, and from the
    /// bounding box of its positions. Reports an assumption.
    pub(super) fn detect(
        builder: &mut Builder<'_>,
        crs: Option<&str>,
        bounds: Option<Bounds<f64>>,
    ) -> Self {
        let Some(bounds) = bounds else {
            return Self::Meters;
        };
        let x = bounds.min.x.abs().max(bounds.max.x.abs());
        let y = bounds.min.y.abs().max(bounds.max.y.abs());
        let can_be_degrees = x <= 180.0 && y <= 90.0;
        let named_degrees = crs.map(|name| name.ends_with("CRS84") || name.ends_with(":4326"));
        let (message, unit) = match (named_degrees, can_be_degrees) {
            (Some(true), true) => return Self::Degrees(LocalProjection::centered_on(bounds)),
            (Some(false), _) => return Self::Meters,
            (Some(true), false) => (
                "the `crs` states degrees, but some positions are beyond 180 or 90: they are read \
                 as meters",
                Self::Meters,
            ),
            (None, true) => (
                "the file names no `crs`, and all positions are within 180 and 90: they are read \
                 as degrees",
                Self::Degrees(LocalProjection::centered_on(bounds)),
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
}
