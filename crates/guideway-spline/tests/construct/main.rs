//! Curves that are built, cut, joined and rounded have the right shape, or say why not.

#[path = "../common/mod.rs"]
mod common;

mod arcs;
mod cuts;
mod fillets;
mod splines;

use common::P;
use guideway_spline::{Point, Runs, bezier, uniform};

fn p(x: f64, y: f64) -> P {
    Point::new(x, y)
}

fn line(from: P, to: P) -> Runs {
    let mut runs = Runs::default();
    runs.push_line(from, to);
    runs
}

/// Unit directions at the start and at the end.
fn directions(runs: &Runs) -> [P; 2] {
    let beziers: Vec<_> = runs.segments().map(uniform::to_bezier).collect();
    let start = bezier::start_direction(&beziers[0]).expect("a curve with a length");
    [
        start,
        bezier::end_direction(beziers.last().expect("a curve")).expect("a curve with a length"),
    ]
}

fn samples(runs: &Runs, count: usize) -> Vec<P> {
    runs.iter()
        .flat_map(|run| common::run_samples(run, count))
        .collect()
}
