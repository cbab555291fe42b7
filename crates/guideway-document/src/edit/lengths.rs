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

/// The vehicle type of a stated length, if it does not hold for all, and the row of its path.
type LengthOf = (Option<Arc<str>>, u32);

/// Stated lengths, in meters.
pub(super) type StatedLengths = BTreeMap<LengthOf, f64>;

/// The lengths that the file states for a path: for all vehicle types, and for each with its own.
pub(super) fn stated_lengths_m(document: &Document, path: u32) -> Vec<(Option<Arc<str>>, f64)> {
    let (paths, row) = (&document.layout().paths, path as usize);
    let shared = paths.attributes.value(row, LENGTH);
    let shared = shared.and_then(|value| Some((None, value.number()?)));
    let entries = paths.vehicle_types();
    let own = entries.entries(row).filter_map(|entry| {
        let length_m = entries.attributes.value(entry, LENGTH)?.number()?;
        Some((Some(entries.type_of(entry).into()), length_m))
    });
    shared.into_iter().chain(own).collect()
}

/// The changes that set the stated lengths of paths.
pub(super) fn set_lengths_m(lengths_m: &StatedLengths) -> Vec<Change> {
    let lengths: Vec<_> = lengths_m.iter().collect();
    let groups = lengths.chunk_by(|a, b| a.0.0 == b.0.0);
    let set = |group: &[(&LengthOf, &f64)]| {
        let values = group
            .iter()
            .map(|(_, length_m)| Some(Value::Float(**length_m)));
        let edit = TableEdit::SetValues {
            of: Table::Paths,
            vehicle_type: group[0].0.0.clone(),
            column: LENGTH.into(),
            quantity: None,
            rows: group.iter().map(|((_, path), _)| *path).collect(),
            values: Arc::new(values.collect::<Values>()),
        };
        edit.into()
    };
    groups.map(set).collect()
}

impl Document {
    /// The stated lengths of paths with other curves. They change by the ratio of the lengths of
    /// the curves, because a drawing may be to another scale than the building.
    pub(super) fn scaled_lengths_m<'r>(
        &self,
        curves: impl Iterator<Item = (u32, &'r Runs)>,
    ) -> StatedLengths {
        let mut scaled = StatedLengths::new();
        for (path, runs) in curves {
            let stated = stated_lengths_m(self, path);
            if stated.is_empty() {
                continue;
            }
            let old_m = length_m(&runs_of(self.layout().paths.get(path as usize)));
            let new_m = length_m(runs);
            if (new_m - old_m).abs() <= 2.0 * LENGTH_TOLERANCE_M {
                continue;
            }
            for (vehicle_type, stated_m) in stated {
                let steps_per_m = 1.0 / LENGTH_TOLERANCE_M;
                let rounded_m = (stated_m * (new_m / old_m) * steps_per_m).round() / steps_per_m;
                if rounded_m.is_finite() {
                    scaled.insert((vehicle_type, path), rounded_m);
                }
            }
        }
        scaled
    }

    /// The changes that replace the curves of paths, with the lengths that are stated for them.
    pub(super) fn reshape(&self, paths: Vec<u32>, curves: &[Runs]) -> Vec<Change> {
        let lengths_m = self.scaled_lengths_m(paths.iter().copied().zip(curves));
        let reshaped = [reshape(paths, curves)].into_iter();
        reshaped.chain(set_lengths_m(&lengths_m)).collect()
    }

    /// The changes of the lengths that are stated for transformed paths.
    pub(super) fn transformed_lengths(&self, paths: &PathSet, by: Affine) -> Vec<Change> {
        let unit = |vector: f64| (vector - 1.0).abs() <= SAME_SCALE;
        if unit(by.x.norm()) && unit(by.y.norm()) && by.x.dot(by.y).abs() <= SAME_SCALE {
            return Vec::new();
        }
        let stated = paths
            .iter()
            .filter(|&path| !stated_lengths_m(self, path).is_empty());
        let paths = &self.layout().paths;
        let transformed = stated.map(|path| (path, mapped_runs(paths.get(path as usize), by)));
        let transformed: Vec<(u32, Runs)> = transformed.collect();
        let curves = transformed.iter().map(|(path, runs)| (*path, runs));
        set_lengths_m(&self.scaled_lengths_m(curves))
    }
}
