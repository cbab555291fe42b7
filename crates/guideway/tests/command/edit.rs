//! Tests of `edit`: scripts, what they change in the file, and how they fail.

use std::path::{Path, PathBuf};

use crate::support::{command, has_keys, json, site, stderr, stdout};

fn edit(folder: &Path, file: &Path, script: &str, args: &[&str]) -> std::process::Output {
    let steps = folder.join("steps.json");
    std::fs::write(&steps, script).unwrap();
    let out = folder.join("out.lif.json");
    let mut command = command();
    command.arg("edit").arg(file).arg("--script").arg(steps);
    if !args.contains(&"--dry-run") {
        command.arg("-o").arg(out);
    }
    command.args(args).output().unwrap()
}

fn out(folder: &Path) -> PathBuf {
    folder.join("out.lif.json")
}

/// Lines of the first file that the second one does not have at their place, with theirs.
fn changed_lines(before: &Path, after: &Path) -> Vec<(String, String)> {
    let [before, after] = [before, after].map(|path| std::fs::read_to_string(path).unwrap());
    assert_eq!(before.lines().count(), after.lines().count());
    let pairs = before.lines().zip(after.lines());
    let changed = pairs.filter(|(a, b)| a != b);
    changed
        .map(|(a, b)| (a.trim().to_owned(), b.trim().to_owned()))
        .collect()
}

#[test]
fn a_set_speed_and_a_moved_node_change_their_lines_alone() {
    let folder = tempfile::tempdir().unwrap();
    let source = folder.path().join("site.lif.json");
    // One line per member, as people keep files under version control.
    let text = std::fs::read_to_string(site()).unwrap();
    let value: serde_json::Value = serde_json::from_str(&text).unwrap();
    std::fs::write(&source, serde_json::to_string_pretty(&value).unwrap()).unwrap();

    let speed = r#"{"steps": [{"do": "set", "paths": ["dock-1-001--dock-1-002"],
        "property": "maxSpeed", "value": 0.5, "vehicle_type": "tugger-3000"}]}"#;
    let done = edit(folder.path(), &source, speed, &[]);
    assert_eq!(done.status.code(), Some(0), "{}", stderr(&done));
    let changed = changed_lines(&source, &out(folder.path()));
    let expected = (
        "\"maxSpeed\": 0.8,".to_owned(),
        "\"maxSpeed\": 0.5,".to_owned(),
    );
    assert_eq!(changed, [expected]);

    let layout = guideway::open(&source).unwrap();
    let node = (0..layout.nodes.len() as u32).find(|&n| layout.nodes.id(n) == "cross-171");
    let at_m = layout.nodes.position_m(node.unwrap());
    let shift = format!(
        r#"{{"steps": [{{"do": "move-node", "node": "cross-171", "to": [{}, {}]}}]}}"#,
        at_m.x,
        at_m.y + 0.25
    );
    let done = edit(folder.path(), &source, &shift, &[]);
    assert_eq!(done.status.code(), Some(0), "{}", stderr(&done));
    let moved = guideway::open(out(folder.path())).unwrap();
    let paths = |layout: &guideway::layout::Layout| layout.paths.len();
    assert_eq!(paths(&moved), paths(&layout));
    for path in moved.paths.iter() {
        let (start, end) = path.ends().unwrap();
        for (node, at_m) in [(path.start_node(), start), (path.end_node(), end)] {
            let node_m = moved.nodes.position_m(node.unwrap());
            assert!(node_m.distance(at_m) < 1e-6, "{} is torn off", path.id());
        }
    }
}

#[test]
fn a_moved_node_rewrites_no_edge_elsewhere() {
    let folder = tempfile::tempdir().unwrap();
    let shift = r#"{"steps": [{"do": "move", "nodes": ["cross-171"], "by": [0.25, 0]}]}"#;
    let done = edit(folder.path(), &site(), shift, &[]);
    assert_eq!(done.status.code(), Some(0), "{}", stderr(&done));
    let read = |path: &Path| -> serde_json::Value {
        serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap()
    };
    let [before, after] = [site(), out(folder.path())].map(|path| read(&path));
    let edges =
        |value: &serde_json::Value| value["layouts"][0]["edges"].as_array().unwrap().clone();
    let changed = edges(&before)
        .into_iter()
        .zip(edges(&after))
        .filter(|(a, b)| a != b);
    let changed: Vec<_> = changed.collect();
    let is_at = |edge: &serde_json::Value| {
        edge["startNodeId"] == "cross-171" || edge["endNodeId"] == "cross-171"
    };
    assert!(!changed.is_empty() && changed.iter().all(|(edge, _)| is_at(edge)));
    let nodes =
        |value: &serde_json::Value| value["layouts"][0]["nodes"].as_array().unwrap().clone();
    let changed = nodes(&before)
        .into_iter()
        .zip(nodes(&after))
        .filter(|(a, b)| a != b);
    let changed: Vec<String> = changed
        .map(|(node, _)| node["nodeId"].to_string())
        .collect();
    assert_eq!(changed, ["\"cross-171\""]);
    assert_eq!(before["layouts"][1], after["layouts"][1]);
    assert_eq!(
        before["layouts"][0]["stations"],
        after["layouts"][0]["stations"]
    );
}

#[test]
fn references_follow_a_renamed_node_into_the_file() {
    let folder = tempfile::tempdir().unwrap();
    let script = r#"{"steps": [{"do": "rename", "node": "cross-171", "to": "gate"}]}"#;
    let done = edit(folder.path(), &site(), script, &["--json"]);
    let report = json(&done, "edit");
    has_keys(&report, &["ms.edit", "ms.total", "not_stored", "output"]);
    assert_eq!(report["steps"][0]["names"][0], "gate");
    let text = std::fs::read_to_string(out(folder.path())).unwrap();
    assert!(!text.contains("NodeId\": \"cross-171\"") && text.contains("\"gate\""));
    let layout = guideway::open(out(folder.path())).unwrap();
    let ends = layout
        .paths
        .iter()
        .flat_map(|path| [path.start_node(), path.end_node()]);
    let gate = ends
        .flatten()
        .filter(|&node| layout.nodes.id(node) == "gate");
    assert!(gate.count() > 1);
}

#[test]
fn levels_and_vehicle_types_reach_the_file() {
    let folder = tempfile::tempdir().unwrap();
    let script = r#"{"steps": [
        {"do": "create-level", "id": "roof", "name": "Roof"},
        {"do": "delete-level", "level": "mezzanine", "move_to": "roof"},
        {"do": "change-level", "level": "hall", "id": "ground"},
        {"do": "change-vehicle-type", "vehicle_type": "tugger-3000", "id": "tugger"},
        {"do": "create-vehicle-type", "id": "crane", "properties": {"maxSpeed": 0.5}},
        {"do": "delete-vehicle-type", "vehicle_type": "stacker-1200", "replace_by": "crane"}
    ]}"#;
    let done = edit(folder.path(), &site(), script, &["--json"]);
    let report = json(&done, "edit");
    assert_eq!(report["steps"][0]["names"][0], "roof");
    assert_eq!(report["steps"][1]["paths"], 8);
    let text = std::fs::read_to_string(out(folder.path())).unwrap();
    // `layoutLevelId` is a property of its own, and stays.
    for gone in [
        "mezzanine\"",
        "layoutId\": \"hall\"",
        "mapId\":\"hall\"",
        "tugger-3000",
        "stacker-1200",
    ] {
        assert!(!text.contains(gone), "{gone}");
    }
    let [before, after] = [site(), out(folder.path())].map(|path| guideway::open(path).unwrap());
    let levels: Vec<&str> = after.levels.iter().map(|level| level.id.as_str()).collect();
    assert_eq!(levels, ["ground", "roof"]);
    let names: Vec<&str> = after.vehicle_type_names().into_iter().collect();
    assert_eq!(names, ["crane", "tugger"]);
    let on = |layout: &guideway::layout::Layout, level: u32| {
        let paths = layout.paths.iter();
        paths.filter(|path| path.level() == Some(level)).count()
    };
    assert_eq!(
        [on(&after, 0), on(&after, 1)],
        [on(&before, 0), on(&before, 1)]
    );
}

#[test]
fn a_failing_step_writes_nothing_and_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let fine = r#"{"do": "two-way", "paths": "all"}"#;
    let mut steps = vec![fine; 6];
    let cases = [
        (
            r#"{"do": "set", "paths": ["nowhere"], "property": "maxSpeed", "value": 1}"#,
            "step 7 (`set`), member `paths`: no path is called `nowhere`",
        ),
        (
            r#"{"do": "set", "paths": "all", "property": "maxSpeed", "value": "fast"}"#,
            "step 7 (`set`): `maxSpeed` takes a number of at least 0 in m/s, not `fast`",
        ),
        (
            r#"{"do": "set", "paths": {"query": "speed >"}, "property": "x", "value": 1}"#,
            "step 7 (`set`), member `paths`: query, at character 1",
        ),
        (
            r#"{"do": "delete", "nodes": ["cross-171"]}"#,
            "step 7 (`delete`): the node `cross-171` has",
        ),
        (
            r#"{"do": "move", "paths": "all", "by": [1]}"#,
            "step 7 (`move`), member `by`: [1] is not two numbers in meters",
        ),
        (
            r#"{"do": "set-level", "paths": "all", "level": "attic"}"#,
            "step 7 (`set-level`), member `level`: no level is called `attic`",
        ),
        (
            r#"{"do": "delete-level", "level": "mezzanine"}"#,
            "step 7 (`delete-level`): the level `mezzanine` has",
        ),
        (
            r#"{"do": "delete-level", "level": "hall", "move_to": null, "with_elements": true}"#,
            "member `move_to`: `move_to` and `with_elements` exclude each other",
        ),
        (
            r#"{"do": "change-level", "level": "mezzanine", "id": "hall"}"#,
            "step 7 (`change-level`): another level is called `hall`",
        ),
        (
            r#"{"do": "delete-vehicle-type", "vehicle_type": "hovercraft"}"#,
            "no vehicle type is called `hovercraft`",
        ),
        (
            r#"{"do": "create-vehicle-type", "id": "crane", "properties": {"maxSpeed": "fast"}}"#,
            "`maxSpeed` takes a number of at least 0 in m/s, not `fast`",
        ),
        (
            r#"{"do": "paste", "from": "none.lif.json", "paths": "all"}"#,
            "step 7 (`paste`), member `from`:",
        ),
        (r#"{"do": "fly"}"#, "step 7: unknown step `fly`"),
        (
            r#"{"do": "rename", "node": "cross-171", "into": "a", "to": "b"}"#,
            "step 7 (`rename`): unknown member `into`",
        ),
        (
            r#"{"do": "rename", "node": "cross-171"}"#,
            "step 7 (`rename`) lacks the member `to`",
        ),
    ];
    for (step, said) in cases {
        steps.push(step);
        let script = format!("{{\"steps\": [{}]}}", steps.join(","));
        let done = edit(folder.path(), &site(), &script, &[]);
        let error = stderr(&done);
        assert_eq!(done.status.code(), Some(2), "{error}");
        assert!(error.contains(said) && error.contains("hint: "), "{error}");
        assert!(!out(folder.path()).exists(), "{step}");
        steps.pop();
    }
    for (script, said) in [
        ("{", "no JSON"),
        ("[]", "the script is no object"),
        ("{\"steps\": [1]}", "step 1 is no object"),
        ("{\"steps\": [], \"more\": 1}", "unknown member `more`"),
    ] {
        let done = edit(folder.path(), &site(), script, &[]);
        assert!(stderr(&done).contains(said), "{}", stderr(&done));
    }
}

#[test]
fn a_dry_run_lists_what_each_step_touches_and_writes_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let script = r#"{"steps": [
        {"do": "copy", "paths": {"query": "id ~ ring"}, "count": 2, "step": [0, 60]},
        {"do": "create-station", "id": "PICK-07", "nodes": ["cross-171"]}]}"#;
    let done = edit(folder.path(), &site(), script, &["--dry-run"]);
    let said = stdout(&done);
    assert_eq!(done.status.code(), Some(0), "{}", stderr(&done));
    assert!(said.contains("  1 copy: "), "{said}");
    assert!(
        said.contains("  2 create-station: 1 station: PICK-07"),
        "{said}"
    );
    assert!(said.contains("nothing was written"), "{said}");
    assert!(!out(folder.path()).exists());
}
