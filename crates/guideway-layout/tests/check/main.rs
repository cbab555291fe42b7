//! Tests of [`guideway_layout::check`] and of docs/diagnostics.md, which explains its findings.

mod differences;
mod driven;
mod findings;
mod in_place;
mod pairs;
mod sketch;
mod units;

use guideway_layout::Code;

/// The page that explains every code.
const PAGE: &str = include_str!("../../../../docs/diagnostics.md");

/// Code with severity, and text, of each entry: "**`CODE`** (SEVERITY): TEXT".
fn entries() -> Vec<(String, &'static str)> {
    let entries = PAGE.split("\n**").skip(1);
    entries
        .map(|entry| {
            let (code, entry) = entry.split_once("** ").expect("the code is bold");
            let (severity, text) = entry.split_once(": ").expect("the severity follows");
            (format!("{code} {severity}"), text)
        })
        .collect()
}

#[test]
fn entries_match_the_codes_in_order() {
    let headings: Vec<_> = entries().into_iter().map(|(heading, _)| heading).collect();
    let expected: Vec<_> = Code::ALL
        .iter()
        .map(|code| format!("`{code}` ({})", code.severity()))
        .collect();
    assert_eq!(headings, expected);
}

#[test]
fn every_entry_has_meaning_and_remedy() {
    for (code, (_, text)) in Code::ALL.iter().zip(entries()) {
        let words: Vec<&str> = text.split_whitespace().collect();
        let (text, meaning) = (words.join(" "), code.meaning());
        assert!(text.contains(meaning), "{code}: {meaning}");
        assert!(text.contains("Remedy: "), "{code} has no remedy");
    }
}
