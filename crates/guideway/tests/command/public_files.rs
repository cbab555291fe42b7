//! `check` over public files: the page `docs/check-on-public-files.md` lists all findings above
//! information, and no others.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use crate::support::{command, json};

/// Files per code and severity, with the number of findings in each.
type Table = BTreeMap<(String, String), BTreeMap<String, u64>>;

fn page() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/check-on-public-files.md")
}

/// The rows `| code | severity | file | count | why |` of the page.
fn documented() -> Table {
    let text = fs::read_to_string(page()).unwrap();
    let mut table = Table::new();
    for line in text.lines().filter(|line| line.starts_with("| `")) {
        let cells: Vec<&str> = line.trim_matches('|').split('|').map(str::trim).collect();
        let [code, severity, file, count, why] = cells[..] else {
            panic!("not five cells: {line}");
        };
        assert!(why.len() > 10, "no reason: {line}");
        let kind = (code.trim_matches('`').to_owned(), severity.to_owned());
        let files = table.entry(kind).or_default();
        let known = files.insert(file.to_owned(), count.replace(',', "").parse().unwrap());
        assert_eq!(known, None, "twice: {line}");
    }
    table
}

fn files_in(folder: &Path, all: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        match path.is_dir() {
            true => files_in(&path, all),
            false => all.extend((path.extension().unwrap_or_default() != "md").then_some(path)),
        }
    }
}

#[test]
fn page_lists_the_findings_in_public_files() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/layouts");
    if !folder.is_dir() {
        println!("SKIPPED: there is no folder {}", folder.display());
        return;
    }
    let mut files = Vec::new();
    files_in(&folder, &mut files);
    files.sort();
    let mut table = Table::new();
    for file in &files {
        let output = command()
            .args(["check", "--json"])
            .arg(file)
            .output()
            .unwrap();
        let report = json(&output, "check");
        let name = file
            .strip_prefix(&folder)
            .unwrap()
            .to_string_lossy()
            .into_owned();
        for kind in report["kinds"].as_array().unwrap() {
            let text = |key: &str| kind[key].as_str().unwrap().to_owned();
            if text("severity") != "info" {
                let files = table.entry((text("code"), text("severity"))).or_default();
                files.insert(name.clone(), kind["count"].as_u64().unwrap());
            }
        }
        for finding in report["findings"].as_array().unwrap() {
            let is_placed = finding["line"].is_u64() || name.contains("_bin_");
            assert!(is_placed, "{name}: {finding:#}");
        }
    }
    let count = |table: &Table| table.values().map(BTreeMap::len).sum::<usize>();
    println!("{} files, {} rows", files.len(), count(&table));
    assert_eq!(table, documented(), "update {}", page().display());
}

#[test]
fn page_has_a_reason_per_row() {
    assert!(documented().len() > 5);
}
