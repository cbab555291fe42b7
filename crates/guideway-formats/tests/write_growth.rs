//! The time of writers grows with the size of the layout, not with its square.

use std::time::{Duration, Instant};

use guideway_formats::{ReadOptions, Target, read_bytes};
use guideway_layout::Layout;

/// LIF 1.0 with one edge for many vehicle types.
fn types(count: usize) -> String {
    let types = (0..count).map(|i| format!(r#"{{"vehicleTypeId":"t{i}","maxSpeed":{i}}}"#));
    let types: Vec<String> = types.collect();
    format!(
        r#"{{"metaInformation":{{"projectIdentification":"p","creator":"c",
        "exportTimestamp":"2024-01-01T00:00:00Z","lifVersion":"1.0.0"}},
        "layouts":[{{"layoutId":"L","layoutVersion":"1","nodes":[
        {{"nodeId":"A","nodePosition":{{"x":0,"y":0}},"vehicleTypeNodeProperties":[]}},
        {{"nodeId":"B","nodePosition":{{"x":5,"y":0}},"vehicleTypeNodeProperties":[]}}],
        "edges":[{{"edgeId":"E","startNodeId":"A","endNodeId":"B",
        "vehicleTypeEdgeProperties":[{}]}}],"stations":[]}}]}}"#,
        types.join(",")
    )
}

fn layout(count: usize) -> Layout {
    let text = types(count);
    let read = read_bytes("types.lif.json", text.as_bytes(), &ReadOptions::default());
    read.expect("a layout")
}

/// The shortest of some runs: others share the machine.
fn time_to_write(layout: &Layout, target: Target) -> Duration {
    let run = || {
        let since = Instant::now();
        target.write(layout, &mut std::io::sink()).expect("written");
        since.elapsed()
    };
    (0..3).map(|_| run()).min().expect("some runs")
}

/// The exponent with which time grows between two sizes.
fn exponent(sizes: [usize; 2], times: [Duration; 2]) -> f64 {
    let ratio = times[1].as_secs_f64() / times[0].as_secs_f64();
    ratio.ln() / (sizes[1] as f64 / sizes[0] as f64).ln()
}

#[test]
fn writers_are_not_quadratic_in_vehicle_types() {
    for target in [
        Target::Lif1,
        Target::Lif2,
        Target::GeoJson,
        Target::OpenTcs7,
    ] {
        let sizes = [500, 2000, 8000];
        let mut all = sizes.map(layout);
        // The second edit moves a node: the save then changes every entry of its edge.
        for is_edited in [false, true] {
            if is_edited {
                for layout in &mut all {
                    let moved = layout.nodes.position_m(1) * 2.0;
                    layout.nodes.set_position_m(1, moved);
                    let other: Vec<String> = layout.paths.vehicle_types().names().to_vec();
                    let other: Vec<&str> = other.iter().skip(1).map(String::as_str).collect();
                    layout.paths.vehicle_types_mut().set(0, &other);
                }
            }
            let times = all.each_ref().map(|layout| time_to_write(layout, target));
            let first = exponent([sizes[0], sizes[1]], [times[0], times[1]]);
            let last = exponent([sizes[1], sizes[2]], [times[1], times[2]]);
            assert!(
                first < 1.6 || last < 1.6,
                "{target:?}: {first:.2}, {last:.2}, {times:?}"
            );
        }
    }
}

#[test]
fn exponents_tell_linear_from_quadratic() {
    let times = |power: i32| [1.0_f64, 4.0].map(|n| Duration::from_secs_f64(n.powi(power)));
    assert!((exponent([1000, 4000], times(1)) - 1.0).abs() < 1e-9);
    assert!((exponent([1000, 4000], times(2)) - 2.0).abs() < 1e-9);
}
