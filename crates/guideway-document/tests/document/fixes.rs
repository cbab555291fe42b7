//! Fixes of findings: each resolves its finding in one step.

use guideway_document::{Document, Element, Fix, fix_all, fixes, has_fixes, located};
use guideway_layout::{CheckOptions, Code, Direction, Layout, NewPath};
use guideway_spline::Runs;

use crate::site::{document_of, p};

/// Findings of a kind, with their elements.
fn found(document: &Document, code: Code) -> Vec<Element> {
    let findings = document.snapshot().findings(&CheckOptions::default());
    let of_kind = findings.iter().filter(|finding| finding.code == code);
    of_kind
        .filter_map(|finding| located(&finding.place))
        .collect()
}

/// Performs the first fix of the first finding of a kind.
fn fix_first(document: &mut Document, code: Code) -> String {
    assert!(has_fixes(code));
    let element = found(document, code)[0];
    let proposed = fixes(document, code, element);
    document
        .fix(&proposed[0].fix)
        .expect("the fix fits its finding");
    proposed[0].label.clone()
}

/// Nodes in a row, 10 m apart, with one-way paths between them in order.
fn row_of(count: u32) -> Layout {
    let mut layout = Layout::default();
    for i in 0..count {
        layout
            .nodes
            .push(&format!("n{i}"), p(10.0 * f64::from(i), 0.0), None);
    }
    for i in 1..count {
        add_path(&mut layout, &format!("p{i}"), [i - 1, i]);
    }
    layout
}

fn add_path(layout: &mut Layout, id: &str, ends: [u32; 2]) {
    let [from, to] = ends.map(|node| layout.nodes.position_m(node));
    let mut runs = Runs::default();
    runs.push_line(from, to);
    layout.paths.push(&NewPath {
        id,
        runs: &runs,
        start_node: Some(ends[0]),
        end_node: Some(ends[1]),
        ..NewPath::default()
    });
}

#[test]
fn findings_of_single_elements_are_resolved_and_undone() {
    let mut layout = row_of(4);
    // A gap, an unused node, a copy of a path, and an identifier that two nodes have.
    layout.nodes.set_position_m(3, p(30.2, 0.1));
    layout.nodes.push("alone", p(5.0, 5.0), None);
    add_path(&mut layout, "copy", [0, 1]);
    layout.nodes.push("n1", p(0.0, 20.0), None);
    add_path(&mut layout, "other", [2, 5]);
    let mut document = document_of(layout);
    for code in [
        Code::NodeGap,
        Code::UnusedNode,
        Code::DuplicatePath,
        Code::DuplicateId,
    ] {
        let before = found(&document, code).len();
        assert!(before > 0, "{code}");
        let label = fix_first(&mut document, code);
        assert_eq!(found(&document, code).len(), before - 1, "{code}: {label}");
        document.undo();
        assert_eq!(found(&document, code).len(), before, "{code}: one step");
        document.redo();
    }
    let path = document.layout().paths.get(2);
    assert!(path.ends().unwrap().1.distance(p(30.2, 0.1)) < 1e-9);
}

#[test]
fn all_findings_of_a_kind_are_one_step() {
    let mut layout = row_of(5);
    for node in 0..5 {
        let at = layout.nodes.position_m(node);
        layout.nodes.set_position_m(node, p(at.x, 0.3));
    }
    let mut document = document_of(layout);
    let elements = found(&document, Code::NodeGap);
    assert_eq!(elements.len(), 8, "both ends of four paths");
    let proposed = fix_all(&document, Code::NodeGap, &elements).unwrap();
    document.fix(&proposed.fix).unwrap();
    assert!(found(&document, Code::NodeGap).is_empty());
    document.undo();
    assert_eq!(found(&document, Code::NodeGap).len(), 8);
    assert_eq!(fix_all(&document, Code::Kink, &elements), None);
}

#[test]
fn gap_between_parts_is_welded_or_connected() {
    let mut layout = row_of(3);
    // Another part begins 0.2 m behind the end of the first one.
    layout.nodes.push("far", p(40.0, 0.0), None);
    layout.nodes.push("near", p(20.2, 0.0), None);
    add_path(&mut layout, "other", [4, 3]);
    let mut document = document_of(layout);
    // The finding may name any node of the part.
    let proposed = fixes(&document, Code::NotConnected, Element::Node(3));
    let labels: Vec<&str> = proposed.iter().map(|fix| &*fix.label).collect();
    assert_eq!(
        labels,
        [
            "Weld the gap of 200 mm between near and n2",
            "Connect near and n2 by a two-way path of 200 mm"
        ]
    );
    document.fix(&proposed[0].fix).unwrap();
    assert!(!document.contains(Element::Node(4)));
    assert_eq!(document.layout().paths.get(2).start_node(), Some(2));
    document.undo();
    document.fix(&proposed[1].fix).unwrap();
    let path = document.layout().paths.get(3);
    assert_eq!(path.direction(), Direction::Both);
    assert_eq!((path.start_node(), path.end_node()), (Some(4), Some(2)));
}

#[test]
fn dead_ends_and_opposed_paths_are_turned() {
    let mut layout = row_of(3);
    add_path(&mut layout, "against", [1, 2]);
    let mut document = document_of(layout);
    let proposed = fixes(&document, Code::DeadEnd, Element::Node(2));
    assert_eq!(
        proposed[0].label,
        "Make the 2 paths that lead there two-way"
    );
    let reversals = fixes(&document, Code::HeadOn, Element::Node(2));
    assert_eq!(reversals.len(), 2);
    document.fix(&reversals[1].fix).unwrap();
    assert_eq!(document.layout().paths.get(2).start_node(), Some(2));
    // A deleted path has no fixes, and an old fix is refused.
    let delete = Fix::Delete(guideway_document::Elements::of(Element::Path(2)));
    document.fix(&delete).unwrap();
    assert!(fixes(&document, Code::DuplicatePath, Element::Path(2)).is_empty());
    assert!(document.fix(&delete).is_err());
}

#[test]
fn rows_of_findings_are_those_of_the_document() {
    let mut document = document_of(row_of(5));
    let first = guideway_document::Elements::of(Element::Path(0));
    document.delete(&first, false).unwrap();
    let findings = document.snapshot().findings_of(|layout| {
        assert_eq!(layout.paths.len(), 3);
        let mut found = guideway_layout::Diagnostics::default();
        let member = guideway_layout::Member::Path(0);
        let place = || guideway_layout::element_place(member, "");
        found.push(Code::ZeroLength, place, || "odd".into(), "");
        found
    });
    let place = &findings.iter().next().unwrap().place;
    assert_eq!(located(place), Some(Element::Path(1)));
    assert_eq!(place.element, "path number 2");
}
