//! Check reports each planted defect, and nothing in a clean layout.

use crate::sketch::{Sketch, line_runs, p, runs_of};
use guideway_layout::{CheckOptions, Code, Diagnostics, Level, NewPath, check};
use guideway_spline::Runs;

pub(crate) fn found(sketch: &Sketch) -> Diagnostics {
    check(&sketch.layout, &CheckOptions::default())
}

/// The codes of the findings with their counts.
pub(crate) fn codes(found: &Diagnostics) -> Vec<(Code, u64)> {
    found.counts().collect()
}

pub(crate) fn only(found: &Diagnostics, code: Code) -> (String, String) {
    assert_eq!(codes(found), [(code, 1)], "{found:?}");
    let finding = found.iter().next().expect("one finding");
    (finding.place.to_string(), finding.message.clone())
}

#[test]
fn clean_layout_has_no_findings() {
    assert!(found(&Sketch::clean()).is_empty());
    assert!(found(&Sketch::default()).is_empty());
}

#[test]
fn reports_the_distance_between_end_and_node() {
    let mut sketch = Sketch::clean();
    sketch.path("off", &line_runs(p(0.0, 0.02), p(10.25, 0.0)), "a", "b");
    let found = found(&sketch);
    assert_eq!(codes(&found), [(Code::NodeGap, 2)]);
    let messages: Vec<_> = found.iter().map(|d| d.message.as_str()).collect();
    assert!(messages[0].contains("begins at (0.000, 0.020) m, 0.020 m from node \"a\""));
    assert!(messages[1].contains("0.250 m from node \"b\" at (10.000, 0.000) m"));
}

#[test]
fn accepts_a_gap_within_the_tolerance() {
    let mut sketch = Sketch::clean();
    sketch.path("off", &line_runs(p(0.0, 0.009), p(10.0, 0.0)), "a", "b");
    assert!(found(&sketch).is_empty());
    let strict = CheckOptions {
        gap_tolerance_m: Some(0.005),
        ..CheckOptions::default()
    };
    assert_eq!(check(&sketch.layout, &strict).count(Code::NodeGap), 1);
}

#[test]
fn reports_a_node_without_paths() {
    let mut sketch = Sketch::clean();
    sketch.node("alone", p(5.0, 5.0));
    assert_eq!(only(&found(&sketch), Code::UnusedNode).0, "node \"alone\"");
}

#[test]
fn reports_a_path_to_another_level() {
    let mut sketch = Sketch::default();
    for id in ["ground", "roof"] {
        sketch.layout.levels.push(Level {
            id: id.to_owned(),
            ..Level::default()
        });
    }
    let start = sketch.layout.nodes.push("a", p(0.0, 0.0), Some(0));
    let end = sketch.layout.nodes.push("b", p(10.0, 0.0), Some(1));
    sketch.layout.paths.push(&NewPath {
        id: "lift",
        runs: &line_runs(p(0.0, 0.0), p(10.0, 0.0)),
        start_node: Some(start),
        end_node: Some(end),
        ..NewPath::default()
    });
    let (place, message) = only(&found(&sketch), Code::CrossLevel);
    assert_eq!(place, "path \"lift\"");
    assert!(message.contains("from level \"ground\" to level \"roof\""));
}

#[test]
fn corner_between_runs_is_a_kink() {
    let mut sketch = Sketch::clean();
    let mut runs = line_runs(p(0.0, 50.0), p(4.0, 50.0));
    runs.push_line(p(4.0, 50.0), p(4.0, 57.0));
    runs.push_line(p(4.0, 57.0), p(9.0, 58.0));
    sketch.free_path("corner", &runs);
    let (place, message) = only(&found(&sketch), Code::Kink);
    assert_eq!(place, "path \"corner\"");
    assert_eq!(
        message,
        "the direction jumps by 90.0 degrees at (4.000, 50.000) m, and at another place"
    );
}

#[test]
fn slight_bend_between_runs_is_no_kink() {
    let mut sketch = Sketch::clean();
    let mut runs = line_runs(p(0.0, 50.0), p(4.0, 50.0));
    runs.push_line(p(4.0, 50.0), p(8.0, 50.3));
    sketch.free_path("bend", &runs);
    assert!(found(&sketch).is_empty());
    let strict = CheckOptions {
        kink_angle_rad: 0.07,
        ..CheckOptions::default()
    };
    assert_eq!(check(&sketch.layout, &strict).count(Code::Kink), 1);
}

#[test]
fn triple_control_point_is_a_kink() {
    let (a, corner, b) = (p(0.0, 50.0), p(5.0, 50.0), p(5.0, 55.0));
    let mut sketch = Sketch::clean();
    sketch.free_path(
        "triple",
        &runs_of(&[a, a, a, corner, corner, corner, b, b, b]),
    );
    let (_, message) = only(&found(&sketch), Code::Kink);
    assert!(
        message.contains("90.0 degrees at (5.000, 50.000) m"),
        "{message}"
    );
    // A double control point makes no kink: the curve cuts the corner.
    let mut smooth = Sketch::clean();
    smooth.free_path("double", &runs_of(&[a, a, a, corner, corner, b, b, b]));
    assert!(found(&smooth).is_empty());
}

#[test]
fn further_repetitions_of_a_control_point_change_nothing() {
    let (a, b, c) = (p(0.0, 50.0), p(5.0, 50.0), p(9.0, 50.0));
    let mut sketch = Sketch::clean();
    sketch.free_path("stop", &runs_of(&[a, a, a, a, b, b, b, b, b, c, c, c, c]));
    assert!(found(&sketch).is_empty());
}

#[test]
fn cusp_inside_a_segment_is_a_kink() {
    let mut line = Runs::default();
    line.push_bezier(&[p(0.0, 50.0), p(9.0, 50.0), p(-2.0, 50.0), p(5.0, 50.0)]);
    let mut cusp = Runs::default();
    cusp.push_bezier(&[p(0.0, 60.0), p(4.0, 64.0), p(0.0, 64.0), p(4.0, 60.0)]);
    let mut sketch = Sketch::clean();
    sketch.free_path("line", &line);
    sketch.free_path("cusp", &cusp);
    let found = found(&sketch);
    assert_eq!(codes(&found), [(Code::Kink, 2)]);
    assert!(
        found.iter().all(|d| d.message.contains("180.0 degrees")),
        "{found:?}"
    );
    assert!(
        found
            .iter()
            .any(|d| d.message.contains("(2.000, 63.000) m")),
        "{found:?}"
    );
}

#[test]
fn line_with_zero_end_speed_is_smooth() {
    // Far from the origin, the speed at the ends is nothing but rounding error of the handles.
    let (a, b) = (p(512_345.678, 5_401_234.567), p(512_357.891, 5_401_239.123));
    let mut runs = Runs::default();
    runs.push_bezier(&[a, a, b, b]);
    runs.push_bezier(&[b, b, b + (b - a), b + (b - a)]);
    let mut sketch = Sketch::default();
    sketch.free_path("far", &runs);
    let options = CheckOptions {
        min_radius_m: Some(1.0),
        ..CheckOptions::default()
    };
    let found = check(&sketch.layout, &options);
    assert!(found.is_empty(), "{found:?}");
}

#[test]
fn reports_the_radius_of_a_tight_bend() {
    let mut sketch = Sketch::default();
    // The radius of the parabola y = a x^2 is smallest at its apex, 1 / (2 a).
    let mut runs = Runs::default();
    runs.push_quadratic(&[p(-2.0, 54.0), p(0.0, 46.0), p(2.0, 54.0)]);
    sketch.free_path("parabola", &runs);
    assert!(found(&sketch).is_empty());
    let with_radius = |radius_m| CheckOptions {
        min_radius_m: Some(radius_m),
        ..CheckOptions::default()
    };
    assert!(check(&sketch.layout, &with_radius(0.5)).is_empty());
    let (place, message) = only(&check(&sketch.layout, &with_radius(0.51)), Code::Curvature);
    assert_eq!(place, "path \"parabola\"");
    assert!(
        message.contains("0.500 m at (0.000, 50.000) m"),
        "{message}"
    );
}

#[test]
fn gap_inside_a_path_is_no_kink() {
    let mut sketch = Sketch::clean();
    let mut runs = line_runs(p(0.0, 50.0), p(4.0, 50.0));
    runs.push_line(p(4.0, 51.5), p(4.0, 57.0));
    sketch.free_path("broken", &runs);
    let (place, message) = only(&found(&sketch), Code::BrokenPath);
    assert_eq!(place, "path \"broken\"");
    assert_eq!(message, "gap of 1.500 m at (4.000, 50.000) m");
}

#[test]
fn reports_a_path_without_length() {
    let mut sketch = Sketch::clean();
    sketch.free_path("dot", &line_runs(p(3.0, 4.0), p(3.0, 4.0)));
    let (place, message) = only(&found(&sketch), Code::ZeroLength);
    assert_eq!(
        (place.as_str(), message.as_str()),
        ("path \"dot\"", "the whole path is at (3.000, 4.000) m")
    );
}

#[test]
fn reports_each_duplicate_identifier_once() {
    let mut sketch = Sketch::clean();
    for x in [1.0, 2.0, 3.0] {
        sketch.free_path("twin", &line_runs(p(x, 20.0), p(x, 30.0)));
        sketch.free_path("", &line_runs(p(x, 40.0), p(x, 50.0)));
        sketch.layout.stations.push("dock", None, Vec::new(), None);
    }
    sketch.node("a", p(0.0, 0.0));
    let found = found(&sketch);
    assert_eq!(found.count(Code::DuplicateId), 3);
    let places: Vec<_> = found.iter().map(|d| d.place.to_string()).collect();
    assert_eq!(
        places[..3],
        ["path \"twin\"", "node \"a\"", "station \"dock\""]
    );
    assert!(found.iter().next().unwrap().message.starts_with("3 paths"));
}

#[test]
fn reports_sizes_that_suggest_another_unit() {
    let of = |x0: f64, x1: f64| {
        let mut sketch = Sketch::default();
        sketch.free_path("first", &line_runs(p(x0, 0.0), p(x0 + 0.001, 0.0)));
        sketch.free_path("last", &line_runs(p(x1, 0.0), p(x1 + 0.001, 0.0)));
        found(&sketch)
    };
    assert!(of(0.0, 90_000.0).is_empty());
    let (place, wide) = only(&of(0.0, 150_000.0), Code::Implausible);
    assert_eq!(place, "layout");
    assert_eq!(
        wide,
        "the layout is 150 km wide, from path \"first\" to path \"last\""
    );
    let (_, far) = only(&of(-2e7, -2e7 + 5.0), Code::Implausible);
    assert_eq!(far, "path \"first\" reaches x = -2.000e7 m");
    let (_, small) = only(&of(0.0, 0.005), Code::Implausible);
    assert_eq!(small, "the layout is only 6.00e-3 m in size");
}

#[test]
fn counts_findings_beyond_the_stored_ones() {
    let mut sketch = Sketch::clean();
    for i in 0..50 {
        let y = 20.0 + f64::from(i);
        sketch.free_path("", &line_runs(p(1.0, y), p(1.0, y)));
    }
    let options = CheckOptions {
        diagnostics_per_code: 3,
        ..CheckOptions::default()
    };
    let found = check(&sketch.layout, &options);
    assert_eq!(
        (found.count(Code::ZeroLength), found.iter().count()),
        (50, 3)
    );
    assert_eq!(found.iter().next().unwrap().place.element, "path number 3");
}
