//! Units that cannot be right are reported first and once; tolerances follow the size of a layout.

use guideway_layout::{
    CheckOptions, Code, Diagnostics, GeoOrigin, NewPath, Place, Quantity, Severity, Value, check,
};

use crate::findings::{codes, found, only};
use crate::sketch::{Sketch, line_runs, p};

/// A network of a row of nodes this far apart.
fn row(count: usize, distance_m: f64) -> Sketch {
    let mut sketch = Sketch::default();
    for i in 0..count {
        let at = p(i as f64 * distance_m, 0.0);
        let node = sketch.layout.nodes.push(&format!("n{i}"), at, None);
        if i > 0 {
            sketch.layout.paths.push(&NewPath {
                id: &format!("e{i}"),
                runs: &line_runs(p(at.x - distance_m, 0.0), at),
                start_node: Some(node - 1),
                end_node: Some(node),
                ..NewPath::default()
            });
        }
    }
    sketch
}

fn with_speed(mut sketch: Sketch, speed_m_per_s: f64) -> Sketch {
    for row in 0..sketch.layout.paths.len() {
        let attributes = &mut sketch.layout.paths.attributes;
        attributes.set_quantity(row, "maxSpeed", speed_m_per_s, Quantity::Speed);
    }
    sketch
}

#[test]
fn nodes_kilometers_apart_suggest_millimeters() {
    let (place, message) = only(&found(&row(5, 1_500.0)), Code::Implausible);
    assert_eq!(place, "layout");
    let expected = "the layout is 6 km wide, from path \"e1\" to path \"e4\"; half of its paths \
                    are larger than 1.5 km";
    assert_eq!(message, expected);
    // A large site with ordinary distances.
    assert!(found(&row(50, 200.0)).is_empty());
    // A test track.
    assert!(found(&row(3, 1_400.0)).is_empty());
}

#[test]
fn drives_of_many_minutes_suggest_another_unit() {
    let centimeters = || row(30, 200.0);
    assert!(found(&centimeters()).is_empty());
    let (_, message) = only(&found(&with_speed(centimeters(), 1.5)), Code::Implausible);
    assert!(
        message.ends_with("half of its paths take more than 2 minutes at 1.5 m/s"),
        "{message}"
    );
    // A road.
    assert!(found(&with_speed(centimeters(), 14.0)).is_empty());
}

#[test]
fn nodes_hundreds_of_meters_apart_suggest_centimeters() {
    let doubts = |sketch: &Sketch| found(sketch).count(Code::Implausible);
    assert_eq!(doubts(&row(9, 450.0)), 1);
    assert_eq!(doubts(&with_speed(row(9, 450.0), 1.0)), 1);
    // A road, and speeds in centimeters per second, of which the speeds are the second finding.
    assert_eq!(doubts(&with_speed(row(9, 450.0), 14.0)), 0);
    assert_eq!(doubts(&with_speed(row(9, 450.0), 150.0)), 2);
    let assumed = |mut sketch: Sketch| {
        let diagnostics = &mut sketch.layout.diagnostics;
        let message = || "the file does not state its unit".to_owned();
        diagnostics.push(Code::AssumedUnit, Place::default, message, "State it");
        doubts(&sketch)
    };
    assert_eq!(assumed(row(36, 99.0)), 0);
    assert_eq!(assumed(row(36, 101.0)), 1);
    let lines = |length_m: f64| {
        let mut sketch = Sketch::default();
        for i in 0..18 {
            let y = 200.0 * f64::from(i);
            sketch.free_path("", &line_runs(p(0.0, y), p(length_m, y)));
        }
        sketch
    };
    assert_eq!(doubts(&lines(220.0)), 0);
    assert_eq!(
        [190.0, 220.0].map(|length_m| assumed(lines(length_m))),
        [0, 1]
    );
}

#[test]
fn stated_lengths_are_compared_with_the_curves() {
    let stated = |lengths_m: &[f64]| {
        let mut sketch = row(1 + lengths_m.len(), 4.0);
        for (row, length_m) in lengths_m.iter().enumerate() {
            let attributes = &mut sketch.layout.paths.attributes;
            attributes.set_quantity(row, "length", *length_m, Quantity::Length);
        }
        let found = found(&sketch);
        assert!(found.iter().all(|d| d.code == Code::Implausible));
        let mut found = found.iter().map(|d| (d.severity, d.message.clone()));
        let first = found.next();
        assert!(found.next().is_none());
        first
    };
    assert_eq!(stated(&[4.0, 2.5, 6.5]), None);
    let (severity, message) = stated(&[4.0, 4000.0, 0.0]).unwrap();
    assert_eq!(severity, Severity::Warning);
    let expected =
        "path \"e2\" states 4000 m; its curve is 4.000 m long, and another length differs";
    assert_eq!(message, expected);
    assert_eq!(stated(&[0.004]).unwrap().0, Severity::Warning);
    // Not to scale, or not known.
    assert_eq!(stated(&[4.0, 12.0]).unwrap().0, Severity::Info);
    assert_eq!(stated(&[0.0]).unwrap().0, Severity::Info);
}

#[test]
fn positions_in_degrees_have_no_other_unit() {
    let mut sketch = row(5, 1_500.0);
    sketch.layout.geo_origin = Some(GeoOrigin {
        longitude_deg: 11.0,
        latitude_deg: 50.0,
    });
    assert!(found(&sketch).is_empty());
}

#[test]
fn motorways_without_nodes_are_plausible() {
    let mut sketch = Sketch::default();
    for y in [0.0, 4.0, 8.0] {
        sketch.free_path("", &line_runs(p(0.0, y), p(6_000.0, y)));
    }
    assert!(found(&sketch).is_empty());
    sketch.free_path("far", &line_runs(p(0.0, 0.0), p(60_000.0, 9.0)));
    sketch.free_path("far", &line_runs(p(0.0, 2.0), p(60_000.0, 9.0)));
    sketch.free_path("far", &line_runs(p(0.0, 3.0), p(60_000.0, 9.0)));
    assert_eq!(found(&sketch).count(Code::Implausible), 1);
}

#[test]
fn wrong_unit_is_the_first_finding_and_the_only_one_of_its_kind() {
    // A million times too small: without tolerances by size, all paths would be duplicates.
    let mut sketch = Sketch::default();
    let assumed = || "the file does not state its unit".to_owned();
    let diagnostics = &mut sketch.layout.diagnostics;
    diagnostics.push(Code::AssumedUnit, Place::default, assumed, "State it");
    for i in 0..20 {
        let x = 1e-3 * f64::from(i);
        sketch.free_path("same id", &line_runs(p(x, 0.0), p(x + 1e-4, 0.0)));
        sketch.free_path("", &line_runs(p(x, 1e-4), p(x + 1e-4, 2e-4)));
    }
    let found = found(&sketch);
    assert_eq!(
        codes(&found),
        [(Code::DuplicateId, 1), (Code::Implausible, 1)]
    );
    let first = found.iter().next().unwrap();
    assert_eq!(first.code, Code::Implausible);
    let expected = "the layout is only 1.91e-2 m in size, and half of its paths are smaller than \
                    1.41e-4 m";
    assert_eq!(first.message, expected);
    // A drawing that states its unit may be small.
    sketch.layout.diagnostics = Diagnostics::default();
    assert_eq!(codes(&self::found(&sketch)), [(Code::DuplicateId, 1)]);
}

#[test]
fn small_drawings_of_ordinary_lines_are_plausible() {
    let mut sketch = Sketch::default();
    sketch.free_path("", &line_runs(p(0.0, 0.0), p(0.05, 0.0)));
    sketch.free_path("", &line_runs(p(0.0, 0.02), p(0.03, 0.03)));
    assert!(found(&sketch).is_empty());
}

#[test]
fn gaps_and_duplicates_are_relative_to_short_paths() {
    let offset = |scale: f64| {
        let mut sketch = Sketch::default();
        for i in 0..9 {
            let y = f64::from(i);
            let line = line_runs(p(0.0, y * scale), p(10.0 * scale, y * scale));
            sketch.free_path("", &line);
        }
        let end = scale * 10.0 + 4e-4;
        sketch.free_path("", &line_runs(p(0.0, 0.0), p(end, 0.0)));
        codes(&found(&sketch))
    };
    assert_eq!(offset(1.0), [(Code::DuplicatePath, 1)]);
    assert_eq!(offset(0.01), []);
}

#[test]
fn tolerances_of_millimeters_read_as_meters_are_millimeters() {
    let mut sketch = row(5, 4_000.0);
    sketch.path("off", &line_runs(p(0.0, 9.0), p(4_000.0, 0.0)), "n0", "n1");
    let codes_found = codes(&found(&sketch));
    assert_eq!(codes_found, [(Code::Implausible, 1)]);
    let strict = CheckOptions {
        gap_tolerance_m: Some(0.01),
        ..CheckOptions::default()
    };
    assert_eq!(check(&sketch.layout, &strict).count(Code::NodeGap), 1);
}

#[test]
fn impossible_speeds_and_angles_are_reported_once_per_column() {
    let mut sketch = with_speed(row(5, 10.0), 1.0);
    let paths = &mut sketch.layout.paths;
    for row in [1, 3] {
        paths
            .attributes
            .set_quantity(row, "maxSpeed", 1_500.0, Quantity::Speed);
    }
    for row in 0..4 {
        paths
            .attributes
            .set_quantity(row, "length", 10.0, Quantity::Length);
        let angle = 6.25;
        paths
            .attributes
            .set_quantity(row, "vehicleOrientation", angle, Quantity::Angle);
    }
    paths.vehicle_types_mut().set(2, &["tug", "fork"]);
    let entries = &mut paths.vehicle_types_mut().attributes;
    entries.set_quantity(1, "turn", -90.0, Quantity::Angle);
    let found = found(&sketch);
    assert_eq!(codes(&found), [(Code::Implausible, 2)]);
    let texts: Vec<_> = found
        .iter()
        .map(|d| format!("{}: {}", d.place, d.message))
        .collect();
    let speed = "column maxSpeed (m/s) of paths: path \"e2\" has 1500, more than 100, and another \
                 value is wrong";
    let turn = "column turn (rad) of paths: path \"e3\" has -90, more than 6.2832";
    assert_eq!(texts, [speed, turn]);
    let (place, message) = only(
        &self::found(&with_speed(row(3, 5.0), -1.0)),
        Code::Implausible,
    );
    assert!(place.contains("maxSpeed"), "{place}");
    let expected = "path \"e1\" has -1, less than 0, and another value is wrong";
    assert_eq!(message, expected);
}

#[test]
fn orientations_beyond_half_a_turn_are_degrees_in_lif_and_vda_5050() {
    let doubts = |format: &str, angle: f64, list: Option<&str>| {
        let mut sketch = row(3, 10.0);
        sketch.layout.provenance.format = format.to_owned();
        let attributes = &mut sketch.layout.paths.attributes;
        match list {
            Some(list) => attributes.set(0, "vehicleOrientations", Value::Json(list)),
            None => attributes.set_quantity(0, "vehicleOrientation", angle, Quantity::Angle),
        }
        found(&sketch).count(Code::Implausible)
    };
    for (format, angle, expected) in [
        ("LIF", std::f64::consts::PI + 7e-6, 0),
        ("LIF", -std::f64::consts::PI, 0),
        ("LIF", 4.0, 1),
        ("VDA 5050", -90.0, 1),
        ("LIF + VDA 5050", 4.0, 1),
        // Degrees from 0 to 360 in the file.
        ("openTCS", 4.71, 0),
        ("LIF + openTCS", 4.71, 0),
        ("openTCS", 90.0, 1),
    ] {
        assert_eq!(doubts(format, angle, None), expected, "{format} {angle}");
    }
    assert_eq!(doubts("LIF", 0.0, Some("[0.0, 90, -1.5]")), 1);
    assert_eq!(doubts("LIF", 0.0, Some("[0.0, 3.14, -1.5]")), 0);
}
