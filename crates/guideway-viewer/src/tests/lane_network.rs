//! A network for tests: lanes with nodes, stations, levels and vehicle types.

use guideway_layout::{Layout, Level, NewPath, Value};
use guideway_spline::{Point, Runs};

/// Lanes on two levels, each joined to the next one by a link, for two vehicle types, with a
/// station at every third one.
pub(crate) fn network(count: u32) -> Layout {
    let mut layout = Layout::default();
    for id in ["ground", "upper"] {
        layout.levels.push(Level {
            id: id.to_owned(),
            ..Level::default()
        });
    }
    let level = |row: u32| Some(u32::from(2 * row >= count));
    for row in 0..count {
        for x in [0.0, 10.0] {
            let at = Point::new(x, 2.0 * f64::from(row));
            layout.nodes.push(&format!("n{row} {x}"), at, level(row));
        }
        if row.is_multiple_of(3) {
            let id = format!("station {row}");
            layout.stations.push(&id, None, vec![2 * row], level(row));
        }
    }
    let lanes = (0..count).map(|row| (format!("lane {row}"), [2 * row, 2 * row + 1], row));
    let links = (1..count).filter(|&row| level(row) == level(row - 1));
    let links = links.map(|row| (format!("link {row}"), [2 * row - 1, 2 * row + 1], row));
    for (id, [start, end], row) in lanes.chain(links) {
        let mut runs = Runs::default();
        let [from, to] = [start, end].map(|node| layout.nodes.position_m(node));
        runs.push_line(from, to);
        let path = layout.paths.push(&NewPath {
            id: &id,
            runs: &runs,
            start_node: Some(start),
            end_node: Some(end),
            level: level(row),
            vehicle_types: &["fork", "tug"],
            ..NewPath::default()
        });
        let speed = Value::Float(f64::from(row) / 2.0);
        layout.paths.attributes.set(path, "speed", speed);
    }
    layout
}
