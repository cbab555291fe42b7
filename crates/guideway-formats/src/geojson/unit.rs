//! In what unit the positions are: degrees, as the standard says, or metres, as people write.

use guideway_layout::{Code, Place};
use guideway_spline::{Bounds, Point};

use crate::builder::Builder;

/// How the positions of a file become metres.
pub(super) enum Unit {
    Metres,
    /// Longitude and latitude. Only their neighbourhood is true to scale, which a layout does not leave.
    Degrees {
        /// The middle of all positions, which becomes the origin.
        middle: Point<f64>,
        metres_per_degree: Point<f64>,
    },
}

impl Unit {
    /// The unit of a file that names a coordinate reference system or does not, by the box of its positions.
    pub(super) fn of(
        builder: &mut Builder<'_>,
        crs: Option<&str>,
        bounds: Option<Bounds<f64>>,
    ) -> Self {
        let Some(bounds) = bounds else {
            return Self::Metres;
        };
        let x = bounds.min.x.abs().max(bounds.max.x.abs());
        let y = bounds.min.y.abs().max(bounds.max.y.abs());
        let can_be_degrees = x <= 180.0 && y <= 90.0;
        let named_degrees = crs.map(|name| name.ends_with("CRS84") || name.ends_with(":4326"));
        let (message, unit) = match (named_degrees, can_be_degrees) {
            (Some(true), true) => return Self::degrees(bounds),
            (Some(false), _) => return Self::Metres,
            (Some(true), false) => (
                "the file says that positions are in degrees, but some are beyond 180 or 90: they \
                 are read as metres",
                Self::Metres,
            ),
            (None, true) => (
                "the file names no `crs`, and all positions are within 180 and 90: they are read \
                 as degrees",
                Self::degrees(bounds),
            ),
            (None, false) => (
                "the file names no `crs`, and some positions are beyond 180 or 90: they are read as \
                 metres",
                Self::Metres,
            ),
        };
        let at = || Place::element("the root");
        let remedy = "If that is wrong, add a `crs`: any but CRS84 and EPSG:4326 stands for metres";
        builder.find(Code::AssumedUnit, &at, || message.to_owned(), remedy);
        unit
    }

    /// Metres a degree at the middle, on the ellipsoid of WGS 84: the radii of curvature along the
    /// meridian, a (1 - e^2) / (1 - e^2 sin^2)^(3/2), and across it, a / (1 - e^2 sin^2)^(1/2).
    fn degrees(bounds: Bounds<f64>) -> Self {
        const SEMI_MAJOR_M: f64 = 6_378_137.0;
        const ECCENTRICITY_SQUARED: f64 = 6.694_379_990_141_32e-3;
        let middle = bounds.min.lerp(bounds.max, 0.5);
        let (sin, cos) = middle.y.to_radians().sin_cos();
        let root = (1.0 - ECCENTRICITY_SQUARED * sin * sin).sqrt();
        let meridian_m = SEMI_MAJOR_M * (1.0 - ECCENTRICITY_SQUARED) / root.powi(3);
        let across_m = SEMI_MAJOR_M / root;
        Self::Degrees {
            middle,
            metres_per_degree: Point::new(across_m * cos, meridian_m) * 1_f64.to_radians(),
        }
    }

    pub(super) fn to_metres(&self, position: Point<f64>) -> Point<f64> {
        match self {
            Self::Metres => position,
            Self::Degrees {
                middle,
                metres_per_degree: scale,
            } => {
                let offset = position - *middle;
                Point::new(offset.x * scale.x, offset.y * scale.y)
            }
        }
    }
}
