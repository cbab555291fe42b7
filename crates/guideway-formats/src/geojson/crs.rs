//! Coordinate reference systems: finds the unit that the `crs` of a file stands for, by its code in
//! the EPSG registry.

use guideway_layout::GeoOrigin;

/// Kind of the positions that a coordinate reference system has.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum System {
    /// Angles: longitude and latitude, in units of this many degrees.
    Degrees(f64),
    /// A plane true to scale, in units of this many meters.
    Plane(f64),
    /// Mercator's projection of the whole earth, of a sphere or an ellipsoid with this eccentricity
    /// squared. Its scale grows with latitude.
    Mercator(f64),
    /// A system that the table does not hold.
    Unknown,
}

impl System {
    /// Returns the system of a name such as `EPSG:4258`, `urn:ogc:def:crs:OGC:1.3:CRS84` or
    /// `http://www.opengis.net/def/crs/EPSG/0/3857`; of a compound one, such as `EPSG:4326+5773`,
    /// the horizontal part.
    pub(super) fn of_name(name: &str) -> Self {
        let mut parts = name.split(['+', ',']).map(Self::of_single_name);
        let known = parts.find(|system| *system != Self::Unknown);
        known.unwrap_or(Self::Unknown)
    }

    fn of_single_name(name: &str) -> Self {
        let name = name.trim();
        let last = name.rsplit([':', '/', '#']).next().unwrap_or_default();
        // Longitude and latitude of WGS 84, NAD 83 and NAD 27.
        let is_geographic = ["CRS84", "CRS84h", "CRS83", "CRS27", "WGS84", "WGS 84"];
        if is_geographic
            .iter()
            .any(|geographic| last.eq_ignore_ascii_case(geographic))
        {
            return Self::Degrees(1.0);
        }
        last.parse().map_or(Self::Unknown, Self::of_code)
    }

    /// Returns the system of a code of the EPSG registry, or of the codes that ESRI and Google gave
    /// to Web Mercator.
    pub(super) fn of_code(code: u32) -> Self {
        match code {
            3857 | 3785 | 6871 | 102_100 | 102_113 | 900_913 => return Self::Mercator(0.0),
            3395 => return Self::Mercator(GeoOrigin::ECCENTRICITY_SQUARED),
            _ => {}
        }
        let mut system = Self::Unknown;
        for line in include_str!("epsg_units.txt").lines() {
            match line.strip_prefix("= ") {
                Some("degree") => system = Self::Degrees(1.0),
                // A right angle has 100 grads.
                Some("grad") => system = Self::Degrees(0.9),
                Some(unit) => {
                    let meters = unit
                        .split(' ')
                        .next()
                        .and_then(|factor| factor.parse().ok());
                    system = meters.map_or(Self::Unknown, Self::Plane);
                }
                None if line.starts_with('#') => {}
                None if line.split(' ').any(|range| holds(range, code)) => return system,
                None => {}
            }
        }
        Self::Unknown
    }
}

/// Returns whether a code is in a range such as `32601-32660`.
fn holds(range: &str, code: u32) -> bool {
    let (first, last) = range.split_once('-').unwrap_or((range, range));
    let [first, last] = [first, last].map(str::parse::<u32>);
    first.is_ok_and(|first| first <= code) && last.is_ok_and(|last| code <= last)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_one_system_agree() {
        for name in [
            "EPSG:4258",
            "epsg:4258",
            "urn:ogc:def:crs:EPSG::4258",
            "urn:ogc:def:crs:EPSG:9.8:4258",
            "urn:x-ogc:def:crs:EPSG:4258",
            "http://www.opengis.net/def/crs/EPSG/0/4258",
            "http://www.opengis.net/gml/srs/epsg.xml#4258",
            "urn:ogc:def:crs:OGC:1.3:CRS84",
            "urn:ogc:def:crs:OGC::CRS83",
            "crs84",
            "EPSG:4326+5773",
            "urn:ogc:def:crs,crs:EPSG::4326,crs:EPSG::5773",
        ] {
            assert_eq!(System::of_name(name), System::Degrees(1.0), "{name}");
        }
        for name in [
            "",
            "EPSG:",
            "urn:ogc:def:crs:EPSG::",
            "local",
            "EPSG:-4326",
            "EPSG:999999",
        ] {
            assert_eq!(System::of_name(name), System::Unknown, "{name}");
        }
    }

    #[test]
    fn codes_have_the_units_of_the_registry() {
        // Geographic, of two and three dimensions; WGS 84, NAD 83, DHDN, GDA 2020, JGD 2011.
        for code in [4326, 4979, 4269, 4314, 7844, 6668] {
            assert_eq!(System::of_code(code), System::Degrees(1.0), "{code}");
        }
        assert_eq!(System::of_code(4807), System::Degrees(0.9));
        // UTM, Gauss-Krueger, Swiss and British grids.
        for code in [25832, 32632, 32733, 31468, 2056, 27700] {
            assert_eq!(System::of_code(code), System::Plane(1.0), "{code}");
        }
        // New York by the survey foot, Michigan and Arizona by the international foot.
        for code in [2263, 6543] {
            let System::Plane(foot_m) = System::of_code(code) else {
                panic!("{code} is no plane");
            };
            assert!((foot_m - 1200.0 / 3937.0).abs() < 1e-15, "{code}: {foot_m}");
        }
        assert_eq!(System::of_code(2253), System::Plane(0.3048));
        assert_eq!(System::of_code(2223), System::Plane(0.3048));
        // Geocentric, vertical, equidistant: neither degrees nor a plane true to scale.
        for code in [4978, 5703, 4087, 32662] {
            assert_eq!(System::of_code(code), System::Unknown, "{code}");
        }
    }
}
