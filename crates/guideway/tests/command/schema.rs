//! Tests of the JSON Schema of the answers: real answers of every command conform to it, those that
//! other tests read too.

use std::sync::LazyLock;

use serde_json::{Map, Value};

use crate::support::{command, names_in, run, site, stderr, stdout};

static SCHEMA: LazyLock<Value> = LazyLock::new(|| {
    serde_json::from_str(include_str!("../../docs/answers.schema.json")).expect("it is JSON")
});

/// Asserts that an answer conforms to the schema of its kind. Returns the kind.
pub(crate) fn assert_conforms(answer: &Value) -> &str {
    let name = answer["guideway"]["report"]
        .as_str()
        .expect("it has a kind");
    let of_report = &SCHEMA["$defs"][name];
    assert!(of_report.is_object(), "no schema of {name}");
    let found = faults(of_report, &SCHEMA, answer, name);
    assert!(found.is_empty(), "{}", found.join("\n"));
    name
}

/// Places at which a value does not conform to a schema, by the keywords that the schema of the
/// answers uses.
fn faults(schema: &Value, root: &Value, value: &Value, at: &str) -> Vec<String> {
    if let Some(reference) = schema["$ref"].as_str() {
        let pointer = reference.trim_start_matches('#');
        let target = root
            .pointer(pointer)
            .unwrap_or_else(|| panic!("no {reference}"));
        return faults(target, root, value, at);
    }
    let mut found = Vec::new();
    if let Some(constant) = schema.get("const")
        && constant != value
    {
        found.push(format!("{at}: {value} is not {constant}"));
    }
    if let Some(values) = schema["enum"].as_array()
        && !values.contains(value)
    {
        found.push(format!("{at}: {value} is none of {values:?}"));
    }
    if let Some(kinds) = schema.get("type") {
        let kinds: Vec<&str> = match kinds {
            Value::Array(kinds) => kinds.iter().filter_map(Value::as_str).collect(),
            kind => kind.as_str().into_iter().collect(),
        };
        if !kinds.iter().any(|kind| is_kind(value, kind)) {
            found.push(format!("{at}: {value} is no {kinds:?}"));
            return found;
        }
    }
    match value {
        Value::Array(items) => {
            for (i, item) in items.iter().enumerate() {
                if let Some(of_item) = schema.get("items") {
                    found.extend(faults(of_item, root, item, &format!("{at}/{i}")));
                }
            }
        }
        Value::Object(object) => found.extend(object_faults(schema, root, object, at)),
        _ => {}
    }
    found
}

fn object_faults(
    schema: &Value,
    root: &Value,
    object: &Map<String, Value>,
    at: &str,
) -> Vec<String> {
    let mut found = Vec::new();
    let required = schema["required"].as_array().into_iter().flatten();
    for key in required.filter_map(Value::as_str) {
        if !object.contains_key(key) {
            found.push(format!("{at}: no {key}"));
        }
    }
    for (key, value) in object {
        let at = format!("{at}/{key}");
        match (
            schema["properties"].get(key),
            schema.get("additionalProperties"),
        ) {
            (Some(of_key), _) => found.extend(faults(of_key, root, value, &at)),
            (None, Some(Value::Bool(false)) | None) => {
                found.push(format!("{at}: not in the schema"));
            }
            (None, Some(of_others)) => found.extend(faults(of_others, root, value, &at)),
        }
    }
    found
}

fn is_kind(value: &Value, kind: &str) -> bool {
    match kind {
        "null" => value.is_null(),
        "boolean" => value.is_boolean(),
        "string" => value.is_string(),
        "integer" => value.is_u64() || value.is_i64(),
        "number" => value.is_number(),
        "array" => value.is_array(),
        "object" => value.is_object(),
        other => panic!("type {other} in the schema"),
    }
}

#[test]
fn answers_of_every_command_conform() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::copy(site(), folder.path().join("site.lif.json")).unwrap();
    let steps = r#"{"steps": [{"do": "set", "paths": "all", "property": "maxSpeed", "value": 1}]}"#;
    std::fs::write(folder.path().join("steps.json"), steps).unwrap();
    let site = "site.lif.json";
    let mut seen = Vec::new();
    for args in [
        &["demo", "--paths", "100"][..],
        &["render", site, "-o", "a.png", "--size", "64x64"],
        &[
            "render",
            site,
            "-o",
            "b.png",
            "--size",
            "64x64",
            "--envelope",
            "2x1",
            "--color-by",
            "maxSpeed",
            "--route",
            "dock-1,dock-3,tugger-3000",
        ],
        &[
            "render",
            site,
            "-o",
            "c.svg",
            "--shade",
            "lines",
            "--floor-plan",
            site,
        ],
        &["tiles", site, "-o", "a.pmtiles", "--zoom", "0-1"],
        &["info", site],
        &["info", "guideway-demo/faulty.lif.json"],
        &["check", site, "--clearance", "0.1", "--envelope", "2x1"],
        &[
            "check",
            "guideway-demo/faulty.lif.json",
            site,
            "--write-baseline",
            "known.json",
        ],
        &[
            "check",
            "guideway-demo/faulty.lif.json",
            "--baseline",
            "known.json",
        ],
        &["check", "guideway-demo/faulty.lif.json"],
        &["diff", site, "guideway-demo/faulty.lif.json"],
        &[
            "edit",
            site,
            "--script",
            "steps.json",
            "-o",
            "edited.lif.json",
        ],
        &["convert", site, "plan.dxf"],
        &["share", site, "-o", "page.html"],
        &["network", "plan.dxf", "-o", "network.lif.json", "--split"],
        &[
            "route",
            site,
            "dock-1",
            "dock-3",
            "--vehicle-type",
            "tugger-3000",
        ],
        &[
            "route",
            site,
            "dock-1",
            "dock-3",
            "--vehicle-type",
            "tugger-3000",
            "-o",
            "way.geojson",
        ],
        &["generate", "d1", "--paths", "100", "-o", "d1.arrow"],
        &["methods"],
        &["doctor"],
        &["completions", "bash"],
        &["man"],
        &["man", "pages"],
        &["schema", "info"],
        &["info", "none.json"],
        &["render", site, "-o", "a.jpg"],
    ] {
        let mut all = command();
        all.args(args).arg("--json").current_dir(folder.path());
        let output = all.output().unwrap();
        let answer: Value = serde_json::from_str(&stdout(&output)).unwrap();
        println!("{args:?}");
        seen.push(assert_conforms(&answer).to_owned());
    }
    // Those that measure: their own tests read them.
    seen.extend(["bench", "bench-report", "bench-tools", "reproduce", "view"].map(str::to_owned));
    seen.sort();
    seen.dedup();
    let defined: Vec<&String> = SCHEMA["$defs"].as_object().unwrap().keys().collect();
    assert_eq!(defined, seen.iter().collect::<Vec<_>>());
    assert!(names_in(folder.path()).contains(&"c.svg".to_owned()));
}

#[test]
fn every_key_has_a_description() {
    fn undescribed(schema: &Value, at: &str, found: &mut Vec<String>) {
        for (key, of_key) in schema["properties"].as_object().into_iter().flatten() {
            let at = format!("{at}/{key}");
            if of_key["description"].as_str().is_none_or(str::is_empty) && of_key["$ref"].is_null()
            {
                found.push(at.clone());
            }
            undescribed(of_key, &at, found);
            undescribed(&of_key["items"], &at, found);
        }
    }
    let mut found = Vec::new();
    for (name, of_report) in SCHEMA["$defs"].as_object().unwrap() {
        undescribed(of_report, name, &mut found);
    }
    assert!(found.is_empty(), "{}", found.join("\n"));
}

#[test]
fn a_wrong_answer_does_not_conform() {
    let root = &*SCHEMA;
    let of_error = &root["$defs"]["error"];
    let good = serde_json::json!({
        "guideway": { "report": "error", "version": 1 },
        "error": { "code": "usage", "message": "m", "remedy": "r" },
    });
    assert_eq!(faults(of_error, root, &good, ""), Vec::<String>::new());
    for (pointer, value) in [
        ("/error/code", serde_json::json!(7)),
        ("/guideway/report", serde_json::json!("render")),
        (
            "/error",
            serde_json::json!({ "code": "usage", "message": "m" }),
        ),
        (
            "/error",
            serde_json::json!({ "code": "a", "message": "m", "remedy": "r", "more": 1 }),
        ),
    ] {
        let mut bad = good.clone();
        *bad.pointer_mut(pointer).unwrap() = value;
        assert!(!faults(of_error, root, &bad, "").is_empty(), "{pointer}");
    }
}

#[test]
fn schema_of_one_command_refers_to_it() {
    let all: Value = serde_json::from_str(&stdout(&run(["schema"]))).unwrap();
    assert_eq!(all, *SCHEMA);
    let one: Value = serde_json::from_str(&stdout(&run(["schema", "render"]))).unwrap();
    assert_eq!(one["$ref"], "#/$defs/render");
    assert!(one["$defs"]["render"].is_object());
    let unknown = run(["schema", "rendr"]);
    assert_eq!(unknown.status.code(), Some(2));
    assert!(stderr(&unknown).contains("render"), "{}", stderr(&unknown));
}
