//! Law of conversion: a layout written in any format reads back with the same bounds.

use std::time::SystemTime;

use guideway_formats::lif::{self, Version};
use guideway_formats::{ReadOptions, arrow, dxf, geojson, read_bytes, svg};
use guideway_layout::{Layout, check_across, merge};
use guideway_spline::{Affine, Bounds, Point};

use crate::read::{assert_finite, options};

/// Largest deviation of the bounds after writing and reading, in meters.
const TOLERANCE_M: f64 = 1e-4;

/// Layouts with larger coordinates are skipped: their copy could exceed the coordinate limit.
const FARTHEST_M: f64 = 1e8;

/// Merges a layout with a moved copy, writes the result in every format, and reads it back. Also
/// writes the layout alone as LIF, whose writer copies unmodeled fields of the source.
///
/// # Panics
/// When a writer fails, its output cannot be read, or the bounds change by more than 0.1 mm.
pub fn convert(bytes: &[u8]) {
    let Ok(layout) = read_bytes("fuzzed", bytes, &options()) else {
        return;
    };
    let Some(bounds) = bounds(&layout).filter(|b| reach_m(b) < FARTHEST_M) else {
        return;
    };
    for version in [Version::V1, Version::V2] {
        assert_round_trip(&layout, Format::Lif(version));
    }
    let mut moved = layout.clone();
    moved.transform(Affine::translation(Point::new(bounds.size().x, 1.0)));
    check_across(&[&layout, &moved]);
    let both = merge(vec![layout, moved]);
    for format in Format::ALL {
        assert_round_trip(&both, format);
    }
}

fn assert_round_trip(layout: &Layout, format: Format) {
    let written = format.write(layout);
    let again = read_bytes("written", &written, &ReadOptions::default())
        .unwrap_or_else(|error| panic!("{format:?}: {error}"));
    assert_finite(&again);
    let (before, after) = (bounds(layout), bounds(&again));
    let (Some(before), Some(after)) = (before, after) else {
        panic!("{format:?}: bounds {before:?} before, {after:?} after");
    };
    let shifts = [before.min - after.min, before.max - after.max];
    let shift_m = shifts.into_iter().map(Point::norm).fold(0.0, f64::max);
    assert!(
        shift_m <= TOLERANCE_M,
        "{format:?}: bounds {before:?} before, {after:?} after"
    );
}

#[derive(Clone, Copy, Debug)]
enum Format {
    Arrow,
    Dxf,
    GeoJson,
    Lif(Version),
    Svg,
}

impl Format {
    const ALL: [Self; 6] = [
        Self::Arrow,
        Self::Dxf,
        Self::GeoJson,
        Self::Lif(Version::V1),
        Self::Lif(Version::V2),
        Self::Svg,
    ];

    fn write(self, layout: &Layout) -> Vec<u8> {
        let mut out = Vec::new();
        let exported = SystemTime::UNIX_EPOCH;
        let written = match self {
            Self::Arrow => return arrow_bytes(layout),
            Self::Dxf => dxf::write_layout(layout, &mut out),
            Self::GeoJson => {
                let tolerance_m = 0.5 * TOLERANCE_M;
                geojson::write_layout(layout, &mut out, &geojson::WriteOptions { tolerance_m })
            }
            Self::Lif(version) => {
                lif::write_layout(layout, &mut out, &lif::WriteOptions { version, exported })
            }
            Self::Svg => svg::write_layout(layout, &mut out),
        };
        written.unwrap_or_else(|error| panic!("{self:?}: {error}"));
        out
    }
}

/// Bytes of an Arrow file.
pub(crate) fn arrow_bytes(layout: &Layout) -> Vec<u8> {
    let mut bytes = Vec::new();
    arrow::write_layout(layout, &mut bytes, &arrow::WriteOptions::default())
        .unwrap_or_else(|error| panic!("{error}"));
    bytes
}

/// Box of all curves; `None` if there is no curve.
fn bounds(layout: &Layout) -> Option<Bounds<f64>> {
    let runs = layout.paths.iter().flat_map(|path| path.runs());
    let segments = runs.flat_map(|run| run.segments());
    segments
        .map(|segment| Bounds::of_segment(&segment))
        .reduce(Bounds::union)
}

fn reach_m(bounds: &Bounds<f64>) -> f64 {
    let Bounds { min, max } = bounds;
    [min.x, min.y, max.x, max.y]
        .into_iter()
        .map(f64::abs)
        .fold(0.0, f64::max)
}
