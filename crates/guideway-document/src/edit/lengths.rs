//! Stated lengths: the lengths that a file states for paths, which follow new curves.

use std::collections::BTreeMap;
use std::sync::Arc;

use guideway_layout::{Value, Values};
use guideway_scene::{Table, TableEdit};
use guideway_spline::{Affine, Runs, run_length};

use super::curves::{mapped_runs, runs_of};
use super::perform::reshape;
use crate::PathSet;
use crate::change::Change;
use crate::document::Document;

/// Column of the length that a file states for a path.
pub(super) const LENGTH: &str = "length";

/// Accuracy of lengths, in meters.
const LENGTH_TOLERANCE_M: f64 = 1e-6;

/// Largest deviation of the vectors of an affine map that keeps lengths: rounding errors.
const SAME_SCALE: f64 = 1e-12;

/// Length of a curve, in meters.
pub(super) fn length_m(runs: &Runs) -> f64 {
    let lengths = runs.iter().map(|run| run_length(run, LENGTH_TOLERANCE_M));
    lengths.sum()
}

/// The length that the file states for a path.
pub(super) fn stated_length_m(document: &Document, path: u32) -> Option<f64> {
    let attributes = &document.layout().paths.attributes;
    attributes.value(path as usize, LENGTH)?.number()
}

/// The change that sets the stated lengths of paths; `None` without any.
pub(super) fn set_lengths_m(lengths_m: &BTreeMap<u32, f64>) -> Option<Change> {
    if lengths_m.is_empty() {
        return None;
    }
    let values: Values = lengths_m.values().map(|v| Some(Value::Float(*v))).collect();
    let edit = TableEdit::SetValues {
        of: Table::Paths,
        vehicle_type: None,
        column: LENGTH.into(),
        quantity: None,
        rows: lengths_m.keys().copied().collect(),
        values: Arc::new(values),
    };
    Some(edit.into())
}

impl Document {
    /// The stated lengths of paths with other curves. They change by the ratio of the lengths of
    /// the curves, because a drawing may be to another scale than the building.
    pub(super) fn scaled_lengths_m<'r>(
        &self,
        curves: impl Iterator<Item = (u32, &'r Runs)>,
    ) -> BTreeMap<u32, f64> {
        let scaled = curves.filter_map(|(path, runs)| {
            let stated_m = stated_length_m(self, path)?;
            let old_m = length_m(&runs_of(self.layout().paths.get(path as usize)));
            let new_m = length_m(runs);
            let scaled_m = stated_m * (new_m / old_m);
            let is_other = (new_m - old_m).abs() > 2.0 * LENGTH_TOLERANCE_M;
            let steps_per_m = 1.0 / LENGTH_TOLERANCE_M;
            let rounded_m = (scaled_m * steps_per_m).round() / steps_per_m;
            (is_other && rounded_m.is_finite()).then_some((path, rounded_m))
        });
        scaled.collect()
    }

    /// The changes that replace the curves of paths, with the lengths that are stated for them.
    pub(super) fn reshape(&self, paths: Vec<u32>, curves: &[Runs]) -> Vec<Change> {
        let lengths_m = self.scaled_lengths_m(paths.iter().copied().zip(curves));
        let reshaped = [reshape(paths, curves)].into_iter();
        reshaped.chain(set_lengths_m(&lengths_m)).collect()
    }

    /// The change of the lengths that are stated for transformed paths, if there is one.
    pub(super) fn transformed_lengths(&self, paths: &PathSet, by: Affine) -> Option<Change> {
        let unit = |vector: f64| (vector - 1.0).abs() <= SAME_SCALE;
        if unit(by.x.norm()) && unit(by.y.norm()) && by.x.dot(by.y).abs() <= SAME_SCALE {
            return None;
        }
        let stated = paths
            .iter()
            .filter(|&path| stated_length_m(self, path).is_some());
        let paths = &self.layout().paths;
        let transformed = stated.map(|path| (path, mapped_runs(paths.get(path as usize), by)));
        let transformed: Vec<(u32, Runs)> = transformed.collect();
        let curves = transformed.iter().map(|(path, runs)| (*path, runs));
        set_lengths_m(&self.scaled_lengths_m(curves))
    }
}
