//! Tests of the OpenDRIVE reader: real files, and lanes beside lines, arcs, spirals and
//! polynomials.

use crate::common::{assert_counts, codes, count, ends, read, real_layouts};
use guideway_formats::{ReadOptions, read_file};
use guideway_layout::{Code, Layout, Value};
use guideway_spline::{Point, nearest_on_run};

/// Element counts per file from the list of sources, made by another program.
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
fn real_files_have_the_expected_counts() {
    for (file, expected) in REAL {
        let Some(folder) = real_layouts("opendrive") else {
            return;
        };
        let layout = read_file(&folder.join(file), &ReadOptions::default()).unwrap();
        assert_counts(&layout, COUNTED, expected, file);
        // The center lane of each section has no width and is not drawn.
        let text = std::fs::read_to_string(folder.join(file)).unwrap();
        let center_lanes = text.matches("<center>").count();
        assert_eq!(
            layout.paths.len() + center_lanes,
            count(&layout, "lanes") as usize,
            "{file}"
        );
        assert!(layout.refused.is_empty(), "{file}");
        assert!(!codes(&layout).contains(&Code::ApproximateShape), "{file}");
    }
}

fn road(geometry: &str, offset: &str, width: &str) -> String {
    format!(
        r#"<OpenDRIVE><header revMajor="1" revMinor="6"/>
        <road id="R" name="Street"><planView>{geometry}</planView>
        <lanes>{offset}<laneSection s="0">
        <left><lane id="1" type="driving">{width}</lane></left>
        <center><lane id="0"/></center>
        <right><lane id="-1" type="walking">{width}</lane></right></laneSection></lanes>
        </road></OpenDRIVE>"#
    )
}

fn geometry(length: f64, shape: &str) -> String {
    format!(r#"<geometry s="0" x="0" y="0" hdg="0" length="{length}">{shape}</geometry>"#)
}

/// The parabola u = b p, v = c p^2.
fn param_poly3(range: &str, b: f64, c: f64) -> String {
    format!(
        "<paramPoly3 pRange='{range}' aU='0' bU='{b}' cU='0' dU='0' \
         aV='0' bV='0' cV='{c}' dV='0'/>"
    )
}

/// A constant lane width of 4 m.
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
fn offsets_lanes_from_a_line_and_reverses_left_ones() {
    let layout = read(&road(&geometry(50.0, "<line/>"), "", WIDTH));
    assert_ends(&layout, "R.0.1", [(50.0, 2.0), (0.0, 2.0)]);
    assert_ends(&layout, "R.0.-1", [(0.0, -2.0), (50.0, -2.0)]);
    assert_eq!(
        layout.paths.geometry().segment_count(),
        2,
        "one segment per lane"
    );
    let kind = layout.paths.attributes.get("type").unwrap();
    assert_eq!(kind.values.get(0), Some(Value::Text("driving")));
    assert!(codes(&layout).is_empty());
    let layout =
        read(&road(&geometry(50.0, "<line/>"), "", WIDTH).replace("<road", "<road rule=\"LHT\""));
    assert_ends(&layout, "R.0.1", [(0.0, 2.0), (50.0, 2.0)]);
}

#[test]
fn speed_limits_are_in_meters_per_second() {
    let speed = |of_road: &str, of_lane: &str| {
        let text = road(&geometry(50.0, "<line/>"), "", &format!("{WIDTH}{of_lane}"));
        let kind = format!("<type s=\"0\" type=\"town\">{of_road}</type><planView>");
        let layout = read(&text.replacen("<planView>", &kind, 1));
        let value = |name| {
            layout
                .paths
                .attributes
                .value(0, name)
                .map(|v| v.to_string())
        };
        (value("maxSpeed"), value("speed"), codes(&layout))
    };
    let some = |text: &str| Some(text.to_owned());
    let kmh = r#"<speed max="36" unit="km/h"/>"#;
    assert_eq!(speed(kmh, ""), (some("10"), None, vec![]));
    let si = r#"<speed sOffset="0" max="2"/>"#;
    assert_eq!(speed(kmh, si), (some("2"), None, vec![]));
    let none = r#"<speed max="no limit" unit="mph"/>"#;
    assert_eq!(speed(none, ""), (None, None, vec![]));
    let two = r#"<speed sOffset="0" max="2"/><speed sOffset="9" max="1"/>"#;
    let (least, _, found) = speed(none, two);
    assert_eq!(least, some("1"));
    assert!(found.contains(&Code::Attribute), "{found:?}");
    let (speed, text, found) = speed(r#"<speed max="9" unit="knots"/>"#, "");
    assert_eq!((speed, text), (None, some("9 knots")));
    assert!(found.contains(&Code::UnknownValue), "{found:?}");
}

#[test]
fn lane_beside_an_arc_is_an_arc() {
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
fn draws_the_center_lane_of_a_road_without_other_lanes() {
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
fn measures_borders_from_the_center_lane() {
    let text = road(
        &geometry(50.0, "<line/>"),
        "",
        &WIDTH.replace("width", "border"),
    );
    assert_ends(&read(&text), "R.0.1", [(50.0, 2.0), (0.0, 2.0)]);
}

#[test]
fn normalized_and_arc_length_polynomials_agree() {
    let by_length = param_poly3("arcLength", 1.0, 0.01);
    let normalized = param_poly3("normalized", 20.0, 4.0);
    let [a, b] =
        [by_length, normalized].map(|shape| read(&road(&geometry(20.0, &shape), "", WIDTH)));
    for id in ["R.0.1", "R.0.-1"] {
        let ((s, e), (t, f)) = (ends(&a, id), ends(&b, id));
        assert!(s.distance(t) < 1e-9 && e.distance(f) < 1e-9);
    }
}

/// Points of the curve with the left offset t(s), by integrating the heading in small steps.
fn integrated(
    length: f64,
    heading: impl Fn(f64) -> f64,
    t: impl Fn(f64) -> f64,
) -> Vec<Point<f64>> {
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

/// Asserts that all points are within the tolerance of a path.
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
fn lanes_beside_spirals_and_polynomials_stay_within_the_tolerance() {
    let offset = r#"<laneOffset s="0" a="0.5" b="0.02" c="0" d="0"/>
        <laneOffset s="40" a="1.3" b="0" c="0" d="0"/>"#;
    let width = r#"<width sOffset="0" a="3" b="0" c="0.001" d="-0.000005"/>"#;
    let shift = |s: f64| if s < 40.0 { 0.5 + 0.02 * s } else { 1.3 };
    let half = |s: f64| 0.5 * (3.0 + 0.001 * s * s - 0.000_005 * s.powi(3));
    let spiral = r#"<spiral curvStart="-0.03" curvEnd="0.08"/>"#;
    let layout = read(&road(&geometry(100.0, spiral), offset, width));
    let heading = |s: f64| -0.03 * s + 0.5 * 0.0011 * s * s;
    assert_on_path(
        &layout,
        "R.0.1",
        &integrated(100.0, heading, |s| shift(s) + half(s)),
    );
    assert_on_path(
        &layout,
        "R.0.-1",
        &integrated(100.0, heading, |s| shift(s) - half(s)),
    );

    // The parameter of this parabola is not its arc length, which offsets follow.
    let length = |x: f64| {
        let slope = 0.008 * x;
        (slope * slope.hypot(1.0) + slope.asinh()) / 0.016
    };
    let parabola = param_poly3("normalized", 100.0, 40.0);
    let layout = read(&road(&geometry(length(100.0), &parabola), offset, width));
    for (id, side) in [("R.0.1", 1.0), ("R.0.-1", -1.0)] {
        let points: Vec<Point<f64>> = (0..=200)
            .map(|i| {
                let x = f64::from(i) / 2.0;
                let (s, slope) = (length(x), 0.008 * x);
                let left = Point::new(-slope, 1.0) * (1.0 / 1_f64.hypot(slope));
                Point::new(x, 0.004 * x * x) + left * (shift(s) + side * half(s))
            })
            .collect();
        assert_on_path(&layout, id, &points);
    }
}

#[test]
fn poly3_has_the_given_arc_length() {
    // A slope of 3 in 4.
    let slope = r#"<poly3 a="0" b="0.75" c="0" d="0"/>"#;
    let layout = read(&road(&geometry(50.0, slope), "", WIDTH));
    let (start, end) = ends(&layout, "R.0.-1");
    assert!((start.distance(end) - 50.0).abs() < 1e-9);
    assert!(start.distance(Point::new(1.2, -1.6)) < 1e-9, "{start:?}");
}
