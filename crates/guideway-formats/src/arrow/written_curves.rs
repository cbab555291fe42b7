//! Written curves: the column with the NURBS curves as their files wrote them.

use arrow_array::cast::AsArray;
use arrow_array::{Array, ArrayRef, StructArray};
use guideway_layout::{Code, Diagnostics, Limits, Paths, Place, WrittenCurve};
use guideway_spline::Point;

use super::batch::Batch;
use super::column_names::{CURVE, DEGREE, KNOTS, POINTS, WEIGHTS};
use super::list_array::{NumberLists, indices};
use super::point_items::PointLists;
use super::problems::damaged;
use super::reading::Reading;
use super::schema::Role;
use crate::Problem;

/// Written curves of the paths under construction.
pub(super) struct CurveColumn<'a> {
    index: usize,
    reading: Reading<'a>,
    /// Rows of paths, with their curves.
    curves: Vec<(usize, WrittenCurve)>,
    rows: usize,
    /// Number of curves that contradict themselves.
    invalid: u64,
}

impl<'a> CurveColumn<'a> {
    /// Makes the column, if the table has one.
    pub(super) fn new(reading: Reading<'a>) -> Option<Self> {
        Some(Self {
            index: reading.columns.get(Role::Curve)?,
            reading,
            curves: Vec::new(),
            rows: 0,
            invalid: 0,
        })
    }

    /// Appends the drawn rows of a batch.
    pub(super) fn add(&mut self, batch: &Batch) -> Result<(), Problem> {
        let column = batch.columns[self.index].as_struct();
        if column.null_count() == column.len() {
            self.rows += batch.drawn_rows();
            return Ok(());
        }
        let degrees = indices(field(column, DEGREE)?)?;
        let knots = NumberLists::new(field(column, KNOTS)?)?;
        let weights = NumberLists::new(field(column, WEIGHTS)?)?;
        let points = PointLists::new(field(column, POINTS)?, self.reading.budget)?;
        for row in batch.drawn.iter().cloned().flatten() {
            if column.is_valid(row) {
                let curve = WrittenCurve {
                    // 0 is no degree.
                    degree: if degrees.is_valid(row) {
                        degrees.value(row)
                    } else {
                        0
                    },
                    knots: knots.get(row).unwrap_or_default(),
                    points_m: points.get(row).collect(),
                    weights: weights.get(row),
                };
                match is_valid(&curve, self.reading.limits) {
                    true => self.curves.push((self.rows, curve)),
                    false => self.invalid += 1,
                }
            }
            self.rows += 1;
        }
        Ok(())
    }

    /// Sets the curves of the paths.
    pub(super) fn finish(self, paths: &mut Paths, diagnostics: &mut Diagnostics) {
        for (path, curve) in self.curves {
            paths.set_written_curve(path, curve);
        }
        if self.invalid > 0 {
            diagnostics.push(
                Code::UnknownValue,
                || Place::element(format!("column {CURVE}")),
                || {
                    format!(
                        "{} curves contradict themselves or exceed a limit: a curve has a degree \
                         from 1, points, finite numbers, and a weight per point if any",
                        self.invalid
                    )
                },
                "The paths keep the curve of their control points; correct the curves",
            );
        }
    }
}

fn field<'a>(column: &'a StructArray, name: &str) -> Result<&'a ArrayRef, Problem> {
    let field = column.column_by_name(name);
    field.ok_or_else(|| damaged(format!("column {CURVE}"), format!("{name} is missing")))
}

fn is_valid(curve: &WrittenCurve, limits: &Limits) -> bool {
    let limit = limits.coordinate_m;
    let is_near = |p: &Point<f64>| p.x.abs() <= limit && p.y.abs() <= limit;
    let weights = curve.weights.as_deref();
    let mut numbers = curve.knots.iter().chain(weights.unwrap_or_default());
    (1..=limits.degree).contains(&(curve.degree as usize))
        && !curve.points_m.is_empty()
        && curve.points_m.len().max(curve.knots.len()) <= limits.curve_points
        && weights.is_none_or(|weights| weights.len() == curve.points_m.len())
        && curve.points_m.iter().all(is_near)
        && numbers.all(|number| number.is_finite())
}
