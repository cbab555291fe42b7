//! The law of the writer of openTCS over all real files: what differs after writing and reading is
//! what the writer lists, and what it lists differs.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use crate::common::shared;
use guideway_formats::opentcs::{Version, write_layout};
use guideway_formats::{Losses, ReadOptions, read_bytes, read_file};
use guideway_layout::{CompareOptions, Difference, Layout, PathRef, differences};

/// Returns all files below a folder of shared material.
fn files(folder: &str) -> Vec<PathBuf> {
    let mut files = Vec::new();
    let mut folders: Vec<PathBuf> = shared(folder).into_iter().collect();
    while let Some(folder) = folders.pop() {
        for entry in folder.read_dir().unwrap() {
            let path = entry.unwrap().path();
            match path.is_dir() {
                true => folders.push(path),
                false => files.push(path),
            }
        }
    }
    files.sort();
    files
}

/// Segments of a path beyond which a comparison takes too long for a test.
const MAX_SEGMENTS: usize = 300;

/// Reads a file, if it is a layout that can be compared in short time.
fn read(path: &Path) -> Option<Layout> {
    let layout = read_file(path, &ReadOptions::default()).ok()?;
    let segments = |path: PathRef<'_>| path.runs().map(|run| run.segments().len()).sum::<usize>();
    let is_short = layout
        .paths
        .iter()
        .all(|path| segments(path) <= MAX_SEGMENTS);
    is_short.then_some(layout)
}

/// Writes a layout and reads the file.
fn through(layout: &Layout, version: Version) -> (Layout, Losses, Vec<u8>) {
    let mut text = Vec::new();
    let losses = write_layout(layout, &mut text, version).unwrap();
    let read = read_bytes("written", &text, &ReadOptions::default());
    (read.unwrap_or_else(|e| panic!("{e}")), losses, text)
}

/// Returns a message if the differences are not those that the writer lists.
fn broken_law(found: &[Difference], losses: &Losses) -> Option<String> {
    let differing: BTreeSet<&str> = found.iter().map(|d| d.what.as_str()).collect();
    let listed: BTreeSet<&str> = losses.iter().map(|l| l.what.as_str()).collect();
    let unlisted = differing.difference(&listed).map(|what| {
        let example = found.iter().find(|d| d.what == *what).unwrap();
        format!("not listed: {what}: {}", example.example)
    });
    let untrue = listed.difference(&differing).map(|what| {
        let loss = losses.iter().find(|l| l.what == *what).unwrap();
        format!("no difference: {what}: {loss}")
    });
    let broken: Vec<String> = unlisted.chain(untrue).collect();
    (!broken.is_empty()).then(|| broken.join("; "))
}

#[test]
fn losses_are_the_differences_of_every_real_file() {
    let mut broken = Vec::new();
    let mut compared = 0;
    for path in ["layouts", "conformance/real", "cases"]
        .into_iter()
        .flat_map(files)
    {
        let Some(layout) = read(&path) else {
            continue;
        };
        for version in [Version::V6, Version::V7] {
            let (again, losses, _) = through(&layout, version);
            let found = differences(&layout, &again, &CompareOptions::default());
            compared += 1;
            if let Some(message) = broken_law(&found, &losses) {
                broken.push(format!("{} {version:?}: {message}", path.display()));
            }
        }
    }
    println!("{compared} conversions compared");
    assert!(broken.is_empty(), "{}", broken.join("\n"));
}
