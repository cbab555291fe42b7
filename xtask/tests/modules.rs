//! No crate has a circle of modules: file A uses file B and B, perhaps through others, uses A.

use std::path::Path;

use xtask::module_graph::{arrows, circles, crate_roots, parse_sources, workspace_circles};

#[test]
fn no_crate_has_a_circle_of_modules() {
    let top = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let roots = crate_roots(&top).expect("the crates are listed");
    assert!(roots.len() >= 15, "the workspace has crates: {roots:?}");
    let found = workspace_circles(&top).expect("the crates are listed");
    let lines = found
        .iter()
        .map(|(root, circle)| format!("{}: {circle}", root.display()));
    let report: Vec<String> = lines.collect();
    assert!(report.is_empty(), "\n{}", report.join("\n"));
}

/// The files of each circle of a crate in memory.
fn found(files: &[(&str, &str)]) -> Vec<Vec<String>> {
    let circles = circles(&arrows(&parse_sources(files)));
    circles.into_iter().map(|circle| circle.files).collect()
}

#[test]
fn finds_two_files_that_use_each_other() {
    let circle = found(&[
        ("lib.rs", "mod a; mod b;"),
        ("a.rs", "use crate::b::B; pub struct A; fn f(_: B) {}"),
        (
            "b.rs",
            "pub struct B; fn g() -> crate::a::A { crate::a::A }",
        ),
    ]);
    assert_eq!(circle, [["a.rs", "b.rs"]]);
}

#[test]
fn finds_a_parent_that_calls_a_child_which_takes_its_types() {
    let circle = found(&[
        (
            "lib.rs",
            "mod part; pub struct Whole; fn f() { part::work() }",
        ),
        (
            "part.rs",
            "use super::Whole; pub fn work() { let _ = Whole; }",
        ),
    ]);
    assert_eq!(circle, [["lib.rs", "part.rs"]]);
}

#[test]
fn finds_methods_that_are_spread_over_files() {
    let circle = found(&[
        ("lib.rs", "mod a; mod b;"),
        (
            "a.rs",
            "pub struct A; impl A { pub fn f(&self) { self.spread() } }",
        ),
        (
            "b.rs",
            "use crate::a::A; impl A { pub fn spread(&self) {} }",
        ),
    ]);
    assert_eq!(circle, [["a.rs", "b.rs"]]);
}

#[test]
fn finds_a_circle_behind_reexports() {
    let circle = found(&[
        ("lib.rs", "mod stage; mod user;"),
        ("stage/mod.rs", "mod inner; pub use inner::Inner;"),
        (
            "stage/inner.rs",
            "use crate::user::help; pub struct Inner; fn f() { help() }",
        ),
        (
            "user.rs",
            "use crate::stage::Inner; pub fn help() {} fn g(_: Inner) {}",
        ),
    ]);
    assert_eq!(circle, [["stage/inner.rs", "user.rs"]]);
}

#[test]
fn passes_doors_and_tests() {
    let circle = found(&[
        ("lib.rs", "mod a; mod b; pub use a::A; pub use b::B;"),
        (
            "a.rs",
            "pub struct A; #[cfg(test)] mod tests { use crate::b::B; fn f(_: B) {} }",
        ),
        ("b.rs", "use crate::A; pub struct B(A);"),
    ]);
    assert!(circle.is_empty(), "{circle:?}");
}
