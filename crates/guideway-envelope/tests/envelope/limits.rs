//! Limits of the clearance check: its work grows with the number of paths, not of pairs.

use guideway_envelope::{Body, ClearanceOptions, ClearanceWork, EnvelopeSource, check_clearance};
use guideway_growth::exponent;
use guideway_layout::{Layout, NewPath};
use guideway_spline::{Point, Runs};

/// A star: many paths that begin at one point, and run side by side.
fn star(paths: usize) -> Layout {
    let mut layout = Layout::default();
    for i in 0..paths {
        let end = Point::new(i as f64 + 1.0, 1.0);
        let mut runs = Runs::default();
        runs.push_bezier(&[0.0, 1.0 / 3.0, 2.0 / 3.0, 1.0].map(|t| Point::default().lerp(end, t)));
        layout.paths.push(&NewPath {
            id: &i.to_string(),
            runs: &runs,
            ..NewPath::default()
        });
    }
    layout
}

fn check(layout: &Layout, most_tests: u64) -> (ClearanceWork, bool) {
    let vehicle = EnvelopeSource::Vehicle(Body::vehicle(2.0, 1.2, 1.0));
    let options = ClearanceOptions {
        clearance_m: 0.5,
        most_tests,
        least_tests_per_path: 300,
        ..ClearanceOptions::default()
    };
    let report = check_clearance(layout, vehicle, None, &options);
    let mut found = report.findings.iter();
    let is_said = found.any(|finding| finding.place.element == "paths");
    (report.work, is_said)
}

#[test]
fn work_of_a_star_is_linear_in_its_paths() {
    let found = exponent([100, 200, 400], |paths| {
        check(&star(paths), 0).0.tests as f64
    });
    assert!(found < 1.2, "exponent {found:.2}");
}

#[test]
fn reached_limit_is_said() {
    let (work, is_said) = check(&star(100), 0);
    assert!(work.incomplete > 0 && is_said, "{work:?}");
    let (work, is_said) = check(&star(8), u64::MAX);
    assert!(work.incomplete == 0 && !is_said, "{work:?}");
}
