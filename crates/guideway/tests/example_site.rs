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

#[test]
fn a_large_site_is_many_halls() {
    let read = |text: &str| {
        let options = guideway::formats::ReadOptions::default();
        guideway::formats::read_bytes("site.lif.json", text.as_bytes(), &options)
            .unwrap_or_else(|problem| panic!("{problem}"))
    };
    let (one, six) = (read(&make_site::site()), read(&make_site::campus(3, 2)));
    assert_eq!(six.paths.len(), 6 * one.paths.len());
    assert_eq!(six.nodes.len(), 6 * one.nodes.len());
    assert_eq!(six.stations.len(), 6 * one.stations.len());
    assert!(six.diagnostics.is_empty(), "all names are found, and once");
    let (small, large) = (
        one.paths.hull_bounds().unwrap(),
        six.paths.hull_bounds().unwrap(),
    );
    assert!(large.max.x - small.max.x == 300.0 && large.max.y - small.max.y == 95.0);
}
