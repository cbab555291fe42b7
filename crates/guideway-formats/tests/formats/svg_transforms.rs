//! Tests of transforms in SVG: attributes and CSS properties, origins, and the boxes to which they
//! refer.

use guideway_layout::{Code, Layout};
use guideway_spline::Point;

use crate::common::{codes, ends, read};

/// Reads a page on which a user unit is a meter.
pub(crate) fn page(content: &str) -> Layout {
    read(&format!(
        r#"<svg xmlns="http://www.w3.org/2000/svg" width="100000mm" height="100000mm"
            viewBox="0 0 100 100" stroke="black" fill="none">{content}</svg>"#
    ))
}

pub(crate) fn assert_line(content: &str, expected: [[f64; 2]; 2]) -> Layout {
    let layout = page(content);
    let (start, end) = ends(&layout, "p");
    for (found, [x, y]) in [start, end].into_iter().zip(expected) {
        let is_near = found.distance(Point::new(x, -y)) < 1e-9;
        assert!(is_near, "{content}: {start:?} to {end:?}");
    }
    layout
}

#[test]
fn css_transforms_apply_about_their_origin() {
    let line = |attributes: &str| format!("<line id='p' x1='10' x2='20' {attributes}/>");
    for (attributes, expected) in [
        ("style='transform:scale(2)'", [[20.0, 0.0], [40.0, 0.0]]),
        (
            "style='transform: translate(1px, 50%) rotate(90deg)'",
            [[1.0, 60.0], [1.0, 70.0]],
        ),
        // A valid property hides the attribute; an invalid one does not.
        (
            "transform='scale(3)' style='transform:none'",
            [[10.0, 0.0], [20.0, 0.0]],
        ),
        (
            "transform='scale(3)' style='transform:qwe'",
            [[30.0, 0.0], [60.0, 0.0]],
        ),
        (
            "transform='rotate(90)' transform-origin='10 0'",
            [[10.0, 0.0], [10.0, 10.0]],
        ),
        (
            "transform='scale(2)' transform-origin='center'",
            [[-30.0, -50.0], [-10.0, -50.0]],
        ),
        (
            "transform='scale(2)' style='transform-origin: right top'",
            [[-80.0, 0.0], [-60.0, 0.0]],
        ),
        (
            "transform='scale(2)' style='transform-origin: 10px 1em'",
            [[10.0, -16.0], [30.0, -16.0]],
        ),
        ("transform-origin='center'", [[10.0, 0.0], [20.0, 0.0]]),
        // The single properties apply in their order, after `transform`.
        (
            "style='rotate: 90deg; translate: 5px 10%; scale: 2 3; transform: translateX(1px)'",
            [[5.0, 32.0], [5.0, 52.0]],
        ),
        (
            "transform='scale(2)' style='scale: none; rotate: x 45deg'",
            [[20.0, 0.0], [40.0, 0.0]],
        ),
        // These are no attributes.
        ("rotate='90' scale='2'", [[10.0, 0.0], [20.0, 0.0]]),
    ] {
        let layout = assert_line(&line(attributes), expected);
        // A turn out of the plane is not read, and told.
        let is_read = !attributes.contains("rotate: x");
        assert_eq!(codes(&layout).is_empty(), is_read, "{attributes}");
        // Groups and references transform alike.
        let inner = "<line id='p' x1='10' x2='20'/>";
        assert_line(&format!("<g {attributes}>{inner}</g>"), expected);
        let sheet = attributes
            .split_once("style='")
            .map(|(_, rest)| rest.trim_end_matches('\''));
        if let Some(sheet) = sheet.filter(|_| !attributes.starts_with("trans")) {
            assert_line(&format!("<style>#p{{{sheet}}}</style>{inner}"), expected);
        }
    }
}

#[test]
fn a_malformed_transform_is_ignored_with_a_warning() {
    for content in [
        "<line id='p' x2='9' transform='qwe'/>",
        "<g transform='qwe'><line id='p' x2='9'/></g>",
        "<svg transform='scale(1'><line id='p' x2='9'/></svg>",
    ] {
        let layout = assert_line(content, [[0.0, 0.0], [9.0, 0.0]]);
        assert_eq!(codes(&layout), [Code::WrongType], "{content}");
    }
}

#[test]
fn a_transform_refers_to_the_bounding_box() {
    let fill = |rest: &str| format!("style='transform-box: fill-box; {rest}'");
    let p = "<line id='p' x1='10' y1='20' x2='20' y2='40'/>";
    let centered = fill("transform-origin: center; transform: scale(2)");
    for (content, expected) in [
        // The box of the line itself; by default the origin is its corner.
        (
            p.replace("/>", &format!(" {centered}/>")),
            [[5.0, 10.0], [25.0, 50.0]],
        ),
        (
            p.replace("/>", &format!(" {}/>", fill("transform: scale(2)"))),
            [[10.0, 20.0], [30.0, 60.0]],
        ),
        (
            p.replace(
                "/>",
                &format!(" {}/>", fill("transform: translate(50%, 10%)")),
            ),
            [[15.0, 22.0], [25.0, 42.0]],
        ),
        // Of a group: what is not displayed does not count, what is not painted does.
        (
            format!(
                "<g {centered}>{p}<path d='M30 40L30 80' stroke='none'/><g display='none'>\
                 <line x2='999'/></g></g>"
            ),
            [[0.0, -10.0], [20.0, 30.0]],
        ),
        // Curves by their own extent, not by that of their control points.
        (
            format!("<g {centered}>{p}<path d='M10 20Q15 0 20 20'/></g>"),
            [[5.0, 15.0], [25.0, 55.0]],
        ),
        // A box within a box: the inner group is 40 by 80 after its transform.
        (
            format!("<g {centered}><g transform='scale(4)'>{p}</g></g>"),
            [[20.0, 40.0], [100.0, 200.0]],
        ),
        (
            format!("<g {centered}><g {centered}>{p}</g></g>"),
            [[-5.0, -10.0], [35.0, 70.0]],
        ),
    ] {
        let layout = assert_line(&content, expected);
        assert!(
            codes(&layout).iter().all(|code| *code == Code::NotDrawn),
            "{content}"
        );
    }
    let reference = format!("<defs>{p}</defs><use id='u' href='#p' x='5' {centered}/>");
    let (start, end) = ends(&page(&reference), "u/p");
    assert!(start.distance(Point::new(10.0, -10.0)) < 1e-9, "{start:?}");
    assert!(end.distance(Point::new(30.0, -50.0)) < 1e-9, "{end:?}");
    assert!(codes(&page(&format!("<g {centered}/>{p}"))).is_empty());
    // Strokes are not measured.
    let stroke = p.replace(
        "/>",
        " style='transform-box: stroke-box; transform: scale(2)'/>",
    );
    assert_eq!(codes(&page(&stroke)), [Code::UnknownValue]);
}
