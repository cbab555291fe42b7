//! The example site that is kept is the one that its program makes.

#[expect(dead_code, reason = "its `main` is not called here")]
#[path = "../examples/make_site.rs"]
mod make_site;

#[test]
fn the_example_site_is_what_its_program_makes() {
    let kept = include_str!("../examples/site.lif.json");
    assert!(
        kept == make_site::site(),
        "run `cargo run --example make_site > crates/guideway/examples/site.lif.json`"
    );
}
