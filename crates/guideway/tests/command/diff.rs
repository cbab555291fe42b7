//! `guideway diff`: the list of changes as text, Markdown and JSON, and the picture.

use std::fs;
use std::path::PathBuf;

use crate::support::{json, read_png, run, site, stderr, stdout};

/// The example site with one speed changed and one edge removed, in a folder of its own.
fn edited(folder: &tempfile::TempDir) -> PathBuf {
    let mut site: serde_json::Value =
        serde_json::from_slice(&fs::read(site()).expect("the site")).expect("JSON");
    let edges = site["layouts"][0]["edges"].as_array_mut().expect("edges");
    edges.remove(1);
    let entry = &mut edges[0]["vehicleTypeEdgeProperties"][0];
    entry["maxSpeed"] = serde_json::json!(0.25);
    let file = folder.path().join("edited.lif.json");
    fs::write(&file, site.to_string()).expect("a file");
    file
}

#[test]
fn lists_changes_in_three_forms() {
    let folder = tempfile::tempdir().expect("a folder");
    let new = edited(&folder);
    let old = site();
    let args = |more: &[&str]| {
        let mut all = vec!["diff".into(), old.clone(), new.clone()];
        all.extend(more.iter().map(PathBuf::from));
        all
    };
    let output = run(args(&[]));
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let text = stdout(&output);
    assert!(
        text.contains("1 path removed") && text.contains("-> 0.25 m/s"),
        "{text}"
    );

    let markdown = stdout(&run(args(&["--form", "markdown"])));
    assert!(markdown.contains("| element | change |"), "{markdown}");

    let output = run(args(&["--json", "--exit-code"]));
    assert_eq!(output.status.code(), Some(1));
    let report = json(&output, "diff");
    let changes = report["changes"].as_array().expect("changes");
    let count = |kind: &str| changes.iter().filter(|c| c["change"] == kind).count();
    assert_eq!((count("removed"), count("set")), (1, 1), "{report:#}");
}

#[test]
fn equal_files_do_not_differ() {
    let output = run(["diff".into(), site(), site(), "--exit-code".into()]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    assert!(
        stdout(&output).contains("no difference"),
        "{}",
        stdout(&output)
    );
}

#[test]
fn picture_shows_what_is_gone() {
    let folder = tempfile::tempdir().expect("a folder");
    let picture = folder.path().join("diff.png");
    let output = run([
        "diff".into(),
        site(),
        edited(&folder),
        "-o".into(),
        picture.clone(),
    ]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let (_, _, pixels) = read_png(&picture);
    let is_red = |p: &[u8]| p[0] > 180 && p[1] < 80 && p[2] < 80;
    let is_blue = |p: &[u8]| p[0] < 80 && p[2] > 180;
    assert!(pixels.chunks_exact(4).any(is_red));
    assert!(pixels.chunks_exact(4).any(is_blue));
}
