//! `guideway bench` and `guideway reproduce`.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;
use std::process::Stdio;
use std::thread::sleep;
use std::time::{Duration, Instant};

use serde_json::Value;

use crate::support::{command, has_keys, json as answer, names_in, run, site, stderr, stdout};

const TINY: [&str; 8] = [
    "bench", "d1", "--paths", "60", "--size", "64x36", "--frames", "2",
];

fn tiny(more: &[&str]) -> std::process::Output {
    run(TINY.iter().chain(more))
}

/// Every key of every object inside.
fn keys(value: &Value, found: &mut BTreeSet<String>) {
    match value {
        Value::Object(object) => {
            for (key, value) in object {
                found.insert(key.clone());
                keys(value, found);
            }
        }
        Value::Array(list) => list.iter().for_each(|value| keys(value, found)),
        _ => {}
    }
}

fn assert_documented(value: &Value) {
    let page = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/bench.md");
    let page = fs::read_to_string(page).unwrap();
    let mut found = BTreeSet::new();
    keys(value, &mut found);
    assert!(found.len() > 20, "{found:?}");
    for key in ["guideway", "report", "version"] {
        found.remove(key);
    }
    for key in found {
        assert!(
            page.contains(&format!("`{key}`")),
            "docs/bench.md does not explain `{key}`"
        );
    }
}

#[test]
fn methods_are_compared_in_text() {
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
fn edits_move_the_share_asked_for_and_one_path_at_the_least() {
    for (moved, paths) in [(None, 1), (Some("10"), 6), (Some("100"), 60)] {
        let mut args = vec!["--methods", "oracle", "--motion", "edit"];
        args.extend(moved.iter().flat_map(|moved| ["--moved", moved]));
        let said = stdout(&tiny(&args));
        let counted = if paths == 1 { "path" } else { "paths" };
        assert!(
            said.contains(&format!(", {paths} {counted} moved each frame")),
            "{said}"
        );
        assert!(said.contains("of the first; in place"), "{said}");
    }
    let apart = ["--methods", "oracle", "--motion", "edit", "--apart"];
    let said = stdout(&tiny(&apart));
    assert!(
        said.contains("moved each frame, each its own way"),
        "{said}"
    );
}

#[test]
fn the_report_is_documented_and_the_same_in_a_file() {
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
        // The oracle works on the scene itself: nothing is brought anywhere.
        let bytes = methods[1]["measured"]["update_bytes"].as_u64();
        assert_eq!(bytes, (motion == "edit").then_some(0));
        assert_eq!(methods[0]["ratio"], 1.0);
        let saved: Value = serde_json::from_str(&fs::read_to_string(&file).unwrap()).unwrap();
        assert_eq!(saved, report);
    }
    assert_eq!(names_in(folder.path()), ["bench.json"]);
}

#[test]
fn a_scene_is_dressed_and_seen_from_nearer() {
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
fn a_file_is_measured_as_it_is() {
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
fn what_makes_no_sense_is_refused() {
    let file = site();
    let file = file.to_str().unwrap();
    for args in [
        &["bench", file, "--paths", "5"][..],
        &["bench", "--moved", "5"],
        &["bench", "--apart"],
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
fn a_method_that_fails_says_why_and_nothing_measured_is_an_error() {
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
fn the_thesis_is_reproduced_and_its_page_made_again() {
    let folder = tempfile::tempdir().unwrap();
    let (first, again) = (
        folder.path().join("deep/first"),
        folder.path().join("again"),
    );
    let output = command()
        .args([
            "reproduce",
            "--quick",
            "--methods",
            "cpu",
            "--minutes",
            "0.02",
            "--json",
            "--out",
        ])
        .arg(&first)
        .output()
        .unwrap();
    let report = answer(&output, "reproduce");
    has_keys(
        &report,
        &[
            "page",
            "run",
            "is_partial",
            "is_whole",
            "findings",
            "parts",
            "ms.total",
        ],
    );
    let names = names_in(&first);
    for name in ["index.html", "run.json", "table-5.1.csv", "figure-5.5.csv"] {
        assert!(names.iter().any(|n| n == name), "{name} in {names:?}");
    }
    let saved: Value =
        serde_json::from_str(&fs::read_to_string(first.join("run.json")).unwrap()).unwrap();
    assert_eq!(saved["guideway"]["report"], "reproduce");
    assert_documented(&saved);
    assert_eq!(saved["results"]["pictures"][0]["figure"], "5.1");

    let output = command()
        .args(["reproduce", "--from"])
        .arg(first.join("run.json"))
        .arg("--out")
        .arg(&again)
        .output()
        .unwrap();
    assert!(
        stdout(&output).contains("index.html"),
        "{}",
        stderr(&output)
    );
    let mut expected = names;
    expected.retain(|name| name != "run.json");
    assert_eq!(names_in(&again), expected);
}

#[test]
fn a_run_goes_on_where_its_time_was_over() {
    let folder = tempfile::tempdir().unwrap();
    let reproduce = |args: &[&str]| {
        let mut command = command();
        command.args(["reproduce", "--json", "--minutes", "0.001"]);
        command.args(args).arg("--out").arg(folder.path());
        command.output().unwrap()
    };
    let path = folder.path().join("run.json");
    let saved = || -> Value { serde_json::from_str(&fs::read_to_string(&path).unwrap()).unwrap() };

    let first = answer(
        &reproduce(&["--quick", "--methods", "cpu,oracle"]),
        "reproduce",
    );
    assert_eq!(first["is_whole"], false);
    let before = saved();
    let output = reproduce(&["--continue"]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let after = saved();
    assert_eq!(after["sittings"].as_array().unwrap().len(), 2);
    assert_eq!(after["sittings"][0], before["sittings"][0]);
    assert_eq!(after["plan"], before["plan"]);
    for list in ["pictures", "borders"] {
        assert_eq!(after["results"][list], before["results"][list]);
    }

    let mut elsewhere = after;
    elsewhere["methods"][0]["device"] = "another".into();
    let text = elsewhere.to_string();
    fs::write(&path, &text).unwrap();
    let output = reproduce(&["--continue"]);
    assert_eq!(output.status.code(), Some(2));
    assert_eq!(answer(&output, "error")["error"]["code"], "other-device");
    elsewhere["methods"][0]["device"] = "CPU".into();
    elsewhere["plan"]["sizes"][0] = 0.into();
    fs::write(&path, elsewhere.to_string()).unwrap();
    let output = reproduce(&["--continue"]);
    let error = answer(&output, "error");
    assert_eq!(error["error"]["code"], "structure");
    let message = error["error"]["message"].as_str().unwrap();
    assert!(
        message.contains("run.json: ") && message.contains("0 paths"),
        "{message}"
    );
}

#[test]
fn a_folder_that_cannot_be_written_is_refused_before_any_work() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("a file");
    fs::write(&file, "as it was").unwrap();
    // Without `--quick`: measuring would take far longer than the test may.
    let output = run(["reproduce", "--json", "--out", file.to_str().unwrap()]);
    assert_eq!(output.status.code(), Some(2));
    assert_eq!(answer(&output, "error")["error"]["code"], "save");
    assert_eq!(fs::read_to_string(&file).unwrap(), "as it was");
}

#[test]
fn what_is_not_a_run_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("run.json");
    for text in [
        "",
        "[]",
        "{}",
        r#"{"guideway":{"report":"bench","version":1}}"#,
        r#"{"guideway":{"report":"reproduce","version":1}}"#,
        r#"{"guideway":{"report":"reproduce","version":2}}"#,
        r#"{"guideway":{"report":"reproduce","version":2},"results":3}"#,
    ] {
        fs::write(&path, text).unwrap();
        let output = command()
            .args(["reproduce", "--json", "--from"])
            .arg(&path)
            .arg("--out")
            .arg(folder.path().join("out"))
            .output()
            .unwrap();
        let error = answer(&output, "error");
        assert_eq!(error["error"]["code"], "structure", "{text}");
        assert!(!folder.path().join("out").exists());
    }
}

#[test]
#[cfg(unix)]
fn what_was_measured_before_ctrl_c_is_kept() {
    let folder = tempfile::tempdir().unwrap();
    let report = folder.path().join("report");
    let mut child = command()
        .args(["reproduce", "--methods", "cpu,oracle", "--out"])
        .arg(&report)
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    let started = Instant::now();
    while !report.is_dir() {
        assert!(
            started.elapsed() < Duration::from_secs(60),
            "it does not begin"
        );
        sleep(Duration::from_millis(10));
    }
    // Now it is at work, and would be for an hour.
    sleep(Duration::from_secs(1));
    let id = child.id().to_string();
    let kill = std::process::Command::new("kill")
        .args(["-INT", &id])
        .status()
        .unwrap();
    assert!(kill.success());
    let asked = Instant::now();
    while child.try_wait().unwrap().is_none() {
        if asked.elapsed() > Duration::from_secs(120) {
            child.kill().unwrap();
            panic!("it does not end");
        }
        sleep(Duration::from_millis(50));
    }
    assert_eq!(child.wait().unwrap().code(), Some(130));
    let saved = fs::read_to_string(report.join("run.json")).unwrap();
    let saved: Value = serde_json::from_str(&saved).unwrap();
    assert_eq!(saved["is_partial"], true);
    let page = fs::read_to_string(report.join("index.html")).unwrap();
    assert!(page.contains("Stopped before its end"));
}
