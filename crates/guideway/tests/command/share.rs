//! Tests of `share`, and of pages that `render` writes.

use serde_json::Value;

use crate::support::{command, names_in, site, stderr, stdout};

/// The content of an element of a page.
fn content<'a>(page: &'a str, id: &str) -> &'a str {
    let (_, rest) = page.split_once(&format!("id=\"{id}\">")).unwrap();
    rest.split_once("</script>").unwrap().0
}

#[test]
fn page_opens_as_its_options_say() {
    let folder = tempfile::tempdir().unwrap();
    let share = |args: &[&str]| {
        let output = command()
            .args(args)
            .current_dir(folder.path())
            .output()
            .unwrap();
        assert!(output.status.success(), "{}", stderr(&output));
        let page = std::fs::read_to_string(folder.path().join("a.html")).unwrap();
        let shared: Value = serde_json::from_str(content(&page, "shared")).unwrap();
        (page, shared)
    };
    let site = site();
    let site = site.to_str().unwrap();
    let view = ["--center", "12.5,-3", "--scale", "40"];
    let colors = ["--color-by", "maxSpeed", "--title", "Hall <3>"];
    let args = [&["share", site, "-o", "a.html"], &view[..], &colors].concat();
    let (page, shared) = share(&args);
    assert_eq!(shared["title"], "Hall <3>");
    assert_eq!(shared["name"], "site.lif.json");
    assert_eq!(shared["look"]["pxPerM"], 40.0);
    assert_eq!(shared["look"]["colorBy"], "maxSpeed");
    assert!(page.contains("connect-src 'none'"));

    let (of_render, shared) = share(&[&["render", site, "-o", "a.html"], &view[..]].concat());
    assert_eq!(shared["look"]["center"], serde_json::json!([12.5, -3.0]));
    assert_eq!(content(&of_render, "layout"), content(&page, "layout"));
    // Several files are one layout, as Arrow.
    let (_, shared) = share(&["share", site, site, "-o", "a.html"]);
    assert_eq!(shared["name"], "site.arrow");
}

#[test]
fn bad_pages_are_refused_and_leave_no_file() {
    let folder = tempfile::tempdir().unwrap();
    let site = site();
    let site = site.to_str().unwrap();
    for (args, said) in [
        (&["share", site, "-o", "a.png"][..], "a.html"),
        (&["share", site, "-o", "a.html", "--scale", "2"], "--center"),
        (
            &["share", site, "-o", "a.html", "--color-by", "x"],
            "maxSpeed",
        ),
        (&["share", site, "-o", "a.html", "--level", "roof"], "roof"),
        (&["share", "none.json", "-o", "a.html"], "none.json"),
        (&["share", site, "-o", "none/a.html"], "folder"),
        (
            &["render", site, "-o", "a.html", "--method", "cpu"],
            "--method",
        ),
        (
            &["render", site, "-o", "a.html", "--envelope", "2x1"],
            "--envelope",
        ),
        (
            &["render", site, "-o", "a.html", "--min-px", "3"],
            "--min-px",
        ),
        (&["render", site, "-o", "a.html", "--nodes"], "--nodes"),
    ] {
        let output = command()
            .args(args)
            .current_dir(folder.path())
            .output()
            .unwrap();
        assert_eq!(
            output.status.code(),
            Some(2),
            "{args:?}: {}",
            stdout(&output)
        );
        assert!(
            stderr(&output).contains(said),
            "{args:?}: {}",
            stderr(&output)
        );
    }
    assert_eq!(names_in(folder.path()), [""; 0]);
}
