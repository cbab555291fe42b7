//! Tests of the readers of Open-RMF site files (`*.site.json`), and of merge keys in building
//! files.

use guideway_layout::{Code, Direction, Layout, Value};

use crate::common::{codes, ends, read};
use guideway_spline::Point;

const SITE: &str = r#"{
  "format_version": "0.1",
  "properties": {"name": "hall"},
  "anchors": {"48": {"Translate2D": [0, 10]}, "49": {"Translate2D": [2, 10]}},
  "levels": {
    "1": {
      "properties": {"name": "L1", "elevation": 0.5},
      "anchors": {
        "4": {"Translate2D": [0.0, 0.0]},
        "5": {"Translate2D": [5.0, 0.0]},
        "6": {"CategorizedTranslate2D": {"General": [5.0, 3.0], "Floor": [5, 4]}}
      },
      "walls": {"3": {"anchors": [4, 48], "texture": 20}},
      "doors": {"10": {"anchors": [5, 6], "name": "main_door", "kind": {}}},
      "floors": {"17": {"anchors": [4, 5, 6]}}
    },
    "22": {
      "properties": {"name": "L2", "elevation": 8.0},
      "anchors": {"24": {"Translate2D": [1, 1]}}
    }
  },
  "lifts": {"46": {
    "properties": {"name": "Main Lift", "reference_anchors": [48, 49]},
    "cabin_anchors": {"44": {"Translate2D": [1, 0.5]}}
  }},
  "navigation": {"guided": {
    "graphs": {"71": {"name": "tugs"}, "72": {"name": "carts"}},
    "lanes": {
      "70": {"anchors": [4, 5], "graphs": "All"},
      "73": {"anchors": [5, 6], "graphs": {"Only": [71]}, "reverse": "Disable",
             "forward": {"speed_limit": 1.5, "dock": {"name": "d"}}},
      "74": {"anchors": [6, 4], "graphs": {"AllExcept": [71]}},
      "75": {"anchors": [6, 44], "graphs": "All"},
      "76": {"anchors": [6, 24], "graphs": "All"},
      "77": {"anchors": [6, 99], "graphs": "All"}
    },
    "locations": {
      "119": {"anchor": 5, "tags": ["Charger", "ParkingSpot"], "name": "B", "graphs": "All"}
    }
  }}
}"#;

fn types(layout: &Layout, id: &str) -> Vec<String> {
    let path = layout.paths.iter().find(|path| path.id() == id).unwrap();
    let names = layout.paths.vehicle_types().of(path.row());
    names.map(str::to_owned).collect()
}

#[test]
fn a_site_has_levels_nodes_lanes_and_lifts() {
    let layout = read(SITE);
    assert_eq!(layout.provenance.format_version, "site");
    let levels: Vec<_> = layout
        .levels
        .iter()
        .map(|l| (l.name.as_deref(), l.elevation_m))
        .collect();
    assert_eq!(levels, [(Some("L1"), Some(0.5)), (Some("L2"), Some(8.0))]);
    let drawn: Vec<&str> = layout.paths.iter().map(|path| path.id()).collect();
    assert_eq!(drawn, ["3", "main_door", "70", "73", "74"]);
    assert_eq!(
        ends(&layout, "73"),
        (Point::new(5.0, 0.0), Point::new(5.0, 3.0))
    );
    let direction = |id: &str| {
        layout
            .paths
            .iter()
            .find(|p| p.id() == id)
            .unwrap()
            .direction()
    };
    assert_eq!(direction("70"), Direction::Both);
    assert_eq!(direction("73"), Direction::Forward);
    let fast = layout.paths.iter().find(|p| p.id() == "73").unwrap().row();
    assert_eq!(
        layout.paths.value(fast, "maxSpeed"),
        Some(Value::Float(1.5))
    );
    assert_eq!(types(&layout, "70"), Vec::<String>::new());
    assert_eq!(types(&layout, "73"), ["tugs"]);
    assert_eq!(types(&layout, "74"), ["carts"]);
    let charger = (0..layout.nodes.len()).find(|&node| layout.nodes.id(node as u32) == "B");
    let is_charger = layout
        .nodes
        .attributes
        .value(charger.unwrap(), "is_charger");
    assert_eq!(is_charger, Some(Value::Bool(true)));
    assert_eq!(layout.stations.position_m(0), Some(Point::new(1.0, 10.0)));
    let refused: Vec<_> = layout
        .refused
        .iter()
        .map(|path| (path.id, path.code))
        .collect();
    let expected = [
        ("75", Code::CrossLevel),
        ("76", Code::CrossLevel),
        ("77", Code::UnknownNode),
    ];
    assert_eq!(refused, expected);
    assert!(codes(&layout).contains(&Code::NotDrawn), "floors");
}

#[test]
fn odd_sites_are_no_panic() {
    for text in [
        r#"{"format_version": 1}"#,
        r#"{"navigation": []}"#,
        r#"{"navigation": {"guided": {"lanes": {"1": 2, "3": {"anchors": 4}}}}}"#,
        r#"{"levels": {"1": {"anchors": {"2": {"Translate2D": [1]}}}}, "navigation": {}}"#,
    ] {
        assert_eq!(read(text).paths.len(), 0, "{text}");
    }
}

#[test]
fn merge_keys_of_building_files_are_resolved() {
    let layout = read(
        "usual: &usual\n  bidirectional: [4, true]\n  speed_limit: [3, 2.5]\n\
         base: &base\n  measurements: [[0, 1, {distance: [3, 10]}]]\n\
         levels:\n  L1:\n    <<: *base\n    \
         vertices: [[0, 0, 0, a], [100, 0, 0, b], [50, 20, 0, c]]\n    \
         lanes:\n    - [0, 1, {<<: *usual}]\n    \
         - [1, 2, {<<: *usual, bidirectional: [4, false]}]\n",
    );
    assert_eq!(ends(&layout, "L1.lanes[0]").1, Point::new(10.0, 0.0));
    let paths = &layout.paths;
    let directions = [0, 1].map(|row| paths.get(row).direction());
    assert_eq!(directions, [Direction::Both, Direction::Forward]);
    for row in 0..2 {
        assert_eq!(paths.value(row, "maxSpeed"), Some(Value::Float(2.5)));
    }
    assert!(paths.value(0, "<<").is_none());
}
