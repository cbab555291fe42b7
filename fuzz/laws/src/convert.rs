use std::fs;
use std::time::SystemTime;

use guideway_formats::lif::{self, Version};
use guideway_formats::{ReadOptions, arrow, dxf, geojson, read_bytes, svg};
use guideway_layout::{Layout, check_across, merge};
use guideway_spline::{Affine, Bounds, Point};

use crate::read::{assert_finite, options};

/// How far a curve may be from what it was before it was written, in meters.
const TOLERANCE_M: f64 = 1e-4;

/// Positions farther out than this are left alone: near the largest coordinate, a copy could go beyond it.
const FARTHEST_M: f64 = 1e8;

/// Writes a layout and a copy of it beside it, as one, in every format, and reads it back: what was written is
/// sound, and all curves are where they were. So it is in the layout's own format, if that is LIF.
pub fn convert(bytes: &[u8]) {
    let Ok(layout) = read_bytes("fuzzed", bytes, &options()) else {
        return;
    };
    let Some(bounds) = bounds(&layout).filter(|b| reach_m(b) < FARTHEST_M) else {
        return;
    };
    // What is beside the layout in its own file is kept in LIF.
    for version in [Version::V1, Version::V2] {
        comes_back(&layout, Format::Lif(version));
    }
    let mut moved = layout.clone();
    moved.transform(Affine::translation(Point::new(bounds.size().x, 1.0)));
    check_across(&[&layout, &moved]);
    let both = merge(vec![layout, moved]);
    for format in Format::ALL {
        comes_back(&both, format);
    }
}

fn comes_back(layout: &Layout, format: Format) {
    let written = format.write(layout);
    let again = read_bytes("written", &written, &ReadOptions::default())
        .unwrap_or_else(|error| panic!("{format:?}: {error}"));
    assert_finite(&again);
    let (before, after) = (bounds(layout), bounds(&again));
    let (Some(before), Some(after)) = (before, after) else {
        panic!("{format:?}: {before:?} became {after:?}");
    };
    let apart = [before.min - after.min, before.max - after.max];
    let apart_m = apart.into_iter().map(Point::norm).fold(0.0, f64::max);
    assert!(
        apart_m <= TOLERANCE_M,
        "{format:?}: {before:?} became {after:?}"
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

/// An Arrow file; it is only written to a disk.
pub(crate) fn arrow_bytes(layout: &Layout) -> Vec<u8> {
    let folder = tempfile::tempdir().expect("a folder for files that pass");
    let path = folder.path().join("layout.arrow");
    arrow::write_layout(layout, &path, &arrow::WriteOptions::default())
        .unwrap_or_else(|error| panic!("{error}"));
    fs::read(&path).expect("the file that was just written")
}

/// The box of all curves; none if there is no curve.
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
