//! Checks that written DXF reads back as the same layout, except for reported losses.

use crate::common::{codes, count, read};
use crate::same::{
    arbitrary_layout, assert_same_curves, assert_same_ids, broken, lost, push_lines,
};
use guideway_formats::Losses;
use guideway_formats::dxf::write_layout;
use guideway_layout::{Direction, Layout, NewPath, Value, WrittenCurve};
use guideway_spline::{Point, Runs};
use proptest::prelude::*;

fn written(layout: &Layout) -> (String, Losses) {
    let mut bytes = Vec::new();
    let losses = write_layout(layout, &mut bytes).unwrap();
    (String::from_utf8(bytes).unwrap(), losses)
}

fn layer(layout: &Layout, path: usize) -> Value<'_> {
    let column = layout.paths.attributes.get("layer").unwrap();
    column.values.get(path).unwrap()
}

proptest! {
    #[test]
    fn any_layout_reads_back(
        layout in arbitrary_layout(),
        colors in prop::collection::vec(any::<u32>(), 7),
    ) {
        let mut layout = layout;
        // Opaque and not white, as DXF requires.
        let color = |i: usize| (colors[i] & 0x7FFF_FF00) | 0xFF;
        layout.paths.set_color_rgba((0..layout.paths.len()).map(color).collect());
        let (text, losses) = written(&layout);
        let what = ["nodes", "vehicle types", "levels", "column maxSpeed"];
        prop_assert_eq!(losses.iter().map(|l| &l.what).collect::<Vec<_>>(), what);
        let again = read(&text);
        assert_same_curves(&layout, &again, "DXF");
        assert_same_ids(&layout, &again, "DXF");
        prop_assert_eq!(layout.paths.color_rgba(), again.paths.color_rgba());
        for path in layout.paths.iter() {
            let level = &layout.levels[path.level().unwrap() as usize].id;
            prop_assert_eq!(layer(&again, path.row()), Value::Text(level));
        }
        prop_assert!(codes(&again).is_empty(), "{:?}", codes(&again));
    }
}

#[test]
fn writes_lines_polylines_and_splines() {
    let mut layout = Layout::default();
    push_lines(&mut layout, "line", &[(0.0, 0.0), (4.0, 3.0)]);
    push_lines(&mut layout, "corner", &[(0.0, 0.0), (4.0, 0.0), (4.0, 3.0)]);
    let mut runs = Runs::default();
    runs.push(&[(0.0, 0.0), (1.0, 2.0), (3.0, 2.0), (4.0, 0.0)].map(|(x, y)| Point::new(x, y)));
    layout.paths.push(&NewPath {
        id: "bow",
        runs: &runs,
        ..NewPath::default()
    });
    let again = read(&written(&layout).0);
    for kind in ["LINE", "LWPOLYLINE", "SPLINE"] {
        assert_eq!(count(&again, kind), 1, "{kind}");
    }
    assert_eq!(again.provenance.format_version, "2007 (AC1021)");
}

#[test]
fn keeps_nurbs_as_they_were_written() {
    let mut layout = Layout::default();
    push_lines(&mut layout, "bend", &[(0.0, 0.0), (4.0, 4.0)]);
    let written_curve = WrittenCurve {
        degree: 2,
        knots: vec![0.0, 0.0, 0.0, 1.0, 1.0, 1.0],
        points_m: [(0.0, 0.0), (4.0, 0.0), (4.0, 4.0)]
            .map(|(x, y)| Point::new(x, y))
            .to_vec(),
        weights: Some(vec![1.0, 0.5_f64.sqrt(), 1.0]),
    };
    layout.paths.set_written_curve(0, written_curve.clone());
    let (text, losses) = written(&layout);
    assert_eq!(lost(&losses), []);
    let again = read(&text);
    assert_eq!(again.paths.written_curve(0), Some(&written_curve));
}

#[test]
fn preserves_any_identifier() {
    let long = "ä".repeat(600);
    // Some are split within what looks like an escape.
    let carets = "^ \\U+0041^I".repeat(60);
    let names = [
        "A --- B",
        "\\U+00E4",
        "C:\\temp\n1",
        "\\M+5BBF5",
        "^I ^ ^",
        &carets,
        &long,
        "",
        "漢 \u{1F69A}",
    ];
    let mut layout = Layout::default();
    for name in names {
        push_lines(&mut layout, name, &[(0.0, 0.0), (4.0, 3.0)]);
    }
    let again = read(&written(&layout).0);
    let read: Vec<&str> = again.paths.iter().map(|p| p.id()).collect();
    assert_eq!(read, names);
}

#[test]
fn changes_and_reports_invalid_layer_names() {
    let mut layout = Layout::default();
    for name in ["Wände", "WÄNDE", "a/b", "0", ""] {
        push_lines(&mut layout, "p", &[(0.0, 0.0), (4.0, 3.0)]);
        let row = layout.paths.len() - 1;
        layout.paths.attributes.set(row, "layer", Value::Text(name));
    }
    let (text, losses) = written(&layout);
    assert_eq!(lost(&losses), [("column layer", 3)]);
    let again = read(&text);
    let layers: Vec<String> = (0..5).map(|p| layer(&again, p).to_string()).collect();
    assert_eq!(layers, ["Wände", "Wände", "a_b", "0", "0"]);
}

#[test]
fn reports_losses() {
    let mut layout = broken(Point::new(6.0, 0.0), Direction::Both);
    layout.paths.set_color_rgba(vec![0xFFFF_FF80]);
    layout.paths.set_rank(vec![3]);
    let (text, losses) = written(&layout);
    let expected = [
        ("colors", 1),
        ("colors", 1),
        ("draw ranks", 1),
        ("directions", 1),
        ("curves", 1),
    ];
    assert_eq!(lost(&losses), expected);
    let again = read(&text);
    let ids: Vec<&str> = again.paths.iter().map(|p| p.id()).collect();
    assert_eq!(ids, ["E", "E~2"]);
}
