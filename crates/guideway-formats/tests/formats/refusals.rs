//! Every refused path has a finding: an error whatever its code, unless the file is right.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use guideway_formats::{ReadOptions, read_file};
use guideway_layout::{Code, Diagnostics, Layout, RefusedPath, Severity};

use crate::common::read;

/// Number of refused paths by code and severity that have no finding.
fn without_finding(layout: &Layout) -> BTreeMap<(Code, Severity), u64> {
    let mut refused = BTreeMap::new();
    for path in layout.refused.iter() {
        let severity = match path.code {
            Code::NotDrawn | Code::CrossLevel => Severity::Info,
            _ => Severity::Error,
        };
        *refused.entry((path.code, severity)).or_insert(0) += 1;
    }
    for finding in layout.diagnostics.iter() {
        let kind = (finding.code, finding.severity);
        if let Some(count) = refused.get_mut(&kind) {
            *count -= 1;
            if *count == 0 {
                refused.remove(&kind);
            }
        }
    }
    refused
}

/// All files below a folder beside the repository, if it exists, without those of attacks, which
/// take long.
fn files(folder: &str) -> Vec<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared");
    let mut folders = vec![root.join(folder)];
    let mut files = Vec::new();
    while let Some(folder) = folders.pop() {
        let Ok(entries) = fs::read_dir(&folder) else {
            println!("SKIPPED: {} is not there", folder.display());
            continue;
        };
        for entry in entries {
            let path = entry.unwrap().path();
            match path.is_dir() {
                true if path.ends_with("hostile") => {}
                true => folders.push(path),
                false => files.push(path),
            }
        }
    }
    files
}

#[test]
fn every_refused_path_of_every_file_has_a_finding() {
    // All findings are stored, so that each can be counted.
    let mut options = ReadOptions::default();
    options.limits.diagnostics_per_code = usize::MAX;
    let mut refused = 0;
    let files: Vec<_> = files("layouts").into_iter().chain(files("cases")).collect();
    for file in &files {
        if let Ok(layout) = read_file(file, &options) {
            let missing = without_finding(&layout);
            assert!(missing.is_empty(), "{}: {missing:?}", file.display());
            refused += layout.refused.len();
        }
    }
    assert!(files.is_empty() || refused > 50, "{refused} refused paths");
}

#[test]
fn a_refusal_without_a_finding_is_noticed() {
    let mut layout = Layout::default();
    layout.refused.push("e1", Code::ZeroLength, "it is a point");
    assert_eq!(without_finding(&layout).len(), 1);
    let mut hidden = Diagnostics::default();
    let path = RefusedPath {
        id: "e1",
        code: Code::ZeroLength,
        detail: "it is a point",
    };
    // A warning does not make up for it.
    hidden.push(path.code, Default::default, String::new, "");
    layout.diagnostics = hidden;
    assert_eq!(without_finding(&layout).len(), 1);
    layout.diagnostics.push_refused(path, Default::default, "");
    assert!(without_finding(&layout).is_empty());
}

#[test]
fn lines_without_positions_are_errors() {
    let layout = read(
        r#"{"type": "FeatureCollection", "features": [
            {"type": "Feature", "properties": {}, "id": "empty",
             "geometry": {"type": "LineString", "coordinates": []}},
            {"type": "Feature", "properties": {}, "id": "point",
             "geometry": {"type": "LineString", "coordinates": [[1, 2]]}},
            {"type": "Feature", "properties": {}, "id": "parts",
             "geometry": {"type": "MultiLineString", "coordinates": [[], []]}}]}"#,
    );
    assert_eq!(layout.refused.len(), 3);
    assert!(without_finding(&layout).is_empty());
    let is_of = |id: &str| {
        let named = |place: &str| place.contains(&format!("\"{id}\""));
        let mut errors = layout.diagnostics.iter();
        errors.any(|d| d.severity == Severity::Error && named(&d.place.element))
    };
    for id in ["empty", "point", "parts"] {
        assert!(is_of(id), "{id}: {:?}", layout.diagnostics);
    }
}

#[test]
fn broken_entities_of_a_drawing_are_errors_and_hidden_ones_are_not() {
    let entity =
        |layer: &str, x: &str| format!("0\nLINE\n8\n{layer}\n10\n{x}\n20\n0\n11\n5\n21\n0\n");
    let text = format!(
        "0\nSECTION\n2\nTABLES\n0\nTABLE\n2\nLAYER\n0\nLAYER\n2\nroads\n70\n0\n62\n7\n\
         0\nLAYER\n2\noff\n70\n0\n62\n-7\n0\nENDTAB\n0\nENDSEC\n\
         0\nSECTION\n2\nENTITIES\n{}{}{}0\nENDSEC\n0\nEOF\n",
        entity("roads", "1"),
        entity("roads", "1,5"),
        entity("off", "2"),
    );
    let layout = read(&text);
    assert_eq!((layout.paths.len(), layout.refused.len()), (1, 2));
    assert!(without_finding(&layout).is_empty());
    assert_eq!(layout.diagnostics.count_at_least(Severity::Error), 1);
}
