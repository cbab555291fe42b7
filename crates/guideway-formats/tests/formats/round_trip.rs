//! Round trip of every real layout through each pair of formats that hold curves.

use std::fs;
use std::path::{Path, PathBuf};
use std::time::SystemTime;

use crate::common::real_layouts;
use crate::same::{assert_same_curves, assert_same_ids, assert_same_network};
use guideway_formats::lif::{Version, WriteOptions};
use guideway_formats::{ReadOptions, arrow, dxf, lif, read_file, svg};
use guideway_layout::{Code, Layout, NewPath};
use guideway_spline::{Point, Runs};

/// A format that holds curves.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Target {
    Arrow,
    Dxf,
    Lif(Version),
    Svg,
}

const TARGETS: [Target; 5] = [
    Target::Arrow,
    Target::Dxf,
    Target::Lif(Version::V1),
    Target::Lif(Version::V2),
    Target::Svg,
];

impl Target {
    fn write(self, layout: &Layout, path: &Path) {
        let mut out = Vec::new();
        let exported = SystemTime::UNIX_EPOCH;
        match self {
            Self::Arrow => {
                arrow::write_layout(layout, &mut out, &arrow::WriteOptions::default()).unwrap()
            }
            Self::Dxf => dxf::write_layout(layout, &mut out).unwrap(),
            Self::Lif(version) => {
                lif::write_layout(layout, &mut out, &WriteOptions { version, exported }).unwrap()
            }
            Self::Svg => svg::write_layout(layout, &mut out).unwrap(),
        };
        fs::write(path, out).unwrap();
    }

    fn through(self, layout: &Layout, folder: &Path) -> Layout {
        let path = folder.join("layout");
        self.write(layout, &path);
        read_file(&path, &ReadOptions::default()).unwrap_or_else(|e| panic!("{self:?}: {e}"))
    }
}

/// Reduces a layout to the common subset of the formats: one-way paths without gaps, in order of
/// their levels. Other tests check that the writers list the rest as losses.
fn plain(layout: &Layout) -> Layout {
    let mut plain = Layout {
        levels: layout.levels.clone(),
        ..Layout::default()
    };
    for node in 0..layout.nodes.len() as u32 {
        let nodes = &layout.nodes;
        plain
            .nodes
            .push(nodes.id(node), nodes.position_m(node), nodes.level(node));
    }
    let mut rows: Vec<usize> = (0..layout.paths.len()).collect();
    let level = |row: usize| {
        let path = layout.paths.get(row);
        let of_start = || layout.nodes.level(path.start_node()?);
        path.level().or_else(of_start).unwrap_or(u32::MAX)
    };
    rows.sort_by_key(|&row| level(row));
    for path in rows.into_iter().map(|row| layout.paths.get(row)) {
        let mut runs = Runs::default();
        let mut end: Option<Point<f64>> = None;
        for run in path.runs() {
            let points: Vec<_> = run.iter().collect();
            let start = guideway_spline::uniform::start(points.first_chunk().unwrap());
            if end.is_some_and(|end| end.distance(start) > 5e-5) {
                break;
            }
            end = Some(guideway_spline::uniform::end(points.last_chunk().unwrap()));
            runs.push(&points);
        }
        if runs.is_empty() {
            continue;
        }
        plain.paths.push(&NewPath {
            id: path.id(),
            runs: &runs,
            start_node: path.start_node(),
            end_node: path.end_node(),
            level: path.level(),
            ..NewPath::default()
        });
    }
    plain
}

fn real_files() -> Vec<PathBuf> {
    let mut files = Vec::new();
    for folder in [
        "dxf",
        "geojson_roads",
        "lanelet2",
        "lif",
        "nav2_geojson",
        "opentcs",
        "opendrive",
        "rmf_building",
        "svg",
        "vda5050",
    ] {
        let Some(folder) = real_layouts(folder) else {
            return Vec::new();
        };
        let entries = folder.read_dir().unwrap();
        files.extend(entries.map(|entry| entry.unwrap().path()));
    }
    files.sort();
    files
}

#[test]
fn real_layouts_survive_every_pair_of_formats() {
    let folder = tempfile::tempdir().unwrap();
    let mut compared = 0;
    for file in real_files() {
        let read = read_file(&file, &ReadOptions::default()).unwrap();
        let layout = plain(&read);
        let name = file.display();
        // A large drawing takes one pair only, for time.
        let pairs = if layout.paths.geometry().segment_count() > 5_000 {
            1
        } else {
            TARGETS.len()
        };
        for first in TARGETS {
            let once = first.through(&layout, folder.path());
            let what = format!("{name} as {first:?}");
            assert_same_curves(&layout, &once, &what);
            assert_same_ids(&layout, &once, &what);
            for second in TARGETS.into_iter().take(pairs) {
                let twice = second.through(&plain(&once), folder.path());
                let what = format!("{what}, then {second:?}");
                assert_same_curves(&layout, &twice, &what);
                assert_same_ids(&layout, &twice, &what);
                compared += layout.paths.len();
            }
        }
    }
    println!("{compared} paths compared");
}

#[test]
fn real_lif_files_keep_their_network() {
    let folder = tempfile::tempdir().unwrap();
    for file in real_files()
        .iter()
        .filter(|f| f.parent().is_some_and(|folder| folder.ends_with("lif")))
    {
        let layout = read_file(file, &ReadOptions::default()).unwrap();
        for version in [Version::V1, Version::V2] {
            let again = Target::Lif(version).through(&layout, folder.path());
            let what = format!("{} as {version:?}", file.display());
            assert_same_curves(&layout, &again, &what);
            assert_same_ids(&layout, &again, &what);
            assert_same_network(&layout, &again, &what);
            assert_eq!(again.diagnostics.count(Code::UnknownNode), 0, "{what}");
        }
    }
}

#[test]
#[should_panic(expected = "m off")]
fn comparison_detects_a_moved_point() {
    let line = |y: f64| {
        let mut layout = Layout::default();
        let mut runs = Runs::default();
        runs.push_line(Point::new(0.0, 0.0), Point::new(7.0, y));
        layout.paths.push(&NewPath {
            id: "a",
            runs: &runs,
            ..NewPath::default()
        });
        layout
    };
    assert_same_curves(&line(0.0), &line(2e-4), "moved");
}
