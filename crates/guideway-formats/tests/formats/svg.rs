//! Tests of the SVG reader: real files, units, transforms, references, styles and arcs.

use crate::common::{assert_counts, codes, count, ends, read, real};
use guideway_layout::{Code, Layout, Value};
use guideway_spline::{Point, uniform};

/// Element counts per file from the list of sources, made by another program.
const REAL: &[(&str, &str)] = &[
    ("material_design_icons.svg", "path 964, circle 25, svg 936"),
    ("resvg_path_A.svg", "path 1, rect 1, svg 1"),
    ("resvg_path_M-C-S.svg", "path 1, rect 1, svg 1"),
    ("resvg_path_M-L-M-Z.svg", "path 1, rect 1, svg 1"),
    (
        "resvg_path_M-M-implicit-M-implicit.svg",
        "path 1, rect 1, svg 1",
    ),
    ("resvg_path_M-Q-T.svg", "path 1, rect 1, svg 1"),
    ("resvg_path_M-V-V-implicit.svg", "path 1, rect 1, svg 1"),
    ("rmf_battle_royale.svg", "path 60, g 2, svg 1"),
];

const COUNTED: &[&str] = &[
    "path", "rect", "circle", "ellipse", "line", "polyline", "polygon", "svg", "g", "use", "text",
    "image",
];

#[test]
fn real_files_have_the_expected_counts() {
    for (file, expected) in REAL {
        let Some(layout) = real("svg", file) else {
            return;
        };
        assert_counts(&layout, COUNTED, expected, file);
        let shapes: u64 = COUNTED[..7].iter().map(|tag| count(&layout, tag)).sum();
        assert_eq!(layout.path_count() as u64, shapes, "{file}");
        // A test file of resvg for path data that must not be drawn.
        let refused = usize::from(*file == "resvg_path_A.svg");
        assert_eq!(layout.refused.len(), refused, "{file}");
    }
}

/// Reads a page on which a user unit is a meter.
fn page(content: &str) -> Layout {
    read(&format!(
        r#"<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink"
            width="100000mm" height="100000mm" viewBox="0 0 100 100"
            stroke="black" fill="none">{content}</svg>"#
    ))
}

fn assert_ends(layout: &Layout, id: &str, expected: [(f64, f64); 2]) {
    let (start, end) = ends(layout, id);
    let [from, to] = expected.map(|(x, y)| Point::new(x, y));
    assert!(
        start.distance(from) < 1e-9 && end.distance(to) < 1e-9,
        "{id}: {start:?} to {end:?}, not {from:?} to {to:?}"
    );
}

#[test]
fn scales_by_the_page_size_and_flips_y() {
    let layout = page(r#"<path id="p" d="M10 20 L30 40"/>"#);
    assert_ends(&layout, "p", [(10.0, -20.0), (30.0, -40.0)]);
    assert!(codes(&layout).is_empty());
    let paper = |head: &str| {
        let line = r#"<line id="p" x2="96" stroke="red"/>"#;
        read(&format!(
            r#"<svg xmlns="http://www.w3.org/2000/svg" {head}>{line}</svg>"#
        ))
    };
    let tall = |ratio: &str| format!(r#"width="10mm" height="99mm" viewBox="0 0 10 10" {ratio}"#);
    for (head, length_m, is_reported) in [
        ("", 0.0254, true),
        (r#"width="96""#, 0.0254, true),
        (r#"width="10cm" viewBox="0 0 100 100""#, 0.096, false),
        (r#"height="2in" viewBox="5 5 96 96""#, 0.0508, false),
        (&tall(""), 0.096, false),
        (&tall(r#"preserveAspectRatio="none""#), 0.096, false),
        (
            &tall(r#"preserveAspectRatio="xMidYMid slice""#),
            0.9504,
            false,
        ),
        (r#"width="100%" viewBox="0 0 50 50""#, 0.0254, true),
    ] {
        let layout = paper(head);
        let (start, end) = ends(&layout, "p");
        assert!(
            (start.distance(end) - length_m).abs() < 1e-9,
            "{head}: {}",
            start.distance(end)
        );
        assert_eq!(
            codes(&layout).contains(&Code::AssumedUnit),
            is_reported,
            "{head}"
        );
    }
}

#[test]
fn applies_inner_transforms_first() {
    let layout = page(
        r#"<g transform="translate(10 0)"><g transform="rotate(90)">
        <path id="p" d="M1 0 H2" transform="scale(3)"/></g></g>"#,
    );
    assert_ends(&layout, "p", [(10.0, -3.0), (10.0, -6.0)]);
}

#[test]
fn fits_nested_svg_elements_into_their_viewport() {
    let layout = page(
        r#"<svg x="20" y="40" width="20" height="10" viewBox="0 0 2 2">
        <line id="middle" x2="2"/></svg>
        <svg x="20" width="20" height="10" viewBox="0 0 2 2" preserveAspectRatio="xMaxYMin">
        <line id="right" x2="2"/><line id="percent" x2="50%"/></svg>"#,
    );
    assert_ends(&layout, "middle", [(25.0, -40.0), (35.0, -40.0)]);
    assert_ends(&layout, "right", [(30.0, 0.0), (40.0, 0.0)]);
    assert_ends(&layout, "percent", [(30.0, 0.0), (35.0, 0.0)]);
}

#[test]
fn use_elements_prefix_identifiers_of_shapes() {
    let layout = page(
        r##"<defs><g id="g"><path id="p" d="M0 0 H1"/></g>
        <symbol id="s" viewBox="0 0 1 1"><path id="q" d="M0 0 H1"/></symbol></defs>
        <use id="a" xlink:href="#g" x="5" y="5" transform="scale(2)"/>
        <use id="b" href="#s" x="1" width="10" height="10"/>
        <use id="c" href="#a"/>"##,
    );
    assert_ends(&layout, "a/p", [(10.0, -10.0), (12.0, -10.0)]);
    assert_ends(&layout, "b/q", [(1.0, 0.0), (11.0, 0.0)]);
    assert_ends(&layout, "c/a/p", [(10.0, -10.0), (12.0, -10.0)]);
    assert_eq!(layout.paths.len(), 3);
    assert_eq!(
        codes(&layout),
        [Code::NotDrawn],
        "the count of shapes in definitions"
    );
}

#[test]
fn resolves_colors_and_widths_from_attributes_rules_and_styles() {
    let layout = page(
        r##"<style>.a { stroke: #0f0 } #d { stroke-width: 3 }</style><pattern id="sky"/>
        <g stroke="blue" stroke-width="2" opacity="0.5">
        <path id="b" d="M0 0 H1"/><path id="a" class="a" d="M0 0 H1" transform="scale(3 1)"/>
        <path id="c" class="a" style="stroke:red;stroke-opacity:50%" d="M0 0 H1"/>
        <path id="d" d="M0 0 H1" fill="#102030" stroke="none"/>
        <path id="e" d="M0 0 H1" stroke="url(#sky)"/></g>"##,
    );
    let colors = layout.paths.color_rgba().unwrap();
    assert_eq!(
        colors,
        [0x0000_FF80, 0x00FF_0080, 0xFF00_0040, 0x1020_3080, 0]
    );
    let widths = layout.paths.width_m().unwrap();
    assert_eq!((widths[0], widths[4]), (2.0, 2.0));
    assert!(
        (widths[1] - 2.0 * 3_f32.sqrt()).abs() < 1e-6,
        "the geometric mean of both scales"
    );
    assert!(widths[3].is_nan(), "a filled shape has no stroke");
}

#[test]
fn refuses_invisible_shapes_with_a_reason() {
    let layout = page(
        r#"<path id="a" d="M0 0 H1" display="none"/>
        <g visibility="hidden"><path id="b" d="M0 0 H1"/>
        <path id="c" d="M0 0 H1" visibility="visible"/></g><path id="d" d="M0 0 H1" stroke="none"/>
        <path id="e" d="M3 3"/>"#,
    );
    let refused: Vec<_> = layout
        .refused
        .iter()
        .map(|r| (r.id.to_owned(), r.code))
        .collect();
    let expected = [
        ("a", Code::NotDrawn),
        ("b", Code::NotDrawn),
        ("d", Code::NotDrawn),
        ("e", Code::TooFewPoints),
    ];
    assert_eq!(refused, expected.map(|(id, code)| (id.to_owned(), code)));
    assert_eq!(layout.paths.id(0), "c");
}

#[test]
fn transformed_circles_stay_within_the_tolerance() {
    let layout =
        page(r#"<circle id="c" cx="40" cy="30" r="25" transform="skewX(30) scale(1 .5)"/>"#);
    let path = layout.paths.get(0);
    let back = |p: Point<f64>| {
        let y = -p.y;
        Point::new(p.x - 30_f64.to_radians().tan() * y, y / 0.5)
    };
    for segment in path.runs().flat_map(|run| run.segments()) {
        for i in 0..=8 {
            let p = back(uniform::point(&segment, f64::from(i) / 8.0));
            let off = p.distance(Point::new(40.0, 30.0)) - 25.0;
            assert!(off.abs() < 2.5e-4, "{off}");
        }
    }
}

#[test]
fn stores_layers_and_groups_in_a_column() {
    let layout = page(
        r#"<g id="g1" xmlns:i="http://www.inkscape.org/namespaces/inkscape" i:label="Roads">
        <path id="a" d="M0 0 H1"/><g><path id="b" d="M0 0 H1"/></g></g>
        <path id="c" d="M0 0 H1"/>"#,
    );
    let group = |row| {
        layout
            .paths
            .attributes
            .get("group")
            .unwrap()
            .values
            .get(row)
    };
    assert_eq!(
        [group(0), group(1), group(2)],
        [Some(Value::Text("Roads")), Some(Value::Text("Roads")), None]
    );
}

#[test]
fn draws_malformed_path_data_up_to_the_error() {
    let layout = page(r#"<path id="a" d="M0 0 H1 V oops"/>"#);
    assert_ends(&layout, "a", [(0.0, 0.0), (1.0, 0.0)]);
    assert_eq!(codes(&layout), [Code::WrongType]);
}
