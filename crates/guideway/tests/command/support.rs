//! Helpers of the tests: run the command, read its reports and pictures.

use std::collections::BTreeSet;
use std::ffi::OsStr;
use std::fs::File;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use serde_json::Value;

use crate::schema::assert_conforms;

/// The example site.
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

/// The JSON object that the command printed, after checks of its kind and keys.
pub(crate) fn json(output: &Output, report: &str) -> Value {
    let text = stdout(output);
    let value: Value = serde_json::from_str(&text)
        .unwrap_or_else(|error| panic!("{error} in {text}\n{}", stderr(output)));
    assert_eq!(assert_conforms(&value), report, "{text}");
    value
}

/// Asserts that an object has every key; `a.b` is key `b` of object `a`.
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

/// Renders the example site.
pub(crate) fn render(picture: &Path, more: &[&str]) -> Output {
    let mut all = command();
    all.arg("render").arg(site());
    all.arg("-o").arg(picture).args(more);
    all.output().expect("the command starts")
}

/// Size and pixels of a PNG file.
pub(crate) fn read_png(path: &Path) -> (u32, u32, Vec<u8>) {
    let file = std::io::BufReader::new(File::open(path).expect("the picture exists"));
    let mut reader = png::Decoder::new(file).read_info().expect("a PNG header");
    let bytes = reader.output_buffer_size().expect("a size");
    let mut pixels = vec![0; bytes];
    let info = reader.next_frame(&mut pixels).expect("pixels");
    (info.width, info.height, pixels)
}

/// Number of pixels that are not white.
pub(crate) fn ink(pixels: &[u8]) -> usize {
    let white = [255; 4];
    let pixels = pixels.chunks_exact(4);
    pixels.filter(|pixel| *pixel != white).count()
}

/// Asserts that README.md of guideway-bench explains every key of a report.
pub(crate) fn assert_documented(report: &Value) {
    let page = Path::new(env!("CARGO_MANIFEST_DIR")).join("../guideway-bench/README.md");
    let page = std::fs::read_to_string(page).expect("README.md of guideway-bench");
    let mut found = BTreeSet::new();
    collect_keys(report, &mut found);
    assert!(found.len() > 20, "{found:?}");
    for key in ["guideway", "report", "version"] {
        found.remove(key);
    }
    for key in found {
        assert!(
            page.contains(&format!("`{key}`")),
            "README.md of guideway-bench does not explain `{key}`"
        );
    }
}

fn collect_keys(value: &Value, found: &mut BTreeSet<String>) {
    match value {
        Value::Object(object) => {
            for (key, value) in object {
                found.insert(key.clone());
                collect_keys(value, found);
            }
        }
        Value::Array(list) => list.iter().for_each(|value| collect_keys(value, found)),
        _ => {}
    }
}
