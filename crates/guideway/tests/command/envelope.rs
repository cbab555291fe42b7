//! Tests of swept areas: `render --envelope` and `check --clearance`.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Output;

use serde_json::Value;

use crate::support::{command, json, site, stderr, stdout};

fn guideway(args: &[&str]) -> Output {
    command().args(args).output().expect("the command starts")
}

fn text(path: &Path) -> &str {
    path.to_str().expect("a plain path")
}

/// A route graph of separate lines.
fn graph(folder: &Path, name: &str, lines: &[[f64; 4]]) -> PathBuf {
    let mut features = Vec::new();
    for (i, [x0, y0, x1, y1]) in lines.iter().enumerate() {
        features.push(format!(
            concat!(
                r#"{{"type":"Feature","properties":{{"id":"e{i}"}},"#,
                r#""geometry":{{"type":"LineString","#,
                r#""coordinates":[[{x0},{y0}],[{x1},{y1}]]}}}}"#
            ),
            i = i,
            x0 = x0,
            y0 = y0,
            x1 = x1,
            y1 = y1
        ));
    }
    let crs = r#""crs":{"type":"name","properties":{"name":"EPSG:25832"}}"#;
    let file = folder.join(name);
    let features = features.join(",");
    fs::write(
        &file,
        format!(r#"{{"type":"FeatureCollection",{crs},"features":[{features}]}}"#),
    )
    .unwrap();
    file
}

#[test]
fn swept_areas_are_below_the_paths_and_reported() {
    let folder = tempfile::tempdir().unwrap();
    let (plain, with) = (folder.path().join("a.png"), folder.path().join("b.png"));
    let render = |picture: &Path, more: &[&str]| {
        let (site, all) = (
            site(),
            ["--size", "400x300", "--center", "50,30", "--scale", "4"],
        );
        let args = [
            &[
                "render",
                text(&site),
                "-o",
                text(picture),
                "--method",
                "cpu",
                "--json",
            ],
            &all[..],
            more,
        ];
        json(&guideway(&args.concat()), "render")
    };
    assert!(render(&plain, &[])["envelopes"].is_null());
    let report = render(&with, &["--envelope", "3x1.4,1"]);
    let swept = &report["envelopes"];
    let count = |key: &str| swept[key].as_u64().unwrap();
    assert_eq!(swept["source"], "3x1.4,1");
    let paths = &report["paths"];
    let shown = paths["drawn"].as_u64().unwrap() + paths["outside"].as_u64().unwrap();
    assert_eq!(count("drawn") + count("outside"), shown);
    assert!(count("drawn") > 0 && count("polygons") >= count("drawn"));
    assert_eq!(swept["without"], Value::Array(Vec::new()));
    let bytes = |path: &Path| fs::read(path).unwrap();
    assert_ne!(bytes(&plain), bytes(&with));

    let vector = folder.path().join("c.svg");
    let site = site();
    let output = guideway(&[
        "render",
        text(&site),
        "-o",
        text(&vector),
        "--envelope",
        "3x1.4",
    ]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    assert!(
        stdout(&output).contains("swept areas (3x1.4,1.5)"),
        "{}",
        stdout(&output)
    );
    assert!(fs::read_to_string(&vector).unwrap().contains("swept areas"));
}

#[test]
fn rejects_invalid_vehicles_and_files_without_envelopes() {
    let folder = tempfile::tempdir().unwrap();
    let (site, picture) = (site(), folder.path().join("a.png"));
    for (bad, said) in [("2x0", "2x1.2,0.5"), ("file", "no path has an envelope")] {
        let output = guideway(&[
            "render",
            text(&site),
            "-o",
            text(&picture),
            "--envelope",
            bad,
        ]);
        assert_eq!(output.status.code(), Some(2), "{bad}");
        assert!(stderr(&output).contains(said), "{bad}: {}", stderr(&output));
        assert!(!picture.exists());
    }
    let output = guideway(&["check", text(&site), "--clearance", "0.3"]);
    assert!(
        stderr(&output).contains("--envelope 2x1.2"),
        "{}",
        stderr(&output)
    );
    let output = guideway(&["check", text(&site), "--envelope", "2x1"]);
    assert!(
        stderr(&output).contains("--clearance"),
        "{}",
        stderr(&output)
    );
}

#[test]
fn reports_paths_and_walls_below_the_clearance() {
    let folder = tempfile::tempdir().unwrap();
    let crossing = [
        [0.0, 0.0, 40.0, 0.0],
        [20.0, -20.0, 20.0, 20.0],
        [0.0, 1.5, 15.0, 1.5],
    ];
    let layout = graph(folder.path(), "layout.geojson", &crossing);
    let plan = graph(folder.path(), "plan.geojson", &[[25.0, 0.8, 40.0, 0.8]]);
    let run = |more: &[&str]| {
        let args = [&["check", text(&layout), "--envelope", "2x1"], more];
        guideway(&args.concat())
    };
    let check = |more: &[&str]| json(&run(&[&["--json"], more].concat()), "check");
    let of_kind = |report: &Value, code: &str| {
        let findings = report["findings"].as_array().unwrap().clone();
        findings.into_iter().filter(|f| f["code"] == code).count()
    };
    let overlaps = check(&["--clearance", "0"]);
    assert_eq!(of_kind(&overlaps, "clearance"), 1);
    assert_eq!(overlaps["clearance"]["envelopes"], 3);
    assert!(overlaps["clearance"]["distances"].as_u64().unwrap() > 0);
    let near = check(&["--clearance", "0.6", "--floor-plan", text(&plan)]);
    assert_eq!(
        (
            of_kind(&near, "clearance"),
            of_kind(&near, "wall-clearance")
        ),
        (2, 1)
    );
    let layer = ["--floor-plan", text(&plan), "--wall-layer", "WALLS"];
    let output = run(&[&["--clearance", "0.6"], &layer[..]].concat());
    assert_eq!(output.status.code(), Some(2));
    assert!(
        stderr(&output).contains("layer `WALLS`"),
        "{}",
        stderr(&output)
    );
    let plain = run(&["--clearance", "0.6"]);
    assert!(stdout(&plain).contains("3 envelopes"), "{}", stdout(&plain));
}

#[test]
fn layers_of_walls_are_found_whatever_their_case() {
    let folder = tempfile::tempdir().unwrap();
    let plan = folder.path().join("plan.dxf");
    let site = site();
    let converted = guideway(&["convert", text(&site), text(&plan)]);
    assert!(converted.status.success(), "{}", stderr(&converted));
    let check = |layer: &str| {
        let vehicle = ["--clearance", "0", "--envelope", "1x0.5", "-q"];
        let walls = ["--floor-plan", text(&plan), "--wall-layer", layer];
        let all = [&["check", text(&site)][..], &vehicle, &walls].concat();
        guideway(&all)
    };
    for known in ["mezzanine", "MEZZANINE", "mezz*"] {
        let output = check(known);
        assert!(output.status.code() < Some(2), "{}", stderr(&output));
    }
    let output = check("mezanine");
    assert_eq!(output.status.code(), Some(2));
    let said = stderr(&output);
    assert!(
        said.contains("mean `mezzanine`? The layers are hall, mezzanine"),
        "{said}"
    );
}

#[test]
fn draws_and_counts_polygons_of_the_file() {
    let folder = tempfile::tempdir().unwrap();
    let (plant, picture) = (
        folder.path().join("plant.xml"),
        folder.path().join("plant.png"),
    );
    let model = r#"<model version="7.0.0"><point name="A" positionX="0" positionY="0"/>
        <point name="B" positionX="10000" positionY="0"/>
        <path name="P" sourcePoint="A" destinationPoint="B"><vehicleEnvelope key="k">
        <vertex x="0" y="-900"/><vertex x="10000" y="-900"/><vertex x="10000" y="900"/>
        <vertex x="5000" y="100"/><vertex x="0" y="900"/></vehicleEnvelope></path>
        <path name="Q" sourcePoint="B" destinationPoint="A"/></model>"#;
    fs::write(&plant, model).unwrap();
    let args = ["--envelope", "file", "--json"];
    let args = [&["render", text(&plant), "-o", text(&picture)], &args[..]];
    let report = json(&guideway(&args.concat()), "render");
    let swept = &report["envelopes"];
    assert_eq!(
        (&swept["drawn"], &swept["polygons"]),
        (&1.into(), &3.into())
    );
    assert_eq!(swept["without"][0]["why"], "the file gives none");
}

#[test]
fn orientations_in_degrees_leave_doubt() {
    let folder = tempfile::tempdir().unwrap();
    let layout = |orientation: f64| {
        let file = folder.path().join("a.lif.json");
        let text = format!(
            r#"{{"metaInformation": {{"projectIdentification": "p", "creator": "c",
                "exportTimestamp": "2025-01-01T00:00:00Z", "lifVersion": "1.0.0"}},
            "layouts": [{{"layoutId": "L", "nodes": [
                {{"nodeId": "A", "nodePosition": {{"x": 0, "y": 0}},
                    "vehicleTypeNodeProperties": []}},
                {{"nodeId": "B", "nodePosition": {{"x": 9, "y": 0}},
                    "vehicleTypeNodeProperties": []}}
            ], "edges": [{{"edgeId": "e", "startNodeId": "A", "endNodeId": "B",
                "vehicleTypeEdgeProperties": [{{"vehicleTypeId": "v", "rotationAllowed": false,
                "vehicleOrientation": {orientation}, "orientationType": "GLOBAL"}}]}}],
            "stations": []}}]}}"#
        );
        fs::write(&file, text).unwrap();
        file
    };
    let doubt = "1 path with an orientation beyond what the format allows, perhaps in degrees";
    for (orientation, is_doubtful) in [(90.0, true), (1.5, false)] {
        let file = layout(orientation);
        let picture = folder.path().join("a.png");
        let more = ["-o", text(&picture), "--method", "cpu", "--envelope", "2x1"];
        let render = guideway(&[&["render", text(&file)], &more[..]].concat());
        assert_eq!(
            stdout(&render).contains(doubt),
            is_doubtful,
            "{}",
            stdout(&render)
        );
        let more = ["--clearance", "0.1", "--envelope", "2x1"];
        let check = guideway(&[&["check", text(&file)], &more[..]].concat());
        assert_eq!(
            stdout(&check).contains(doubt),
            is_doubtful,
            "{}",
            stdout(&check)
        );
    }
}
