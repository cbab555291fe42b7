//! What must hold of every read, whatever the bytes.

use guideway_formats::{ReadOptions, read_bytes};
use guideway_layout::{CheckOptions, Limits, check};

/// Reads and checks a layout. An error is fine; a panic, a curve that cannot be drawn or a finding without
/// words is not.
pub fn read(bytes: &[u8]) {
    let options = ReadOptions {
        // Small, so that a run is short and what is held stays far below the fuzzer's own limit.
        limits: Limits {
            control_points: 200_000,
            curve_points: 1_000,
            ..Limits::default()
        },
        ..ReadOptions::default()
    };
    let layout = match read_bytes("fuzzed", bytes, &options) {
        Ok(layout) => layout,
        Err(error) => {
            assert!(!error.to_string().is_empty() && !error.remedy().is_empty());
            return;
        }
    };
    for path in layout.paths.iter() {
        let mut points = path.runs().flat_map(|run| run.iter());
        assert!(points.all(|p| p.is_finite()), "path {}", path.id());
    }
    for finding in layout.diagnostics.iter() {
        let texts = [&finding.place.element, &finding.message, &finding.remedy];
        assert!(texts.iter().all(|text| !text.is_empty()), "{finding:?}");
    }
    check(&layout, &CheckOptions::default());
}
