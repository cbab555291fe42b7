//! Tests of OpenDRIVE after public reports: places that differ by rounding, arc length of
//! polynomials, borders, widths and lengths.

use guideway_layout::{Code, Layout, Severity};
use guideway_spline::{Point, uniform};

use crate::common::{codes, ends, read, read_real, real_cases};

fn road(length: &str, geometry: &str, lanes: &str) -> Layout {
    read(&format!(
        "<OpenDRIVE><road id='7' length='{length}'><planView>{geometry}</planView>\
         <lanes>{lanes}</lanes></road></OpenDRIVE>"
    ))
}

fn line(s: f64, length: f64) -> String {
    format!("<geometry s='{s:?}' x='{s:?}' y='0' hdg='0' length='{length:?}'><line/></geometry>")
}

fn record(tag: &str, key: &str, at: f64, [a, b]: [f64; 2]) -> String {
    format!("<{tag} {key}='{at:?}' a='{a:?}' b='{b:?}' c='0' d='0'/>")
}

fn section(s: f64, lanes: &[(i64, String)]) -> String {
    let lane =
        |(id, records): &(i64, String)| format!("<lane id='{id}' type='driving'>{records}</lane>");
    let side = |of: fn(i64) -> bool| {
        lanes
            .iter()
            .filter(|(id, _)| of(*id))
            .map(lane)
            .collect::<String>()
    };
    let (left, right) = (side(|id| id > 0), side(|id| id < 0));
    format!("<laneSection s='{s:?}'><left>{left}</left><right>{right}</right></laneSection>")
}

fn assert_end(layout: &Layout, id: &str, expected: [f64; 2]) {
    let (_, end) = ends(layout, id);
    let expected = Point::new(expected[0], expected[1]);
    assert!(
        end.distance(expected) < 1e-9,
        "{id} ends at {end:?}, not {expected:?}"
    );
}

/// Messages and places of the findings with a code.
fn findings(layout: &Layout, code: Code) -> Vec<(String, String)> {
    let found = layout.diagnostics.iter().filter(|d| d.code == code);
    found
        .map(|d| (d.place.element.clone(), d.message.clone()))
        .collect()
}

#[test]
fn records_one_rounding_after_a_geometry_count() {
    let tie = 2.406_657_433_403_103_f64;
    let geometry = line(0.0, tie.next_down()) + &line(tie, 6.0);
    let widths =
        record("width", "sOffset", 0.0, [3.0, 0.0]) + &record("width", "sOffset", tie, [6.0, 0.0]);
    let end = tie + 6.0;
    let layout = road("8.4", &geometry, &section(0.0, &[(-1, widths)]));
    assert_end(&layout, "7.0.-1", [end, -3.0]);
    let offsets =
        record("laneOffset", "s", 0.0, [0.0, 0.0]) + &record("laneOffset", "s", tie, [4.0, 0.0]);
    let width = record("width", "sOffset", 0.0, [2.0, 0.0]);
    let lanes = offsets + &section(0.0, &[(-1, width.clone())]);
    assert_end(&road("8.4", &geometry, &lanes), "7.0.-1", [end, 3.0]);
    // Borders, and sections that begin there.
    let borders = record("border", "sOffset", 0.0, [3.0, 0.0])
        + &record("border", "sOffset", tie, [6.0, 0.0]);
    assert_end(
        &road("8.4", &geometry, &section(0.0, &[(-1, borders)])),
        "7.0.-1",
        [end, -3.0],
    );
    let wide = record("width", "sOffset", 0.0, [6.0, 0.0]);
    let sections = section(0.0, &[(-1, width)]) + &section(tie, &[(-1, wide)]);
    assert_end(&road("8.4", &geometry, &sections), "7.1.-1", [end, -3.0]);
    let Some(cases) = real_cases("xodr") else {
        return;
    };
    let layout = read_real(&cases.join("o21_tie.xodr"));
    let run = layout.paths.get(0).runs().next_back().unwrap();
    let segment = run.segments().next_back().unwrap();
    // The arc of radius 10 is 13 from its center on the right.
    let center = Point::new(2.406_657_433_403_102, 10.0);
    assert!((uniform::point(&segment, 1.0).distance(center) - 13.0).abs() < 1e-3);
}

#[test]
fn s_along_polynomials_is_the_arc_length() {
    let keys = |axis: &str, [a, b, c, d]: [f64; 4]| {
        format!("a{axis}='{a:?}' b{axis}='{b:?}' c{axis}='{c:?}' d{axis}='{d:?}'")
    };
    let (u, v) = ([0.0, 12.0, -9.0, 2.0], [0.0, 0.0, -16.0, 7.0]);
    let at = |[a, b, c, d]: [f64; 4], p: f64| a + p * (b + p * (c + p * d));
    let point = |p: f64| Point::new(at(u, p), at(v, p));
    // The parameter at half of the length of a fine polyline.
    const STEPS: u32 = 1_000_000;
    let step = |i: u32| point(f64::from(i) / f64::from(STEPS));
    let lengths: Vec<f64> = (1..=STEPS)
        .scan(0.0, |sum, i| {
            *sum += step(i).distance(step(i - 1));
            Some(*sum)
        })
        .collect();
    let total = lengths[lengths.len() - 1];
    let half = lengths.partition_point(|length| *length < total / 2.0);
    let middle = step(half as u32);
    let width = || record("width", "sOffset", 0.0, [0.0, 0.0]);
    let lanes = section(0.0, &[(-1, width())]) + &section(total / 2.0, &[(-1, width())]);
    let scaled = |of: [f64; 4]| {
        let mut factor = 1.0;
        of.map(|number| {
            let scaled = number * factor;
            factor /= total;
            scaled
        })
    };
    for shape in [
        format!(
            "<paramPoly3 pRange='normalized' {} {}/>",
            keys("U", u),
            keys("V", v)
        ),
        format!("<paramPoly3 {} {}/>", keys("U", u), keys("V", v)),
        format!(
            "<paramPoly3 pRange='arcLength' {} {}/>",
            keys("U", scaled(u)),
            keys("V", scaled(v))
        ),
    ] {
        let geometry =
            format!("<geometry s='0' x='0' y='0' hdg='0' length='{total:?}'>{shape}</geometry>");
        let layout = road(&format!("{total:?}"), &geometry, &lanes);
        assert!(!codes(&layout).contains(&Code::Implausible));
        let (_, found) = ends(&layout, "7.0.-1");
        assert!(
            found.distance(middle) < 1e-4,
            "{shape}: {found:?}, not {middle:?}"
        );
        let (_, found) = ends(&layout, "7.1.-1");
        assert!(found.distance(point(1.0)) < 1e-9, "{shape}");
    }
    // v = 0.05 u^2 has the length (2 w sqrt(1 + 4 w^2) + asinh 2 w) / (4 * 0.05) with w = 0.05 u.
    let length = |u: f64| {
        let x = 0.1 * u;
        (x * x.hypot(1.0) + x.asinh()) / 0.2
    };
    let geometry = format!(
        "<geometry s='0' x='0' y='0' hdg='0' length='{:?}'>\
         <poly3 a='0' b='0' c='0.05' d='0'/></geometry>",
        length(30.0)
    );
    let lanes = section(0.0, &[(-1, width())]) + &section(length(20.0), &[(-1, width())]);
    let layout = road(&format!("{:?}", length(30.0)), &geometry, &lanes);
    let (_, end) = ends(&layout, "7.0.-1");
    assert!(end.distance(Point::new(20.0, 20.0)) < 1e-6, "{end:?}");
}

#[test]
fn offset_lanes_of_polynomials_keep_their_distance() {
    let Some(cases) = real_cases("xodr") else {
        return;
    };
    let layout = read_real(&cases.join("o19_section_in_parampoly3.xodr"));
    // The middle by arc length, from an integration of its own: p = 0.3895.
    let (_, end) = ends(&layout, "1.0.-1");
    let (start, _) = ends(&layout, "1.1.-1");
    assert!(end.distance(start) < 1e-6);
}

#[test]
fn a_polynomial_with_a_wrong_length_is_reported() {
    let shape = "<paramPoly3 aU='0' bU='10' cU='0' dU='0' aV='0' bV='0' cV='0' dV='0'/>";
    let geometry = format!("<geometry s='0' x='0' y='0' hdg='0' length='12'>{shape}</geometry>");
    let width = record("width", "sOffset", 0.0, [2.0, 0.0]);
    let layout = road("12", &geometry, &section(0.0, &[(-1, width)]));
    assert_end(&layout, "7.0.-1", [10.0, -1.0]);
    assert_eq!(
        findings(&layout, Code::Implausible)[0].0,
        "geometry of road \"7\""
    );
}

#[test]
fn borders_lie_on_the_side_of_their_lane() {
    let border = |a| record("border", "sOffset", 0.0, [a, 0.0]);
    for (lanes, ends, contradictions) in [
        (
            vec![(1, border(3.0)), (-1, border(-4.0)), (-2, border(-7.0))],
            [1.5, -2.0, -5.5],
            0,
        ),
        (
            vec![(1, border(3.0)), (-1, border(4.0)), (-2, border(7.0))],
            [1.5, -2.0, -5.5],
            0,
        ),
        (
            vec![(1, border(-3.0)), (-1, border(-4.0)), (-2, border(-7.0))],
            [1.5, -2.0, -5.5],
            1,
        ),
        (
            vec![(1, border(3.0)), (-1, border(-4.0)), (-2, border(7.0))],
            [1.5, -2.0, -5.5],
            1,
        ),
    ] {
        let layout = road("9", &line(0.0, 9.0), &section(0.0, &lanes));
        // Left lanes lead against the road.
        let (start, _) = crate::common::ends(&layout, "7.0.1");
        assert!((start.y - ends[0]).abs() < 1e-9, "{start:?}");
        assert_end(&layout, "7.0.-1", [9.0, ends[1]]);
        assert_end(&layout, "7.0.-2", [9.0, ends[2]]);
        let found = findings(&layout, Code::Implausible);
        assert_eq!(found.len(), contradictions, "{found:?}");
    }
}

#[test]
fn borders_that_contradict_widths_are_findings() {
    let lane = |border: f64| {
        record("width", "sOffset", 0.0, [2.0, 0.0])
            + &record("border", "sOffset", 0.0, [border, 0.0])
    };
    for (inner, outer, contradictions) in [(-2.0, -4.01, 0), (-3.0, -4.0, 1), (-2.0, -2.0, 1)] {
        let lanes = section(0.0, &[(-1, lane(inner)), (-2, lane(outer))]);
        let layout = road("9", &line(0.0, 9.0), &lanes);
        assert_end(&layout, "7.0.-2", [9.0, -3.0]);
        let found = findings(&layout, Code::Implausible);
        assert_eq!(found.len(), contradictions, "{found:?}");
    }
}

#[test]
fn wrong_widths_are_findings_at_their_lane() {
    let width = |at, ab| record("width", "sOffset", at, ab);
    for (records, code) in [
        (width(1.0, [3.0, 0.0]), Code::MissingField),
        (width(0.0, [1.0, -0.5]), Code::Implausible),
        (
            width(0.0, [3.0, 0.0]) + &width(5.0, [-1.0, 0.0]),
            Code::Implausible,
        ),
        (String::new(), Code::MissingField),
    ] {
        let right = section(0.0, &[(-1, width(0.0, [3.0, 0.0]))]);
        let layout = road(
            "9",
            &line(0.0, 9.0),
            &(right + &section(2.0, &[(-1, records)])),
        );
        let found = findings(&layout, code);
        assert_eq!(found.len(), 1, "{code}");
        assert_eq!(found[0].0, "lane \"7.1.-1\"");
    }
    // A lane that ends.
    let layout = road(
        "9",
        &line(0.0, 9.0),
        &section(0.0, &[(-1, width(0.0, [4.5, -0.5]))]),
    );
    assert!(codes(&layout).is_empty());
}

#[test]
fn wrong_lengths_are_findings_at_their_road() {
    let lanes = section(0.0, &[(-1, record("width", "sOffset", 0.0, [3.0, 0.0]))]);
    let two = |s| line(0.0, 5.0) + &line(s, 4.0);
    for (length, geometry, expected) in [
        ("9", two(5.0), None),
        ("9.0004", two(5.001), None),
        ("20", two(5.0), Some("its length is 20 m")),
        ("3", two(5.0), Some("its length is 3 m")),
        ("11", two(7.0), Some("gap")),
        ("8", two(4.0), Some("overlaps")),
    ] {
        let layout = road(length, &geometry, &lanes);
        let found = findings(&layout, Code::Implausible);
        assert_eq!(
            found.len(),
            usize::from(expected.is_some()),
            "{length}: {found:?}"
        );
        if let Some(expected) = expected {
            assert_eq!(found[0].0, "road \"7\"");
            assert!(found[0].1.contains(expected), "{}", found[0].1);
        }
    }
    let layout = road("nan", &two(5.0), &lanes);
    assert_eq!(findings(&layout, Code::WrongType)[0].0, "road \"7\"");
}

#[test]
fn findings_of_the_cases_name_road_section_and_lane() {
    let Some(cases) = real_cases("xodr") else {
        return;
    };
    for file in ["o08_widths.xodr", "o09_lengths.xodr"] {
        let layout = read_real(&cases.join(file));
        assert!(
            layout
                .diagnostics
                .iter()
                .any(|d| d.severity > Severity::Info)
        );
        for finding in layout.diagnostics.iter() {
            let place = &finding.place.element;
            assert!(
                place.contains("road \"") || place.contains("lane \""),
                "{file}: {place}"
            );
        }
    }
}

#[test]
fn headings_in_degrees_are_doubted() {
    let lanes = section(0.0, &[(-1, record("width", "sOffset", 0.0, [3.0, 0.0]))]);
    let found = |heading: f64| {
        let geometry = line(0.0, 5.0).replace("hdg='0'", &format!("hdg='{heading:?}'"));
        let found = findings(&road("5", &geometry, &lanes), Code::Implausible);
        found.iter().any(|(_, message)| message.contains("heading"))
    };
    assert!([90.0, -45.0].into_iter().all(found));
    assert!(![0.0, 3.1, -6.3, 9.5].into_iter().any(found));
}

#[test]
fn records_and_sides_that_contradict_each_other_are_found() {
    let width = |a: f64| record("width", "sOffset", 0.0, [a, 0.0]);
    let found = |lanes: &str| {
        let layout = road("5", &line(0.0, 5.0), lanes);
        let found = findings(&layout, Code::Implausible);
        (
            layout,
            found
                .into_iter()
                .map(|(_, message)| message)
                .collect::<Vec<_>>(),
        )
    };
    let twice = |second: f64| section(0.0, &[(-1, width(3.0) + &width(second))]);
    let (layout, messages) = found(&twice(5.0));
    assert_end(&layout, "7.0.-1", [5.0, -2.5]);
    assert_eq!(messages, ["a second record begins at sOffset = 0"]);
    assert!(found(&twice(3.0)).1.is_empty());
    let swapped = section(0.0, &[(1, width(3.0))]).replace("id='1'", "id='-1'");
    let (layout, messages) = found(&swapped);
    assert_end(&layout, "7.0.-1", [5.0, -1.5]);
    assert_eq!(messages, ["the lane -1 stands in `left`"]);
}

#[test]
fn elements_out_of_order_are_sorted_and_found() {
    let width = |at: f64, a: f64| record("width", "sOffset", at, [a, 0.0]);
    let lane = |a: f64| [(-1, width(0.0, a))];
    let found = |geometry: &str, lanes: &str| {
        let layout = road("5", geometry, lanes);
        let found = findings(&layout, Code::Implausible).into_iter();
        (
            found.map(|(_, message)| message).collect::<Vec<_>>(),
            layout,
        )
    };
    let sections = [section(3.0, &lane(6.0)), section(0.0, &lane(3.0))];
    let (messages, layout) = found(&line(0.0, 5.0), &sections.concat());
    let expected = ["<laneSection> begins at s = 0, after one that begins at 3"];
    assert_eq!(messages, expected);
    assert_end(&layout, "7.0.-1", [3.0, -1.5]);
    assert_end(&layout, "7.1.-1", [5.0, -3.0]);
    let records = section(0.0, &[(-1, width(3.0, 6.0) + &width(0.0, 3.0))]);
    let (messages, layout) = found(&line(0.0, 5.0), &records);
    assert_eq!(
        messages,
        ["<width> begins at sOffset = 0, after one that begins at 3"]
    );
    assert_end(&layout, "7.0.-1", [5.0, -3.0]);
    let lines = line(2.0, 3.0) + &line(0.0, 2.0);
    let messages = found(&lines, &section(0.0, &lane(3.0))).0;
    assert_eq!(
        messages,
        ["<geometry> begins at s = 0, after one that begins at 2"]
    );
    let sorted = [section(0.0, &lane(3.0)), section(3.0, &lane(6.0))];
    assert!(found(&line(0.0, 5.0), &sorted.concat()).0.is_empty());
}
