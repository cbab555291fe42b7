//! Chains of short lines become curves within a tolerance.

use guideway_network::BuildOptions;
use guideway_spline::{Point, Runs, nearest_on_run};

use crate::sketch::{add_line, add_runs, drawing, network, split};

#[test]
fn short_lines_become_a_curve_within_the_tolerance() {
    let mut layout = drawing(&[]);
    let at = |i: u32| {
        let angle = f64::from(i) * std::f64::consts::FRAC_PI_2 / 40.0;
        Point::new(5.0 * angle.cos(), 5.0 * angle.sin())
    };
    for i in 0..40 {
        let (a, b) = (at(i), at(i + 1));
        // Every third line is drawn the other way round.
        let line = if i % 3 == 0 {
            [b.x, b.y, a.x, a.y]
        } else {
            [a.x, a.y, b.x, b.y]
        };
        add_line(&mut layout, line, "TRACK");
    }
    let options = BuildOptions {
        smooth_m: Some(0.005),
        ..split()
    };
    let made = network(&layout, &options);
    assert_eq!((made.layout.paths.len(), made.layout.nodes.len()), (1, 2));
    assert!(made.report.smoothed_curves <= 4, "{:?}", made.report);
    let path = made.layout.paths.get(0);
    for i in 0..=40 {
        let near = path.runs().map(|run| {
            let run: Vec<_> = run.iter().collect();
            nearest_on_run(&run, at(i), 1e-6).unwrap().distance
        });
        let near_m = near.fold(f64::INFINITY, f64::min);
        assert!(near_m <= 0.005 + 1e-6, "vertex {i}: {near_m}");
    }
}

#[test]
fn corners_and_long_lines_are_not_smoothed() {
    let mut layout = drawing(&[]);
    let corners = [(0.0, 0.0), (5.0, 0.0), (5.0, 5.0), (10.0, 6.0)];
    let corners = corners.map(|(x, y)| Point::new(x, y));
    let mut runs = Runs::default();
    guideway_spline::polyline_to_runs(&corners, &mut runs);
    add_runs(&mut layout, &runs, "TRACK");
    let options = BuildOptions {
        smooth_m: Some(0.01),
        ..split()
    };
    assert_eq!(network(&layout, &options).report.smoothed_lines, 0);
}
