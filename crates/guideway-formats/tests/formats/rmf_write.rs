//! Open-RMF writer: the fleet adapter loads each navigation graph, and only listed losses differ.

use std::collections::HashSet;

use crate::common::{assert_losses_are_differences, read, read_real, shared};
use guideway_formats::rmf::write_navigation_graph;
use guideway_formats::{Losses, Target};
use guideway_layout::{
    Block, CompareOptions, Direction, Layout, Level, Member, NewPath, Quantity, Value, differences,
};
use guideway_spline::{Point, Runs, arc_to_runs};

fn write(layout: &Layout) -> (String, Losses) {
    let mut bytes = Vec::new();
    let losses = write_navigation_graph(layout, &mut bytes).unwrap();
    (String::from_utf8(bytes).unwrap(), losses)
}

fn whats(losses: &Losses) -> HashSet<&str> {
    losses.iter().map(|loss| loss.what.as_str()).collect()
}

const OF_BUILDINGS: &[&str] = &[
    "paths",
    "directions",
    "ends",
    "nodes",
    "layout properties",
    "column drawing",
];

/// Files, and the losses beside those of all buildings.
const FILES: &[(&str, &[&str])] = &[
    (
        "layouts/rmf_building/airport_terminal.building.yaml",
        &["column flattened_x_offset", "column flattened_y_offset"],
    ),
    (
        "layouts/rmf_building/hotel.building.yaml",
        &["column flattened_x_offset", "column flattened_y_offset"],
    ),
    (
        "layouts/rmf_building/office.building.yaml",
        &["column layers"],
    ),
    (
        "conformance/real/eiu_tb3_world.building.yaml",
        &["column layers"],
    ),
    ("conformance/real/lil_far.building.yaml", &[]),
];

#[test]
fn buildings_become_navigation_graphs() {
    let Some(folder) = shared("") else {
        return;
    };
    for (file, more) in FILES {
        let layout = read_real(&folder.join(file));
        let (text, losses) = write(&layout);
        let again = read(&text);
        assert_losses_are_differences(&layout, &again, &losses, file);
        let expected = OF_BUILDINGS.iter().chain(*more).copied().collect();
        assert_eq!(whats(&losses), expected, "{file}");
        assert_eq!(Target::of_source(&again), Some(Target::Rmf), "{file}");
        // A graph keeps all its parts.
        let (text, losses) = write(&again);
        assert!(losses.is_empty(), "{file}: {losses:?}");
        let third = read(&text);
        let found = differences(&again, &third, &CompareOptions::default());
        assert!(found.is_empty(), "{file}: {found:?}");
    }
}

#[test]
fn a_real_navigation_graph_comes_back_unchanged() {
    let Some(folder) = shared("") else {
        return;
    };
    for file in [
        "conformance/real/eiu_nav_graph.yaml",
        "cases/rmf/r08_nav_dupdock.yaml",
    ] {
        let layout = read_real(&folder.join(file));
        let (text, losses) = write(&layout);
        assert!(losses.is_empty(), "{file}: {losses:?}");
        assert_losses_are_differences(&layout, &read(&text), &losses, file);
    }
}

#[test]
fn a_graph_has_the_structure_of_generated_ones() {
    let Some(folder) = shared("conformance/real") else {
        return;
    };
    let layout = read_real(&folder.join("eiu_nav_graph.yaml"));
    let (text, _) = write(&layout);
    let expected = concat!(
        "building_name: \"tb3_world\"\n",
        "doors:\n",
        "  \"null\":\n",
        "    endpoints: [[29.398886, -13.010072], [31.729081, -14.097469]]\n",
        "    map: \"tb3_world\"\n",
        "levels:\n",
        "  tb3_world:\n",
        "    vertices:\n",
        "    - [30.422184, -14.782218, {name: \"wp3\"}]\n",
    );
    assert!(text.starts_with(expected), "{text}");
    for line in [
        "    - [12.868272, -14.782218, {name: \"wp2_parking\", is_parking_spot: true}]\n",
        "    lanes:\n    - [0, 1, {}]\n    - [1, 0, {}]\n",
        "lifts: {}\n",
    ] {
        assert!(text.contains(line), "{line}\n{text}");
    }
}

fn line(layout: &mut Layout, id: &str, [start, end]: [u32; 2], direction: Direction) -> usize {
    let mut runs = Runs::default();
    let ends = [start, end].map(|node| layout.nodes.position_m(node));
    runs.push_line(ends[0], ends[1]);
    layout.paths.push(&NewPath {
        id,
        runs: &runs,
        start_node: Some(start),
        end_node: Some(end),
        direction,
        level: Some(0),
        vehicle_types: &["graph 2"],
    })
}

fn site() -> Layout {
    let mut layout = Layout::default();
    layout.levels.push(Level {
        id: "yes".into(),
        name: Some("Ground: 1".into()),
        elevation_m: Some(2.0),
        ..Level::default()
    });
    for (id, x) in [("a", 0.0), ("yes.vertices[1]", 5.0), ("c \"d\"\t", 9.0)] {
        layout.nodes.push(id, Point::new(x, 1.0), Some(0));
    }
    let path = line(&mut layout, "lane 7", [0, 1], Direction::Forward);
    line(&mut layout, "yes.lanes[1]", [1, 2], Direction::Forward);
    let attributes = &mut layout.paths.attributes;
    attributes.set_quantity(path, "maxSpeed", 0.5, Quantity::Speed);
    attributes.set(path, "orientation_constraint", Value::Text("forward"));
    attributes.set(path, "dock_name", Value::Text("007"));
    attributes.set(path, "list", Value::Json("[1,{\"a\":null}]"));
    layout
        .nodes
        .attributes
        .set(1, "is_charger", Value::Bool(true));
    let lift = layout
        .stations
        .push("lift", Some(Point::new(9.0, 1.0)), vec![2], None) as usize;
    let attributes = &mut layout.stations.attributes;
    attributes.set(lift, "kind", Value::Text("lift"));
    attributes.set_quantity(lift, "theta", 1.5, Quantity::Angle);
    attributes.set_quantity(lift, "width", 2.0, Quantity::Length);
    attributes.set_quantity(lift, "depth", 3.0, Quantity::Length);
    layout.blocks.push(Block {
        id: "m".into(),
        members: vec![Member::Node(0), Member::Path(1)],
        ..Block::default()
    });
    layout.attributes.set(0, "name", Value::Text("Hall 2"));
    layout
}

#[test]
fn what_a_graph_holds_comes_back() {
    let layout = site();
    let (text, losses) = write(&layout);
    assert!(losses.is_empty(), "{losses:?}");
    assert_losses_are_differences(&layout, &read(&text), &losses, &text);
    let speed = read(&text);
    let speed = speed.paths.attributes.get("maxSpeed").unwrap();
    assert_eq!(speed.quantity, Some(Quantity::Speed));
}

#[test]
fn a_two_way_path_is_two_lanes() {
    let mut layout = site();
    layout.paths.set_direction(0, Direction::Both);
    let (text, losses) = write(&layout);
    assert_eq!(whats(&losses), ["directions"].into());
    let again = read(&text);
    assert_losses_are_differences(&layout, &again, &losses, &text);
    let reverse = again.paths.get(1);
    assert_eq!(reverse.id(), "lane 7~2");
    assert_eq!(
        (reverse.start_node(), reverse.end_node()),
        (Some(1), Some(0))
    );
    let constraint = again.paths.attributes.value(1, "orientation_constraint");
    assert_eq!(constraint, Some(Value::Text("backward")));
}

#[test]
fn lists_what_does_not_come_back() {
    let mut layout = site();
    let mut runs = Runs::default();
    arc_to_runs(Point::new(0.0, 1.0), 5.0, 0.0, 1.0, 1e-4, &mut runs);
    let mut geometry = guideway_layout::Geometry::default();
    geometry.push(&runs);
    let written = guideway_layout::WrittenCurves::default();
    layout.paths.replace_curves(&[0], &geometry, &written);
    layout.paths.push(&NewPath {
        id: "without nodes",
        runs: &runs,
        ..NewPath::default()
    });
    layout.nodes.push("a", Point::new(7.0, 7.0), Some(0));
    layout.nodes.push("far", Point::new(8.0, 8.0), None);
    layout.nodes.attributes.set(0, "name", Value::Text("A"));
    let attributes = &mut layout.paths.attributes;
    attributes.set(1, "orientation_constraint", Value::Text("sideways"));
    attributes.set_quantity(1, "maxSpeed", 0.0, Quantity::Speed);
    attributes.set(1, "id", Value::Int(3));
    layout.stations.push("rack", None, Vec::new(), None);
    layout.blocks[0].members.push(Member::Station(1));
    let (text, losses) = write(&layout);
    let expected = [
        "paths",
        "curves",
        "nodes",
        "levels",
        "column maxSpeed",
        "column orientation_constraint",
        "column id",
        "column name",
        "stations",
        "blocks",
    ];
    assert_eq!(whats(&losses), expected.into());
    let again = read(&text);
    assert_losses_are_differences(&layout, &again, &losses, &text);
    // The fleet adapter refuses a repeated name.
    assert_eq!(again.nodes.id(3), "a~2");
}
