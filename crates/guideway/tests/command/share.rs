//! Tests of `share`, and of pages that `render` writes.

use std::io::Read;
use std::path::Path;

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use flate2::read::GzDecoder;
use serde_json::Value;

use crate::support::{command, names_in, site, stderr, stdout};

/// The content of an element of a page.
fn content<'a>(page: &'a str, id: &str) -> &'a str {
    let (_, rest) = page.split_once(&format!("id=\"{id}\">")).unwrap();
    rest.split_once("</script>").unwrap().0
}

/// The file that an element of a page holds.
fn file_in(page: &str, id: &str) -> Vec<u8> {
    let packed = BASE64_STANDARD.decode(content(page, id)).unwrap();
    let mut bytes = Vec::new();
    GzDecoder::new(&*packed).read_to_end(&mut bytes).unwrap();
    bytes
}

/// Runs the command in a folder; it must succeed.
fn run_in(folder: &Path, args: &[&str]) {
    let output = command().args(args).current_dir(folder).output().unwrap();
    assert!(output.status.success(), "{}", stderr(&output));
}

#[test]
fn page_opens_as_its_options_say() {
    let folder = tempfile::tempdir().unwrap();
    let share = |args: &[&str]| {
        run_in(folder.path(), args);
        let page = std::fs::read_to_string(folder.path().join("a.html")).unwrap();
        let shared: Value = serde_json::from_str(content(&page, "shared")).unwrap();
        (page, shared)
    };
    let site = site();
    let site = site.to_str().unwrap();
    let view = ["--center", "12.5,-3", "--scale", "40"];
    let colors = ["--color-by", "maxSpeed", "--breaks", "0.5,1"];
    let title = ["--title", "Hall <3>"];
    let args = [&["share", site, "-o", "a.html"], &view[..], &colors, &title].concat();
    let (page, shared) = share(&args);
    assert_eq!(shared["title"], "Hall <3>");
    assert_eq!(shared["name"], "site.arrow");
    assert_eq!(shared["format"], "LIF");
    assert_eq!(shared["look"]["pxPerM"], 40.0);
    assert_eq!(shared["look"]["colorBy"], "maxSpeed");
    let breaks = serde_json::json!([0.5, 1.0]);
    assert_eq!(shared["look"]["breaks"], breaks);
    assert_eq!(shared["look"].get("range"), None);
    assert!(page.contains("connect-src 'none'"));

    let args = [&["render", site, "-o", "a.html"], &view[..], &colors].concat();
    let (of_render, shared) = share(&args);
    assert_eq!(shared["look"]["breaks"], breaks);
    assert_eq!(shared["look"]["center"], serde_json::json!([12.5, -3.0]));
    assert_eq!(content(&of_render, "layout"), content(&page, "layout"));
    // Several files are one layout.
    let (page_of_two, _) = share(&["share", site, site, "-o", "a.html"]);
    for (page, paths) in [(page, 326), (page_of_two, 652)] {
        let file = folder.path().join("of-page.arrow");
        std::fs::write(file, file_in(&page, "layout")).unwrap();
        let info = ["info", "of-page.arrow", "--json"];
        let info = command()
            .args(info)
            .current_dir(folder.path())
            .output()
            .unwrap();
        let info: Value = serde_json::from_slice(&info.stdout).unwrap();
        assert_eq!(info["paths"], paths);
    }
}

#[test]
fn page_holds_floor_plan_vehicle_and_palette() {
    let folder = tempfile::tempdir().unwrap();
    let site = site();
    let site = site.to_str().unwrap();
    let run = |args: &[&str]| run_in(folder.path(), args);
    run(&["convert", site, "plan.dxf"]);
    run(&["render", site, "-o", "plan.png", "--size", "30x20"]);
    let image = std::fs::read(folder.path().join("plan.png")).unwrap();
    let pgm = [b"P5 2 1 255\n".as_slice(), &[0, 254]].concat();
    std::fs::write(folder.path().join("map.pgm"), pgm).unwrap();
    let map = "image: map.pgm\nresolution: 0.5\norigin: [1.0, 2.0, 0.0]\nnegate: 0\n\
               occupied_thresh: 0.65\nfree_thresh: 0.196\n";
    std::fs::write(folder.path().join("map.yaml"), map).unwrap();
    let placement = |px_per_m: f64, rotate_deg: f64, offset: [f64; 2]| {
        let placement =
            serde_json::json!({ "pxPerM": px_per_m, "rotateDeg": rotate_deg, "offset": offset });
        Some(placement)
    };
    let options = ["--color-by", "maxSpeed", "--palette", "gray"];
    let more = ["--range", "0..2", "--envelope", "2x1"];
    for (plan, place, start) in [
        ("plan.dxf@offset=3,2", None, &b"ARROW1"[..]),
        (
            "plan.png@px-per-m=4,rotate=20,offset=1,-5",
            placement(4.0, 20.0, [1.0, -5.0]),
            &image,
        ),
        ("map.yaml", placement(2.0, 0.0, [1.0, 2.0]), b"\x89PNG"),
    ] {
        for start_of in [["share", site, "-o"], ["render", site, "-o"]] {
            let plan_args = ["a.html", "--floor-plan", plan];
            run(&[&start_of[..], &plan_args, &options, &more].concat());
            let page = std::fs::read_to_string(folder.path().join("a.html")).unwrap();
            let shared: Value = serde_json::from_str(content(&page, "shared")).unwrap();
            assert_eq!(shared["look"]["palette"], "gray");
            assert_eq!(shared["look"]["range"], serde_json::json!([0.0, 2.0]));
            assert_eq!(shared["look"]["envelope"], "2x1,1");
            let name = plan.split('@').next().unwrap();
            assert_eq!(shared["floorPlan"]["name"], name);
            let expected = place.clone().unwrap_or(Value::Null);
            assert_eq!(shared["floorPlan"]["placement"], expected);
            let bytes = file_in(&page, "floor-plan");
            assert!(bytes.starts_with(start), "{plan}");
        }
    }
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
            &["render", site, "-o", "a.html", "--world-file"],
            "--world-file",
        ),
        (
            &["share", site, "-o", "a.html", "--envelope", "file"],
            "the file gives none",
        ),
        (
            &["share", site, "-o", "a.html", "--floor-plan", "none.png"],
            "none.png",
        ),
        (
            &["share", site, "-o", "a.html", "--palette", "gray"],
            "--color-by",
        ),
        (
            &["share", site, "-o", "a.html", "--breaks", "0.5"],
            "--color-by",
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
