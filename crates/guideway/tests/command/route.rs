//! Tests of `route --format geojson` and of routes over pictures.

use std::fs;

use serde_json::Value;

use crate::support::{json, read_png, render, run, site, stderr, stdout};

const TYPE: [&str; 2] = ["--vehicle-type", "tugger-3000"];

/// Arguments of a route across the example site.
fn route(more: &[&str]) -> std::process::Output {
    let site = site();
    let mut args = vec!["route", site.to_str().unwrap(), "dock-1", "charger-1"];
    args.extend(TYPE);
    args.extend(more);
    run(args)
}

#[test]
fn geojson_has_a_line_per_path_with_times() {
    let report = json(&route(&["--json"]), "route");
    let output = route(&["--format", "geojson"]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let collection: Value = serde_json::from_slice(&output.stdout).unwrap();
    let features = collection["features"].as_array().unwrap();
    let rows = report["paths"].as_array().unwrap();
    assert_eq!(features.len(), rows.len());
    assert!(rows.len() > 3);
    let mut last: Option<Value> = None;
    for (feature, row) in features.iter().zip(rows) {
        assert_eq!(feature["geometry"]["type"], "LineString", "{feature:#}");
        let properties = &feature["properties"];
        for key in [
            "length_m",
            "speed_m_s",
            "turn_deg",
            "turn_s",
            "drive_s",
            "end_s",
        ] {
            let of = |value: &Value| value[key].as_f64().unwrap();
            assert!(
                (of(properties) - of(row)).abs() < 1e-9,
                "{key}: {feature:#}"
            );
        }
        assert_eq!(
            (&properties["from"], &properties["to"]),
            (&row["from"], &row["to"])
        );
        let line = feature["geometry"]["coordinates"].as_array().unwrap();
        if let Some(last) = last.replace(line.last().unwrap().clone()) {
            let close =
                |i: usize| (last[i].as_f64().unwrap() - line[0][i].as_f64().unwrap()).abs() < 0.01;
            assert!(close(0) && close(1), "{last} {}", line[0]);
        }
    }
    let both = route(&["--format", "geojson", "--json"]);
    assert_eq!(both.status.code(), Some(2));
    json(&route(&["--format", "json"]), "route");
}

#[test]
fn geojson_of_a_place_on_earth_is_in_degrees() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("a.geojson");
    let node = |id: &str, lon: f64| {
        format!(
            r#"{{"type": "Feature", "id": "{id}", "properties": {{"guideway:element": "node"}},
               "geometry": {{"type": "Point", "coordinates": [{lon}, 49.5]}}}}"#
        )
    };
    let edge = r#"{"type": "Feature", "id": "e",
        "properties": {"guideway:element": "path", "guideway:start": "a", "guideway:end": "b"},
        "geometry": {"type": "LineString", "coordinates": [[8.0, 49.5], [8.001, 49.5]]}}"#;
    let features = [node("a", 8.0), node("b", 8.001), edge.to_owned()].join(",");
    fs::write(
        &file,
        format!(
            r#"{{"type": "FeatureCollection",
                "guideway": {{"version": 1, "unit": "degree"}}, "features": [{features}]}}"#
        ),
    )
    .unwrap();
    let output = run([
        "route",
        file.to_str().unwrap(),
        "a",
        "b",
        "--format",
        "geojson",
    ]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let collection: Value = serde_json::from_slice(&output.stdout).unwrap();
    let line = &collection["features"][0]["geometry"]["coordinates"];
    assert!(
        (line[1][0].as_f64().unwrap() - 8.001).abs() < 1e-6,
        "{line}"
    );
}

#[test]
fn render_draws_the_route_over_the_paths() {
    let folder = tempfile::tempdir().unwrap();
    let [plain, marked] = ["a.png", "b.png"].map(|name| folder.path().join(name));
    let route = ["--route", "dock-1,charger-1,tugger-3000"];
    assert_eq!(render(&plain, &[]).status.code(), Some(0));
    let output = render(&marked, &[&route[..], &["--json"]].concat());
    let report = json(&output, "render");
    let paths = report["route"]["paths"].as_u64().unwrap();
    assert!(paths > 3 && report["route"]["length_m"].as_f64().unwrap() > 10.0);
    let (before, after) = (read_png(&plain).2, read_png(&marked).2);
    let pixels = before.chunks_exact(4).zip(after.chunks_exact(4));
    let changed = pixels.filter(|(a, b)| a != b).count();
    assert!(changed > 2000, "{changed}");
    let said = stdout(&render(&marked, &route));
    assert!(said.contains("route from dock-1 to charger-1: "), "{said}");

    let vector = folder.path().join("c.svg");
    assert_eq!(render(&vector, &route).status.code(), Some(0));
    let svg = fs::read_to_string(&vector).unwrap();
    assert!(
        svg.contains("charger-1</text>") && svg.contains("#ff7800"),
        "the band and its end"
    );

    let open = render(&marked, &["--route", "dock-1,charger-1"]);
    let said = stderr(&open);
    assert!(said.contains("--route dock-1,charger-1,TYPE"), "{said}");
    assert!(!said.contains("--vehicle-type"), "{said}");
    let unknown = render(&marked, &["--route", "dock1,charger-1,tugger-3000"]);
    assert_eq!(unknown.status.code(), Some(2));
    let said = stderr(&unknown);
    assert!(
        said.contains("\"dock1\"") && said.contains("near names are dock-1"),
        "{said}"
    );
}
