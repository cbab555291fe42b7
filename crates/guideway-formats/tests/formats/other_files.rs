//! Parts of a layout that lie in other files, and values that are not read: each has a finding.

use guideway_layout::{Code, Layout, Severity};
use guideway_spline::Point;

use super::svg_transforms::page;
use crate::common::{ends, read};

/// Severity and message of the findings of a code.
fn found(layout: &Layout, code: Code) -> Vec<(Severity, String)> {
    let found = layout.diagnostics.iter().filter(|d| d.code == code);
    found.map(|d| (d.severity, d.message.clone())).collect()
}

#[test]
fn included_files_are_errors_that_name_them() {
    const XINCLUDE: &str = "xmlns:xi='http://www.w3.org/2001/XInclude'";
    let xi = "<xi:include href='b.xml'/>";
    for (text, file) in [
        (
            "<OpenDRIVE><header revMajor='1'/><include file='b.xodr'/></OpenDRIVE>".to_owned(),
            "b.xodr",
        ),
        (
            "<OpenDRIVE><road id='1' length='1'><planView/><lanes><include file='l.xml'/></lanes>\
             </road></OpenDRIVE>"
                .to_owned(),
            "l.xml",
        ),
        (
            format!("<svg xmlns='http://www.w3.org/2000/svg' {XINCLUDE}><g>{xi}</g></svg>"),
            "b.xml",
        ),
        (
            format!("<model version='6.0.0' {XINCLUDE}>{xi}</model>"),
            "b.xml",
        ),
        (format!("<osm version='0.6' {XINCLUDE}>{xi}</osm>"), "b.xml"),
    ] {
        let layout = read(&text);
        let message = format!("the included file `{file}` is not in this one");
        let expected = [(Severity::Error, message)];
        assert_eq!(found(&layout, Code::UnknownValue), expected, "{text}");
        assert_eq!(layout.refused.len(), 1, "{text}");
    }
    // An element of another vocabulary is no inclusion.
    let other = "<svg xmlns='http://www.w3.org/2000/svg' xmlns:a='u'><a:include href='x'/></svg>";
    assert_eq!(read(other).refused.len(), 0);
}

#[test]
fn style_sheets_of_other_files_are_named() {
    let drawing = |before: &str, style: &str| {
        let svg = "<svg xmlns='http://www.w3.org/2000/svg' width='9mm'>";
        read(&format!(
            "{before}{svg}<style>{style}</style><line id='p' x2='9' stroke='red'/></svg>"
        ))
    };
    let sheet = "<?xml-stylesheet type='text/css' href=\"a.css\"?>";
    for (before, style, file) in [
        (sheet, "", "a.css"),
        (
            "",
            "@import url(\"b.css\") screen; line{stroke:red}",
            "b.css",
        ),
        ("", "@import 'c.css';", "c.css"),
        ("", "@import url( d.css );", "d.css"),
    ] {
        let message = format!("the style sheet `{file}` is not in this file");
        let expected = [(Severity::Warning, message)];
        let layout = drawing(before, style);
        assert_eq!(
            found(&layout, Code::UnknownValue),
            expected,
            "{before}{style}"
        );
        assert_eq!(layout.paths.len(), 1);
    }
    for within in [
        "<?xml-stylesheet href='#own'?>",
        "<?xml-model href='a.rng'?>",
    ] {
        assert_eq!(found(&drawing(within, ""), Code::UnknownValue), []);
    }
}

#[test]
fn values_that_are_not_read_have_a_finding() {
    for (shape, name) in [
        ("<line id='p' x1='calc(1px + 1px)' x2='9'/>", "x1"),
        ("<line id='p' x2='9' y2='5vw'/>", "y2"),
        ("<rect id='p' width='9' height='9' rx='1furlong'/>", "rx"),
        (
            "<line id='p' x2='9' style='transform: translate3d(1px, 2px, 0)'/>",
            "transform",
        ),
        (
            "<line id='p' x2='9' style='transform: translate(calc(1px + 2px), 0)'/>",
            "transform",
        ),
        ("<line id='p' x2='9' style='rotate: 0 1 0 9deg'/>", "rotate"),
        ("<circle id='p' r='3' style='cx: calc(3px)'/>", "cx"),
        (
            "<g style='translate: 1vw'><line id='p' x2='9'/></g>",
            "translate",
        ),
    ] {
        let found = found(&page(shape), Code::WrongType);
        assert_eq!(found.len(), 1, "{shape}: {found:?}");
        assert!(
            found[0].1.starts_with(&format!("its `{name}` is `")),
            "{found:?}"
        );
    }
    for shape in [
        "<line id='p' x2='9' style='transform: none'/>",
        "<line id='p' x2='9' style='transform: rotate(9deg); transform: translate3d(0, 0, 1px)'/>",
        "<rect id='p' width='9' height='9' rx='auto' style='width: auto'/>",
        "<line id='p' x2=' 9mm '/>",
    ] {
        assert_eq!(found(&page(shape), Code::WrongType), [], "{shape}");
    }
}

#[test]
fn references_and_shapes_are_found_as_they_are_written() {
    let layout = page(
        "<defs><line id='Straße 1' x2='9'/></defs><use id='u' href='#Stra%C3%9Fe%201' y='2'/>",
    );
    let end = Point::new(9.0, -2.0);
    assert_eq!(ends(&layout, "u/Straße 1"), (Point::new(0.0, -2.0), end));
    for broken in ["#Stra%C3", "#%zz", "#%4", "#%"] {
        let text = format!("<defs><line id='Straße 1' x2='9'/></defs><use href='{broken}'/>");
        assert_eq!(found(&page(&text), Code::UnknownValue).len(), 1, "{broken}");
    }
    let layout = page("<path id='p' d='M0 0L1 1' style='d: path(\"M0 0L9 9\")'/>");
    assert_eq!(ends(&layout, "p").1, Point::new(9.0, -9.0));
    assert_eq!(
        page("<path id='p' d='M0 0L1 1' style='d: none'/>")
            .paths
            .len(),
        0
    );
}

#[test]
fn elements_of_one_line_have_names_of_their_own() {
    let layout = page(
        "<line x2='9'/><g><line x2='8'/></g><defs><line id='d' x2='7'/></defs><use href='#d'/>",
    );
    let ids: Vec<&str> = layout.paths.iter().map(|path| path.id()).collect();
    assert_eq!(ids, ["line 2", "line 2 (2)", "line 2 (3)/d"]);
}
