//! The style rules of CONTRIBUTING.md hold for every file, and each rule can fail.

use std::path::Path;

use xtask::style::{check_file, check_links, check_repository};

#[test]
fn every_file_keeps_the_style_rules() {
    let top = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let violations = check_repository(&top).expect("git lists the files");
    let lines: Vec<String> = violations.iter().map(ToString::to_string).collect();
    assert!(
        lines.is_empty(),
        "{} violations\n{}",
        lines.len(),
        lines.join("\n")
    );
}

/// The message of the only violation of a file.
fn only_message(name: &str, text: &str) -> String {
    let found = check_file(name, text);
    assert_eq!(found.len(), 1, "{found:?}");
    found[0].message.clone()
}

#[test]
fn finds_wide_lines() {
    let line = format!("//! Header.\n// {}\n", "x".repeat(98));
    assert!(only_message("crates/a/src/a.rs", &line).contains("101 columns"));
    let prose = "x".repeat(101);
    assert!(only_message("docs/a.md", &prose).contains("101 columns"));
}

#[test]
fn passes_wide_tables_and_links() {
    let table = format!("| {} |\n[a]({})\n", "x".repeat(120), "y".repeat(120));
    assert!(check_file("docs/a.md", &table).is_empty());
}

#[test]
fn finds_long_files() {
    let long = format!("//! Header.\n{}", "\n".repeat(400));
    assert!(only_message("crates/a/src/a.rs", &long).contains("limit 400"));
    let shader = "\n".repeat(201);
    assert!(only_message("crates/a/src/a.wgsl", &shader).contains("limit 200"));
}

#[test]
fn finds_a_missing_header() {
    assert!(only_message("crates/a/src/a.rs", "use b;\n").contains("no module header"));
    assert!(check_file("crates/a/tests/a.rs", "use b;\n").is_empty());
}

#[test]
fn finds_raw_file_names_in_messages() {
    let text = "//! Header.\nprintln!(\"{}\", path.display());\n";
    assert!(only_message("crates/a/src/a.rs", text).contains("shown_path"));
    for other in [
        "crates/a/tests/a.rs",
        "xtask/src/a.rs",
        "crates/a/src/b/tests.rs",
    ] {
        assert!(check_file(other, text).is_empty(), "{other}");
    }
}

#[test]
fn finds_a_question_word_as_subject() {
    let text = "//! What was covered becomes pixels.\n";
    assert!(only_message("crates/a/src/a.rs", text).contains("`What`"));
    assert!(only_message("docs/a.md", "## How it draws\n").contains("`How`"));
    assert!(check_file("docs/a.md", "## How fast is it?\n").is_empty());
}

#[test]
fn finds_forbidden_words() {
    let text = "//! Header.\nstruct Easel;\n";
    assert!(only_message("crates/a/src/a.rs", text).contains("FrameTarget"));
    assert!(only_message("docs/a.md", "The colour of a path.\n").contains("color"));
    assert!(check_file("docs/a.md", "Easels are not easels.\n").is_empty());
}

#[test]
fn finds_broken_links() {
    let top = Path::new(env!("CARGO_MANIFEST_DIR"));
    let text = "[a](Cargo.toml) [b](https://example.org) [c](#part) [d](missing.md#part)\n";
    let found = check_links(top, "README.md", text);
    assert_eq!(found.len(), 1, "{found:?}");
    assert!(found[0].message.contains("missing.md"));
}
