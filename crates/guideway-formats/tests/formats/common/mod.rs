//! Helpers for tests of several formats: real layouts, reading, ends, counts.

use std::path::{Path, PathBuf};

use crate::law::compare;
use guideway_formats::{Losses, ReadOptions, read_bytes, read_file};
use guideway_layout::{Code, Layout};
use guideway_spline::Point;

/// Returns the folder of real layouts beside the repository, if it exists. Their licenses keep them
/// out of the repository.
pub(crate) fn real_layouts(format: &str) -> Option<PathBuf> {
    shared(&format!("layouts/{format}"))
}

/// Returns a folder or file of the material beside the repository, if it exists.
pub(crate) fn shared(path: &str) -> Option<PathBuf> {
    let shared = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared");
    let path = shared.join(path);
    if path.exists() {
        return Some(path);
    }
    println!("SKIPPED: there is no {}", path.display());
    None
}

/// Returns the folder of small cases of a format beside the repository, if it exists.
pub(crate) fn real_cases(format: &str) -> Option<PathBuf> {
    let folder = real_layouts(".")?.join("../cases").join(format);
    folder.is_dir().then_some(folder)
}

/// Reads a file that must be readable.
pub(crate) fn read_real(path: &Path) -> Layout {
    read_file(path, &ReadOptions::default()).unwrap_or_else(|e| panic!("{e}"))
}

/// Checks that a layout read back differs from the written one in the listed losses only, and in
/// all of them.
pub(crate) fn assert_losses_are_differences(a: &Layout, b: &Layout, losses: &Losses, file: &str) {
    let listed: Vec<String> = losses.iter().map(|loss| loss.what.clone()).collect();
    let breaches = compare(a, b, &listed, 1e-5);
    assert!(breaches.is_empty(), "{file}: {breaches:#?}");
}

/// Reads a real file; `None` without the folder of real layouts.
pub(crate) fn real(format: &str, file: &str) -> Option<Layout> {
    let path = real_layouts(format)?.join(file);
    Some(read_file(&path, &ReadOptions::default()).unwrap_or_else(|e| panic!("{e}")))
}

/// Reads a layout from a text that must be readable.
pub(crate) fn read(text: &str) -> Layout {
    read_bytes("test", text.as_bytes(), &ReadOptions::default()).unwrap_or_else(|e| panic!("{e}"))
}

/// Returns the start and end of the path with an id.
pub(crate) fn ends(layout: &Layout, id: &str) -> (Point<f64>, Point<f64>) {
    let path = layout.paths.iter().find(|p| p.id() == id);
    let path = path.unwrap_or_else(|| panic!("no path {id}"));
    path.ends().unwrap()
}

/// Returns the codes of the diagnostics in order.
pub(crate) fn codes(layout: &Layout) -> Vec<Code> {
    layout.diagnostics.counts().map(|(code, _)| code).collect()
}

/// Returns a count of the provenance; zero if it is missing.
pub(crate) fn count(layout: &Layout, name: &str) -> u64 {
    let counts = &layout.provenance.counts;
    counts.iter().find(|(n, _)| n == name).map_or(0, |c| c.1)
}

/// Checks the counts of a layout against a text such as `points 55, paths 68`; missing names mean
/// zero.
pub(crate) fn assert_counts(layout: &Layout, all: &[&str], expected: &str, file: &str) {
    for name in all {
        let mut stated = expected.split(", ").filter_map(|c| c.rsplit_once(' '));
        let stated = stated.find(|(n, _)| n == name).map_or("0", |c| c.1);
        assert_eq!(count(layout, name).to_string(), stated, "{name} of {file}");
    }
}
