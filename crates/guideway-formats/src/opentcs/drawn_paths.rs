//! Draws all paths of a plant: chooses connection types, the scale of the drawing, and control
//! points in its units.

use guideway_layout::{Layout, PathRef, Value};
use guideway_spline::Point;
use rayon::prelude::*;
use serde_json::{Map, Value as Json};

use super::held::{json, speed_mm_s};
use super::path_mapper::{CONNECTION_TYPE, REVERSED};
use super::plant::Plant;
use super::shape::{CURVE_TOLERANCE_M, Connection, Shape, beziers_of};
use super::visual_layout::DEFAULT_SCALE;
use super::write::is_two_way;
use crate::Losses;
use crate::clamped::POSITION_STEP_M;

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
    /// Whether the file has the path from its end to its start.
    pub(super) is_reversed: bool,
    /// Whether the column of connection types states the type, which the curve does not tell.
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
        let stated = drawn.drawing(layout);
        let stated = ["scaleX", "scaleY"].map(|name| stated.get(name).and_then(Json::as_f64));
        let is_scale = |scale: &f64| scale.is_finite() && *scale > 0.0;
        let stated = match stated.map(|scale| scale.filter(is_scale)) {
            [Some(x), Some(y)] => Some(Point::new(x, y)),
            _ => None,
        };
        drawn.choose_scale(stated);
        let is_other = stated.is_some_and(|stated| stated != drawn.scale_mm)
            || stated.is_none() && drawn.scale_mm.x != DEFAULT_SCALE;
        let detail = format!("scale of the drawing: {} mm per unit", drawn.scale_mm.x);
        losses.add("layout properties", usize::from(is_other), detail);
        let scale_mm = drawn.scale_mm;
        drawn
            .paths
            .par_iter_mut()
            .flatten()
            .for_each(|path| path.place(scale_mm));
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
            let (start, end) = path.ends()?;
            let points = plant.ends[path.row()]?.map(|point| plant.position_m(point));
            let ends_m = start.distance(points[0]).max(end.distance(points[1]));
            let apart_m = drawn.shape.error_m + drawn.shift_m(self.scale_mm).max(ends_m);
            (apart_m > POSITION_STEP_M).then_some(apart_m)
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

    /// Rounds the control points to units of the drawing.
    fn place(&mut self, scale_mm: Point<f64>) {
        let units = |p: &Point<f64>| {
            [p.x * 1e3 / scale_mm.x, -p.y * 1e3 / scale_mm.y].map(|unit| unit.round() as i64)
        };
        self.control_units = self.shape.control.iter().map(units).collect();
    }

    /// Upper bound of the distance by which rounded control points move the curve.
    fn shift_m(&self, scale_mm: Point<f64>) -> f64 {
        let share = match self.shape.connection {
            Connection::Bezier | Connection::Bezier3 => BEZIER_SHARE,
            _ => 1.0,
        };
        let off = |meters: f64, scale_mm: f64| {
            let units = meters * 1e3 / scale_mm;
            (units - units.round()) * scale_mm / 1e3
        };
        let control = self.shape.control.iter();
        let shifts = control.map(|p| Point::new(off(p.x, scale_mm.x), off(p.y, scale_mm.y)).norm());
        share * shifts.fold(0.0, f64::max)
    }
}
