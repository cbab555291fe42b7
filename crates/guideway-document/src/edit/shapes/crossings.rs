//! Splits at crossings: a node wherever two paths cross, or one ends on another.

use std::collections::BTreeMap;
use std::sync::Arc;

use guideway_spline::Runs;
use guideway_spline::construct::{crossings, nearest_parameter};

use super::error::ShapeError;
use super::split::{Cuts, JOIN_M};
use crate::PathSet;
use crate::document::Document;
use crate::edit::curves::runs_of;
use crate::elements::Elements;

/// Most cuts of one step.
const MAX_CUTS: usize = 100_000;

/// Most pairs of paths with overlapping boxes that are compared.
const MAX_PAIRS: usize = 10_000_000;

/// Accuracy of the place nearest to an end, in meters.
const NEAREST_M: f64 = 1e-9;

impl Document {
    /// Splits the paths wherever two of the same level cross, or one ends on another.
    /// Paths that lie on each other, such as the two ways of one track, do not cross. Selects the
    /// pieces and returns the nodes.
    ///
    /// # Errors
    /// When the paths do not cross, would be cut at too many places, or as for other edits.
    pub fn split_at_crossings(&mut self, paths: &PathSet) -> Result<Vec<u32>, ShapeError> {
        self.check_paths(paths)?;
        let path = |row: u32| self.layout().paths.get(row as usize);
        let curves: BTreeMap<u32, Runs> =
            paths.iter().map(|row| (row, runs_of(path(row)))).collect();
        let (mut cuts, mut pairs) = (Cuts::new(self), 0);
        for (&row, runs) in &curves {
            let Some(bounds) = self.index.path_bounds(row) else {
                continue;
            };
            let near = self.index.paths_in(bounds.inflated(JOIN_M));
            let is_pair = |other: &u32| {
                *other > row
                    && curves.contains_key(other)
                    && path(*other).level() == path(row).level()
            };
            let mut others: Vec<u32> = near.filter(is_pair).collect();
            others.sort_unstable();
            pairs += others.len();
            if pairs > MAX_PAIRS {
                let (what, limit) = ("pairs of paths compared", MAX_PAIRS);
                return Err(ShapeError::TooMany { what, limit });
            }
            for other in others {
                if let Some(with) = curves.get(&other) {
                    cut_pair(&mut cuts, [(row, runs), (other, with)]);
                }
                if cuts.count > MAX_CUTS {
                    let (what, limit) = ("places cut", MAX_CUTS);
                    return Err(ShapeError::TooMany { what, limit });
                }
            }
        }
        if cuts.count == 0 {
            return Err(ShapeError::NoCrossing);
        }
        let (changes, pieces, nodes) = cuts.finish();
        self.perform("split at crossings", changes)?;
        self.selection = Arc::new(Elements::of_paths(pieces));
        Ok(nodes)
    }
}

/// Cuts two paths where they cross, and each one where the other ends on it.
fn cut_pair(cuts: &mut Cuts<'_>, pair: [(u32, &Runs); 2]) {
    let [(_, first), (_, second)] = pair;
    // Curves that share a part do not cross.
    for crossing in crossings(first, second).unwrap_or_default() {
        for ((path, runs), at) in pair.into_iter().zip(crossing.at) {
            cuts.add(path, runs, at, crossing.position);
        }
    }
    for (ending, (path, runs)) in [(pair[0], pair[1]), (pair[1], pair[0])] {
        for end in [ending.1.start(), ending.1.end()].into_iter().flatten() {
            let Some((at, nearest)) = nearest_parameter(runs, end, NEAREST_M) else {
                continue;
            };
            let is_end = [runs.start(), runs.end()]
                .into_iter()
                .flatten()
                .any(|other| other.distance(end) <= JOIN_M);
            if nearest.distance <= JOIN_M && !is_end {
                // The end first, so that its node becomes the node of the cut.
                cuts.add(ending.0, ending.1, at, end);
                cuts.add(path, runs, at, end);
            }
        }
    }
}
