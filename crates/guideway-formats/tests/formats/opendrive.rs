//! OpenDRIVE: the real files, and lanes beside lines, arcs, spirals and polynomials.

use crate::common::{assert_counts, codes, count, ends, read, real_layouts};
use guideway_formats::{ReadOptions, read_file};
use guideway_layout::{Code, Layout, Value};
use guideway_spline::{Point, nearest_on_run};

/// Counts as the list of sources of the real layouts has them, made by another program.
const REAL: &[(&str, &str)] = &[
    (
        "fabriksgatan.xodr",
        "roads 16, junctions 1, lanes 60, paramPoly3 16, arc 8",
    ),
    ("jolengatan.xodr", "roads 1, lanes 7, paramPoly3 19"),
    (
        "multi_intersections.xodr",
        "roads 63, junctions 5, lanes 305, line 95, spiral 56, arc 32",
    ),
    (
        "soderleden.xodr",
        "roads 5, junctions 1, lanes 40, paramPoly3 16, arc 1",
    ),
];

const COUNTED: &[&str] = &[
    "roads",
    "junctions",
    "lanes",
    "line",
    "arc",
    "spiral",
    "poly3",
    "paramPoly3",
];

#[test]
fn real_files_have_the_counts_of_their_sources() {
    for (file, expected) in REAL {
        let Some(folder) = real_layouts("opendrive") else {
            return;
        };
        let layout = read_file(&folder.join(file), &ReadOptions::default()).unwrap();
        assert_counts(&layout, COUNTED, expected, file);
        // The lane in the middle of each section has no width and is not drawn.
        let text = std::fs::read_to_string(folder.join(file)).unwrap();
        let middles = text.matches("<center>").count();
        assert_eq!(
            layout.paths.len() + middles,
            count(&layout, "lanes") as usize,
            "{file}"
        );
        assert!(layout.refused.is_empty(), "{file}");
        assert!(!codes(&layout).contains(&Code::ApproximateShape), "{file}");
    }
}

fn road(geometry: &str, offset: &str, width: &str) -> String {
    format!(
        r#"<OpenDRIVE><header revMajor="1" revMinor="6"/><road id="R" name="Street"><planView>{geometry}</planView>
        <lanes>{offset}<laneSection s="0">
        <left><lane id="1" type="driving">{width}</lane></left><center><lane id="0"/></center>
        <right><lane id="-1" type="walking">{width}</lane></right></laneSection></lanes></road></OpenDRIVE>"#
    )
}

fn geometry(length: f64, shape: &str) -> String {
    format!(r#"<geometry s="0" x="0" y="0" hdg="0" length="{length}">{shape}</geometry>"#)
}

const WIDTH: &str = r#"<width sOffset="0" a="4" b="0" c="0" d="0"/>"#;

fn assert_ends(layout: &Layout, id: &str, expected: [(f64, f64); 2]) {
    let (start, end) = ends(layout, id);
    let [from, to] = expected.map(|(x, y)| Point::new(x, y));
    assert!(
        start.distance(from) < 1e-9 && end.distance(to) < 1e-9,
        "{id}: {start:?} to {end:?}, not {from:?} to {to:?}"
    );
}

#[test]
fn lanes_lie_beside_a_line_and_come_toward_on_the_left() {
    let layout = read(&road(&geometry(50.0, "<line/>"), "", WIDTH));
    assert_ends(&layout, "R.0.1", [(50.0, 2.0), (0.0, 2.0)]);
    assert_ends(&layout, "R.0.-1", [(0.0, -2.0), (50.0, -2.0)]);
    assert_eq!(
        layout.paths.geometry().segment_count(),
        2,
        "a line is one piece"
    );
    let kind = layout.paths.attributes.get("type").unwrap();
    assert_eq!(kind.values.get(0), Some(Value::Text("driving")));
    assert!(codes(&layout).is_empty());
    let layout =
        read(&road(&geometry(50.0, "<line/>"), "", WIDTH).replace("<road", "<road rule=\"LHT\""));
    assert_ends(&layout, "R.0.1", [(0.0, 2.0), (50.0, 2.0)]);
}

#[test]
fn a_lane_beside_a_quarter_circle_is_one() {
    let quarter = 50.0 * std::f64::consts::FRAC_PI_2;
    let layout = read(&road(
        &geometry(quarter, r#"<arc curvature="0.02"/>"#),
        "",
        WIDTH,
    ));
    assert_ends(&layout, "R.0.-1", [(0.0, -2.0), (52.0, 50.0)]);
    for run in layout.paths.get(1).runs() {
        for segment in run.segments() {
            for i in 0..=8 {
                let p = guideway_spline::uniform::point(&segment, f64::from(i) / 8.0);
                assert!((p.distance(Point::new(0.0, 50.0)) - 52.0).abs() < 1e-4);
            }
        }
    }
}

#[test]
fn the_middle_is_drawn_where_there_is_no_other_lane() {
    let text = road(
        &geometry(50.0, "<line/>"),
        r#"<laneOffset s="0" a="3" b="0" c="0" d="0"/>"#,
        "",
    );
    let start = text.find("<left>").unwrap();
    let end = text.find("</laneSection>").unwrap();
    let text = [
        &text[..start],
        "<center><lane id=\"0\"/></center>",
        &text[end..],
    ]
    .concat();
    assert_ends(&read(&text), "R.0.0", [(0.0, 3.0), (50.0, 3.0)]);
}

#[test]
fn borders_are_measured_from_the_middle() {
    let text = road(
        &geometry(50.0, "<line/>"),
        "",
        &WIDTH.replace("width", "border"),
    );
    assert_ends(&read(&text), "R.0.1", [(50.0, 2.0), (0.0, 2.0)]);
}

#[test]
fn a_normalized_polynomial_and_one_by_length_are_the_same() {
    let by_length = r#"<paramPoly3 pRange="arcLength" aU="0" bU="1" cU="0" dU="0" aV="0" bV="0" cV="0.01" dV="0"/>"#;
    let normalized = r#"<paramPoly3 pRange="normalized" aU="0" bU="20" cU="0" dU="0" aV="0" bV="0" cV="4" dV="0"/>"#;
    let [a, b] =
        [by_length, normalized].map(|shape| read(&road(&geometry(20.0, shape), "", WIDTH)));
    for id in ["R.0.1", "R.0.-1"] {
        let ((s, e), (t, f)) = (ends(&a, id), ends(&b, id));
        assert!(s.distance(t) < 1e-9 && e.distance(f) < 1e-9);
    }
}

/// Where the lane with the offset t(s) to the left is, by small steps along the heading.
fn walked(length: f64, heading: impl Fn(f64) -> f64, t: impl Fn(f64) -> f64) -> Vec<Point<f64>> {
    const STEPS: u32 = 20_000;
    let step = length / f64::from(STEPS);
    let direction = |s: f64| {
        let (sin, cos) = heading(s).sin_cos();
        Point::new(cos, sin)
    };
    let mut at = Point::new(0.0, 0.0);
    let mut points = Vec::new();
    for i in 0..=STEPS {
        let s = f64::from(i) * step;
        let ahead = direction(s);
        if i % 100 == 0 {
            points.push(at + Point::new(-ahead.y, ahead.x) * t(s));
        }
        // Simpson's rule.
        at = at + (ahead + direction(s + step / 2.0) * 4.0 + direction(s + step)) * (step / 6.0);
    }
    points
}

/// That no point is farther from a path than the tolerance.
fn assert_on_path(layout: &Layout, id: &str, points: &[Point<f64>]) {
    let path = layout.paths.iter().find(|p| p.id() == id).unwrap();
    let runs: Vec<Vec<Point<f64>>> = path.runs().map(|run| run.iter().collect()).collect();
    for &point in points {
        let distances = runs
            .iter()
            .filter_map(|run| nearest_on_run(run, point, 1e-7));
        let nearest = distances.map(|n| n.distance).fold(f64::INFINITY, f64::min);
        assert!(nearest < 1e-4, "{id}: {nearest} m at {point:?}");
    }
}

#[test]
fn lanes_beside_spirals_and_polynomials_are_within_the_tolerance() {
    let offset = r#"<laneOffset s="0" a="0.5" b="0.02" c="0" d="0"/><laneOffset s="40" a="1.3" b="0" c="0" d="0"/>"#;
    let width = r#"<width sOffset="0" a="3" b="0" c="0.001" d="-0.000005"/>"#;
    let shift = |s: f64| if s < 40.0 { 0.5 + 0.02 * s } else { 1.3 };
    let half = |s: f64| 0.5 * (3.0 + 0.001 * s * s - 0.000_005 * s.powi(3));
    let spiral = r#"<spiral curvStart="-0.03" curvEnd="0.08"/>"#;
    let layout = read(&road(&geometry(100.0, spiral), offset, width));
    let heading = |s: f64| -0.03 * s + 0.5 * 0.0011 * s * s;
    assert_on_path(
        &layout,
        "R.0.1",
        &walked(100.0, heading, |s| shift(s) + half(s)),
    );
    assert_on_path(
        &layout,
        "R.0.-1",
        &walked(100.0, heading, |s| shift(s) - half(s)),
    );

    // A parabola by its parameter, which is not its length: the offset goes by the parameter as well.
    let parabola = r#"<paramPoly3 pRange="arcLength" aU="0" bU="1" cU="0" dU="0" aV="0" bV="0" cV="0.004" dV="0"/>"#;
    let layout = read(&road(&geometry(100.0, parabola), offset, width));
    for (id, side) in [("R.0.1", 1.0), ("R.0.-1", -1.0)] {
        let points: Vec<Point<f64>> = (0..=200)
            .map(|i| {
                let s = f64::from(i) / 2.0;
                let slope = 0.008 * s;
                let left = Point::new(-slope, 1.0) * (1.0 / 1_f64.hypot(slope));
                Point::new(s, 0.004 * s * s) + left * (shift(s) + side * half(s))
            })
            .collect();
        assert_on_path(&layout, id, &points);
    }
}

#[test]
fn poly3_is_as_long_as_it_says() {
    // A slope of 3 in 4.
    let slope = r#"<poly3 a="0" b="0.75" c="0" d="0"/>"#;
    let layout = read(&road(&geometry(50.0, slope), "", WIDTH));
    let (start, end) = ends(&layout, "R.0.-1");
    assert!((start.distance(end) - 50.0).abs() < 1e-9);
    assert!(start.distance(Point::new(1.2, -1.6)) < 1e-9, "{start:?}");
}
