//! Builder of small layouts with defects.

use guideway_layout::{Layout, NewPath};
use guideway_spline::{Point, Runs};

/// Builder of a layout.
#[derive(Default)]
pub(crate) struct Sketch {
    pub(crate) layout: Layout,
}

impl Sketch {
    /// A straight and a bent path between two nodes, without findings.
    pub(crate) fn clean() -> Self {
        let mut sketch = Self::default();
        sketch.node("a", p(0.0, 0.0));
        sketch.node("b", p(10.0, 0.0));
        let mut bent = Runs::default();
        bent.push_bezier(&[p(10.0, 0.0), p(14.0, 0.0), p(-4.0, 8.0), p(0.0, 0.0)]);
        sketch.path("straight", &line_runs(p(0.0, 0.0), p(10.0, 0.0)), "a", "b");
        sketch.path("bent", &bent, "b", "a");
        sketch
    }

    pub(crate) fn node(&mut self, id: &str, at: Point<f64>) {
        self.layout.nodes.push(id, at, None);
    }

    /// Adds a path between two nodes.
    pub(crate) fn path(&mut self, id: &str, runs: &Runs, start: &str, end: &str) {
        let nodes = &self.layout.nodes;
        let row = |id| (0..nodes.len() as u32).find(|&node| nodes.id(node) == id);
        let (start_node, end_node) = (row(start), row(end));
        self.layout.paths.push(&NewPath {
            id,
            runs,
            start_node,
            end_node,
            ..NewPath::default()
        });
    }

    /// Adds a path without nodes.
    pub(crate) fn free_path(&mut self, id: &str, runs: &Runs) {
        self.layout.paths.push(&NewPath {
            id,
            runs,
            ..NewPath::default()
        });
    }
}

pub(crate) fn p(x: f64, y: f64) -> Point<f64> {
    Point::new(x, y)
}

pub(crate) fn runs_of(points: &[Point<f64>]) -> Runs {
    let mut runs = Runs::default();
    runs.push(points);
    runs
}

pub(crate) fn line_runs(start: Point<f64>, end: Point<f64>) -> Runs {
    let mut runs = Runs::default();
    runs.push_line(start, end);
    runs
}
