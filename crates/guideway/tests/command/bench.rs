//! Tests of `guideway bench`, and of the arguments of `reproduce`.

use std::fs;

use guideway_bench::Comparison;
use guideway_bench::survey::{Survey, SurveyCase};
use serde_json::{Value, json};

use crate::schema::assert_conforms;
use crate::support::{
    assert_documented, command, has_keys, json as answer, names_in, run, site, stderr, stdout,
};

const TINY: [&str; 8] = [
    "bench", "d1", "--paths", "60", "--size", "64x36", "--frames", "2",
];

fn tiny(more: &[&str]) -> std::process::Output {
    run(TINY.iter().chain(more))
}

#[test]
fn prints_a_table_of_methods() {
    let output = tiny(&["--methods", "cpu,oracle"]);
    assert!(output.status.success(), "{}", stderr(&output));
    let said = stdout(&output);
    for part in [
        "d1: 60 paths, 480 segments",
        "64 x 36",
        "cpu ",
        "oracle ",
        "1.00",
        "60 of 60 paths drawn",
    ] {
        assert!(said.contains(part), "{part} in {said}");
    }
}

#[test]
fn edits_move_the_requested_share_but_at_least_one_path() {
    for (moved, paths) in [(None, 1), (Some("10"), 6), (Some("100"), 60)] {
        let mut args = vec!["--methods", "oracle", "--motion", "edit"];
        args.extend(moved.iter().flat_map(|moved| ["--moved", moved]));
        let said = stdout(&tiny(&args));
        let counted = if paths == 1 { "path" } else { "paths" };
        assert!(
            said.contains(&format!(", {paths} {counted} moved each frame")),
            "{said}"
        );
        assert!(said.contains("of the first; a gesture"), "{said}");
    }
    let drop = ["--methods", "oracle", "--motion", "edit", "--drop"];
    let said = stdout(&tiny(&drop));
    assert!(said.contains("moved each frame by one edit"), "{said}");
    assert!(said.contains("of the first; in place"), "{said}");
    let apart = ["--methods", "oracle", "--motion", "edit", "--apart"];
    let said = stdout(&tiny(&apart));
    assert!(
        said.contains("moved each frame, each its own way"),
        "{said}"
    );
    for (flag, text) in [
        ("--remove", "removed by each frame or restored"),
        ("--restyle", "restyled by each frame"),
        ("--recolor", "in other colors each frame"),
    ] {
        let said = stdout(&tiny(&["--methods", "cpu", "--motion", "edit", flag]));
        assert!(said.contains(text), "{said}");
    }
}

#[test]
fn report_is_documented_and_equal_in_a_file() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("bench.json");
    for motion in ["still", "pan", "zoom", "edit"] {
        let output = tiny(&[
            "--methods",
            "cpu,oracle",
            "--motion",
            motion,
            "--json",
            "-o",
            file.to_str().unwrap(),
        ]);
        let report = answer(&output, "bench");
        assert_documented(&report);
        has_keys(
            &report,
            &[
                "machine.cores",
                "scene.segments",
                "view.px_per_m",
                "memory_bytes",
                "edit_share",
                "edit_paths",
                "edit_is_apart",
                "edit_way",
            ],
        );
        assert_eq!(report["motion"], motion);
        let methods = report["methods"].as_array().unwrap();
        assert_eq!(methods.len(), 2);
        for (method, name) in methods.iter().zip(["cpu", "oracle"]) {
            assert_eq!(method["method"], name);
            assert_eq!(method["measured"]["frame_ms"]["count"], 2);
            assert_eq!(method["measured"]["paths"]["total"], 60);
            let (measured, is_edited) = (&method["measured"], motion == "edit");
            assert_eq!(measured["update_ms"].is_object(), is_edited);
            assert_eq!(measured["first_frame"]["update_ms"].is_number(), is_edited);
        }
        let is_gesture = &methods[1]["measured"]["update_is_gesture"];
        assert_eq!(is_gesture.as_bool(), (motion == "edit").then_some(true));
        // The oracle reads the scene itself: it uploads nothing.
        let bytes = methods[1]["measured"]["update_bytes"].as_u64();
        assert_eq!(bytes, (motion == "edit").then_some(0));
        assert_eq!(methods[0]["ratio"], 1.0);
        let saved: Value = serde_json::from_str(&fs::read_to_string(&file).unwrap()).unwrap();
        assert_eq!(saved, report);
    }
    assert_eq!(names_in(folder.path()), ["bench.json"]);
}

#[test]
fn report_of_a_computer_is_documented() {
    let measured = answer(&tiny(&["--methods", "cpu", "--json"]), "bench");
    let comparison: Comparison = serde_json::from_value(measured).unwrap();
    let survey = Survey {
        machine: comparison.machine.clone(),
        device_limits: vec![("Largest buffer".into(), "2 GB".into())],
        started: "2026-01-01T00:00:00Z".into(),
        elapsed_s: 1.5,
        cases_left_out: 9,
        cases: vec![SurveyCase {
            title: "A site".into(),
            comparison,
        }],
    };
    let mut report = serde_json::to_value(&survey).unwrap();
    report["guideway"] = json!({ "report": "bench-report", "version": 1 });
    assert_conforms(&report);
}

#[test]
fn dress_and_magnify_change_scene_and_view() {
    let px_per_m = |options: &[&str]| {
        let report = answer(
            &tiny(&[&["--methods", "cpu", "--json"], options].concat()),
            "bench",
        );
        assert_eq!(report["methods"][0]["measured"]["paths"]["total"], 60);
        (
            report["view"]["px_per_m"].as_f64().unwrap(),
            (report["dress"].clone(), report["is_density"].clone()),
        )
    };
    let (all, own) = px_per_m(&[]);
    let (near, mixed) = px_per_m(&["--magnify", "20", "--dress", "mixed", "--shade", "density"]);
    assert!((near / all - 20.0).abs() < 1e-6);
    assert_eq!(own, ("own".into(), false.into()));
    assert_eq!(mixed, ("mixed".into(), true.into()));
}

#[test]
fn measures_a_layout_file() {
    let output = command()
        .args([
            "bench",
            "--methods",
            "cpu",
            "--size",
            "64x36",
            "--frames",
            "1",
            "--json",
        ])
        .arg(site())
        .output()
        .unwrap();
    let report = answer(&output, "bench");
    let measured = &report["methods"][0]["measured"];
    assert_eq!(measured["paths"]["total"], report["scene"]["paths"]);
}

#[test]
fn rejects_invalid_arguments_with_a_remedy() {
    let file = site();
    let file = file.to_str().unwrap();
    for args in [
        &["bench", file, "--paths", "5"][..],
        &["bench", "--moved", "5"],
        &["bench", "--apart"],
        &["bench", "--drop"],
        &["bench", "--remove"],
        &["bench", "--report", "laptop.txt"],
        &["bench", "--report", "laptop.html", "-o", "laptop.json"],
        &["bench", "--motion", "edit", "--drop", "--restyle"],
        &["bench", "--motion", "edit", "--moved", "0"],
        &["bench", "--methods", "nothing"],
        &["bench", "--frames", "0"],
        &["reproduce", "--methods", "nothing"],
        &["reproduce", "--methods", "cpu+nothing"],
        &["reproduce", "--from", "run.json", "--quick"],
        &["reproduce", "--continue", "--methods", "cpu"],
        &["reproduce", "--continue", "--from", "run.json"],
        &["reproduce", "--continue"],
        &["reproduce", "--minutes", "0"],
    ] {
        let folder = tempfile::tempdir().unwrap();
        let output = command()
            .args(args)
            .arg("--json")
            .current_dir(&folder)
            .output()
            .unwrap();
        assert_eq!(output.status.code(), Some(2), "{args:?}");
        let error = answer(&output, "error");
        assert!(
            error["error"]["remedy"]
                .as_str()
                .is_some_and(|r| !r.is_empty()),
            "{error}"
        );
        assert!(names_in(folder.path()).is_empty(), "{args:?}");
    }
}

#[test]
fn reports_why_methods_fail_and_exits_with_error() {
    let output = tiny(&["--methods", "cpu,oracle", "--memory", "0", "--json"]);
    assert_eq!(output.status.code(), Some(2));
    let report = answer(&output, "bench");
    assert_documented(&report);
    for method in report["methods"].as_array().unwrap() {
        let why = method["why_not"].as_str().unwrap();
        assert!(why.contains("--memory"), "{why}");
    }
}

#[test]
fn measures_the_tools_of_a_network() {
    let output = run(["bench", "tools", "--paths", "400", "--json"]);
    assert!(output.status.success(), "{}", stderr(&output));
    let report = answer(&output, "bench-tools");
    let rows = report["tools"].as_array().unwrap();
    let tools: Vec<&str> = rows
        .iter()
        .map(|row| row["tool"].as_str().unwrap())
        .collect();
    assert_eq!(tools, ["network", "check", "router", "route", "diff"]);
    let is_measured = |row: &Value| row["ms"].as_f64().unwrap() > 0.0;
    assert!(rows.iter().all(is_measured), "{report}");
    let said = stdout(&run(["bench", "tools", "--paths", "400"]));
    assert!(said.contains("network") && said.contains("400"), "{said}");
}
