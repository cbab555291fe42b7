//! What the tests of the command share: running it, and files to run it on.

use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use serde_json::Value;

/// The example site, which every test may read.
pub(crate) fn site() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/site.lif.json")
}

pub(crate) fn command() -> Command {
    Command::new(env!("CARGO_BIN_EXE_guideway"))
}

pub(crate) fn run<S: AsRef<OsStr>>(args: impl IntoIterator<Item = S>) -> Output {
    command().args(args).output().expect("the command starts")
}

pub(crate) fn stdout(output: &Output) -> String {
    String::from_utf8_lossy(&output.stdout).into_owned()
}

pub(crate) fn stderr(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

/// The one JSON object of an answer, whose envelope says what it is.
pub(crate) fn json(output: &Output, report: &str) -> Value {
    let text = stdout(output);
    let value: Value = serde_json::from_str(&text)
        .unwrap_or_else(|error| panic!("{error} in {text}\n{}", stderr(output)));
    assert_eq!(value["guideway"]["report"], report, "{text}");
    assert_eq!(value["guideway"]["version"], 1, "{text}");
    value
}

/// Asserts that an object has a value under each key, written `a.b` for one inside another.
pub(crate) fn has_keys(value: &Value, keys: &[&str]) {
    for key in keys {
        let inner = key.split('.').try_fold(value, |v, part| v.get(part));
        assert!(inner.is_some(), "no key {key} in {value:#}");
    }
}

pub(crate) fn names_in(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).expect("the folder is there");
    let mut names: Vec<String> = entries
        .map(|entry| entry.expect("an entry").file_name())
        .map(|name| name.to_string_lossy().into_owned())
        .collect();
    names.sort();
    names
}
