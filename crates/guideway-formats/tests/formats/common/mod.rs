//! What the tests of several formats share.

use std::path::{Path, PathBuf};

use guideway_formats::{ReadOptions, read_bytes, read_file};
use guideway_layout::{Code, Layout};
use guideway_spline::Point;

/// The folder of real layouts, which lies beside the repository. It is not part of it, for licenses.
pub(crate) fn real_layouts(format: &str) -> Option<PathBuf> {
    let shared = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/layouts");
    let folder = shared.join(format);
    if folder.is_dir() {
        return Some(folder);
    }
    println!("SKIPPED: the real layouts are not at {}", folder.display());
    None
}

/// A real file, which must be readable; none where there are none.
pub(crate) fn real(format: &str, file: &str) -> Option<Layout> {
    let path = real_layouts(format)?.join(file);
    Some(read_file(&path, &ReadOptions::default()).unwrap_or_else(|e| panic!("{e}")))
}

/// A layout from text that must be readable.
pub(crate) fn read(text: &str) -> Layout {
    read_bytes("test", text.as_bytes(), &ReadOptions::default()).unwrap_or_else(|e| panic!("{e}"))
}

/// Where each path begins and ends.
pub(crate) fn ends(layout: &Layout, id: &str) -> (Point<f64>, Point<f64>) {
    let path = layout.paths.iter().find(|p| p.id() == id);
    let path = path.unwrap_or_else(|| panic!("no path {id}"));
    path.ends().unwrap()
}

/// The kinds of findings, in their order.
pub(crate) fn codes(layout: &Layout) -> Vec<Code> {
    layout.diagnostics.counts().map(|(code, _)| code).collect()
}

/// A count under the format's own name; zero if it is not counted.
pub(crate) fn count(layout: &Layout, name: &str) -> u64 {
    let counts = &layout.provenance.counts;
    counts.iter().find(|(n, _)| n == name).map_or(0, |c| c.1)
}

/// Checks counts written as `points 55, paths 68` against a layout; names that are absent mean zero.
pub(crate) fn assert_counts(layout: &Layout, all: &[&str], expected: &str, file: &str) {
    for name in all {
        let mut stated = expected.split(", ").filter_map(|c| c.rsplit_once(' '));
        let stated = stated.find(|(n, _)| n == name).map_or("0", |c| c.1);
        assert_eq!(count(layout, name).to_string(), stated, "{name} of {file}");
    }
}
