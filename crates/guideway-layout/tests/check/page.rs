//! The page on diagnostics keeps up with the code.

use guideway_layout::Code;

const PAGE: &str = include_str!("../../../../docs/diagnostics.md");

/// Heading and text of each finding.
fn entries() -> Vec<(&'static str, &'static str)> {
    let sections = PAGE.split("\n### ").skip(1);
    sections
        .map(|s| s.split_once('\n').expect("a heading ends with its line"))
        .collect()
}

#[test]
fn every_code_has_its_entry_in_order_and_there_is_no_other() {
    let headings: Vec<_> = entries().iter().map(|(heading, _)| *heading).collect();
    let expected: Vec<_> = Code::ALL
        .iter()
        .map(|code| format!("`{code}` ({})", code.severity()))
        .collect();
    assert_eq!(headings, expected);
}

#[test]
fn every_entry_has_the_meaning_an_example_and_a_way_to_mend_it() {
    for (code, (_, text)) in Code::ALL.iter().zip(entries()) {
        assert!(text.contains(code.meaning()), "{code}: {}", code.meaning());
        assert!(text.contains("\n> "), "{code} has no example");
        assert!(text.contains("\nTo mend it: "), "{code} has no remedy");
    }
}
