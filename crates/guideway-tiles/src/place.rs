//! Places a layout on the map of the earth, where it has a place there, and chooses its grid.

use std::f64::consts::PI;
use std::sync::Arc;

use guideway_layout::{GeoOrigin, Geometry, Layout, WrittenCurves};
use guideway_spline::{Point, Runs, uniform};

use crate::TileGrid;

/// Largest extent of the control points of a segment that is mapped as a whole, in meters.
///
/// The map of the control points is not quite that of the curve: it is off by at most an eighth of
/// the square of this extent times the curvature of Mercator's map, which is tan(latitude) / 6378
/// km. Derived: 0.4 mm at 60 degrees, and 3 mm at 85.
const WHOLE_M: f64 = 40.0;
/// Most halvings of a segment: enough for one around the earth.
const MAX_HALVINGS: u32 = 22;
/// Latitude at which the map of the earth ends: it is a square.
const MAX_LATITUDE_DEG: f64 = 85.051_128_779_806_6;

/// Chooses the grid of a layout. A layout with a place on earth gets the grid of the earth, and its
/// curves and widths are mapped there; any other one, or all if `on_plane`, a square around it.
pub fn place(layout: Arc<Layout>, on_plane: bool) -> (Arc<Layout>, TileGrid) {
    match layout.geo_origin.filter(|_| !on_plane) {
        Some(origin) => {
            let mut layout = Arc::unwrap_or_clone(layout);
            map_to_earth(&mut layout, origin);
            (Arc::new(layout), TileGrid::EARTH)
        }
        None => {
            let grid = TileGrid::around(layout.paths.hull_bounds());
            (layout, grid)
        }
    }
}

/// Units of the earth's grid per meter on the ground, at a latitude.
pub(crate) fn units_per_m(latitude_deg: f64) -> f64 {
    let units_per_equator_m = TileGrid::EARTH.side() / (2.0 * PI * GeoOrigin::SEMI_MAJOR_M);
    units_per_equator_m / latitude_deg.to_radians().cos()
}

fn map_to_earth(layout: &mut Layout, origin: GeoOrigin) {
    let to_degrees = origin.to_degrees();
    let side = TileGrid::EARTH.side();
    let map = |p: Point<f64>| {
        let degrees = to_degrees(p);
        let latitude = degrees.y.clamp(-MAX_LATITUDE_DEG, MAX_LATITUDE_DEG);
        let north = latitude.to_radians().tan().asinh() / (2.0 * PI);
        Point::new(degrees.x / 360.0 * side, north * side)
    };
    let paths = &mut layout.paths;
    let mut mapped = Geometry::default();
    let (mut runs, mut points) = (Runs::default(), Vec::new());
    for row in 0..paths.len() {
        runs.clear();
        for run in paths.geometry().runs(row) {
            points.clear();
            points.extend(run.iter());
            match points.array_windows().all(is_small) {
                true => {
                    points.iter_mut().for_each(|p| *p = map(*p));
                    runs.push(&points);
                }
                false => points
                    .array_windows()
                    .for_each(|segment| push_mapped(segment, &map, MAX_HALVINGS, &mut runs)),
            }
        }
        mapped.push(&runs);
    }
    let scale = units_per_m(origin.latitude_deg) as f32;
    let widths = paths.width_m();
    let widths = widths.map(|all| all.iter().map(|width| width * scale).collect());
    let rows: Vec<u32> = (0..paths.len() as u32).collect();
    paths.replace_curves(&rows, &mapped, &WrittenCurves::default());
    if let Some(widths) = widths {
        paths.set_width_m(widths);
    }
}

/// Appends a segment, mapped in parts that are small enough.
fn push_mapped(
    segment: &[Point<f64>; 4],
    map: &impl Fn(Point<f64>) -> Point<f64>,
    halvings: u32,
    runs: &mut Runs,
) {
    if halvings == 0 || is_small(segment) {
        runs.push_segment(&segment.map(map));
        return;
    }
    for half in uniform::halves(segment) {
        push_mapped(&half, map, halvings - 1, runs);
    }
}

fn is_small(segment: &[Point<f64>; 4]) -> bool {
    let [first, rest @ ..] = segment;
    rest.iter().all(|p| p.distance(*first) <= WHOLE_M)
}

#[cfg(test)]
mod tests {
    use guideway_layout::NewPath;

    use super::*;

    #[test]
    fn long_lines_are_where_the_map_of_their_points_is() {
        let origin = GeoOrigin {
            longitude_deg: 11.5,
            latitude_deg: 60.0,
        };
        let mut layout = Layout {
            geo_origin: Some(origin),
            ..Layout::default()
        };
        let mut runs = Runs::default();
        let [a, b] = [Point::new(-20_000.0, 1000.0), Point::new(9000.0, 30_000.0)];
        runs.push_line(a, b);
        layout.paths.push(&NewPath {
            id: "a",
            runs: &runs,
            ..NewPath::default()
        });
        layout.paths.set_width_m(vec![2.0]);
        let layout = Arc::new(layout);
        let (placed, grid) = place(Arc::clone(&layout), false);
        assert_eq!(grid, TileGrid::EARTH);
        let per_degree_m = origin.meters_per_degree();
        // A point on the line: its degrees are linear in meters.
        let at = a.lerp(b, 0.3);
        let expected = Point::new(
            origin.longitude_deg + at.x / per_degree_m.x,
            origin.latitude_deg + at.y / per_degree_m.y,
        );
        let path = placed.paths.get(0);
        let segments = path.runs().flat_map(|run| {
            let points: Vec<_> = run.iter().collect();
            let all: Vec<[Point<f64>; 4]> = points.array_windows().copied().collect();
            all
        });
        let off_m = |p: Point<f64>| {
            let off = grid.degrees(p) - expected;
            (off.x * per_degree_m.x).hypot(off.y * per_degree_m.y)
        };
        let steps = segments.flat_map(|s| (0..=64).map(move |i| (s, f64::from(i) / 64.0)));
        let nearest = steps.map(|(s, t)| off_m(uniform::point(&s, t)));
        // Within half a step along the line of what lies on it.
        assert!(nearest.fold(f64::INFINITY, f64::min) < 0.5);
        let width = placed.paths.width_m().unwrap()[0];
        assert!(
            (width - 2.0 * 1.194_3_f32.recip() * 2.0).abs() < 0.01,
            "{width}"
        );

        let (plane, grid) = place(layout, true);
        assert_eq!(grid.kind(), crate::GridKind::Plane);
        assert_eq!(plane.paths.get(0).runs().len(), 1);
    }
}
