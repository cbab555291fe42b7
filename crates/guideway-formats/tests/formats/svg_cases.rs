//! Tests of SVG after public reports: font sizes, conditions, circles of references, strokes that
//! do not scale, document type definitions.

use guideway_layout::{Code, RunPoints, Severity};
use guideway_spline::uniform::point;
use guideway_spline::{Bounds, Point};

use crate::common::{codes, ends, read, read_real, real_cases};

use super::svg_transforms::{assert_line, page};

#[test]
fn geometry_may_be_stated_by_style() {
    let bounds = |content: &str| {
        let layout = page(content);
        assert_eq!(
            (layout.paths.len(), layout.refused.len()),
            (1, 0),
            "{content}"
        );
        let segments = layout.paths.get(0).runs().flat_map(|run| run.segments());
        let boxes = segments.map(|segment| Bounds::of_segment(&segment));
        let bounds = boxes.reduce(Bounds::union).unwrap();
        [bounds.min.x, -bounds.max.y, bounds.max.x, -bounds.min.y].map(f64::round)
    };
    for (content, expected) in [
        (
            "<circle id='p' style='r: 7px; cx: 9px; cy: 20%'/>",
            [2.0, 13.0, 16.0, 27.0],
        ),
        (
            "<style>.a{width:10px;height:1em;x:3px}</style><rect id='p' class='a' width='99'/>",
            [3.0, 0.0, 13.0, 16.0],
        ),
        (
            "<ellipse id='p' rx='4' style='ry: 2px; rx: nonsense'/>",
            [-4.0, -2.0, 4.0, 2.0],
        ),
        (
            "<line id='p' style='x1: 5px' x2='9'/>",
            [0.0, 0.0, 9.0, 0.0],
        ),
    ] {
        assert_eq!(bounds(content), expected, "{content}");
    }
}

#[test]
fn em_is_the_size_of_the_font() {
    for (content, length) in [
        ("<line id='p' x2='1em'/>", 16.0),
        ("<g font-size='20'><line id='p' x2='1em'/></g>", 20.0),
        (
            "<g style='font: bold 10px serif'><line id='p' x2='2em' font-size='50%'/></g>",
            10.0,
        ),
        (
            "<style>line{font-size:large}</style><line id='p' x2='1ex'/>",
            9.6,
        ),
        ("<g font-size='9'><line id='p' x2='1rem'/></g>", 16.0),
    ] {
        assert_line(content, [[0.0, 0.0], [length, 0.0]]);
    }
}

#[test]
fn a_switch_draws_the_first_graphic_whose_conditions_hold() {
    let wrong = "<line id='w' x2='1'/>";
    let right = "<line id='p' x2='9'/>";
    for before in [
        "<random/>",
        "<title>t</title><desc/><metadata/>",
        "<foreignObject/>",
        "<line id='w' x2='1' systemLanguage='xx'/>",
        "<line id='w' x2='1' systemLanguage=''/>",
        "<g requiredExtensions='http://ns.adobe.com/x'><line id='w' x2='1'/></g>",
        "<x:line xmlns:x='urn:x'/>",
    ] {
        let layout = page(&format!("<switch>{before}{right}{wrong}</switch>"));
        assert_eq!(layout.paths.len(), 1, "{before}");
        ends(&layout, "p");
    }
    let english = "<line id='p' x2='9' systemLanguage='de, en-US'/>";
    ends(&page(&format!("<switch>{english}{wrong}</switch>")), "p");
    // Outside of a switch, conditions hide as `display` does.
    let layout = page("<g systemLanguage='xx'><line id='p' x2='9'/></g>");
    assert_eq!((layout.paths.len(), layout.refused.len()), (0, 1));
}

#[test]
fn references_to_elements_around_them_are_refused() {
    let shape = "<line id='s' x2='9'/>";
    for (content, paths) in [
        ("<use href='#u' id='u'/><line id='s' x2='9'/>".to_owned(), 1),
        (format!("<g id='g'><use href='#g' x='2'/>{shape}</g>"), 1),
        (
            format!("<g id='a'><use href='#b'/></g><g id='b'><use href='#a'/>{shape}</g>"),
            3,
        ),
        (
            format!("<symbol id='a'><use href='#a'/>{shape}</symbol><use href='#a'/>"),
            1,
        ),
        (format!("<svg id='a'><use href='#a'/>{shape}</svg>"), 1),
    ] {
        let layout = page(&content);
        assert_eq!(layout.paths.len(), paths, "{content}");
        let found = layout
            .diagnostics
            .iter()
            .find(|d| d.code == Code::UnknownValue);
        assert!(found.unwrap().message.contains("contains it"), "{content}");
        assert!(!layout.refused.is_empty() && found.unwrap().severity == Severity::Error);
    }
    for (href, said) in [
        ("href='#none'", "`#none` is not in this file"),
        ("href='hall.svg#a'", "`hall.svg#a` is not in this file"),
        ("", "it has no `href`"),
    ] {
        let layout = page(&format!("<use {href}/><line x2='9'/>"));
        assert_eq!((layout.paths.len(), layout.refused.len()), (1, 1));
        let refused = layout.refused.get(0);
        assert!(refused.detail.contains(said), "{}", refused.detail);
    }
    // The same element twice, side by side, is no circle.
    let twice = page(
        "<defs><g id='a'><line id='s' x2='9'/></g></defs><use href='#a'/><use href='#a' y='2'/>",
    );
    assert_eq!(twice.paths.len(), 2);
}

#[test]
fn strokes_that_do_not_scale_have_pixels_of_the_page() {
    let layout = page(
        "<g transform='scale(3)'>
         <line id='a' x2='9' stroke-width='2' vector-effect='non-scaling-stroke'/>
         <line id='b' x2='9' stroke-width='2' style='vector-effect: non-scaling-stroke'/>
         <line id='c' x2='9' stroke-width='2'/>
         <g vector-effect='non-scaling-stroke'><line id='d' x2='9' stroke-width='2'/></g></g>",
    );
    let widths: Vec<f32> = layout.paths.width_m().unwrap().to_vec();
    let pixel = 0.0254 / 96.0 * 2.0;
    for (found, expected) in widths.into_iter().zip([pixel, pixel, 6.0, 6.0]) {
        assert!(
            (f64::from(found) - expected).abs() < 1e-6,
            "{found}, not {expected}"
        );
    }
}

#[test]
fn old_inkscape_files_have_a_note() {
    let file = |head: &str| {
        let inkscape = "xmlns:inkscape='http://www.inkscape.org/namespaces/inkscape'";
        read(&format!(
            "<svg xmlns='http://www.w3.org/2000/svg' {inkscape} width='1220mm' {head}>\
             <line x2='900' stroke='red'/></svg>"
        ))
    };
    for (head, is_noted) in [
        ("inkscape:version='0.91 r13725'", true),
        ("inkscape:version='0.48.4'", true),
        ("inkscape:version='0.92.3'", false),
        ("inkscape:version='1.3'", false),
        ("inkscape:version='0.91' viewBox='0 0 1220 610'", false),
        ("", false),
    ] {
        let found = codes(&file(head)).contains(&Code::AssumedUnit);
        assert_eq!(found, is_noted, "{head}");
    }
}

/// Expected bounds of the rectangle of resvg's files, in user units of a page of 200.
const RESVG: [(&str, [f64; 4]); 5] = [
    (
        "structure/style-attribute/transform.svg",
        [20.0, 20.0, 180.0, 180.0],
    ),
    (
        "structure/transform-origin/on-shape.svg",
        [43.431_457, 43.431_457, 156.568_543, 156.568_543],
    ),
    ("shapes/rect/em-values.svg", [20.0, 20.0, 180.0, 180.0]),
    (
        "structure/switch/non-SVG-child.svg",
        [20.0, 20.0, 180.0, 180.0],
    ),
    (
        "structure/use/indirect-recursive-2.svg",
        [20.0, 20.0, 180.0, 180.0],
    ),
];

#[test]
fn files_of_resvg_have_the_bounds_of_its_pictures() {
    let Some(cases) = real_cases("svg_resvg") else {
        return;
    };
    for (file, expected) in RESVG {
        let layout = read_real(&cases.join(file));
        assert_eq!(layout.paths.len(), 2, "{file}");
        let path = layout.paths.iter().find(|p| p.id() == "rect1").unwrap();
        let segments = path.runs().flat_map(|run| run.segments());
        let points = segments.flat_map(|s| [0.0, 0.25, 0.5, 0.75, 1.0].map(|t| point(&s, t)));
        let mut found = [
            f64::INFINITY,
            f64::INFINITY,
            f64::NEG_INFINITY,
            f64::NEG_INFINITY,
        ];
        for Point { x, y } in points {
            found[0] = found[0].min(x);
            found[1] = found[1].min(-y);
            found[2] = found[2].max(x);
            found[3] = found[3].max(-y);
        }
        for (found, expected) in found.into_iter().zip(expected) {
            let found = found / (0.0254 / 96.0);
            assert!(
                (found - expected).abs() < 0.01,
                "{file}: {found}, not {expected}"
            );
        }
    }
    let layout = read_real(&cases.join("shapes/path/invalid-transform.svg"));
    assert_eq!(layout.paths.len(), 2);
}

#[test]
fn definitions_declare_prefixes_and_entities() {
    let file = |definition: &str, attributes: &str, content: &str| {
        read(&format!(
            "<!DOCTYPE svg {definition}><svg xmlns='http://www.w3.org/2000/svg' \
             width='9mm' stroke='red' {attributes}>{content}</svg>"
        ))
    };
    let line = "<line id='p' x2='9'/>";
    for (definition, attributes, content) in [
        (
            "[<!ATTLIST g xmlns:k CDATA #FIXED 'urn:k' k:e CDATA #IMPLIED>]",
            "",
            "<g k:e='x'><line id='p' x2='9'/></g>",
        ),
        (
            "PUBLIC '-//W3C//DTD SVG 1.1//EN' 'x'",
            "",
            "<use xlink:href='#p'/><line id='p' x2='9'/>",
        ),
        (
            "[<?x ]><!-- ?><!ENTITY a 'p'>]",
            "",
            "<line id='&a;' x2='9'/>",
        ),
        (
            "[<!ENTITY a \"]>\"><!ENTITY b '<line id=\"p\" x2=\"9\"/>'>]",
            "id='&a;'",
            "&b;",
        ),
        (
            "[<!ENTITY % p 'x'>%p;<!ENTITY a 'p'><!NOTATION n SYSTEM ']>'>]",
            "",
            "<line id='&a;' x2='9'/>",
        ),
        ("[<!ENTITY s 'stroke-width:2'>]", "style='&s;'", line),
    ] {
        let layout = file(definition, attributes, content);
        ends(&layout, "p");
    }
    let Some(cases) = real_cases("svg") else {
        return;
    };
    assert_eq!(read_real(&cases.join("s06f_attlist.svg")).path_count(), 1);
}

#[test]
fn a_missing_or_negative_radius_is_as_the_other_one() {
    let points = |shape: &str| -> Vec<Point<f64>> {
        let layout = page(&format!("<{shape}/>"));
        assert_eq!(layout.paths.len(), 1, "{shape}");
        let path = layout.paths.get(0);
        let points = |run: RunPoints<'_>| (0..run.len()).map(|i| run.get(i)).collect::<Vec<_>>();
        path.runs().flat_map(points).collect()
    };
    for shape in ["rect width='9' height='7'", "ellipse cx='4'"] {
        let both = points(&format!("{shape} rx='3' ry='3'"));
        for radii in ["rx='3'", "ry='3'", "rx='-1' ry='3'", "rx='3%' ry='-5'"] {
            assert_eq!(points(&format!("{shape} {radii}")), both, "{shape} {radii}");
        }
    }
    let sharp = points("rect width='9' height='7'");
    assert_eq!(points("rect width='9' height='7' rx='-3' ry='-2'"), sharp);
}

#[test]
fn a_paint_that_does_not_exist_draws_nothing() {
    for (paint, paths) in [
        ("url(#sky)", 1),
        ("url(#none)", 0),
        ("url(#none) red", 1),
        ("url(#p)", 0),
    ] {
        let layout = page(&format!(
            "<linearGradient id='sky'/><line id='p' x2='9' stroke='{paint}'/>"
        ));
        assert_eq!(layout.paths.len(), paths, "{paint}");
        assert_eq!(layout.refused.len(), 1 - paths, "{paint}");
    }
}
