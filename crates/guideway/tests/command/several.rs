//! Tests of merged files, floor plans, SVG pictures, conversions and their reports.

use std::fs;
use std::path::{Path, PathBuf};

use guideway::scene::{Frame, FrameSize};
use serde_json::Value;

use crate::support::{command, has_keys, json, names_in, site, stderr, stdout};

fn guideway(args: &[&str]) -> std::process::Output {
    command().args(args).output().unwrap()
}

fn text(path: &Path) -> &str {
    path.to_str().unwrap()
}

/// The example site as a DXF drawing.
fn plan(folder: &Path) -> PathBuf {
    let plan = folder.join("plan.dxf");
    let output = guideway(&["convert", text(&site()), text(&plan)]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    plan
}

fn pixels(path: &Path) -> Vec<[u8; 4]> {
    let file = std::io::BufReader::new(fs::File::open(path).unwrap());
    let mut reader = png::Decoder::new(file).read_info().unwrap();
    let mut bytes = vec![0; reader.output_buffer_size().unwrap()];
    reader.next_frame(&mut bytes).unwrap();
    bytes
        .chunks_exact(4)
        .map(|p| [p[0], p[1], p[2], p[3]])
        .collect()
}

#[test]
fn merges_files_with_their_placements() {
    let folder = tempfile::tempdir().unwrap();
    let (site_path, plan) = (site(), plan(folder.path()));
    let info = |files: &[&str]| {
        let output = guideway(&[&["info", "--json"], files].concat());
        json(&output, "info")
    };
    let (alone, moved) = (
        text(&plan),
        format!("{}@scale=2,offset=1000,-5", text(&plan)),
    );
    let (site, first, both) = (
        info(&[text(&site_path)]),
        info(&[alone]),
        info(&[text(&site_path), &moved]),
    );
    let number = |report: &Value, key: &str| report[key].as_f64().unwrap();
    let sum = |key| number(&site, key) + number(&first, key);
    assert_eq!(number(&both, "paths"), sum("paths"));
    let length = number(&site, "length_m") + 2.0 * number(&first, "length_m");
    assert!((number(&both, "length_m") - length).abs() < 1e-3 * length);
    let right = |report: &Value| report["bounds_m"]["max"][0].as_f64().unwrap();
    assert!((right(&both) - (1000.0 + 2.0 * right(&first))).abs() < 1e-6);
    let columns = both["attributes"]["paths"].as_array().unwrap();
    let source = columns.iter().find(|c| c["name"] == "source").unwrap();
    assert_eq!(source["distinct"], 2);
    assert_eq!(both["file"], format!("{}, {}", text(&site_path), alone));
    let said = stdout(&guideway(&["info", text(&site_path), alone]));
    assert!(said.starts_with("files       2, together "), "{said}");
    assert!(said.contains(&format!("\n  {alone}\nformat")), "{said}");
}

#[test]
fn rejects_invalid_placements() {
    for (bad, said) in [
        ("x.dxf@scale=0", "a number from 1e-9"),
        ("x.dxf@size=3", "scale, rotate and offset"),
        ("x.dxf@offset=3", "12.5,-3"),
    ] {
        let output = guideway(&["info", bad]);
        assert_eq!(output.status.code(), Some(2), "{bad}");
        assert!(stderr(&output).contains(said), "{bad}: {}", stderr(&output));
    }
    let output = guideway(&["info", &format!("{}@px-per-m=3", text(&site()))]);
    assert!(stderr(&output).contains("images"), "{}", stderr(&output));
}

#[test]
fn check_finds_identifiers_in_several_files() {
    let folder = tempfile::tempdir().unwrap();
    let copy = folder.path().join("copy.json");
    fs::copy(site(), &copy).unwrap();
    let output = guideway(&["check", "--together", "--json", text(&site()), text(&copy)]);
    let report = json(&output, "check");
    has_keys(&report, &["file", "files", "findings", "kinds", "paths"]);
    assert_eq!(report["files"].as_array().unwrap().len(), 2);
    let findings = report["findings"].as_array().unwrap();
    let across: Vec<&Value> = findings
        .iter()
        .filter(|f| f["code"] == "duplicate-id")
        .collect();
    assert!(!across.is_empty());
    assert!(across.iter().all(|f| f["file"] == text(&copy)));
    assert!(
        across[0]["message"]
            .as_str()
            .unwrap()
            .contains("site.lif.json")
    );
    let said = stdout(&guideway(&[
        "check",
        "--together",
        text(&site()),
        text(&copy),
    ]));
    assert!(said.contains("all files: 0 errors"), "{said}");
    // Each by itself, both are right.
    let alone = json(
        &guideway(&["check", "--json", text(&site()), text(&copy)]),
        "check",
    );
    let of_kind = |code: &str| {
        let findings = alone["findings"].as_array().unwrap();
        findings.iter().filter(|f| f["code"] == code).count()
    };
    assert_eq!(of_kind("duplicate-id"), 0);
}

#[test]
fn sarif_names_rules_and_locations() {
    let folder = tempfile::tempdir().unwrap();
    let copy = folder.path().join("a b.json");
    fs::copy(site(), &copy).unwrap();
    let output = guideway(&["check", "--format", "sarif", text(&site()), text(&copy)]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let log: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(log["version"], "2.1.0");
    let run = &log["runs"][0];
    has_keys(
        run,
        &[
            "tool.driver.name",
            "tool.driver.rules",
            "artifacts",
            "invocations",
        ],
    );
    let rules = run["tool"]["driver"]["rules"].as_array().unwrap();
    let results = run["results"].as_array().unwrap();
    assert!(!results.is_empty());
    for result in results {
        let rule = &rules[result["ruleIndex"].as_u64().unwrap() as usize];
        assert_eq!(rule["id"], result["ruleId"]);
        assert!(["note", "warning", "error"].contains(&result["level"].as_str().unwrap()));
        let location = &result["locations"][0];
        let artifact = &location["physicalLocation"]["artifactLocation"];
        let index = artifact["index"].as_u64().unwrap() as usize;
        assert_eq!(artifact["uri"], run["artifacts"][index]["location"]["uri"]);
        has_keys(&location["logicalLocations"][0], &["fullyQualifiedName"]);
    }
    let uri = run["artifacts"][1]["location"]["uri"].as_str().unwrap();
    assert!(
        uri.starts_with("file:///") && uri.ends_with("a%20b.json"),
        "{uri}"
    );

    let json_twice = guideway(&["check", "--format", "sarif", "--json", text(&site())]);
    assert_eq!(json_twice.status.code(), Some(2));
    let json_once = guideway(&["check", "--format", "json", text(&site())]);
    json(&json_once, "check");
}

#[test]
fn converts_to_every_format_and_back() {
    let folder = tempfile::tempdir().unwrap();
    let paths =
        |file: &Path| json(&guideway(&["info", "--json", text(file)]), "info")["paths"].clone();
    for (name, format, more) in [
        ("a.arrow", "Arrow", &[][..]),
        ("a.dxf", "DXF", &[]),
        ("a.geojson", "GeoJSON", &[]),
        ("a.lif.json", "LIF", &[]),
        ("b.json", "LIF", &["--to", "lif2"]),
        ("a.svg", "SVG", &[]),
    ] {
        let target = folder.path().join(name);
        let site = site();
        let args = [&["convert", text(&site), text(&target)], more].concat();
        let output = guideway(&args);
        assert_eq!(output.status.code(), Some(0), "{name}: {}", stderr(&output));
        let info = json(&guideway(&["info", "--json", text(&target)]), "info");
        assert_eq!(info["format"], format, "{name}");
        assert_eq!(paths(&target), paths(&site), "{name}");
    }
    let output = guideway(&["convert", text(&site()), text(&folder.path().join("c.txt"))]);
    assert_eq!(output.status.code(), Some(2));
    assert!(stderr(&output).contains("--to lif2"), "{}", stderr(&output));
}

#[test]
fn svg_picture_has_curves_and_colors() {
    let folder = tempfile::tempdir().unwrap();
    let picture = folder.path().join("site.svg");
    let render = |more: &[&str]| {
        guideway(
            &[
                &["render", text(&site()), "-o", text(&picture), "--json"],
                more,
            ]
            .concat(),
        )
    };
    let args = ["--color-by", "maxSpeed", "--legend", "--size", "640x360"];
    let report = json(&render(&args), "render");
    assert_eq!(report["method"]["name"], "svg");
    let count = |key: &str| report["paths"][key].as_u64().unwrap();
    assert!(count("drawn") > 0);
    let accounted = count("drawn") + count("outside") + count("hidden") + count("refused");
    assert_eq!(accounted, count("total"));
    assert_eq!(report["legend"]["unit"], "m/s");
    let svg = fs::read_to_string(&picture).unwrap();
    assert!(svg.contains(r#"viewBox="0 0 640 360""#));
    assert_eq!(svg.matches("<path id=").count() as u64, count("drawn"));
    for entry in report["legend"]["entries"].as_array().unwrap() {
        let color = format!("#{}", entry["color"].as_str().unwrap());
        assert!(svg.contains(&color), "{color}");
    }
    assert!(svg.contains("maxSpeed (m/s)</text>"));

    let output = render(&["--method", "cpu"]);
    assert_eq!(output.status.code(), Some(2));
    let error = &json(&output, "error")["error"];
    assert!(error["remedy"].as_str().unwrap().contains("PNG"), "{error}");
}

#[test]
fn floor_plan_is_below_the_paths() {
    let folder = tempfile::tempdir().unwrap();
    let plan = plan(folder.path());
    let render = |picture: &Path, plan: &str| {
        let (site, picture) = (site(), picture.to_owned());
        let output = guideway(&[
            "render",
            text(&site),
            "-o",
            text(&picture),
            "--size",
            "400x300",
            "--center",
            "50,30",
            "--scale",
            "4",
            "--method",
            "cpu",
            "--floor-plan",
            plan,
        ]);
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    };
    let (plain, both) = (folder.path().join("a.png"), folder.path().join("b.png"));
    // A plan far away is invisible; one under the layout changes only pixels without paths.
    render(&plain, &format!("{}@offset=5000,0", text(&plan)));
    render(&both, &format!("{}@offset=0.7,0.7", text(&plan)));
    let (plain, both) = (pixels(&plain), pixels(&both));
    let changed = plain.iter().zip(&both).filter(|(a, b)| a != b).count();
    assert!(changed > 500, "{changed}");
    let black = |p: &[u8; 4]| *p == [0, 0, 0, 255];
    assert!(plain.iter().zip(&both).all(|(a, b)| !black(a) || black(b)));

    let vector = folder.path().join("c.svg");
    render_svg(&vector, text(&plan));
    let svg = fs::read_to_string(&vector).unwrap();
    assert!(svg.contains("floor plan") && svg.contains("#c2cad3"));
}

fn render_svg(picture: &Path, plan: &str) {
    let (site, picture) = (site(), picture.to_owned());
    let output = guideway(&[
        "render",
        text(&site),
        "-o",
        text(&picture),
        "--floor-plan",
        plan,
    ]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
}

#[test]
fn image_is_below_the_paths_at_its_scale() {
    let folder = tempfile::tempdir().unwrap();
    let image = folder.path().join("hall.png");
    let mut frame = Frame::new(FrameSize::new(10, 10).unwrap());
    frame.pixels_mut().fill([200, 220, 255, 255]);
    guideway::save_png(&frame, &image).unwrap();
    let picture = folder.path().join("a.png");
    let placed = format!("{}@px-per-m=1,offset=45,25", text(&image));
    let output = guideway(&[
        "render",
        text(&site()),
        "-o",
        text(&picture),
        "--size",
        "200x200",
        "--center",
        "50,30",
        "--scale",
        "10",
        "--floor-plan",
        &placed,
    ]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let all = pixels(&picture);
    let tinted = all.iter().filter(|p| **p == [200, 220, 255, 255]).count();
    // Half as wide and as high as the picture, minus the pixels of paths.
    assert!((5_000..=10_000).contains(&tinted), "{tinted}");

    let vector = folder.path().join("a.svg");
    render_svg(&vector, &placed);
    let svg = fs::read_to_string(&vector).unwrap();
    assert!(svg.contains("data:image/png;base64,"));

    let unsized_image = guideway(&[
        "render",
        text(&site()),
        "-o",
        text(&picture),
        "--floor-plan",
        text(&image),
    ]);
    assert_eq!(unsized_image.status.code(), Some(2));
    assert!(
        stderr(&unsized_image).contains("px-per-m=20"),
        "{}",
        stderr(&unsized_image)
    );
    fs::write(&image, b"\x89PNG\r\n\x1a\nrest").unwrap();
    let broken = guideway(&[
        "render",
        text(&site()),
        "-o",
        text(&picture),
        "--floor-plan",
        &placed,
    ]);
    assert_eq!(broken.status.code(), Some(2));
    assert!(stderr(&broken).contains("hall.png"), "{}", stderr(&broken));
    assert!(
        !names_in(folder.path())
            .iter()
            .any(|name| name.ends_with(".part"))
    );
}
