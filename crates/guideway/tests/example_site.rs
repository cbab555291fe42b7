//! Tests that the committed example site is the output of its generator.

#[expect(dead_code, reason = "`main` is not called here")]
#[path = "../examples/make_site/main.rs"]
mod make_site;

#[test]
fn committed_site_equals_generated_site() {
    let committed = include_str!("../examples/site.lif.json");
    assert!(
        committed == make_site::site(),
        "run `cargo run --example make_site > crates/guideway/examples/site.lif.json`"
    );
}

#[test]
fn campus_repeats_the_site_with_distinct_names() {
    let read = |text: &str| {
        let options = guideway::formats::ReadOptions::default();
        guideway::formats::read_bytes("site.lif.json", text.as_bytes(), &options)
            .unwrap_or_else(|problem| panic!("{problem}"))
    };
    let (one, six) = (read(&make_site::site()), read(&make_site::campus(3, 2)));
    assert_eq!(six.paths.len(), 6 * one.paths.len());
    assert_eq!(six.nodes.len(), 6 * one.nodes.len());
    assert_eq!(six.stations.len(), 6 * one.stations.len());
    assert!(six.diagnostics.is_empty(), "all names are known and unique");
    let (small, large) = (
        one.paths.hull_bounds().unwrap(),
        six.paths.hull_bounds().unwrap(),
    );
    assert!(large.max.x - small.max.x == 300.0 && large.max.y - small.max.y == 95.0);
}
