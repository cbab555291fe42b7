//! Tests of the openTCS reader: real files, units, the y axis and legacy positions.

use crate::common::{assert_counts, codes, ends, read, real, real_layouts};
use guideway_layout::{Code, Direction, Layout, Member, Quantity, Severity, Value};
use guideway_spline::{Point, uniform};

/// Version and element counts per file from the list of sources, made by another program. For the
/// first file, the list omits the control points, which are in a property: two per curve.
pub(crate) const REAL: &[(&str, &str, &str)] = &[
    (
        "Demo-01_openTCS4.12_v0.0.2.xml",
        "0.0.2",
        "points 55, paths 68, locations 14, vehicles 4, blocks 4, controlPoints 68, BEZIER 34, \
         DIRECT 34",
    ),
    (
        "Demo-01_openTCS6.x_envelopes.xml",
        "6.0.0",
        "points 59, paths 75, locations 16, vehicles 4, blocks 2, controlPoints 70, envelopes 4, \
         layers 1, BEZIER 35, DIRECT 40",
    ),
    (
        "Demo-01_v7.0.0.xml",
        "7.0.0",
        "points 59, paths 75, locations 16, vehicles 4, blocks 2, controlPoints 70, envelopes 4, \
         layers 1, BEZIER 35, DIRECT 40",
    ),
    (
        "PlantModelV004.sample.xml",
        "0.0.4",
        "points 15, paths 7, locations 2, vehicles 1, blocks 2, controlPoints 9, envelopes 1, \
         layers 3, DIRECT 2, ELBOW 1, SLANTED 1, POLYPATH 1, BEZIER 1, BEZIER_3 1",
    ),
    (
        "PlantModelV7.sample.xml",
        "7.0.0",
        "points 15, paths 7, locations 2, vehicles 1, blocks 2, controlPoints 9, envelopes 1, \
         layers 3, DIRECT 2, ELBOW 1, SLANTED 1, POLYPATH 1, BEZIER 1, BEZIER_3 1",
    ),
];

const COUNTED: &[&str] = &[
    "points",
    "paths",
    "locations",
    "vehicles",
    "blocks",
    "controlPoints",
    "envelopes",
    "layers",
    "DIRECT",
    "ELBOW",
    "SLANTED",
    "POLYPATH",
    "BEZIER",
    "BEZIER_3",
];

/// A model of two points, 10 m apart, and paths.
pub(crate) fn model(paths: &str) -> String {
    format!(
        r#"<model version="7.0.0"><point name="A" positionX="0" positionY="0"/>
           <point name="B" positionX="10000" positionY="0"/>{paths}
           <visualLayout name="V" scaleX="50.0" scaleY="20.0"/></model>"#
    )
}

pub(crate) fn path(layout: &str) -> Layout {
    read(&model(&format!(
        r#"<path name="P" sourcePoint="A" destinationPoint="B">{layout}</path>"#
    )))
}

#[test]
fn real_files_have_the_expected_counts() {
    let Some(folder) = real_layouts("opentcs") else {
        return;
    };
    assert_eq!(folder.read_dir().unwrap().count(), REAL.len());
    for (file, version, expected) in REAL {
        let layout = real("opentcs", file).unwrap();
        assert_counts(&layout, COUNTED, expected, file);
        assert_eq!(layout.provenance.format_version, *version);
        assert_eq!(
            layout.diagnostics.count_at_least(Severity::Warning),
            0,
            "{file}"
        );
        assert!(layout.refused.is_empty());
    }
}

#[test]
fn curves_of_real_files_end_at_their_points() {
    for (file, ..) in REAL {
        let Some(layout) = real("opentcs", file) else {
            return;
        };
        for path in layout.paths.iter() {
            let (start, end) = path.ends().unwrap();
            let node = |row: Option<u32>| layout.nodes.position_m(row.unwrap());
            assert!(
                start.distance(node(path.start_node())) < 1e-9,
                "{file} {}",
                path.id()
            );
            assert!(
                end.distance(node(path.end_node())) < 1e-9,
                "{file} {}",
                path.id()
            );
        }
    }
}

/// A mirrored or unscaled control point would be far from the line between the points.
#[test]
fn control_points_of_real_files_are_near_their_ends() {
    for (file, ..) in REAL.iter().filter(|r| r.0.starts_with("Demo")) {
        let Some(layout) = real("opentcs", file) else {
            return;
        };
        for path in layout.paths.iter() {
            let (start, end) = path.ends().unwrap();
            let middle = start.lerp(end, 0.5);
            for segment in path.runs().flat_map(|r| r.segments()) {
                for control in uniform::to_bezier(&segment) {
                    let distance_m = control.distance(middle);
                    assert!(
                        distance_m <= start.distance(end),
                        "{file} {}: {distance_m} m",
                        path.id()
                    );
                }
            }
        }
    }
}

#[test]
fn all_versions_of_the_demo_plant_have_the_same_size() {
    let (Some(old), Some(new)) = (real("opentcs", REAL[0].0), real("opentcs", REAL[2].0)) else {
        return;
    };
    let (old, new) = (
        old.paths.hull_bounds().unwrap(),
        new.paths.hull_bounds().unwrap(),
    );
    let (a, b) = (old.size(), new.size());
    assert!(
        a.x > 40.0 && a.x < 80.0 && a.y > 20.0 && a.y < 60.0,
        "{a:?}"
    );
    assert!(
        (a.x - b.x).abs() < 10.0 && (a.y - b.y).abs() < 10.0,
        "{a:?} {b:?}"
    );
}

#[test]
fn legacy_files_use_drawn_positions() {
    let Some(layout) = real("opentcs", REAL[0].0) else {
        return;
    };
    assert_eq!(codes(&layout), [Code::LegacyPosition]);
    assert_eq!(layout.diagnostics.count(Code::LegacyPosition), 1);
    let message = &layout.diagnostics.iter().next().unwrap().message;
    assert!(message.starts_with("55 of them"), "{message}");
    // Point-0001 is at (53288, -3893) in the plant and at (28000, 11000) in the drawing.
    let (start, _) = ends(&layout, "Point-0001 --- Point-0002");
    assert_eq!(start, Point::new(28.0, 11.0));
}

#[test]
fn reads_every_connection_type() {
    for file in ["PlantModelV004.sample.xml", "PlantModelV7.sample.xml"] {
        let Some(layout) = real("opentcs", file) else {
            return;
        };
        assert_eq!(codes(&layout), [Code::ApproximateShape]);
        assert_eq!(layout.diagnostics.count(Code::ApproximateShape), 2);
        let segments = |id: &str| {
            let path = layout.paths.iter().find(|p| p.id() == id).unwrap();
            path.runs().map(|r| r.segments().len()).sum::<usize>()
        };
        assert_eq!(segments("Point-0007 --- Point-0008"), 3);
        assert_eq!(segments("Point-0009 --- Point-0010"), 1);
        assert_eq!(segments("Point-0011 --- Point-0012"), 2);
        let path = layout.paths.iter().last().unwrap();
        assert_eq!(path.direction(), Direction::Both);
        let get = |name: &str| {
            let column = layout.paths.attributes.get(name);
            column.and_then(|c| c.values.get(path.row()))
        };
        let block = &layout.blocks[0];
        assert_eq!(block.id, "Block-0001");
        let members = [Member::Station(0), Member::Node(12), Member::Path(6)];
        assert_eq!(block.members, members);
        let of_block = |name: &str| block.attributes.value(0, name);
        assert_eq!(of_block("color"), Some(Value::Text("#33CC00")));
        assert_eq!(of_block("property.b-key"), Some(Value::Text("b-value")));
        assert_eq!(get("locked"), Some(Value::Bool(true)));
        assert_eq!(get("maxSpeed"), Some(Value::Float(1.5)));
        assert_eq!(get("maxReverseSpeed"), None);
        assert_eq!(get("length"), Some(Value::Float(5.0)));
        assert_eq!(get("vehicleEnvelope"), Some(Value::Json(r#"["env-key"]"#)));
        let Some(Value::Json(operations)) = get("peripheralOperations") else {
            panic!("no operations");
        };
        assert!(
            operations.contains(r#""completionRequired":true"#),
            "{operations}"
        );
        let station = |name: &str| layout.stations.attributes.value(0, name);
        assert_eq!(station("kind"), Some(Value::Text("LType-0001")));
        let operations = Value::Json(r#"[["v-operation"]]"#);
        assert_eq!(station("linkOperations"), Some(operations));
        let theta = layout.nodes.attributes.get("theta").unwrap();
        let turned = (0..15).filter_map(|row| theta.values.get(row));
        let quarter = Value::Float(std::f64::consts::FRAC_PI_2);
        assert_eq!(turned.collect::<Vec<_>>(), [quarter]);
        assert_eq!(theta.quantity, Some(Quantity::Angle));
        assert_eq!(get("property.p-key"), Some(Value::Text("p-value")));
        assert_eq!(layout.stations.nodes(0), [12]);
    }
}

#[test]
fn bezier_3_passes_through_its_middle_control_point() {
    let Some(layout) = real("opentcs", "PlantModelV7.sample.xml") else {
        return;
    };
    let mut paths = layout.paths.iter();
    let path = paths
        .find(|p| p.id() == "Point-0011 --- Point-0012")
        .unwrap();
    let first = path.runs().next().unwrap().segments().next().unwrap();
    // The third control point is (659, -140) in units of 50 mm with y down.
    assert!(uniform::end(&first).distance(Point::new(32.95, 7.0)) < 1e-9);
}

#[test]
fn control_points_are_in_layout_units_with_y_down() {
    let layout =
        path(r#"<pathLayout connectionType="BEZIER"><controlPoint x="60" y="-100"/></pathLayout>"#);
    let segment = layout
        .paths
        .get(0)
        .runs()
        .next()
        .unwrap()
        .segments()
        .next()
        .unwrap();
    let bezier = uniform::to_bezier(&segment);
    for handle in &bezier[1..3] {
        assert!(handle.distance(Point::new(3.0, 2.0)) < 1e-9, "{handle:?}");
    }
}

#[test]
fn draws_a_polyline_for_a_wrong_number_of_control_points() {
    let three = r#"<controlPoint x="1" y="1"/>"#.repeat(3);
    for (kind, points, code) in [
        ("BEZIER", three.as_str(), Code::TooFewPoints),
        ("BEZIER", "", Code::TooFewPoints),
        ("BEZIER_3", &three, Code::TooFewPoints),
        ("SPIRAL", &three, Code::UnknownValue),
    ] {
        let text = format!(r#"<pathLayout connectionType="{kind}">{points}</pathLayout>"#);
        let layout = path(&text);
        assert_eq!(codes(&layout), [code], "{kind}");
        assert_eq!(layout.paths.len(), 1);
        assert_eq!(ends(&layout, "P").1, Point::new(10.0, 0.0));
    }
}

#[test]
fn reports_unknown_points_and_accepts_loops() {
    let layout = read(&model(
        r#"<path name="P" sourcePoint="A" destinationPoint="X"/>
           <path name="P" sourcePoint="A" destinationPoint="A"/>"#,
    ));
    assert_eq!(codes(&layout), [Code::UnknownNode]);
    assert_eq!(layout.diagnostics.iter().count(), 1, "one finding per path");
    assert_eq!(layout.refused.iter().next().unwrap().id, "P");
    assert_eq!(layout.paths.len(), 1);
    let place = &layout.diagnostics.iter().next().unwrap().place;
    assert_eq!(
        (place.element.as_str(), place.line),
        ("path \"P\"", Some(2))
    );
}

#[test]
fn paths_of_hidden_layers_are_not_drawn() {
    let model = |layer: &str, group: &str| {
        let point =
            |name: &str, x: u32| format!("<point name='{name}' positionX='{x}' positionY='0'/>");
        let path = |name: &str, id: u32| {
            format!(
                "<path name='{name}' sourcePoint='A' destinationPoint='B'>\
                 <pathLayout connectionType='DIRECT' layerId='{id}'/></path>"
            )
        };
        read(&format!(
            "<model version='6.0.0' name='m'>{}{}{}{}<visualLayout name='V'>\
             <layer id='0' ordinal='0' visible='true' name='Shown' groupId='0'/>\
             <layer id='1' ordinal='1' visible='{layer}' name='Other' groupId='1'/>\
             <layerGroup id='0' name='G' visible='true'/>\
             <layerGroup id='1' name='H' visible='{group}'/></visualLayout>\
             <block name='b'><member name='other'/></block></model>",
            point("A", 0),
            point("B", 5000),
            path("shown", 0),
            path("other", 1)
        ))
    };
    let shown = model("true", "true");
    assert_eq!((shown.paths.len(), shown.refused.len()), (2, 0));
    for (layer, group) in [("false", "true"), ("true", "false")] {
        let layout = model(layer, group);
        assert_eq!(layout.paths.len(), 1);
        let refused = layout.refused.iter().next().unwrap();
        assert_eq!((refused.id, refused.code), ("other", Code::NotDrawn));
        assert_eq!(refused.detail, "its layer `Other` is hidden");
        // The block keeps the name of its member, which exists.
        assert_eq!(codes(&layout), [Code::NotDrawn]);
    }
}
