//! Tests of SARIF output against its schema. They need Python with jsonschema; `GUIDEWAY_PYTHON`
//! names the interpreter.

use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use serde_json::{Value, json};

use crate::support::{command, run, site, stderr};

const SCHEMA: &str = concat!(
    env!("CARGO_MANIFEST_DIR"),
    "/tests/schemas/sarif-2.1.0.json"
);

const VALIDATE: &str = "\
import json, sys, jsonschema
schema = json.load(open(sys.argv[1]))
errors = jsonschema.Draft7Validator(schema).iter_errors(json.load(sys.stdin))
errors = [f'{error.json_path}: {error.message}' for error in errors]
print('\\n'.join(errors))
";

/// The errors of a log, one per line; `None` (and a message) without Python and jsonschema.
fn errors(log: &Value) -> Option<String> {
    let interpreter = std::env::var("GUIDEWAY_PYTHON").unwrap_or_else(|_| "python3".into());
    let python = |code| {
        let mut command = Command::new(&interpreter);
        command.args(["-c", code, SCHEMA]);
        command
    };
    let can = python("import jsonschema").output();
    if !can.is_ok_and(|output| output.status.success()) {
        println!("SKIPPED: {interpreter} cannot import jsonschema; set GUIDEWAY_PYTHON");
        return None;
    }
    let mut command = python(VALIDATE);
    let piped = command.stdin(Stdio::piped()).stdout(Stdio::piped());
    let mut validator = piped.spawn().unwrap();
    let mut stdin = validator.stdin.take().unwrap();
    stdin.write_all(log.to_string().as_bytes()).unwrap();
    drop(stdin);
    let output = validator.wait_with_output().unwrap();
    assert!(output.status.success(), "{}", stderr(&output));
    Some(String::from_utf8(output.stdout).unwrap().trim().to_owned())
}

fn log_of(files: &[&Path]) -> Value {
    let flags = ["check", "--format", "sarif"].map(Path::new);
    let output = run(flags.iter().chain(files));
    serde_json::from_slice(&output.stdout).unwrap_or_else(|e| panic!("{e}: {}", stderr(&output)))
}

/// Writes one of the bad files, named by format and name, into a folder. Returns its path.
fn bad_file(folder: &Path, file: &str) -> PathBuf {
    let path = folder.join(file.replace('/', "-"));
    fs::write(&path, guideway_bad_files::input(file).unwrap()).unwrap();
    path
}

#[test]
fn reports_go_to_files_in_each_form() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("report");
    let saved = |format: &[&str]| {
        let output = command()
            .arg("check")
            .arg(site())
            .args(format)
            .arg("-o")
            .arg(&file)
            .output()
            .unwrap();
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
        assert!(output.stdout.is_empty());
        fs::read_to_string(&file).unwrap()
    };
    assert!(saved(&["--format", "sarif"]).contains("\"2.1.0\""));
    assert!(saved(&["--json"]).contains("\"report\": \"check\""));
    assert!(saved(&["-q"]).contains("site.lif.json: 326 paths, "));
    let over = run([
        "check".as_ref(),
        site().as_os_str(),
        "-o".as_ref(),
        site().as_os_str(),
    ]);
    assert_eq!(over.status.code(), Some(2), "{}", stderr(&over));
}

#[test]
fn logs_conform_to_the_schema() {
    let folder = tempfile::tempdir().unwrap();
    // With and without lines; with errors, warnings and notes; several files.
    let files = [
        "lif/knots-object.json",
        "dxf/insert-unknown-block.dxf",
        "opentcs/valid.xml",
        "geojson/valid-graph.geojson",
    ]
    .map(|file| bad_file(folder.path(), file));
    let mut logs: Vec<Value> = files.iter().map(|file| log_of(&[file.as_path()])).collect();
    logs.push(log_of(&[site().as_path(), files[0].as_path()]));
    for log in logs {
        if let Some(errors) = errors(&log) {
            assert_eq!(errors, "", "{log:#}");
        }
    }
}

#[test]
fn schema_check_rejects_a_broken_log() {
    let mut log = log_of(&[site().as_path()]);
    log["runs"][0]["results"][0]["level"] = json!("grave");
    log["runs"][0]["tool"]["driver"]["name"] = Value::Null;
    if let Some(errors) = errors(&log) {
        assert!(
            errors.contains("grave") && errors.contains("name"),
            "{errors}"
        );
    }
}

#[test]
fn findings_in_json_files_have_lines() {
    let folder = tempfile::tempdir().unwrap();
    let log = log_of(&[&bad_file(folder.path(), "lif/knots-object.json")]);
    let results = log["runs"][0]["results"].as_array().unwrap();
    let wrong = results
        .iter()
        .find(|r| r["ruleId"] == "wrong-type")
        .unwrap();
    let region = &wrong["locations"][0]["physicalLocation"]["region"];
    assert!(region["startLine"].as_u64().unwrap() > 0, "{wrong:#}");
    assert!(region["startColumn"].as_u64().unwrap() > 1, "{wrong:#}");
}

#[test]
fn logs_have_what_code_scanning_asks_for() {
    let folder = tempfile::tempdir().unwrap();
    // A note of the whole file has no line.
    fs::create_dir(folder.path().join("plans")).unwrap();
    let name = "plans/roads.geojson";
    let line = |id: usize| {
        format!(
            r#"{{"type": "Feature", "properties": {{}}, "id": {id},
                "geometry": {{"type": "LineString", "coordinates": [[{id}, 500]]}}}}"#
        )
    };
    let lines: Vec<String> = (0..6000).map(line).collect();
    let features = lines.join(",\n");
    let text = format!("{{\"type\": \"FeatureCollection\", \"features\": [{features}]}}");
    fs::write(folder.path().join(name), text).unwrap();
    fs::write(folder.path().join("broken.json"), "{\n \"layouts\": [\n}").unwrap();
    let output = command()
        .current_dir(folder.path())
        .args(["check", "--format", "sarif", "--baseline", "none.json"])
        .args(["broken.json", name])
        .output()
        .unwrap();
    assert_eq!(output.status.code(), Some(2), "the baseline does not exist");
    fs::write(
        folder.path().join("none.json"),
        r#"{"guideway": {"report": "baseline", "version": 1}, "findings": []}"#,
    )
    .unwrap();
    // With a baseline, more findings are kept than a log may have.
    let output = command()
        .current_dir(folder.path())
        .args(["check", "--format", "sarif", "--baseline", "none.json"])
        .args(["broken.json", name])
        .output()
        .unwrap();
    assert_eq!(output.status.code(), Some(1), "{}", stderr(&output));
    let log: Value = serde_json::from_slice(&output.stdout).unwrap();
    let run = &log["runs"][0];
    let results = run["results"].as_array().unwrap();
    assert_eq!(results.len(), 5000);
    assert!(results.iter().all(|result| result["level"] == "error"));
    let said = run["invocations"][0]["toolExecutionNotifications"][0]["message"]["text"].as_str();
    assert!(said.unwrap().contains("of severity error"), "{said:?}");
    let mut prints = std::collections::HashSet::new();
    for result in results {
        let place = &result["locations"][0]["physicalLocation"];
        assert!(
            place["region"]["startLine"].as_u64().unwrap() >= 1,
            "{result:#}"
        );
        let uri = place["artifactLocation"]["uri"].as_str().unwrap();
        assert!([name, "broken.json"].contains(&uri), "{uri}");
        let print = &result["partialFingerprints"]["primaryLocationLineHash"];
        assert!(prints.insert(format!("{uri} {print}")), "{result:#}");
    }
    let unreadable = results
        .iter()
        .find(|r| r["ruleId"] == "unreadable")
        .unwrap();
    let place = &unreadable["locations"][0]["physicalLocation"];
    assert_eq!(place["region"]["startLine"], 3);
    for rule in run["tool"]["driver"]["rules"].as_array().unwrap() {
        let texts = [
            &rule["fullDescription"]["text"],
            &rule["help"]["text"],
            &rule["help"]["markdown"],
            &rule["defaultConfiguration"]["level"],
        ];
        let is_text = |text: &&Value| text.as_str().is_some_and(|text| !text.is_empty());
        assert!(texts.iter().all(is_text), "{rule:#}");
    }
    if let Some(errors) = errors(&log) {
        assert_eq!(errors, "", "{:#}", run["results"][0]);
    }
}
