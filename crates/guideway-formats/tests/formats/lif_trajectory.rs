//! LIF trajectories: degree, knots, weights and control points, valid and invalid.

use guideway_layout::{Code, Layout};
use guideway_spline::Point;

use crate::common::{codes, ends};
use crate::lif_texts::{ARCH, trajectory};

#[test]
fn accepts_a_degree_with_a_decimal_point() {
    let knots = r#""knotVector": [0,0,0,0,1,1,1,1]"#;
    let whole = trajectory(&format!(r#""degree": 3, {knots}, {ARCH}"#));
    let point = trajectory(&format!(r#""degree": 3.0, {knots}, {ARCH}"#));
    assert!(whole.diagnostics.is_empty() && point.diagnostics.is_empty());
    let points = |l: &Layout| {
        l.paths
            .get(0)
            .runs()
            .flat_map(|r| r.iter())
            .collect::<Vec<_>>()
    };
    assert_eq!(points(&whole), points(&point));
    assert_eq!(points(&whole).len(), 4);
}

#[test]
fn absent_knots_default_to_uniform_clamped() {
    for knots in ["", r#""knotVector": null,"#, r#""knotVector": [],"#] {
        let layout = trajectory(&format!(r#""degree": 3, {knots} {ARCH}"#));
        assert_eq!(codes(&layout), [Code::MissingKnots]);
        assert_eq!(layout.paths.geometry().segment_count(), 1);
    }
}

#[test]
fn invalid_knots_draw_the_control_polygon_with_a_hint() {
    let cases = [
        // As many knots as for degree 2, but more at one end than it has.
        ("[0,0,0,0,1,1,1]", "7 knots"),
        ("[1,1,1,0,0,0]", "6 knots"),
        ("[0,0,0,0,1,1,1,0.5]", "knot 7 is 0.5"),
        ("[0,0,0,0,0,0,0,0]", "domain"),
        ("[0,0,0,0,1,1,1,1,1]", "9 knots"),
    ];
    for (knots, part) in cases {
        let layout = trajectory(&format!(r#""degree": 3, "knotVector": {knots}, {ARCH}"#));
        assert_eq!(layout.diagnostics.count(Code::BadKnots), 1, "{knots}");
        let finding = layout.diagnostics.iter().find(|d| d.code == Code::BadKnots);
        let message = &finding.unwrap().message;
        assert!(message.contains(part), "{knots}: {message}");
        assert_eq!(layout.paths.geometry().segment_count(), 3, "three lines");
    }
}

#[test]
fn knots_that_follow_a_known_mistake_draw_the_curve() {
    let arch = |degree: usize, knots: &str| {
        let knots = format!(r#""degree": {degree}, "knotVector": {knots}, {ARCH}"#);
        trajectory(&knots)
    };
    let points = |layout: &Layout| {
        let runs = layout.paths.get(0).runs();
        runs.flat_map(|run| run.iter()).collect::<Vec<_>>()
    };
    let right = points(&arch(3, "[0,0,0,0,1,1,1,1]"));
    for (degree, knots, mistake) in [
        (
            3,
            "[0,0,0,1,1,1]",
            "the writer leaves out the first and the last knot",
        ),
        (4, "[0,0,0,0,1,1,1,1]", "the degree is the order"),
        (3, "[0,1]", "the writer lists each knot once"),
        (3, "[0,0,0,0,0,1,1,1,1,1]", "once too often"),
    ] {
        let layout = arch(degree, knots);
        assert_eq!(points(&layout), right, "{knots}");
        assert_eq!(codes(&layout), [Code::BadKnots], "{knots}");
        let message = &layout.diagnostics.iter().next().unwrap().message;
        assert!(message.contains(mistake), "{knots}: {message}");
        // The file states no curve: a writer gives back what it stated.
        assert!(layout.paths.written_curve(0).is_none());
        assert!(layout.paths.value(0, "trajectory").is_some());
    }
    // Of degree 2, with an inner knot.
    let layout = arch(3, "[0,0,0,0.5,1,1,1]");
    let right = points(&arch(2, "[0,0,0,0.5,1,1,1]"));
    assert_eq!(points(&layout), right);
}

#[test]
fn points_of_weight_zero_pull_nothing() {
    let knots = r#""degree": 2, "knotVector": [0,0,0,1,1,1]"#;
    let points = |weights: [f64; 3]| {
        let point = |(x, y): (i32, i32), weight: f64| {
            format!(r#"{{"x": {x}, "y": {y}, "weight": {weight:?}}}"#)
        };
        let points = [(0, 0), (5, 5), (10, 0)];
        let points: Vec<_> = (0..3).map(|i| point(points[i], weights[i])).collect();
        format!(r#"{knots}, "controlPoints": [{}]"#, points.join(","))
    };
    let layout = trajectory(&points([1.0, 0.0, 1.0]));
    assert_eq!(codes(&layout), []);
    let runs = layout.paths.get(0).runs();
    assert!(
        runs.flat_map(|run| run.iter())
            .all(|point| point.y.abs() < 1e-12)
    );
    assert_eq!(
        ends(&layout, "E"),
        (Point::new(0.0, 0.0), Point::new(10.0, 0.0))
    );
    // Without an end, the curve is a line from the next point on.
    for (weights, from, to) in [
        ([0.0, 1.0, 1.0], (5.0, 5.0), (10.0, 0.0)),
        ([1.0, 2.0, 0.0], (0.0, 0.0), (5.0, 5.0)),
    ] {
        let layout = trajectory(&points(weights));
        let expected = [from, to].map(|(x, y)| Point::new(x, y));
        let (from, to) = ends(&layout, "E");
        let apart = from.distance(expected[0]).max(to.distance(expected[1]));
        assert!(apart < 1e-12, "{weights:?}: {from:?} to {to:?}");
        let [start, end] = expected;
        let aside = |p: Point<f64>| (p - start).cross(end - start).abs();
        let mut drawn = layout.paths.get(0).runs().flat_map(|run| run.iter());
        assert!(drawn.all(|p| aside(p) < 1e-9), "{weights:?}");
        assert_eq!(codes(&layout), [Code::BadWeight], "{weights:?}");
        assert!(layout.paths.written_curve(0).is_some(), "{weights:?}");
    }
    // Weights that are all zero define no curve.
    for weights in [[0.0; 3], [1.0, -1.0, 1.0]] {
        let layout = trajectory(&points(weights));
        assert_eq!(codes(&layout), [Code::BadWeight], "{weights:?}");
        assert!(layout.paths.value(0, "trajectory").is_some(), "{weights:?}");
    }
}

#[test]
fn draws_unclamped_knots_as_stated() {
    let layout = trajectory(&format!(
        r#""degree": 3, "knotVector": [0,1,2,3,4,5,6,7], {ARCH}"#
    ));
    assert_eq!(codes(&layout), [Code::UnclampedKnots]);
    let (start, _) = ends(&layout, "E");
    assert!(
        start.distance(Point::new(10.0 / 6.0, 25.0 / 6.0)) < 1e-12,
        "{start:?}"
    );
}

#[test]
fn invalid_weight_counts_as_one() {
    for weight in ["-0.5", "-1", "\"x\""] {
        let points = ARCH.replacen(r#""y":5"#, &format!(r#""y":5,"weight":{weight}"#), 1);
        let layout = trajectory(&format!(
            r#""degree": 3, "knotVector": [0,0,0,0,1,1,1,1], {points}"#
        ));
        let expected = if weight == "\"x\"" {
            Code::WrongType
        } else {
            Code::BadWeight
        };
        assert_eq!(codes(&layout), [expected], "{weight}");
        assert_eq!(layout.paths.geometry().segment_count(), 1);
    }
}

#[test]
fn applies_weights() {
    // A quarter circle: the standard quadratic with the middle weight at cos 45 degrees.
    let layout = trajectory(
        r#""degree": 2, "knotVector": [0,0,0,1,1,1], "controlPoints":
           [{"x":0,"y":0},{"x":10,"y":0,"weight":0.7071067811865476},{"x":10,"y":10}]"#,
    );
    let center = Point::new(0.0, 10.0);
    for run in layout.paths.get(0).runs() {
        for segment in run.segments() {
            let middle = guideway_spline::uniform::point(&segment, 0.5);
            assert!((middle.distance(center) - 10.0).abs() < 1e-4);
        }
    }
}

#[test]
fn trajectory_without_points_draws_the_straight_line() {
    for points in [
        "",
        r#""controlPoints": []"#,
        r#""controlPoints": [{"x":1,"y":1}]"#,
    ] {
        let layout = trajectory(points);
        assert_eq!(layout.diagnostics.count(Code::TooFewPoints), 1, "{points}");
        assert_eq!(
            ends(&layout, "E"),
            (Point::new(0.0, 0.0), Point::new(10.0, 0.0))
        );
    }
}

#[test]
fn weighted_curve_obeys_the_point_budget() {
    // Coordinates for which the tolerance is unreachable: each span would convert to 1,000 cubics.
    let curve = |weights: i64| {
        let points: Vec<String> = (0..1_000)
            .map(|i| {
                let (x, weight) = (i % 2 * 900_000_000, i % weights + 1);
                format!(r#"{{"x":{x},"y":9e8,"weight":{weight}}}"#)
            })
            .collect();
        let knots: Vec<String> = (0..1_004_i64)
            .map(|i| i.clamp(3, 1_000).to_string())
            .collect();
        format!(
            r#""degree": 3, "knotVector": [{}], "controlPoints": [{}]"#,
            knots.join(","),
            points.join(",")
        )
    };
    let layout = trajectory(&curve(7));
    assert!(codes(&layout).contains(&Code::ApproximateShape));
    assert_eq!(
        layout.paths.geometry().segment_count(),
        999,
        "the control polygon"
    );
    let layout = trajectory(&curve(1));
    assert!(
        codes(&layout).is_empty(),
        "one without weights is exact and small"
    );
}
