//! Tests of `guideway reproduce`.

use std::fs;
#[cfg(unix)]
use std::process::Stdio;
#[cfg(unix)]
use std::thread::sleep;
#[cfg(unix)]
use std::time::{Duration, Instant};

use serde_json::Value;

use crate::support::{
    assert_documented, command, has_keys, json as answer, names_in, run, stderr, stdout,
};

#[test]
fn measures_a_quick_run_and_rebuilds_its_page() {
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
fn continues_a_run_after_its_time_limit() {
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
fn rejects_unwritable_folder_before_any_work() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("a file");
    fs::write(&file, "as it was").unwrap();
    // Without `--quick` a measurement would outlast the test by far.
    let output = run(["reproduce", "--json", "--out", file.to_str().unwrap()]);
    assert_eq!(output.status.code(), Some(2));
    assert_eq!(answer(&output, "error")["error"]["code"], "save");
    assert_eq!(fs::read_to_string(&file).unwrap(), "as it was");
}

#[test]
fn rejects_files_that_are_no_run() {
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
fn saves_partial_run_on_ctrl_c() {
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
            "the run does not begin"
        );
        sleep(Duration::from_millis(10));
    }
    // The run is under way, and would take an hour.
    sleep(Duration::from_secs(1));
    let id = child.id().to_string();
    let kill = std::process::Command::new("kill")
        .args(["-INT", &id])
        .status()
        .unwrap();
    assert!(kill.success());
    let requested = Instant::now();
    while child.try_wait().unwrap().is_none() {
        if requested.elapsed() > Duration::from_secs(120) {
            child.kill().unwrap();
            panic!("the run does not end");
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
