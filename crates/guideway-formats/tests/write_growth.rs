//! The time of writers grows with the size of the layout, not with its square.

use guideway_formats::{ReadOptions, Target, read_bytes};
use guideway_growth::exponent_of_time;
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

/// The same, after a node was moved and all vehicle types but one were left.
fn edited(count: usize) -> Layout {
    let mut layout = layout(count);
    let moved = layout.nodes.position_m(1) * 2.0;
    layout.nodes.set_position_m(1, moved);
    let other: Vec<String> = layout.paths.vehicle_types().names().to_vec();
    let other: Vec<&str> = other.iter().skip(1).map(String::as_str).collect();
    layout.paths.vehicle_types_mut().set(0, &other);
    layout
}

#[test]
fn writers_are_not_quadratic_in_vehicle_types() {
    for target in [
        Target::Lif1,
        Target::Lif2,
        Target::GeoJson,
        Target::OpenTcs7,
    ] {
        // The second edit moves a node: the save then changes every entry of its edge.
        for is_edited in [false, true] {
            let made = |count| {
                if is_edited {
                    edited(count)
                } else {
                    layout(count)
                }
            };
            let found = exponent_of_time([500, 2000, 8000], made, |layout| {
                target.write(layout, &mut std::io::sink()).expect("written");
            });
            assert!(found < 1.5, "{target:?}, edited: {is_edited}: {found:.2}");
        }
    }
}
