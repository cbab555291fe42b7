//! Computes a frame per level: the map from file positions to meters with y up. Fiducials align the
//! levels of a building.
//!
//! Source: `building.py`, `level.py` and `transform.py` of
//! [`rmf_building_map_tools`](https://github.com/open-rmf/rmf_traffic_editor).

use guideway_layout::{Code, GeoOrigin, Place};
use guideway_spline::{Affine, Bounds, Point};

use super::level::Level;
use crate::builder::{Builder, PlaceFn};
use crate::wgs84::{LocalProjection, from_mercator, is_lon_lat};

/// Meters per pixel without a measurement: the initial scale of the editor.
const DEFAULT_SCALE: f64 = 0.05;

/// The coordinate system of a file.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Coordinates {
    /// Pixels of a floor plan, y down.
    Image,
    /// Meters, y up.
    Meters,
    /// Longitude and latitude.
    Degrees,
    /// Meters of web Mercator, whose scale grows with the latitude.
    Mercator,
}

/// The map from the positions of one level to meters.
#[derive(Clone, Copy, Debug)]
pub(super) enum Frame {
    Plane(Affine),
    Degrees(LocalProjection),
}

impl Frame {
    /// Maps a position to meters, y up.
    pub(super) fn to_meters(self, position: Point<f64>) -> Point<f64> {
        match self {
            Self::Plane(affine) => affine.apply(position),
            Self::Degrees(degrees) => degrees.to_meters(position),
        }
    }
}

/// The frame of every level. The others are aligned to the level `reference`.
pub(super) fn frames(
    builder: &mut Builder<'_>,
    coordinates: Coordinates,
    levels: &[Level<'_>],
    reference: usize,
) -> Vec<Frame> {
    let positions = levels.iter().flat_map(|level| &level.positions).flatten();
    let same = match coordinates {
        Coordinates::Image => return image_frames(builder, levels, reference),
        Coordinates::Meters => Frame::Plane(Affine::IDENTITY),
        Coordinates::Degrees => {
            let sound = || positions.clone().copied().filter(|&p| is_lon_lat(p));
            let projection = LocalProjection::centered_on(sound);
            projection.map_or(Frame::Plane(Affine::IDENTITY), |projection| {
                builder.layout.geo_origin = Some(projection.origin());
                Frame::Degrees(projection)
            })
        }
        Coordinates::Mercator => {
            let bounds = Bounds::of_points(positions.copied().filter(|p| p.is_finite()));
            let middle = bounds.map_or(Point::new(0.0, 0.0), |b| b.center());
            // A meter at the latitude p has the length 1 / cos p = cosh(y / R) in the projection.
            let scale = 1.0 / (middle.y / GeoOrigin::SEMI_MAJOR_M).cosh();
            builder.layout.geo_origin = bounds.and_then(|_| mercator_origin(middle));
            let to_origin = Affine::translation(-middle);
            Frame::Plane(to_origin.then(Affine::scale(scale, scale, Point::new(0.0, 0.0))))
        }
    };
    vec![same; levels.len()]
}

/// The place on earth of a position in web Mercator, if it is on earth.
fn mercator_origin(position: Point<f64>) -> Option<GeoOrigin> {
    let degrees = from_mercator(position, 0.0);
    is_lon_lat(degrees).then_some(GeoOrigin {
        longitude_deg: degrees.x,
        latitude_deg: degrees.y,
    })
}

fn image_frames(builder: &mut Builder<'_>, levels: &[Level<'_>], reference: usize) -> Vec<Frame> {
    let Some(reference_level) = levels.get(reference) else {
        return Vec::new();
    };
    let reference_scale = measured_scale(builder, reference_level).unwrap_or_else(|| {
        if reference_level.positions.is_empty() {
            return DEFAULT_SCALE;
        }
        let message = || {
            format!(
                "the level has no measurement; a pixel of the floor plan is read as \
                 {DEFAULT_SCALE} m"
            )
        };
        let remedy = "Measure a distance in the editor; all lengths depend on it";
        let at: PlaceFn<'_> = &|| reference_level.place("measurements");
        builder.report(Code::AssumedUnit, at, message, remedy);
        DEFAULT_SCALE
    });
    let frame = |(index, level): (usize, &Level<'_>)| {
        if index == reference {
            return similarity(reference_scale, 0.0, Point::new(0.0, 0.0));
        }
        let pairs = common_fiducials(reference_level, level);
        match alignment(&pairs, reference_scale) {
            Some(frame) => frame,
            None if level.positions.is_empty() => {
                similarity(reference_scale, 0.0, Point::new(0.0, 0.0))
            }
            None => {
                let message = || {
                    format!(
                        "{} fiducials in common with level `{}`, expected two or more to align it",
                        pairs.len(),
                        reference_level.name
                    )
                };
                let remedy = "It is drawn at the origin of its floor plan; add fiducials in the \
                              editor";
                let at: PlaceFn<'_> = &|| level.place("fiducials");
                builder.report(Code::AssumedUnit, at, message, remedy);
                let scale = measured_scale(builder, level).unwrap_or(reference_scale);
                similarity(scale, 0.0, Point::new(0.0, 0.0))
            }
        }
    };
    levels.iter().enumerate().map(frame).collect()
}

/// A frame that flips pixels to y up, scales, rotates and then translates them.
fn similarity(scale: f64, angle_rad: f64, offset_m: Point<f64>) -> Frame {
    let origin = Point::new(0.0, 0.0);
    let affine = Affine::scale(scale, -scale, origin)
        .then(Affine::rotation(angle_rad, origin))
        .then(Affine::translation(offset_m));
    Frame::Plane(affine)
}

/// The mean of meters per pixel over all measurements of a level; `None` without a valid one.
/// Reports invalid measurements.
fn measured_scale(builder: &mut Builder<'_>, level: &Level<'_>) -> Option<f64> {
    let mut scales = Vec::new();
    for (index, measured) in level.measurements.iter().enumerate() {
        let ends = measured.ends.map(|end| level.position(end));
        let scale = match ends {
            [Some(a), Some(b)] => measured.distance_m / a.distance(b),
            _ => f64::NAN,
        };
        if scale.is_finite() && scale > 0.0 {
            scales.push(scale);
            continue;
        }
        let message = || {
            let distance_m = measured.distance_m;
            match ends {
                [Some(a), Some(b)] => {
                    let pixels = a.distance(b);
                    format!("{distance_m} m between two vertices that are {pixels} pixels apart")
                }
                _ => format!("{distance_m} m between vertices that do not exist"),
            }
        };
        let remedy = "It is left out; measure the distance again in the editor";
        let at: PlaceFn<'_> = &|| Place {
            line: Some(measured.line),
            ..level.place(&format!("measurements[{index}]"))
        };
        builder.report(Code::Implausible, at, message, remedy);
    }
    let count = scales.len() as f64;
    (count > 0.0).then(|| scales.iter().sum::<f64>() / count)
}

/// The positions of the fiducials that two levels share, in pixels with y up; the reference first.
fn common_fiducials(reference: &Level<'_>, level: &Level<'_>) -> Vec<[Point<f64>; 2]> {
    /// Bounds the quadratic cost of [`alignment`].
    const MAX_PAIRS: usize = 100;
    let others = &level.fiducials;
    let pairs = reference.fiducials.iter().filter_map(|&(name, here)| {
        let found = others.iter().find(|(other, _)| *other == name)?;
        Some([here, found.1].map(|p| Point::new(p.x, -p.y)))
    });
    pairs.take(MAX_PAIRS).collect()
}

/// Aligns a level to the reference by their common fiducials: the rotation and the scale are means
/// over all pairs of fiducials, and the offset is the mean of the remaining differences. `None` if
/// no two fiducials have different positions.
///
/// Cost: O(fiducials^2).
fn alignment(pairs: &[[Point<f64>; 2]], reference_scale: f64) -> Option<Frame> {
    let (mut sum, mut ratios) = (Point::new(0.0, 0.0), Vec::new());
    for (i, a) in pairs.iter().enumerate() {
        for b in &pairs[i + 1..] {
            let [here, there] = [b[0] - a[0], b[1] - a[1]];
            let ratio = there.norm() / here.norm();
            if ratio.is_finite() && ratio > 0.0 {
                ratios.push(ratio);
                let unit = 1.0 / (here.norm() * there.norm());
                sum = sum + Point::new(there.dot(here), there.cross(here)) * unit;
            }
        }
    }
    if ratios.is_empty() {
        return None;
    }
    let ratio = ratios.iter().sum::<f64>() / ratios.len() as f64;
    let scale = reference_scale / ratio;
    let angle_rad = sum.y.atan2(sum.x);
    let turn = Affine::rotation(angle_rad, Point::new(0.0, 0.0));
    let offsets = pairs
        .iter()
        .map(|[here, there]| *here * reference_scale - turn.apply(*there * scale));
    let sum = offsets.fold(Point::new(0.0, 0.0), |a, b| a + b);
    Some(similarity(
        scale,
        angle_rad,
        sum * (1.0 / pairs.len() as f64),
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn alignment_recovers_rotation_scale_and_offset() {
        // The other plan has twice the resolution, is rotated by 90 degrees and shifted.
        let other = |p: Point<f64>| Point::new(-p.y * 2.0 + 30.0, p.x * 2.0 - 7.0);
        let here = [(0.0, 0.0), (10.0, 2.0), (3.0, 8.0)].map(|(x, y)| Point::new(x, y));
        let pairs = here.map(|p| [p, other(p)]);
        let Some(Frame::Plane(affine)) = alignment(&pairs, 0.5) else {
            panic!("no frame");
        };
        for [here, there] in pairs {
            let pixel = Point::new(there.x, -there.y);
            assert!(affine.apply(pixel).distance(here * 0.5) < 1e-12);
        }
        assert!(alignment(&pairs[..1], 0.5).is_none(), "one fiducial");
        assert!(
            alignment(&[pairs[0], pairs[0]], 0.5).is_none(),
            "one fiducial twice"
        );
    }
}
