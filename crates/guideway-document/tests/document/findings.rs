use guideway_document::{Document, SelectMode};
use guideway_layout::{CheckOptions, Code, NewPath};
use guideway_spline::Runs;

use crate::site::{document_of, lanes, p};

#[test]
fn what_is_odd_is_found_in_the_document_as_it_is_by_its_own_rows() {
    let mut layout = lanes(3);
    let mut dot = Runs::default();
    dot.push_line(p(5.0, 9.0), p(5.0, 9.0));
    layout.paths.push(&NewPath {
        runs: &dot,
        ..NewPath::default()
    });
    let mut document = document_of(layout);
    let told = |document: &Document| {
        let found = document.snapshot().findings(&CheckOptions::default());
        let places = found
            .iter()
            .filter(|finding| finding.code == Code::ZeroLength);
        places.map(|f| f.place.to_string()).collect::<Vec<_>>()
    };
    assert_eq!(told(&document), ["path number 4"]);
    let first = document.state();
    document.select([0].into_iter().collect(), SelectMode::Replace);
    document.delete_selection().unwrap();
    assert_ne!(document.state(), first);
    assert_eq!(told(&document), ["path number 4"]);
    document.select([3].into_iter().collect(), SelectMode::Replace);
    document.delete_selection().unwrap();
    assert!(told(&document).is_empty());
    document.undo();
    document.undo();
    assert_eq!(document.state(), first);
}
