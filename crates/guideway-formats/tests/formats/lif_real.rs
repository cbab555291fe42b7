//! Real LIF files: counts, trajectories and levels as other programs find them.

use guideway_layout::{CheckOptions, Code, Severity, check};
use guideway_spline::Point;

use crate::common::{assert_counts, codes, ends, real, real_layouts};

/// Reference counts of another program, from the list of sources of the real layouts.
const REAL: &[(&str, &str)] = &[
    (
        "continua_example.lif.json",
        "layouts 2, nodes 3, edges 2, stations 2, trajectories 1, vehicleTypes 2",
    ),
    (
        "lif100_example01_forward_edge.json",
        "layouts 1, nodes 2, edges 1, vehicleTypes 1",
    ),
    (
        "lif100_example02_bidirectional_edge.json",
        "layouts 1, nodes 2, edges 2, vehicleTypes 1",
    ),
    (
        "lif100_example04_omnidirectional_edge.json",
        "layouts 1, nodes 2, edges 2, vehicleTypes 1",
    ),
    (
        "lif100_example05_multiple_layouts_in_one_lif.json",
        "layouts 2, nodes 4, edges 2, vehicleTypes 1",
    ),
    (
        "lif100_example06_station_with_one_node.json",
        "layouts 1, nodes 2, edges 2, stations 1, vehicleTypes 1",
    ),
    (
        "lif100_example07_station_with_two_nodes.json",
        "layouts 1, nodes 5, edges 6, stations 1, vehicleTypes 1",
    ),
    (
        "lif100_example10_station_with_three_nodes_restricted_to_different.json",
        "layouts 1, nodes 6, edges 6, stations 1, vehicleTypes 3",
    ),
    (
        "lif100_example11_multiple_edges_with_load_restrictions.json",
        "layouts 1, nodes 5, edges 8, vehicleTypes 1",
    ),
    (
        "lif100_example13_battery_charging_station.json",
        "layouts 1, nodes 2, edges 2, stations 1, vehicleTypes 1",
    ),
    (
        "lif100_example14_two_levels_of_a_facility_in_one_lif_file.json",
        "layouts 2, nodes 4, edges 5, vehicleTypes 1",
    ),
    (
        "lif100_example16_rack_station_modelled_by_three_nodes.json",
        "layouts 1, nodes 4, edges 6, stations 3, vehicleTypes 1",
    ),
    (
        "lif100_example17_edge_with_trajectory_definition.json",
        "layouts 1, nodes 2, edges 2, trajectories 2, vehicleTypes 1",
    ),
    (
        "lif100_example19_forward_edge_with_two_vehicle_types_with_differi.json",
        "layouts 1, nodes 2, edges 1, vehicleTypes 2",
    ),
    (
        "lif200_example14_two_levels_of_a_facility_in_one_lif_file.json",
        "layouts 2, nodes 4, edges 5, vehicleTypes 1",
    ),
    (
        "lif200_example17_edge_with_trajectory_definition.json",
        "layouts 1, nodes 2, edges 2, trajectories 2, vehicleTypes 1",
    ),
];

const COUNTED: &[&str] = &[
    "layouts",
    "nodes",
    "edges",
    "stations",
    "trajectories",
    "vehicleTypes",
];

#[test]
fn real_files_have_the_reference_counts() {
    let Some(folder) = real_layouts("lif") else {
        return;
    };
    assert_eq!(folder.read_dir().unwrap().count(), REAL.len());
    for (file, expected) in REAL {
        let layout = real("lif", file).unwrap();
        assert_counts(&layout, COUNTED, expected, file);
        let stated = if file.starts_with("lif200") {
            "2.0"
        } else {
            "1.0"
        };
        assert_eq!(layout.provenance.format_version, stated, "{file}");
        assert_eq!(layout.provenance.format, "LIF");
        let errors = layout.diagnostics.count_at_least(Severity::Error);
        let broken = u64::from(*file == "continua_example.lif.json");
        assert_eq!(errors > 0, broken > 0, "{file}: {:?}", codes(&layout));
    }
}

#[test]
fn official_examples_of_1_0_state_version_0_11() {
    if let Some(layout) = real("lif", REAL[1].0) {
        assert_eq!(codes(&layout), [Code::Version]);
    }
}

#[test]
fn draws_trajectories_at_their_stated_positions() {
    if let Some(layout) = real(
        "lif",
        "lif100_example17_edge_with_trajectory_definition.json",
    ) {
        // The curves of this example begin 5.00 m and 11.40 m from their nodes.
        let checked = check(&layout, &CheckOptions::default());
        let gaps: Vec<&str> = checked
            .iter()
            .filter(|d| d.code == Code::NodeGap)
            .map(|d| d.message.as_str())
            .collect();
        for (verb, gap) in [("begins", " 5.000 m from"), ("begins", " 11.400 m from")] {
            let found = gaps.iter().any(|g| g.starts_with(verb) && g.contains(gap));
            assert!(found, "{gaps:?}");
        }
    }
    if let Some(layout) = real(
        "lif",
        "lif200_example17_edge_with_trajectory_definition.json",
    ) {
        let checked = check(&layout, &CheckOptions::default());
        assert_eq!(checked.count(Code::NodeGap), 0);
        let (start, end) = ends(&layout, "N1-N2");
        assert!(start.distance(Point::new(5.0, 0.0)) < 1e-12);
        assert!(end.distance(Point::new(15.0, 0.0)) < 1e-12);
        // y is up: this edge bulges above its nodes, the other way back below.
        let bounds = layout.paths.get(0).hull_bounds().unwrap();
        assert!(bounds.max.y > 3.0 && layout.paths.get(1).hull_bounds().unwrap().min.y < -3.0);
        let types: Vec<&str> = layout.paths.vehicle_types().of(0).collect();
        assert_eq!(types, ["Manufacturer_A Series_1"]);
    }
}

#[test]
fn refuses_edges_between_levels() {
    for file in [
        "lif100_example14_two_levels_of_a_facility_in_one_lif_file.json",
        "lif200_example14_two_levels_of_a_facility_in_one_lif_file.json",
    ] {
        let Some(layout) = real("lif", file) else {
            return;
        };
        assert!(!layout.refused.is_empty(), "{file}");
        assert!(layout.refused.iter().all(|r| r.code == Code::CrossLevel));
        assert_eq!(layout.path_count(), 5);
        assert_eq!(layout.levels.len(), 2);
    }
}

#[test]
fn malformed_example_draws_its_control_polygon() {
    if let Some(layout) = real("lif", "continua_example.lif.json") {
        assert!(codes(&layout).contains(&Code::TooFewPoints));
        let (start, end) = ends(&layout, "edge-001");
        assert_eq!(start, Point::new(1000.0, 1500.0));
        assert_eq!(end, Point::new(2000.0, 2500.0));
    }
}
