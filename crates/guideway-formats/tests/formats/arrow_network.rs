//! Arrow tables of version 2 hold whole layouts: everything that is written is read back.

use guideway_formats::arrow::{Precision, WriteOptions, write_layout};
use guideway_formats::{ReadOptions, lif, read_file};
use guideway_layout::{
    Attribute, Direction, Layout, Level, NewPath, Quantity, Value, Values, WrittenCurve,
};
use guideway_spline::{Point, Runs};

use crate::common::{real, real_layouts};
use crate::networks::{differences, network};

/// Returns a layout after it was written and read, and the version of the table.
fn through(layout: &Layout, precision: Option<Precision>) -> (Layout, String) {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("layout.arrow");
    let mut file = std::fs::File::create(&path).expect("a new file");
    let losses = write_layout(layout, &mut file, &WriteOptions { precision }).expect("a file");
    assert!(losses.is_empty());
    let back = read_file(&path, &ReadOptions::default()).unwrap_or_else(|e| panic!("{e}"));
    let version = back.provenance.format_version.clone();
    (back, version)
}

#[test]
fn any_layout_is_read_back_equal() {
    for seed in 0..1_000 {
        let layout = network(seed);
        let (back, _) = through(&layout, Some(Precision::F64));
        let different = differences(&layout, &back);
        assert!(
            different.is_empty(),
            "seed {seed}: {}",
            different.join("\n")
        );
        let found: Vec<_> = back.diagnostics.iter().collect();
        assert!(found.is_empty(), "seed {seed}: {found:?}");
    }
}

#[test]
fn comparison_detects_each_change() {
    let layout = network(4);
    assert!(differences(&layout, &network(4)).is_empty());
    let mut seen = std::collections::HashSet::new();
    for seed in 0..40 {
        let other = network(seed);
        let different = differences(&layout, &other);
        seen.extend(
            different
                .iter()
                .map(|d| d.split(':').next().unwrap().to_owned()),
        );
    }
    assert_eq!(seen.len(), 10, "{seen:?}");
}

fn line(y: f64) -> Runs {
    let mut runs = Runs::default();
    runs.push_line(Point::new(0.0, y), Point::new(4.0, y));
    runs
}

/// A layout of two paths, to which a test adds one feature.
fn two_paths() -> Layout {
    let mut layout = Layout::default();
    for (id, y) in [("a", 0.0), ("b", 2.0)] {
        layout.paths.push(&NewPath {
            id,
            runs: &line(y),
            ..NewPath::default()
        });
    }
    layout
}

#[test]
fn paths_alone_stay_in_version_1() {
    let mut layout = two_paths();
    layout.paths.attributes.set(1, "lanes", Value::Int(2));
    layout
        .paths
        .attributes
        .set(0, "direction", Value::Text("north"));
    layout.paths.set_rank(vec![1, 0]);
    layout.levels.push(Level {
        id: "hall".into(),
        ..Level::default()
    });
    layout.paths.set_level(1, Some(0));
    let (back, version) = through(&layout, None);
    assert_eq!(version, "1");
    assert!(differences(&layout, &back).is_empty());

    let changes: [fn(&mut Layout); 8] = [
        |layout| {
            layout.nodes.push("N", Point::new(0.0, 0.0), None);
        },
        |layout| layout.paths.set_direction(0, Direction::Both),
        |layout| layout.paths.vehicle_types_mut().set(0, &["tug"]),
        |layout| layout.levels[0].elevation_m = Some(3.0),
        |layout| layout.levels.push(layout.levels[0].clone()),
        |layout| layout.paths.attributes.set(0, "rank", Value::Text("high")),
        |layout| layout.paths.attributes.set(0, "list", Value::Json("[]")),
        |layout| {
            let attributes = &mut layout.paths.attributes;
            attributes.set_quantity(0, "maxSpeed", 1.5, Quantity::Speed);
        },
    ];
    for (index, change) in changes.into_iter().enumerate() {
        let mut changed = layout.clone();
        change(&mut changed);
        let (back, version) = through(&changed, None);
        assert_eq!(version, "2", "change {index}");
        let different = differences(&changed, &back);
        assert!(different.is_empty(), "change {index}: {different:?}");
        assert!(back.diagnostics.iter().next().is_none(), "change {index}");
    }
}

#[test]
fn columns_of_other_elements_take_no_memory_of_paths() {
    let mut layout = two_paths();
    layout.nodes.push("N", Point::new(0.0, 0.0), None);
    layout.nodes.attributes.set(0, "theta", Value::Float(1.0));
    layout.paths.attributes.set(0, "lanes", Value::Int(1));
    let (back, _) = through(&layout, None);
    assert!(back.paths.attributes.get("theta").is_none());
    assert!(back.nodes.attributes.get("lanes").is_none());
    assert_eq!(
        back.nodes.attributes.value(0, "theta"),
        Some(Value::Float(1.0))
    );
}

#[test]
fn elements_of_many_batches_keep_their_references() {
    let mut layout = Layout::default();
    let count = 40_000_u32;
    for node in 0..count {
        let position = Point::new(f64::from(node), 0.5);
        layout.nodes.push(&format!("N{node}"), position, None);
    }
    for path in 0..count {
        layout.paths.push(&NewPath {
            id: "p",
            runs: &line(f64::from(path)),
            start_node: Some(path),
            end_node: Some(count - 1 - path),
            vehicle_types: if path % 3 == 0 { &["tug", "fork"] } else { &[] },
            ..NewPath::default()
        });
    }
    let entries = layout.paths.vehicle_types_mut();
    let last = entries.entries(39_999).start;
    entries.attributes.set(last, "maxSpeed", Value::Float(0.25));
    layout.paths.set_written_curve(
        33_333,
        WrittenCurve {
            degree: 2,
            knots: Vec::new(),
            points_m: vec![Point::new(0.1, 0.2); 3],
            weights: Some(vec![1.0, 0.7, 1.0]),
        },
    );
    let (back, _) = through(&layout, None);
    let different = differences(&layout, &back);
    assert!(different.is_empty(), "{}", different[0].len());
    assert_eq!(
        back.paths.value_for(39_999, "tug", "maxSpeed"),
        Some(Value::Float(0.25))
    );
}

#[test]
fn types_of_numbers_stay_narrow() {
    let mut layout = two_paths();
    layout.nodes.push("N", Point::new(0.0, 0.0), None);
    let narrow = |values, source: &str| Attribute {
        source_type: Some(source.into()),
        ..Attribute::new("size", values)
    };
    let paths = narrow(
        Values::Int([Some(3), Some(-4)].into_iter().collect()),
        "Int8",
    );
    let nodes = narrow(Values::Float([Some(0.5)].into_iter().collect()), "Float32");
    layout.paths.attributes.insert(paths.clone());
    layout.nodes.attributes.insert(nodes.clone());
    let (back, _) = through(&layout, None);
    assert_eq!(back.paths.attributes.get("size"), Some(&paths));
    assert_eq!(back.nodes.attributes.get("size"), Some(&nodes));
}

#[test]
fn real_layouts_are_read_back_equal() {
    let mut compared = 0;
    for format in [
        "lif",
        "opentcs",
        "rmf_building",
        "vda5050",
        "nav2_geojson",
        "dxf",
        "svg",
    ] {
        let Some(folder) = real_layouts(format) else {
            return;
        };
        for entry in folder.read_dir().expect("the folder") {
            let file = entry.expect("an entry").path();
            let layout = read_file(&file, &ReadOptions::default()).expect("a layout");
            let (back, _) = through(&layout, Some(Precision::F64));
            let different = differences(&layout, &back);
            let first = different
                .first()
                .map(|text| text.chars().take(400).collect::<String>());
            assert_eq!(first, None, "{}", file.display());
            compared += 1;
        }
    }
    assert!(compared > 50, "{compared}");
}

#[test]
fn two_way_lanes_pass_through_arrow_to_lif() {
    let Some(office) = real("rmf_building", "office.building.yaml") else {
        return;
    };
    let (mut back, _) = through(&office, Some(Precision::F64));
    // The writer names the source.
    back.provenance = office.provenance.clone();
    let both = |layout: &Layout| {
        let paths = layout.paths.iter();
        paths
            .filter(|path| path.direction() == Direction::Both)
            .count()
    };
    assert_eq!((both(&office), both(&back)), (66, 66));
    let lif = |layout: &Layout| {
        let mut out = Vec::new();
        let options = lif::WriteOptions {
            version: lif::Version::V1,
            exported: std::time::SystemTime::UNIX_EPOCH,
        };
        lif::write_layout(layout, &mut out, &options).expect("a text");
        String::from_utf8(out).expect("a text")
    };
    assert_eq!(lif(&office), lif(&back));
}

#[test]
fn vehicle_types_pass_through_arrow() {
    let site = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../guideway/examples/site.lif.json"
    );
    let site = read_file(site.as_ref(), &ReadOptions::default()).expect("a layout");
    let (back, version) = through(&site, None);
    assert_eq!(version, "2");
    let of = |layout: &Layout| -> Vec<Vec<String>> {
        let types = layout.paths.vehicle_types();
        let rows = 0..layout.paths.len();
        rows.map(|row| types.of(row).map(str::to_owned).collect())
            .collect()
    };
    let with = |name: &str| {
        of(&back)
            .iter()
            .filter(|types| types.iter().any(|t| t == name))
            .count()
    };
    assert_eq!((with("stacker-1200"), with("tugger-3000")), (312, 182));
    assert_eq!(of(&site), of(&back));
}
