//! Compares layouts as text, one line per element.

use guideway_layout::{Layout, Level, PathRef, VehicleType};

/// Everything that a file holds of paths, nodes, stations, levels and vehicle types, one line each.
pub(super) fn content(layout: &Layout) -> Vec<String> {
    let paths = &layout.paths;
    let path = |path: PathRef<'_>| {
        let row = path.row();
        let runs: Vec<Vec<_>> = path.runs().map(|run| run.iter().collect()).collect();
        let types: Vec<&str> = paths.vehicle_types().of(row).collect();
        let columns = paths.attributes.iter();
        let values = columns.map(|c| (&c.name, c.values.get(row)));
        format!(
            "path {} {runs:?} {:?} {:?} {:?} {:?} {types:?} {:?} {:?}",
            path.id(),
            path.start_node(),
            path.end_node(),
            path.direction(),
            path.level(),
            paths.own_style(row),
            values.collect::<Vec<_>>(),
        )
    };
    let nodes = &layout.nodes;
    let node = |row: u32| {
        let types: Vec<&str> = nodes.vehicle_types().of(row as usize).collect();
        format!(
            "node {} {:?} {:?} {types:?}",
            nodes.id(row),
            nodes.position_m(row),
            nodes.level(row)
        )
    };
    let stations = &layout.stations;
    let station = |row: u32| {
        format!(
            "station {} {:?} {:?} {:?}",
            stations.id(row),
            stations.position_m(row),
            stations.nodes(row),
            stations.level(row)
        )
    };
    let level = |level: &Level| format!("level {} {:?}", level.id, level.name);
    let vehicle_type = |of: &VehicleType| format!("vehicle type {}", of.id);
    (paths.iter().map(path))
        .chain((0..nodes.len() as u32).map(node))
        .chain((0..stations.len() as u32).map(station))
        .chain(layout.levels.iter().map(level))
        .chain(layout.vehicle_types.iter().map(vehicle_type))
        .collect()
}

/// The first line that differs between two layouts.
pub(super) fn difference(a: &Layout, b: &Layout) -> Option<String> {
    let (a, b) = (content(a), content(b));
    let lines = a.iter().zip(&b).find(|(a, b)| a != b);
    let line = lines.map(|(a, b)| format!("{a}\nis not\n{b}"));
    line.or_else(|| (a.len() != b.len()).then(|| format!("{} lines and {}", a.len(), b.len())))
}

#[test]
fn detects_any_difference() {
    use guideway_layout::Value;
    use guideway_spline::{Affine, Point};

    let site = super::services::lanes(4);
    assert_eq!(difference(&site, &site.clone()), None);
    assert!(difference(&site, &super::services::lanes(3)).is_some());
    let changes: [fn(&mut Layout); 3] = [
        |site| {
            let by = Affine::translation(Point::new(1e-12, 0.0));
            site.paths.transform([2], by);
        },
        |site| site.paths.attributes.set(1, "speed", Value::Float(0.75)),
        |site| site.paths.set_own_style(3, Default::default()),
    ];
    for (change, is_one) in changes.into_iter().zip([true, true, false]) {
        let mut other = site.clone();
        change(&mut other);
        assert_eq!(difference(&site, &other).is_some(), is_one);
    }
}
