//! Law of reading: bytes yield a drawable layout with complete findings, or an error with a remedy.

use guideway_formats::{ReadOptions, read_bytes};
use guideway_layout::{CheckOptions, Layout, Limits, check};

/// Options with low limits: memory stays far below the limit of the fuzzer, and runs stay short.
pub(crate) fn options() -> ReadOptions<'static> {
    ReadOptions {
        limits: Limits {
            control_points: 200_000,
            curve_points: 1_000,
            ..Limits::default()
        },
        ..ReadOptions::default()
    }
}

/// Reads and checks a layout.
///
/// # Panics
/// When a reader panics, an error or a finding lacks a text, or a coordinate is not finite.
pub fn read(bytes: &[u8]) {
    let layout = match read_bytes("fuzzed", bytes, &options()) {
        Ok(layout) => layout,
        Err(error) => {
            assert!(!error.to_string().is_empty() && !error.remedy().is_empty());
            return;
        }
    };
    assert_finite(&layout);
    let found = check(&layout, &CheckOptions::default());
    for finding in layout.diagnostics.iter().chain(found.iter()) {
        let texts = [&finding.place.element, &finding.message, &finding.remedy];
        assert!(texts.iter().all(|text| !text.is_empty()), "{finding:?}");
    }
}

pub(crate) fn assert_finite(layout: &Layout) {
    for path in layout.paths.iter() {
        let mut points = path.runs().flat_map(|run| run.iter());
        assert!(points.all(|p| p.is_finite()), "path {}", path.id());
    }
}
