//! Reads the area of a path from a file: splits polygons with holes into convex parts.

use earcut::{Earcut, deviation};
use guideway_layout::{Layout, PathRef, Value};
use guideway_spline::Point;

use crate::{ConvexPolygon, NoEnvelope, Sweep};

/// The column with areas: the coordinates of a GeoJSON MultiPolygon (RFC 7946, 3.1.7), in meters.
const AREA_COLUMN: &str = "vehicleEnvelope.area";

/// Relative rounding error of the area of a polygon.
const AREA_ERROR: f64 = 1e-9;

type Ring = Vec<[f64; 2]>;

/// The swept area in the file for a path.
pub(crate) fn file_area(layout: &Layout, path: usize) -> Result<Sweep, NoEnvelope> {
    let column = layout.paths.attributes.get(AREA_COLUMN);
    let value = column.and_then(|column| column.values.get(path));
    let Some(Value::Json(text) | Value::Text(text)) = value else {
        return Err(NoEnvelope::NotInFile);
    };
    let polygons: Vec<Vec<Ring>> =
        serde_json::from_str(text).map_err(|_| NoEnvelope::Unreadable)?;
    let mut parts = Vec::new();
    polygons.iter().for_each(|rings| add(rings, &mut parts));
    let reach_m = reach_m(layout.paths.get(path), &parts);
    Sweep::of_areas(parts, reach_m).ok_or(NoEnvelope::Unreadable)
}

/// Largest distance of the parts from the hull of a path: about the size of the vehicle.
fn reach_m(path: PathRef<'_>, parts: &[ConvexPolygon]) -> f64 {
    let Some(path_hull) = ConvexPolygon::hull(path.runs().flat_map(|run| run.iter())) else {
        return 0.0;
    };
    let corners = parts.iter().flat_map(ConvexPolygon::points);
    let from_path_m =
        corners.filter_map(|&corner| Some(ConvexPolygon::hull([corner])?.distance(&path_hull)));
    from_path_m.fold(0.0, f64::max)
}

/// Adds the convex parts of a polygon: the first ring is its boundary, the others are holes.
fn add(rings: &[Ring], parts: &mut Vec<ConvexPolygon>) {
    let open = |ring: &Ring| match ring.as_slice() {
        [first, rest @ .., last] if first == last => [&[*first], rest].concat(),
        all => all.to_vec(),
    };
    let (mut corners, mut holes) = (Vec::new(), Vec::new());
    for (index, ring) in rings.iter().map(open).enumerate() {
        if index > 0 {
            holes.push(corners.len());
        }
        corners.extend(ring);
    }
    let points = || corners.iter().map(|&[x, y]| Point::new(x, y));
    let Some(hull) = points()
        .all(Point::is_finite)
        .then(|| ConvexPolygon::hull(points()))
        .flatten()
    else {
        return;
    };
    let mut triangles: Vec<usize> = Vec::new();
    Earcut::new().earcut(corners.iter().copied(), &holes, &mut triangles);
    let triangle = |of: &[usize]| {
        ConvexPolygon::hull(of.iter().map(|&i| Point::new(corners[i][0], corners[i][1])))
    };
    let cut = || triangles.chunks_exact(3).filter_map(triangle);
    let cut_m2: f64 = cut().map(|part| part.area_m2()).sum();
    let is_convex = cut_m2 >= hull.area_m2() * (1.0 - AREA_ERROR);
    // A boundary that crosses itself has no defined interior: the hull is the safe choice.
    let is_simple = deviation(corners.iter().copied(), &holes, &triangles) <= AREA_ERROR;
    if is_convex || !is_simple {
        parts.push(hull);
    } else {
        parts.extend(cut());
    }
}
