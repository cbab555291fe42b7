//! Tests of `check` as a tool of a repository: selected kinds, settings, baselines, exit codes.

use std::fs;
use std::path::Path;
use std::process::Output;

use serde_json::{Value, json};

use crate::support::{command, json as answer, site, stderr, stdout};

/// Runs `check` in a folder.
fn check(folder: &Path, args: &[&str]) -> Output {
    let mut command = command();
    command.current_dir(folder).arg("check").args(args);
    command.output().unwrap()
}

fn report(folder: &Path, args: &[&str]) -> Value {
    let output = check(folder, &[&["--json"], args].concat());
    assert!(output.status.code() < Some(2), "{}", stdout(&output));
    answer(&output, "check")
}

fn codes(report: &Value) -> Vec<&str> {
    let kinds = report["kinds"].as_array().unwrap();
    kinds
        .iter()
        .map(|kind| kind["code"].as_str().unwrap())
        .collect()
}

/// Writes a layout of an edge that misses its end node, an unused node and a duplicate of the edge.
fn write_layout(path: &Path, more: &[Value]) {
    let node = |id: &str, x: f64| {
        let at = json!({ "x": x, "y": 0.0 });
        json!({ "nodeId": id, "nodePosition": at, "vehicleTypeNodeProperties": [] })
    };
    let edge = |id: &str| {
        json!({
            "edgeId": id, "startNodeId": "a", "endNodeId": "b",
            "vehicleTypeEdgeProperties": [{
                "vehicleTypeId": "agv",
                "trajectory": {
                    "degree": 1, "knotVector": [0.0, 0.0, 1.0, 1.0],
                    "controlPoints": [{ "x": 0.0, "y": 0.0 }, { "x": 9.0, "y": 0.0 }],
                },
            }],
        })
    };
    let mut nodes = vec![node("a", 0.0), node("b", 10.0), node("unused", 20.0)];
    nodes.extend(more.iter().cloned());
    let file = json!({
        "metaInformation": { "projectIdentification": "test", "creator": "test",
            "exportTimestamp": "2026-01-01T00:00:00Z", "lifVersion": "1.0.0" },
        "layouts": [{
            "layoutId": "ground", "nodes": nodes, "edges": [edge("e1"), edge("e2")],
            "stations": [],
        }],
    });
    fs::create_dir_all(path.parent().unwrap()).unwrap();
    fs::write(path, serde_json::to_string_pretty(&file).unwrap()).unwrap();
}

#[test]
fn only_and_ignore_select_kinds() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    write_layout(&folder.join("a.json"), &[]);
    let all = report(folder, &["a.json"]);
    assert!(codes(&all).contains(&"node-gap") && codes(&all).contains(&"unused-node"));
    let only = report(folder, &["a.json", "--only", "node-gap,unused-node"]);
    assert_eq!(codes(&only), ["node-gap", "unused-node"]);
    let rest = report(
        folder,
        &["a.json", "--ignore", "node-gap", "--ignore", "unused-node"],
    );
    assert_eq!(codes(&rest).len(), codes(&all).len() - 2);
    assert!(!codes(&rest).contains(&"node-gap"));
    let unknown = check(folder, &["a.json", "--ignore", "nodegap"]);
    assert_eq!(unknown.status.code(), Some(2));
    let said = stderr(&unknown);
    assert!(
        said.contains("`nodegap`") && said.contains("nearest is node-gap"),
        "{said}"
    );
}

#[test]
fn failing_level_decides_the_exit_code() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    write_layout(&folder.join("a.json"), &[]);
    let exit = |args: &[&str]| check(folder, &[&["a.json"], args].concat()).status.code();
    assert_eq!(exit(&[]), Some(0), "warnings alone pass");
    assert_eq!(exit(&["--fail-on", "error"]), Some(0));
    assert_eq!(exit(&["--fail-on", "warning"]), Some(1));
    assert_eq!(exit(&["--strict"]), Some(1));
    assert_eq!(exit(&["--only", "unused-node", "--strict"]), Some(0));
    assert_eq!(
        exit(&["--only", "unused-node", "--fail-on", "info"]),
        Some(1)
    );
    assert_eq!(
        exit(&["--strict", "--fail-on", "info"]),
        Some(2),
        "they contradict"
    );
}

#[test]
fn settings_of_the_nearest_folder_apply_and_arguments_win() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    write_layout(&folder.join("halls/north/a.json"), &[]);
    write_layout(&folder.join("halls/old/b.json"), &[]);
    fs::write(
        folder.join("guideway.toml"),
        "[check]\nignore = [\"unused-node\"]\nfail-on = \"warning\"\n\
         [[check.files]]\npaths = [\"halls/old/**\"]\nfail-on = \"error\"\n\
         ignore = [\"node-gap\"]\n",
    )
    .unwrap();
    let north = "halls/north/a.json";
    let of_north = check(folder, &[north]);
    assert_eq!(of_north.status.code(), Some(1), "warnings fail");
    let said = stdout(&of_north);
    assert!(
        !said.contains("unused-node") && said.contains("guideway.toml"),
        "{said}"
    );
    let old = report(folder, &["halls/old/b.json"]);
    assert_eq!(old["exit_code"], 0);
    assert!(!codes(&old).contains(&"node-gap") && codes(&old).contains(&"duplicate-path"));
    let config = old["files"][0]["config"].as_str().unwrap();
    assert!(config.ends_with("guideway.toml"), "{config}");
    // An argument wins.
    let loose = check(folder, &[north, "--fail-on", "error"]);
    assert_eq!(loose.status.code(), Some(0));
    assert_eq!(
        codes(&report(folder, &[north, "--only", "unused-node"])),
        ["unused-node"]
    );
    // The nearest file wins over the one above, and limits of a file hold for its folder.
    fs::write(folder.join("halls/guideway.toml"), "[limits]\npaths = 1\n").unwrap();
    let limited = check(folder, &[north]);
    assert_eq!(limited.status.code(), Some(2));
    assert!(
        stderr(&limited).contains("limit of 1"),
        "{}",
        stderr(&limited)
    );
    let raised = check(folder, &[north, "--limit", "paths=9"]);
    assert_eq!(raised.status.code(), Some(0), "{}", stderr(&raised));
    fs::write(folder.join("halls/guideway.toml"), "[check]\nignor = []\n").unwrap();
    let bad = check(folder, &[north]);
    assert_eq!(bad.status.code(), Some(2));
    let said = stderr(&bad);
    for part in ["halls/guideway.toml", "line 2", "ignor", "hint: "] {
        assert!(said.contains(part), "{part}: {said}");
    }
    let given = check(folder, &[north, "--config", "guideway.toml"]);
    assert_eq!(given.status.code(), Some(1), "{}", stderr(&given));
}

#[test]
fn only_new_findings_count_against_a_baseline() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let file = folder.join("site/a.json");
    write_layout(&file, &[]);
    let args = ["site/a.json", "--fail-on", "info"];
    let saved = check(
        folder,
        &[&args[..], &["--write-baseline", "known.json"]].concat(),
    );
    assert_eq!(saved.status.code(), Some(0), "{}", stderr(&saved));
    assert!(
        stdout(&saved).contains("saved as known"),
        "{}",
        stdout(&saved)
    );
    let with_baseline = [&args[..], &["--baseline", "known.json"]].concat();
    let same = report(folder, &with_baseline);
    assert_eq!(
        (&same["exit_code"], &same["findings"]),
        (&json!(0), &json!([]))
    );
    assert!(same["known"].as_u64().unwrap() >= 3, "{same:#}");
    assert_eq!(same["gone"], json!([]));

    // Moved lines change nothing; a new unused node is new.
    let text = fs::read_to_string(&file).unwrap();
    fs::write(&file, text.replace("{\n", "{\n\n\n")).unwrap();
    assert_eq!(report(folder, &with_baseline)["findings"], json!([]));
    let node = json!({
        "nodeId": "another", "nodePosition": { "x": 30.0, "y": 0.0 },
        "vehicleTypeNodeProperties": [],
    });
    write_layout(&file, &[node]);
    let new = report(folder, &with_baseline);
    assert_eq!(new["exit_code"], 1);
    let places: Vec<&str> = new["findings"]
        .as_array()
        .unwrap()
        .iter()
        .map(|finding| finding["place"].as_str().unwrap())
        .collect();
    assert_eq!(places, ["node \"another\""]);

    // The report names mended findings.
    let text = fs::read_to_string(&file).unwrap();
    fs::write(&file, text.replace("\"unused\"", "\"renamed\"")).unwrap();
    let mended = report(folder, &with_baseline);
    assert_eq!(mended["gone"][0]["place"], "node \"unused\"");
    let said = stdout(&check(folder, &with_baseline));
    assert!(
        said.contains("gone: unused-node at node \"unused\""),
        "{said}"
    );

    // From another folder, the same files are known.
    let inner = folder.join("site");
    let other = check(&inner, &["a.json", "--baseline", "../known.json", "--json"]);
    assert!(answer(&other, "check")["known"].as_u64().unwrap() >= 2);
    fs::write(folder.join("known.json"), "{}").unwrap();
    let bad = check(folder, &with_baseline);
    assert_eq!(bad.status.code(), Some(2));
    assert!(
        stderr(&bad).contains("--write-baseline"),
        "{}",
        stderr(&bad)
    );
}

#[test]
fn an_unreadable_file_is_a_finding_and_not_the_end() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    write_layout(&folder.join("a.json"), &[]);
    fs::write(folder.join("b.json"), "{\n\"layouts\": [,\n").unwrap();
    let site = site();
    let args = ["b.json", "a.json", "no-such-file", site.to_str().unwrap()];
    let output = check(folder, &[&["--json"], &args[..]].concat());
    assert_eq!(output.status.code(), Some(1));
    let found = answer(&output, "check");
    let unread: Vec<&Value> = found["findings"]
        .as_array()
        .unwrap()
        .iter()
        .filter(|finding| finding["code"] == "unreadable")
        .collect();
    assert_eq!(unread.len(), 2, "{found:#}");
    assert_eq!(
        (&unread[0]["file"], &unread[0]["line"]),
        (&json!("b.json"), &json!(2))
    );
    assert_eq!(unread[1]["file"], "no-such-file");
    assert!(found["files"][3]["paths"].as_u64().unwrap() > 0);
    let said = stdout(&check(folder, &args));
    assert!(said.contains("b.json: not read, 1 error"), "{said}");
    // Without any readable file the command could not run.
    let none = check(folder, &["b.json", "no-such-file"]);
    assert_eq!(none.status.code(), Some(2));
    assert!(stdout(&none).contains("unreadable"), "{}", stdout(&none));
    let sarif = check(folder, &["b.json", "--format", "sarif"]);
    assert_eq!(sarif.status.code(), Some(2));
    let log: Value = serde_json::from_slice(&sarif.stdout).unwrap();
    assert_eq!(
        log["runs"][0]["invocations"][0]["executionSuccessful"],
        false
    );
}
