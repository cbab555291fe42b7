//! Damaged and malicious Arrow files give an error or a layout, without panic or large allocation.

use std::fs;
use std::path::Path;

use guideway_bad_files::{folder, input, inputs};
use guideway_formats::arrow::{ArrowWriter, Column, ColumnType, Precision};
use guideway_formats::{ReadOptions, read_bytes, read_file};
use guideway_layout::{Layout, Member, Value};
use guideway_spline::Point;

/// Describes the outcome of a file in the format of `expect.tsv`.
fn outcome(path: &Path) -> String {
    match read_file(path, &ReadOptions::default()) {
        Err(error) => {
            let text = error.to_string();
            assert!(text.len() < 2_000, "overlong message: {text}");
            format!("error {}", error.code())
        }
        Ok(layout) => {
            let mut words = vec![format!("drawn {}", layout.paths.len())];
            let elements = [
                ("nodes", layout.nodes.len()),
                ("stations", layout.stations.len()),
                ("blocks", layout.blocks.len()),
            ];
            let elements = elements.iter().filter(|(_, count)| *count > 0);
            words.extend(elements.map(|(name, count)| format!("{name} {count}")));
            let refused = layout
                .refused
                .iter()
                .map(|r| format!("{}={}", r.id, r.code));
            words.extend(refused);
            let found = layout.diagnostics.counts();
            words.extend(found.map(|(code, count)| format!("{code}*{count}")));
            words.join(" ")
        }
    }
}

#[test]
fn bad_files_have_the_expected_outcome() {
    let table = folder("arrow").join("expect.tsv");
    let table = fs::read_to_string(table).expect("the table is there");
    let mut rows: Vec<(&str, &str)> = Vec::new();
    for line in table.lines().filter(|l| !l.starts_with('#')) {
        rows.push(line.split_once('\t').expect("file, tab, outcome"));
    }
    let inputs = inputs("arrow").expect("the archive is there");
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("file.arrow");
    let mut wrong = Vec::new();
    for (name, expected) in &rows {
        fs::write(&path, inputs.get(name).expect(name)).expect("room on the disk");
        let actual = outcome(&path);
        if actual != *expected {
            wrong.push(format!("{name}\t{actual}"));
        }
    }
    assert!(
        wrong.is_empty(),
        "unexpected outcomes:\n{}",
        wrong.join("\n")
    );

    for (file, _) in inputs.iter() {
        assert!(
            rows.iter().any(|r| r.0 == file),
            "{file} is not in expect.tsv"
        );
    }
}

/// Returns a small table with every kind of column.
fn valid_file() -> Vec<u8> {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("valid.arrow");
    let columns = vec![
        Column::new("guideway.part", ColumnType::UInt32),
        Column::new("level", ColumnType::Text),
        Column::new("width_m", ColumnType::Float32),
        Column::new("kind", ColumnType::Text),
        Column::new("busy", ColumnType::Bool),
        Column::new("count", ColumnType::Int16),
    ];
    let mut writer = ArrowWriter::create(&path, Precision::F32, columns).expect("a writer");
    for row in 0..9_i64 {
        let run: Vec<Point<f64>> = (0..5)
            .map(|x| Point::new(f64::from(x), row as f64))
            .collect();
        let values = [
            Some(Value::Int(row % 3)),
            Some(Value::Text("ground")),
            (row % 2 == 0).then_some(Value::Float(0.5)),
            (row != 4).then_some(Value::Text("aisle")),
            Some(Value::Bool(row > 2)),
            Some(Value::Int(row)),
        ];
        let id = format!("path-{}", row / 3);
        writer.push_run(&id, &run, &values).expect("a row");
    }
    writer.finish().expect("a file");
    fs::read(&path).expect("the file")
}

/// Reads any bytes, and checks the invariants of a layout that they give.
fn read_any(bytes: &[u8]) -> Option<Layout> {
    let layout = read_bytes("damaged", bytes, &ReadOptions::default()).ok()?;
    let (nodes, levels) = (layout.nodes.len(), layout.levels.len());
    let is_below = |index: Option<u32>, count: usize| index.is_none_or(|i| (i as usize) < count);
    for path in layout.paths.iter() {
        assert!(path.runs().all(|run| run.len() >= 4));
        assert!(path.runs().all(|run| run.iter().all(Point::is_finite)));
        assert!(is_below(path.level(), levels));
        assert!(is_below(path.start_node(), nodes) && is_below(path.end_node(), nodes));
    }
    assert_eq!(layout.paths.vehicle_types().len(), layout.paths.len());
    assert_eq!(layout.nodes.vehicle_types().len(), nodes);
    for node in 0..nodes as u32 {
        assert!(layout.nodes.position_m(node).is_finite());
        assert!(is_below(layout.nodes.level(node), levels));
    }
    let stations = layout.stations.len();
    for station in 0..stations as u32 {
        let served = layout.stations.nodes(station);
        assert!(served.iter().all(|&node| is_below(Some(node), nodes)));
        assert!(is_below(layout.stations.level(station), levels));
    }
    for member in layout.blocks.iter().flat_map(|block| &block.members) {
        assert!(match *member {
            Member::Path(row) => is_below(Some(row), layout.paths.len()),
            Member::Node(row) => is_below(Some(row), nodes),
            Member::Station(row) => is_below(Some(row), stations),
        });
    }
    assert!(layout.zones.iter().all(|zone| is_below(zone.level, levels)));
    Some(layout)
}

#[test]
fn rejects_truncated_files() {
    let bytes = valid_file();
    assert_eq!(read_any(&bytes).expect("valid").paths.len(), 3);
    for len in 0..bytes.len() {
        assert!(read_any(&bytes[..len]).is_none(), "cut at {len}");
    }
}

#[test]
fn truncated_streams_have_whole_batches_or_fail() {
    // A file consists of its magic, a stream and a footer.
    let file = valid_file();
    let bytes = &file[8..];
    for len in 0..bytes.len() {
        if let Some(layout) = read_any(&bytes[..len]) {
            assert!(matches!(layout.paths.len(), 0 | 3), "cut at {len}");
        }
    }
}

#[test]
fn changed_bytes_do_not_panic() {
    let mut files = vec![valid_file()];
    for name in [
        "refused-rows",
        "laughs",
        "lz4-garbled",
        "dictionary-key-beyond",
        "network",
        "network-interleaved",
    ] {
        files.push(input(&format!("arrow/{name}.arrow")).expect("a file"));
    }
    let mut state = 0x9e37_79b9_7f4a_7c15_u64;
    let mut next = |below: usize| {
        // xorshift64: the same damage in every run.
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state % below as u64) as usize
    };
    for file in &files {
        for _ in 0..500 {
            let mut bytes = file.clone();
            for _ in 0..=next(3) {
                let at = next(bytes.len());
                bytes[at] = match next(4) {
                    0 => 0xFF,
                    1 => 0,
                    2 => bytes[at] ^ (1 << next(8)),
                    _ => next(256) as u8,
                };
            }
            read_any(&bytes);
            read_any(&bytes[8..]);
        }
    }
}
