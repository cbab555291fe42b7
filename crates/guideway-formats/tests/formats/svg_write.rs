//! Checks that written SVG reads back as the same layout, except for reported losses.

use crate::common::{codes, read};
use crate::same::{
    arbitrary_layout, assert_same_curves, assert_same_ids, broken, lost, push_lines,
};
use guideway_formats::Losses;
use guideway_formats::svg::{PathData, Stroke, SvgWriter, write_layout};
use guideway_layout::{Code, Direction, Layout, Value};
use guideway_spline::{Point, Runs};
use proptest::prelude::*;

fn written(layout: &Layout) -> (String, Losses) {
    let mut bytes = Vec::new();
    let losses = write_layout(layout, &mut bytes).unwrap();
    (String::from_utf8(bytes).unwrap(), losses)
}

fn line(id: &str) -> Layout {
    let mut layout = Layout::default();
    push_lines(&mut layout, id, &[(0.0, 0.0), (40.0, 30.0)]);
    layout
}

proptest! {
    #[test]
    fn any_layout_reads_back(
        layout in arbitrary_layout(),
        colors in prop::collection::vec(any::<u32>(), 7),
        widths in prop::collection::vec(0.01_f32..2.0, 7),
    ) {
        let mut layout = layout;
        let count = layout.paths.len();
        layout.paths.set_color_rgba(colors[..count].iter().map(|c| c | 1).collect());
        layout.paths.set_width_m(widths[..count].to_vec());
        let (text, losses) = written(&layout);
        let what = ["nodes", "directions", "vehicle types", "levels", "column maxSpeed"];
        prop_assert_eq!(losses.iter().map(|l| &l.what).collect::<Vec<_>>(), what);
        let again = read(&text);
        assert_same_curves(&layout, &again, "SVG");
        assert_same_ids(&layout, &again, "SVG");
        prop_assert_eq!(layout.paths.color_rgba(), again.paths.color_rgba());
        for path in layout.paths.iter() {
            let width_m = again.paths.width_m().unwrap()[path.row()];
            prop_assert!((width_m - widths[path.row()]).abs() < 1e-5);
            let level = &layout.levels[path.level().unwrap() as usize].id;
            let group = again.paths.attributes.get("group").unwrap();
            prop_assert_eq!(group.values.get(path.row()), Some(Value::Text(level)));
        }
        prop_assert!(codes(&again).is_empty(), "{:?} in {text}", codes(&again));
    }
}

#[test]
fn preserves_gaps_and_writes_straight_segments_as_lines() {
    let layout = broken(Point::new(6.0, 2.0), Direction::Forward);
    let (text, _) = written(&layout);
    assert!(text.contains(r#"d="M0 0L1 0M5 0L6 -2""#), "{text}");
    assert_same_curves(&layout, &read(&text), "broken");
}

#[test]
fn preserves_identifiers_that_xml_allows() {
    let mut layout = Layout::default();
    for id in [
        "A --- B",
        "a<b & \"c\">",
        "tab\tand\nline",
        "漢 \u{1F69A}",
        "bell\u{7}",
        "",
    ] {
        push_lines(&mut layout, id, &[(0.0, 0.0), (1.0, 1.0)]);
    }
    let (text, losses) = written(&layout);
    assert_eq!(lost(&losses), [("directions", 6), ("paths", 2)]);
    let again = read(&text);
    let ids: Vec<&str> = again.paths.iter().map(|p| p.id()).collect();
    assert_eq!(
        ids[..5],
        [
            "A --- B",
            "a<b & \"c\">",
            "tab\tand\nline",
            "漢 \u{1F69A}",
            "bell_"
        ]
    );
}

#[test]
fn page_has_the_size_of_the_site() {
    let (text, _) = written(&line("a"));
    // 40 m by 30 m, with a margin of 2 % of the larger side.
    assert!(text.contains(r#"viewBox="-0.8 -30.8 41.6 31.6""#), "{text}");
    assert!(
        text.contains(r#"width="41600mm" height="31600mm""#),
        "{text}"
    );
    let (empty, _) = written(&Layout::default());
    assert!(empty.contains(r#"viewBox="-0.5 -0.5 1 1""#), "{empty}");
}

#[test]
fn reports_losses_and_orders_paths_by_rank() {
    let mut layout = line("low");
    push_lines(&mut layout, "high", &[(0.0, 5.0), (9.0, 5.0)]);
    layout.paths.set_rank(vec![3, -1]);
    layout.refused.push("R", Code::NonFinite, "");
    layout.stations.push("S", None, Vec::new(), None);
    let (text, losses) = written(&layout);
    assert_eq!(
        lost(&losses),
        [
            ("refused paths", 1),
            ("draw ranks", 2),
            ("stations", 1),
            ("directions", 2)
        ]
    );
    assert!(text.find("high").unwrap() < text.find("low").unwrap());
    assert_eq!(read(&text).paths.get(0).direction(), Direction::Both);
}

#[test]
fn writes_paths_of_width_zero_with_a_default_width() {
    let mut layout = line("a");
    layout.paths.set_width_m(vec![0.0]);
    assert_same_curves(&layout, &read(&written(&layout).0), "no width");
}

#[test]
fn paths_override_only_what_differs_from_the_common_stroke() {
    let mut out = Vec::new();
    let common = Stroke::new(0x0000_0080, 1.0);
    let mut svg = SvgWriter::begin(&mut out, [0.0, 0.0, 9.0, 9.0], "", &common).unwrap();
    let mut data = PathData::new(1e-3);
    let mut runs = Runs::default();
    runs.push_line(Point::new(0.0, 0.0), Point::new(1.0, 0.12345));
    data.push_segment(runs.points().first_chunk().unwrap());
    svg.path("a", &data, &common).unwrap();
    svg.path("b", &data, &Stroke::new(0xFF00_00FF, f64::from(0.3_f32)))
        .unwrap();
    svg.path("c", &PathData::new(1.0), &common).unwrap();
    svg.finish().unwrap();
    let text = String::from_utf8(out).unwrap();
    assert!(
        text.contains("<path id=\"a\" d=\"M0 0L1 0.123\"/>"),
        "{text}"
    );
    let b = r##"d="M0 0L1 0.123" stroke="#ff0000" stroke-opacity="1" stroke-width="0.3"/>"##;
    assert!(text.contains(b), "{text}");
    assert!(!text.contains("\"c\""));
}
