//! Arrow files read in part: the record batches in an area, and when all are read.

use guideway_formats::arrow::{WriteOptions, write_layout};
use guideway_formats::{BYTES_READ, FILE_BYTES, ReadOptions, read_bytes};
use guideway_layout::{Layout, NewPath};
use guideway_spline::{Bounds, Point, Runs};

/// Rows of a record batch.
const BATCH: usize = 16_384;

/// A line per meter of the x axis, in the order of the axis.
fn lines(start: f64, count: usize) -> Layout {
    let mut layout = Layout::default();
    let mut runs = Runs::default();
    for at in 0..count {
        let from = Point::new(start + at as f64, 0.0);
        runs.clear();
        runs.push_line(from, from + Point::new(0.75, 0.5));
        push(&mut layout, &format!("line-{at}"), &runs);
    }
    layout
}

fn push(layout: &mut Layout, id: &str, runs: &Runs) {
    layout.paths.push(&NewPath {
        id,
        runs,
        ..NewPath::default()
    });
}

fn bytes(layout: &Layout) -> Vec<u8> {
    let mut bytes = Vec::new();
    write_layout(layout, &mut bytes, &WriteOptions::default()).expect("a file");
    bytes
}

fn read(bytes: &[u8], area: Option<[f64; 2]>) -> Layout {
    let area = area.map(|[from, to]| Bounds {
        min: Point::new(from, -1.0),
        max: Point::new(to, 1.0),
    });
    let options = ReadOptions {
        area,
        ..ReadOptions::default()
    };
    read_bytes("part", bytes, &options).expect("a layout")
}

/// Identifiers and boxes of paths.
fn paths(layout: &Layout) -> Vec<(&str, Option<Bounds<f64>>)> {
    let paths = layout.paths.iter();
    paths.map(|path| (path.id(), path.hull_bounds())).collect()
}

fn is_part(layout: &Layout) -> bool {
    layout.provenance.count(BYTES_READ).is_some()
}

#[test]
fn only_the_batches_in_an_area_are_read() {
    let file = bytes(&lines(0.0, 4 * BATCH));
    let whole = read(&file, None);
    assert!(!is_part(&whole) && whole.paths.len() == 4 * BATCH);
    let border = (2 * BATCH) as f64;
    for (area, batches) in [
        ([20_000.0, 20_100.0], 1..2),
        ([border - 10.0, border + 10.0], 1..3),
    ] {
        let part = read(&file, Some(area));
        let expected = &paths(&whole)[batches.start * BATCH..batches.end * BATCH];
        assert!(paths(&part) == expected, "{area:?}");
        let count = |name| part.provenance.count(name).expect("a count") as f64;
        assert_eq!(count(FILE_BYTES) as usize, file.len());
        let share = count(BYTES_READ) / count(FILE_BYTES);
        let expected = batches.len() as f64 / 4.0;
        assert!((share - expected).abs() < 0.02, "{area:?}: {share}");
    }
}

#[test]
fn a_path_over_the_border_of_batches_is_read_whole() {
    let mut layout = lines(0.0, BATCH - 1);
    // Its first run is the last row of a batch, its second one the first row of the next.
    let mut runs = Runs::default();
    runs.push_line(Point::new(-50.0, 0.0), Point::new(-40.0, 0.0));
    runs.push_line(Point::new(-40.0, 0.0), Point::new(-40.0, 9.0));
    push(&mut layout, "corner", &runs);
    for (from, count) in [(100_000.0, BATCH - 1), (200_000.0, BATCH)] {
        for path in lines(from, count).paths.iter() {
            path.copy_runs(&mut runs);
            push(&mut layout, path.id(), &runs);
        }
    }
    let file = bytes(&layout);
    let whole = read(&file, None);
    for (at, rows) in [
        (100.0, 0..2 * BATCH - 1),
        (100_100.0, 0..2 * BATCH - 1),
        (200_100.0, 2 * BATCH - 1..3 * BATCH - 1),
    ] {
        let part = read(&file, Some([at - 1.0, at + 1.0]));
        assert!(
            is_part(&part) && paths(&part) == paths(&whole)[rows],
            "{at}"
        );
    }
}

#[test]
fn all_is_read_where_a_part_could_not_stand_alone() {
    let near = Some([0.0, 1.0]);
    let mut layout = lines(0.0, 2 * BATCH);
    let file = bytes(&layout);
    assert_eq!(read(&file, near).paths.len(), BATCH);
    // Nothing is there: the reader is to know where the paths are.
    let nowhere = read(&file, Some([-9.0, -8.0]));
    assert!(!is_part(&nowhere) && nowhere.paths.len() == 2 * BATCH);
    // A part that is all of it.
    assert!(!is_part(&read(&file, Some([-1e6, 1e6]))));
    // Without the extents, and with those of another number of batches.
    let replaced = |from: &str, to: &str| {
        let mut bytes = file.clone();
        let at = bytes
            .windows(from.len())
            .rposition(|at| at == from.as_bytes());
        let at = at.expect("the text");
        bytes[at..at + from.len()].copy_from_slice(to.as_bytes());
        bytes
    };
    for damaged in [
        replaced("guideway.extents", "guideway.extentz"),
        replaced("],[16384", "], 16384"),
        replaced("[16384", "[-6384"),
    ] {
        let whole = read(&damaged, near);
        assert!(!is_part(&whole) && whole.paths.len() == 2 * BATCH);
    }
    // Ranks stay, so that a part keeps its draw order.
    layout.paths.set_rank((0..2 * BATCH as i32).rev().collect());
    let part = read(&bytes(&layout), near);
    assert_eq!(
        part.paths.rank().map(|ranks| ranks[0]),
        Some(2 * BATCH as i32 - 1)
    );
    assert_eq!(part.paths.len(), BATCH);
    // Nodes refer to paths, and paths to nodes, by their numbers.
    layout.nodes.push("N", Point::new(0.0, 0.0), None);
    let whole = read(&bytes(&layout), near);
    assert!(!is_part(&whole) && whole.paths.len() == 2 * BATCH);
}
