//! Extent: sizes and coordinates that suggest a wrong unit.

use guideway_spline::{Bounds, uniform};

use super::element::element_name;
use super::options::CheckOptions;
use crate::{Code, Diagnostics, Layout, PathRef, Place};

const REMEDY: &str = "Check the unit of the file; if it is right, look for stray paths";

/// Reports a layout that is too large or too small, and coordinates too far from the origin.
pub(super) fn check(layout: &Layout, options: &CheckOptions, found: &mut Diagnostics) {
    let mut axes = [Axis::new("wide", "x"), Axis::new("high", "y")];
    for path in layout.paths.iter() {
        if let Some(Bounds { min, max }) = bounds(path) {
            axes[0].add(path.row(), min.x, max.x);
            axes[1].add(path.row(), min.y, max.y);
        }
    }
    let extent_m = axes[0].extent_m().max(axes[1].extent_m());
    if (0.0..options.smallest_extent_m).contains(&extent_m) {
        push(found, || {
            format!("the layout is only {extent_m:.2e} m in size")
        });
    }
    for axis in &axes {
        axis.check(layout, options, found);
    }
}

/// Box of the Bezier points, which is tighter than that of the B-spline control points.
fn bounds(path: PathRef<'_>) -> Option<Bounds<f64>> {
    let segments = path.runs().flat_map(|run| run.segments());
    Bounds::of_points(segments.flat_map(|segment| uniform::to_bezier(&segment)))
}

fn push(found: &mut Diagnostics, message: impl FnOnce() -> String) {
    let place = || Place::element("layout");
    found.push(Code::Implausible, place, message, REMEDY);
}

/// The least and the greatest coordinate on one axis, and the rows of their paths.
struct Axis {
    adjective: &'static str,
    name: &'static str,
    least: (f64, usize),
    greatest: (f64, usize),
}

impl Axis {
    fn new(adjective: &'static str, name: &'static str) -> Self {
        Self {
            adjective,
            name,
            least: (f64::INFINITY, 0),
            greatest: (f64::NEG_INFINITY, 0),
        }
    }

    fn add(&mut self, row: usize, least_m: f64, greatest_m: f64) {
        if least_m < self.least.0 {
            self.least = (least_m, row);
        }
        if greatest_m > self.greatest.0 {
            self.greatest = (greatest_m, row);
        }
    }

    /// Negative if there are no coordinates.
    fn extent_m(&self) -> f64 {
        self.greatest.0 - self.least.0
    }

    fn check(&self, layout: &Layout, options: &CheckOptions, found: &mut Diagnostics) {
        let path = |row| element_name("path", row, layout.paths.id(row));
        let extent_m = self.extent_m();
        if extent_m > options.largest_extent_m {
            push(found, || {
                let (from, to) = (path(self.least.1), path(self.greatest.1));
                let (extent_km, adjective) = (extent_m / 1e3, self.adjective);
                format!("the layout is {extent_km:.0} km {adjective}, from {from} to {to}")
            });
        }
        let ends = [self.least, self.greatest];
        let farthest = ends
            .into_iter()
            .max_by(|a, b| a.0.abs().total_cmp(&b.0.abs()));
        if let Some((value_m, row)) = farthest
            && extent_m >= 0.0
            && value_m.abs() > options.largest_coordinate_m
        {
            push(found, || {
                let (axis, path) = (self.name, path(row));
                format!("{path} reaches {axis} = {value_m:.3e} m")
            });
        }
    }
}
