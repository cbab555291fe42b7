//! [`PathRef`]: one path of the table, with its curve and properties.

use guideway_spline::construct::{parameter_at_length, point_at};
use guideway_spline::{Bounds, Point, Runs, run_length, uniform};

use super::table::NONE;
use crate::{Direction, Paths, RunPoints, Value};

/// Largest error of the length of a run, in meters: a tenth of a millimeter.
const LENGTH_TOLERANCE_M: f64 = 1e-4;

/// One path of a [`Paths`] table.
#[derive(Clone, Copy, Debug)]
pub struct PathRef<'a> {
    paths: &'a Paths,
    row: usize,
}

impl<'a> PathRef<'a> {
    /// Row in the table.
    pub fn row(self) -> usize {
        self.row
    }

    pub(super) fn new(paths: &'a Paths, row: usize) -> Self {
        Self { paths, row }
    }

    /// Identifier in the file.
    pub fn id(self) -> &'a str {
        self.paths.ids.get(self.row)
    }

    /// Control runs, in meters.
    pub fn runs(self) -> impl ExactSizeIterator<Item = RunPoints<'a>> + Clone {
        self.paths.geometry.runs(self.row)
    }

    /// Replaces the contents of `runs` by a copy of its control runs.
    pub fn copy_runs(self, runs: &mut Runs) {
        runs.clear();
        for run in self.runs() {
            runs.push(&run.iter().collect::<Vec<_>>());
        }
    }

    /// Row of its first node.
    pub fn start_node(self) -> Option<u32> {
        some(self.paths.start_nodes.as_ref(), self.row)
    }

    /// Row of its last node.
    pub fn end_node(self) -> Option<u32> {
        some(self.paths.end_nodes.as_ref(), self.row)
    }

    /// Directions in which vehicles drive.
    pub fn direction(self) -> Direction {
        let column = self.paths.directions.as_ref();
        column.map_or(Direction::Forward, |column| column[self.row])
    }

    /// Index of its level.
    pub fn level(self) -> Option<u32> {
        some(self.paths.levels.as_ref(), self.row)
    }

    /// Box of its control points, which contains the curve; `None` if it has no points.
    pub fn hull_bounds(self) -> Option<Bounds<f64>> {
        self.runs()
            .filter_map(RunPoints::bounds)
            .reduce(Bounds::union)
    }

    /// Start and end of the curve; `None` if it has no segments.
    pub fn ends(self) -> Option<(Point<f64>, Point<f64>)> {
        let first = self.runs().next()?;
        let last = self.runs().last()?;
        let start = uniform::start(&first.segments().next()?);
        let end = uniform::end(&last.segments().last()?);
        Some((start, end))
    }

    /// Value in a column: see [`Paths::value`].
    pub fn value(self, name: &str) -> Option<Value<'a>> {
        self.paths.value(self.row, name)
    }

    /// Length along the curve, in meters, within a tenth of a millimeter per run.
    pub fn length_m(self) -> f64 {
        let runs = self.runs().map(|run| match run {
            RunPoints::F64(points) => run_length(points, LENGTH_TOLERANCE_M),
            RunPoints::F32(points) => run_length(points, LENGTH_TOLERANCE_M),
        });
        runs.sum()
    }

    /// The point of the curve at a distance along it from its start, in meters, within a tenth of a
    /// millimeter; its end for a greater distance. `None` if it has no segments.
    pub fn point_at_m(self, along_m: f64) -> Option<Point<f64>> {
        let mut runs = Runs::default();
        self.copy_runs(&mut runs);
        let at = parameter_at_length(&runs, along_m.max(0.0), LENGTH_TOLERANCE_M)?;
        point_at(&runs, at)
    }
}

fn some(column: Option<&Vec<u32>>, row: usize) -> Option<u32> {
    column
        .map(|column| column[row])
        .filter(|&index| index != NONE)
}
