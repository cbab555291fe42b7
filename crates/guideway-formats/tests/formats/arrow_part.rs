//! Arrow files read in part: the record batches in an area, and when all are read.

use guideway_formats::arrow::{WriteOptions, write_layout};
use guideway_formats::{BYTES_READ, FILE_BYTES, ReadOptions, read_bytes};
use guideway_layout::{Attribute, Attributes, Block, Layout, Member, NewPath, TypeEntries, Values};
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
}

/// A network along the x axis: a node per meter, a path from each node to the next one, with a
/// property for one of two vehicle types, and a station and a block per kilometer.
fn network(count: usize) -> Layout {
    let mut layout = lines(0.0, count);
    for at in 0..=count {
        let position = Point::new(at as f64, 0.0);
        layout.nodes.push(&format!("node-{at}"), position, None);
    }
    for path in 0..count {
        let [start, end] = [path, path + 1].map(|node| Some(node as u32));
        layout.paths.set_nodes(path, start, end);
    }
    let mut types = TypeEntries::default();
    (0..count).for_each(|_| types.push(&["tugger", "stacker"]));
    let speeds = (0..2 * count).map(|entry| Some(entry as f64)).collect();
    let speeds = Attribute::new("maxSpeed", Values::Float(speeds));
    types.attributes.insert(speeds);
    *layout.paths.vehicle_types_mut() = types;
    for at in (0..count).step_by(1000) {
        let nodes = vec![at as u32];
        layout
            .stations
            .push(&format!("station-{at}"), None, nodes, None);
        layout.blocks.push(Block {
            id: format!("block-{at}"),
            members: vec![Member::Path(at as u32), Member::Node(at as u32)],
            attributes: Attributes::default(),
        });
    }
    layout
}

#[test]
fn a_part_of_a_network_has_its_nodes_and_the_properties_per_type() {
    let count = 4 * BATCH;
    let file = bytes(&network(count));
    let whole = read(&file, None);
    assert!(!is_part(&whole) && whole.diagnostics.is_empty());
    let at = 2 * BATCH + 100;
    let part = read(&file, Some([at as f64, at as f64 + 10.0]));
    assert!(is_part(&part));
    let listed: Vec<String> = part.diagnostics.iter().map(|d| d.message.clone()).collect();
    assert!(part.diagnostics.is_empty(), "{listed:?}");
    assert_eq!(part.paths.len(), BATCH);
    assert_eq!(part.nodes.len(), BATCH);
    // Everything that refers to others refers to the same ones.
    for path in part.paths.iter() {
        let number: usize = path.id()["line-".len()..].parse().unwrap();
        let of_whole = whole.paths.get(number);
        assert_eq!(path.id(), of_whole.id());
        let node = |layout: &Layout, node: Option<u32>| node.map(|n| layout.nodes.id(n).to_owned());
        assert_eq!(
            node(&part, path.start_node()),
            node(&whole, of_whole.start_node())
        );
        // The last path leads to a node of a batch beyond the area.
        let is_last = path.row() + 1 == BATCH;
        let end = node(&whole, of_whole.end_node()).filter(|_| !is_last);
        assert_eq!(node(&part, path.end_node()), end);
        let speeds = |layout: &Layout, row: usize| {
            let types = layout.paths.vehicle_types();
            let column = types.attributes.get("maxSpeed").unwrap();
            let entries = types.entries(row);
            let values = entries.map(|entry| column.values.get(entry).unwrap().to_string());
            values.collect::<Vec<_>>()
        };
        assert_eq!(speeds(&part, path.row()), speeds(&whole, number));
    }
    // Stations and blocks are all there, with what is in the part.
    assert_eq!(part.stations.len(), whole.stations.len());
    assert_eq!(part.blocks.len(), whole.blocks.len());
    let members: Vec<_> = part.blocks.iter().flat_map(|of| &of.members).collect();
    let near = (2 * BATCH..3 * BATCH).filter(|at| at % 1000 == 0).count();
    assert_eq!(members.len(), 2 * near);
    for member in members {
        let id = match *member {
            Member::Path(row) => &part.paths.id(row as usize)["line-".len()..],
            Member::Node(row) => &part.nodes.id(row)["node-".len()..],
            Member::Station(_) => unreachable!("blocks have no stations"),
        };
        assert_eq!(id.parse::<usize>().unwrap() % 1000, 0);
    }
    let count = |name| part.provenance.count(name).expect("a count") as f64;
    let share = count(BYTES_READ) / count(FILE_BYTES);
    assert!((0.2..0.35).contains(&share), "{share}");
    // Counts that contradict the rows: all is read.
    let text = b",16384,0]";
    let at_text = file.windows(text.len()).position(|at| at == text).unwrap();
    let mut damaged = file.clone();
    damaged[at_text + 1] = b'9';
    let near = Some([at as f64, at as f64 + 10.0]);
    assert!(!is_part(&read(&damaged, near)));
    // Wrong ones give wrong references at most.
    damaged[at_text + 1..][..2].copy_from_slice(b"11");
    assert_eq!(read(&damaged, near).paths.len(), BATCH);
    // A number beyond the table is still a fault, in a part too.
    let mut faulty = network(4 * BATCH);
    faulty.paths.set_nodes(at, Some(1_000_000), None);
    let part = read(&bytes(&faulty), near);
    assert!(is_part(&part) && part.diagnostics.iter().count() == 1);
}

#[test]
fn rows_in_hilbert_order_say_so_and_batches_end_with_clusters() {
    let mut layout = lines(0.0, 2 * BATCH);
    // Two runs: rows and paths are not the same.
    let mut runs = Runs::default();
    runs.push_line(Point::new(-50.0, 0.0), Point::new(-40.0, 0.0));
    runs.push_line(Point::new(-40.0, 0.0), Point::new(-40.0, 9.0));
    push(&mut layout, "corner", &runs);
    assert!(!read(&bytes(&layout), None).paths.is_hilbert_ordered());
    let rows: Vec<usize> = [2 * BATCH].into_iter().chain(0..2 * BATCH).collect();
    layout.retain_paths(&rows);
    layout.paths.set_hilbert_ordered();
    let file = bytes(&layout);
    assert!(read(&file, None).paths.is_hilbert_ordered());
    let part = read(&file, Some([20_000.0, 20_010.0]));
    assert!(is_part(&part) && part.paths.is_hilbert_ordered());
    let first: usize = part.paths.id(0)["line-".len()..].parse().unwrap();
    assert_eq!((first + 1) % 64, 0, "the part begins within a cluster");
    push(&mut layout, "another", &runs);
    assert!(!layout.paths.is_hilbert_ordered());
}
