//! Tests of `guideway info`, `check`, `methods`, `completions`, `man` and the help.

use std::fs;
use std::path::PathBuf;

use crate::support::{command, has_keys, json as answer, names_in, run, site, stderr, stdout};
use serde_json::{Value, json};

/// A LIF file with one edge from (0, 0) to (10, 0), modified by `change`.
fn lif(folder: &tempfile::TempDir, change: impl FnOnce(&mut Value)) -> PathBuf {
    let node = |id: &str, x: f64| {
        json!({
            "nodeId": id,
            "mapId": "m",
            "nodePosition": { "x": x, "y": 0.0 },
            "vehicleTypeNodeProperties": [{ "vehicleTypeId": "v" }],
        })
    };
    let mut layout = json!({
        "layoutId": "floor",
        "nodes": [node("a", 0.0), node("b", 10.0)],
        "edges": [{
            "edgeId": "e",
            "startNodeId": "a",
            "endNodeId": "b",
            "vehicleTypeEdgeProperties": [{
                "vehicleTypeId": "v",
                "vehicleOrientation": 0.0,
                "orientationType": "TANGENTIAL",
                "maxSpeed": 1.5,
                "rotationAllowed": false,
            }],
        }],
        "stations": [],
    });
    change(&mut layout);
    let file = json!({
        "metaInformation": {
            "projectIdentification": "p",
            "creator": "c",
            "exportTimestamp": "2025-01-01T00:00:00Z",
            "lifVersion": "1.0.0",
        },
        "layouts": [layout],
    });
    let path = folder.path().join("a.lif.json");
    fs::write(&path, file.to_string()).unwrap();
    path
}

fn on_file(args: &[&str], file: &PathBuf) -> std::process::Output {
    command().args(args).arg(file).output().unwrap()
}

#[test]
fn severities_have_colors_where_they_are_asked_for() {
    let said = |args: &[&str], variables: &[(&str, &str)]| {
        let mut all = command();
        all.env_remove("NO_COLOR").env_remove("CLICOLOR_FORCE");
        let output = all.args(args).envs(variables.iter().copied()).output();
        let output = output.unwrap();
        stdout(&output) + &stderr(&output)
    };
    let site = site();
    let check = ["check", "--show", "1", site.to_str().unwrap()];
    let (forced, none) = (("CLICOLOR_FORCE", "1"), ("NO_COLOR", "1"));
    for (args, variables, has_colors) in [
        (&["--color", "auto"][..], &[][..], false),
        (&[], &[forced], true),
        (&[], &[forced, none], false),
        (&["--color=always"], &[none], true),
        (&["--color", "never"], &[forced], false),
    ] {
        let text = said(&[&check, args].concat(), variables);
        let word = if has_colors {
            "\u{1b}[1;34minfo\u{1b}[0m: "
        } else {
            "info: "
        };
        assert!(text.contains(word), "{args:?}, {variables:?}: {text}");
        // Errors of arguments and help have them too.
        for more in [&["--no-such"][..], &["--help"]] {
            let text = said(&[&check, args, more].concat(), variables);
            assert_eq!(text.contains('\u{1b}'), has_colors, "{args:?}: {text}");
        }
    }
}

#[test]
fn a_quiet_check_prints_the_errors_that_it_finds() {
    let folder = tempfile::tempdir().unwrap();
    let faulty = lif(&folder, |hall| hall["edges"][0]["endNodeId"] = json!("c"));
    let said = stdout(&on_file(&["check", "-q"], &faulty));
    assert!(said.starts_with("error: unknown-node (2)"), "{said}");
    assert!(
        !said.contains("warning") && !said.contains("took"),
        "{said}"
    );
    let sound = lif(&folder, |_| {});
    assert_eq!(stdout(&on_file(&["check", "-q"], &sound)), "");
}

#[test]
fn info_summarizes_the_file() {
    let folder = tempfile::tempdir().unwrap();
    let file = lif(&folder, |_| {});
    let said = stdout(&on_file(&["info"], &file));
    for part in [
        "LIF 1.0",
        "10 m",
        "maxSpeed (m/s)",
        "maxSpeed 1.5 m/s",
        "floor (1 path)",
        "took ",
    ] {
        assert!(said.contains(part), "{part} in {said}");
    }
    let report = answer(&on_file(&["info", "--json"], &file), "info");
    has_keys(
        &report,
        &[
            "file",
            "file_bytes",
            "format",
            "format_version",
            "source_counts",
            "paths",
            "two_way_paths",
            "kinds",
            "segments",
            "control_points",
            "nodes",
            "stations",
            "levels",
            "vehicle_types",
            "bounds_m.min",
            "bounds_m.max",
            "length_m",
            "attributes.paths",
            "attributes.nodes",
            "attributes.stations",
            "refused",
            "findings",
            "memory_bytes",
            "ms.read",
            "ms.measure",
            "ms.total",
        ],
    );
    assert_eq!((&report["paths"], &report["nodes"]), (&json!(1), &json!(2)));
    assert!((report["length_m"].as_f64().unwrap() - 10.0).abs() < 1e-5);
    let kind = &report["kinds"][0];
    assert_eq!(
        (&kind["name"], &kind["paths"]),
        (&json!("one-way"), &json!(1))
    );
    let speeds = report["attributes"]["paths"].as_array().unwrap();
    let speed = speeds.iter().find(|c| c["name"] == "maxSpeed").unwrap();
    has_keys(
        speed,
        &["type", "values", "missing", "distinct", "min", "max", "top"],
    );
    assert_eq!(
        (&speed["unit"], &speed["per_type"]),
        (&json!("m/s"), &json!(0))
    );
    assert_eq!(speed["top"][0], json!({ "value": "1.5", "count": 1 }));
}

#[test]
fn check_exits_with_0_without_findings() {
    let folder = tempfile::tempdir().unwrap();
    let file = lif(&folder, |_| {});
    for args in [&["check"][..], &["check", "--strict"]] {
        let output = on_file(args, &file);
        assert_eq!(output.status.code(), Some(0), "{}", stdout(&output));
    }
    // The two-way roads of the site are a note, not a warning.
    let output = on_file(&["check", "--strict"], &site());
    assert_eq!(output.status.code(), Some(0), "{}", stdout(&output));
}

#[test]
fn check_exits_with_1_on_warnings_only_if_strict() {
    let folder = tempfile::tempdir().unwrap();
    let file = lif(&folder, |layout| {
        let edge = layout["edges"][0].clone();
        layout["edges"].as_array_mut().unwrap().push(edge);
    });
    let output = on_file(&["check"], &file);
    assert_eq!(output.status.code(), Some(0), "{}", stdout(&output));
    assert!(
        stdout(&output).contains("warning: duplicate-id"),
        "{}",
        stdout(&output)
    );
    let strict = on_file(&["check", "--strict"], &file);
    assert_eq!(strict.status.code(), Some(1));
}

#[test]
fn check_exits_with_1_on_errors_and_prints_remedies() {
    let folder = tempfile::tempdir().unwrap();
    let file = lif(&folder, |layout| {
        layout["edges"][0]["endNodeId"] = json!("nowhere");
    });
    let output = on_file(&["check"], &file);
    assert_eq!(output.status.code(), Some(1));
    let said = stdout(&output);
    assert!(
        said.contains("error: unknown-node") && said.contains("hint: "),
        "{said}"
    );

    let output = on_file(&["check", "--json"], &file);
    assert_eq!(output.status.code(), Some(1));
    let report = answer(&output, "check");
    let keys = [
        "file",
        "paths",
        "refused",
        "errors",
        "warnings",
        "notes",
        "exit_code",
        "kinds",
        "findings",
    ];
    has_keys(&report, &keys);
    has_keys(
        &report["kinds"][0],
        &["code", "severity", "count", "meaning"],
    );
    let keys = ["code", "severity", "place", "line", "message", "remedy"];
    has_keys(&report["findings"][0], &keys);
    assert_eq!(report["exit_code"], 1);
}

#[test]
fn check_and_info_agree_about_refused_paths() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("roads.geojson");
    let line = |id: usize, positions: &str| {
        format!(
            r#"{{"type": "Feature", "properties": {{}}, "id": {id},
                "geometry": {{"type": "LineString", "coordinates": [{positions}]}}}}"#
        )
    };
    let lines = [
        line(1, ""),
        line(2, "[1, 2]"),
        line(3, "[0, 0], [5, 5]"),
        line(4, ""),
    ];
    let features = lines.join(",");
    let text = format!(r#"{{"type": "FeatureCollection", "features": [{features}]}}"#);
    fs::write(&file, text).unwrap();

    let info = answer(&on_file(&["info", "--json"], &file), "info");
    let refused = info["refused"].as_array().unwrap();
    let of_info: u64 = refused
        .iter()
        .map(|kind| kind["count"].as_u64().unwrap())
        .sum();
    assert_eq!(of_info, 3);
    assert!(
        refused.iter().all(|kind| kind["severity"] == "error"),
        "{refused:?}"
    );

    let output = on_file(&["check", "--json"], &file);
    assert_eq!(output.status.code(), Some(1));
    let check = answer(&output, "check");
    assert_eq!((&check["refused"], &check["paths"]), (&json!(3), &json!(4)));
    assert_eq!(check["files"][0]["refused"], 3);
    assert!(check["errors"].as_u64().unwrap() >= 3);
    let said = stdout(&on_file(&["check"], &file));
    assert!(said.contains("4 paths, 3 of them refused, "), "{said}");
}

#[test]
fn check_reports_a_wrong_unit_before_errors() {
    let folder = tempfile::tempdir().unwrap();
    let file = lif(&folder, |layout| {
        layout["nodes"][1]["nodePosition"]["x"] = json!(60_000.0);
        let mut edge = layout["edges"][0].clone();
        edge["endNodeId"] = json!("nowhere");
        layout["edges"].as_array_mut().unwrap().push(edge);
    });
    let said = stdout(&on_file(&["check"], &file));
    assert!(said.starts_with("warning: implausible (1)"), "{said}");
    assert!(said.contains("error: unknown-node"), "{said}");
    let report = answer(&on_file(&["check", "--json"], &file), "check");
    assert_eq!(report["findings"][0]["code"], "implausible");
    assert_eq!(report["kinds"][0]["code"], "implausible");
}

#[test]
fn check_applies_thresholds_of_the_arguments() {
    let folder = tempfile::tempdir().unwrap();
    let file = lif(&folder, |layout| {
        layout["edges"][0]["vehicleTypeEdgeProperties"][0]["trajectory"] = json!({
            "degree": 2,
            "knotVector": [0.0, 0.0, 0.0, 1.0, 1.0, 1.0],
            "controlPoints": [
                { "x": 0.0, "y": 0.0 },
                { "x": 5.0, "y": 5.0 },
                { "x": 10.0, "y": 0.0 },
            ],
        });
    });
    let kinds = |args: &[&str]| stdout(&on_file(args, &file));
    assert!(!kinds(&["check"]).contains("curvature"));
    assert!(!kinds(&["check", "--min-radius", "1"]).contains("curvature"));
    assert!(kinds(&["check", "--min-radius", "8"]).contains("curvature"));
}

#[test]
fn every_report_rejects_unreadable_files() {
    for name in ["info", "check"] {
        let output = run([name, "there-is-no-such-file"]);
        assert_eq!(output.status.code(), Some(2));
        let text = stderr(&output);
        assert!(
            text.starts_with("error: ") && text.contains("\nhint: "),
            "{text}"
        );
        let output = run([name, "there-is-no-such-file", "--json"]);
        assert_eq!(answer(&output, "error")["error"]["code"], "not-found");
    }
}

#[test]
fn methods_lists_availability() {
    assert!(stdout(&run(["methods"])).contains("cpu"));
    let report = answer(&run(["methods", "--json"]), "methods");
    assert!(report["auto"].is_string());
    let keys = ["name", "summary", "device", "runs", "why_not"];
    report["methods"]
        .as_array()
        .unwrap()
        .iter()
        .for_each(|m| has_keys(m, &keys));
}

#[test]
fn help_lists_commands_and_exit_codes() {
    let output = run(["--help"]);
    assert_eq!(output.status.code(), Some(0));
    let said = stdout(&output);
    for command in [
        "render",
        "info",
        "check",
        "methods",
        "demo",
        "completions",
        "man",
    ] {
        assert!(
            said.contains(&format!("\n  {command} ")),
            "{command} in {said}"
        );
        let help = run([command, "--help"]);
        assert_eq!(help.status.code(), Some(0), "{command}");
        assert!(stdout(&help).contains("Usage: guideway"), "{command}");
    }
    assert!(said.contains("Exit codes: 0 "), "{said}");
    assert_eq!(run::<&str>([]).status.code(), Some(2));
    assert_eq!(run(["--version"]).status.code(), Some(0));
    assert_eq!(run(["rendr"]).status.code(), Some(2));
}

#[test]
fn prints_completions_and_manual_pages() {
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        assert!(
            stdout(&run(["completions", shell])).contains("guideway"),
            "{shell}"
        );
    }
    assert!(stdout(&run(["man"])).contains(".TH"));
    let folder = tempfile::tempdir().unwrap();
    let output = command().arg("man").arg(folder.path()).output().unwrap();
    assert_eq!(output.status.code(), Some(0));
    assert!(names_in(folder.path()).contains(&"guideway-render.1".to_owned()));
}
