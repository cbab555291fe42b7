//! Runs the worked examples of `examples/tasks`.

#[path = "../../examples/tasks/main.rs"]
#[expect(dead_code, reason = "the test runs the tasks itself")]
mod examples;

#[test]
fn worked_examples_say_what_they_did() {
    let folder = tempfile::tempdir().unwrap();
    let said = examples::run_all(&[], folder.path()).unwrap();
    let of = |name: &str| {
        let found = said.iter().find(|(task, _)| *task == name);
        found.map(|(_, text)| text.as_str()).unwrap_or_default()
    };
    assert_eq!(
        of("open"),
        "dock-1-002--dock-1-003 is 4 m long, at 0.3 m/s; its middle is at 36, 4"
    );
    assert_eq!(of("check"), "0 warnings and errors ");
    assert_eq!(of("render"), "326 paths in site.svg and plan.png");
    assert_eq!(of("edit"), "4 m before, 4.031 m after");
    assert!(of("convert").starts_with("site.dxf has 326 paths, "));
    assert_eq!(of("network"), "294 edges between 225 nodes");
    assert_eq!(of("route"), "5 paths, 39.3 m, 59.7 s");
    for name in [
        "site.svg",
        "plan.png",
        "moved.lif.json",
        "site.arrow",
        "network.lif.json",
    ] {
        assert!(folder.path().join(name).exists(), "{name}");
    }
    assert!(
        examples::run_all(&["open".to_owned()], folder.path())
            .unwrap()
            .len()
            == 1
    );
}
