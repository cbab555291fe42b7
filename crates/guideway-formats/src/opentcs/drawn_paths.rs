//! Draws all paths of a plant: chooses connection types, the scale of the drawing, and control
//! points in its units.

use guideway_layout::{Layout, PathRef, Value};
use guideway_spline::Point;
use rayon::prelude::*;
use serde_json::{Map, Value as Json};

use super::path_mapper::{CONNECTION_TYPE, REVERSED};
use super::plant::Plant;
use super::shape::{CURVE_TOLERANCE_M, Connection, Shape, beziers_of};
use super::values::{SAME_M, is_two_way, json, speed_mm_s};
use super::visual_layout::DEFAULT_SCALE;
use crate::Losses;

/// Scales of a drawing that are tried after that of the layout, in millimeters per unit. With the
/// first one, the editor draws points as large as in a new model.
const SCALES_MM: [f64; 6] = [DEFAULT_SCALE, 20.0, 10.0, 5.0, 2.0, 1.0];

/// Largest share of the displacement of its control points by which a cubic curve moves.
const BEZIER_SHARE: f64 = 0.75;

/// A path as drawn.
pub(super) struct DrawnPath {
    /// Connection type and control points, from the source point of the file to its destination.
    pub(super) shape: Shape,
    /// Control points in units of the drawing, y down.
    pub(super) control_units: Vec<[i64; 2]>,
    /// True if the file has the path from its end to its start.
    pub(super) is_reversed: bool,
    /// True if the column of connection types states the type, which the curve does not tell.
    pub(super) is_stated: bool,
}

/// All paths as drawn.
pub(super) struct DrawnPaths {
    paths: Vec<Option<DrawnPath>>,
    /// Millimeters per unit of the drawing along x and y.
    pub(super) scale_mm: Point<f64>,
}

impl DrawnPaths {
    /// Draws the paths of a layout; lists the curves that change.
    pub(super) fn draw(layout: &Layout, plant: &Plant<'_>, losses: &mut Losses) -> Self {
        let rows = 0..layout.paths.len();
        let draw = |row: usize| {
            plant.ends[row]?;
            Some(DrawnPath::new(layout, layout.paths.get(row)))
        };
        let paths: Vec<_> = rows.into_par_iter().map(draw).collect();
        let mut drawn = Self {
            scale_mm: Point::new(DEFAULT_SCALE, DEFAULT_SCALE),
            paths,
        };
        let drawing = drawn.drawing(layout);
        let numbers = ["scaleX", "scaleY"].map(|name| drawing.get(name).and_then(Json::as_f64));
        let is_scale = |scale: &f64| scale.is_finite() && *scale > 0.0;
        let stated = match numbers.map(|scale| scale.filter(is_scale)) {
            [Some(x), Some(y)] => Some(Point::new(x, y)),
            _ => None,
        };
        drawn.choose_scale(stated);
        let scale = drawn.scale_mm;
        let is_other = match drawing.is_empty() {
            true => Some(scale.x) != Some(DEFAULT_SCALE),
            false => numbers != [Some(scale.x), Some(scale.y)],
        };
        let detail = format!("scale of the drawing: {} mm per unit", drawn.scale_mm.x);
        losses.add("layout properties", usize::from(is_other), detail);
        let scale_mm = drawn.scale_mm;
        let rows = drawn.paths.par_iter_mut().zip(&plant.ends);
        rows.for_each(|(path, ends)| {
            if let (Some(path), Some(ends)) = (path, ends) {
                path.place(scale_mm, ends.map(|point| plant.position_m(point)));
            }
        });
        drawn.add_losses(layout, plant, losses);
        drawn
    }

    /// A path as drawn; `None` if it has no curve.
    pub(super) fn get(&self, path: usize) -> Option<&DrawnPath> {
        self.paths[path].as_ref()
    }

    /// The `visualLayout` of the layout.
    pub(super) fn drawing(&self, layout: &Layout) -> Map<String, Json> {
        json(layout.attributes.value(0, "visualLayout")).unwrap_or_default()
    }

    /// Chooses the scale of the layout, else the coarsest one by which no curve moves farther than
    /// [`CURVE_TOLERANCE_M`].
    fn choose_scale(&mut self, stated: Option<Point<f64>>) {
        let scales = SCALES_MM.map(|scale| Point::new(scale, scale));
        let mut candidates = stated.into_iter().chain(scales);
        let paths = &self.paths;
        let is_near = |scale: &Point<f64>| {
            let drawn = paths.par_iter().flatten();
            drawn.all(|path| path.shift_m(*scale) <= CURVE_TOLERANCE_M)
        };
        self.scale_mm = candidates.find(is_near).unwrap_or(scales[scales.len() - 1]);
    }

    /// Lists the curves that change, with an upper bound of the distance.
    fn add_losses(&self, layout: &Layout, plant: &Plant<'_>, losses: &mut Losses) {
        let apart = layout.paths.iter().filter_map(|path| {
            let drawn = self.paths[path.row()].as_ref()?;
            let (start, end) = path
                .ends()
                .filter(|_| plant.keeps_path(layout, path.row()))?;
            let points = plant.ends[path.row()]?.map(|point| plant.position_m(point));
            let moved_m = drawn.moved_m(self.scale_mm, [start, end], points);
            let apart_m = drawn.shape.error_m + moved_m;
            (apart_m > SAME_M).then_some(apart_m)
        });
        let (count, most_m) = apart.fold((0, 0.0_f64), |(count, most_m), apart_m| {
            (count + 1, most_m.max(apart_m))
        });
        let detail = format!(
            "curves: drawn within {:.1} mm, as openTCS can draw them in its units",
            (most_m * 1e4).ceil() / 10.0
        );
        losses.add("curves", count, detail);
    }
}

impl DrawnPath {
    fn new(layout: &Layout, path: PathRef<'_>) -> Self {
        let row = path.row();
        let beziers = beziers_of(path);
        let stated = match layout.paths.attributes.value(row, CONNECTION_TYPE) {
            Some(Value::Text(stated)) => Some(stated),
            _ => None,
        };
        let mut shape = Shape::of_path(path, &beziers, stated);
        let is_stated = Connection::of_curve(&beziers) != Some(shape.connection)
            && stated == Some(shape.connection.name());
        let is_reversed = layout.paths.attributes.value(row, REVERSED) == Some(Value::Bool(true))
            && !is_two_way(layout, row)
            && speed_mm_s(layout.paths.value(row, "maxSpeed")) != Some(0);
        if is_reversed {
            shape.control.reverse();
        }
        Self {
            shape,
            control_units: Vec::new(),
            is_reversed,
            is_stated,
        }
    }

    /// Rounds the control points to units of the drawing. A curve that is straight then becomes
    /// straight lines, as which a reader takes it.
    fn place(&mut self, scale_mm: Point<f64>, mut ends: [Point<f64>; 2]) {
        let units = |p: &Point<f64>| {
            [p.x * 1e3 / scale_mm.x, -p.y * 1e3 / scale_mm.y].map(|unit| unit.round() as i64)
        };
        self.control_units = self.shape.control.iter().map(units).collect();
        if self.is_reversed {
            ends.reverse();
        }
        let meters = |&[x, y]: &[i64; 2]| {
            Point::new(x as f64 * scale_mm.x / 1e3, -(y as f64) * scale_mm.y / 1e3)
        };
        let control: Vec<_> = self.control_units.iter().map(meters).collect();
        let beziers = self.shape.connection.beziers(&control, ends);
        let of_curve = Connection::of_curve(&beziers);
        if of_curve == Some(self.shape.connection) {
            self.is_stated = false;
        } else if !self.is_stated {
            match of_curve {
                Some(Connection::Direct) => self.control_units.clear(),
                Some(Connection::Polypath) => self.control_units = vec![self.control_units[2]],
                _ => return,
            }
            self.shape.connection = of_curve.unwrap_or(self.shape.connection);
        }
    }

    /// Control points as written, in meters.
    fn written_control(&self, scale_mm: Point<f64>) -> Vec<Point<f64>> {
        let meters = |&[x, y]: &[i64; 2]| {
            let [x, y] = [x as f64 * scale_mm.x, -(y as f64) * scale_mm.y];
            Point::new(x / 1e3, y / 1e3)
        };
        self.control_units.iter().map(meters).collect()
    }

    /// Upper bound of the distance by which rounding moves the curve between two points of the
    /// layout, which are written at others.
    fn moved_m(
        &self,
        scale_mm: Point<f64>,
        mut stated: [Point<f64>; 2],
        mut written: [Point<f64>; 2],
    ) -> f64 {
        if self.is_reversed {
            stated.reverse();
            written.reverse();
        }
        let control = self.written_control(scale_mm);
        if control.len() != self.shape.control.len() || self.is_curved() {
            let ends = stated.iter().zip(&written).map(|(a, b)| a.distance(*b));
            return ends.fold(self.shift_m(scale_mm), f64::max);
        }
        let lines = |control: &[Point<f64>], [start, end]: [Point<f64>; 2]| {
            [&[start], control, &[end]].concat()
        };
        let (stated, written) = (lines(&self.shape.control, stated), lines(&control, written));
        farthest_corner_m(&stated, &written).max(farthest_corner_m(&written, &stated))
    }

    fn is_curved(&self) -> bool {
        matches!(
            self.shape.connection,
            Connection::Bezier | Connection::Bezier3
        )
    }

    /// Upper bound of the distance by which rounded control points move the curve.
    fn shift_m(&self, scale_mm: Point<f64>) -> f64 {
        let share = if self.is_curved() { BEZIER_SHARE } else { 1.0 };
        let off = |meters: f64, scale_mm: f64| {
            let units = meters * 1e3 / scale_mm;
            (units - units.round()) * scale_mm / 1e3
        };
        let control = self.shape.control.iter();
        let shifts = control.map(|p| Point::new(off(p.x, scale_mm.x), off(p.y, scale_mm.y)).norm());
        share * shifts.fold(0.0, f64::max)
    }
}

/// Largest distance of the corners of a polyline from the lines of another one that end at the
/// corner of the same number.
fn farthest_corner_m(corners: &[Point<f64>], lines: &[Point<f64>]) -> f64 {
    let off = |(index, corner): (usize, &Point<f64>)| {
        let near = &lines[index.saturating_sub(1)..lines.len().min(index + 2)];
        let distances = near.array_windows().map(|line| distance_m(*corner, line));
        distances.fold(f64::INFINITY, f64::min)
    };
    corners.iter().enumerate().map(off).fold(0.0, f64::max)
}

fn distance_m(point: Point<f64>, &[start, end]: &[Point<f64>; 2]) -> f64 {
    let line = end - start;
    let length_squared = line.dot(line);
    let share = match length_squared > 0.0 {
        true => (point - start).dot(line) / length_squared,
        false => 0.0,
    };
    point.distance(start.lerp(end, share.clamp(0.0, 1.0)))
}
