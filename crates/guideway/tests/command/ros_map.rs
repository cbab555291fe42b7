//! Tests of ROS maps as floor plans: pictures, walls, errors.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::Value;

use crate::support::{json, read_png, run, site, stderr};

const WHITE: [u8; 4] = [255, 255, 255, 255];
const WALL: [u8; 4] = [75, 85, 99, 255];
/// A translucent gray on white.
const UNKNOWN: [u8; 4] = [223, 223, 223, 255];

fn text(path: &Path) -> &str {
    path.to_str().unwrap()
}

/// Writes a map of 4 x 2 cells of 5 m: wall, unknown, free, free above free, free, free, wall.
fn map(folder: &Path, origin: &str) -> PathBuf {
    fs::create_dir_all(folder.join("images")).unwrap();
    let pixels = b"P5\n4 2\n255\n\x00\x80\xFE\xFE\xFE\xFE\xFE\x00";
    fs::write(folder.join("images/hall.pgm"), pixels).unwrap();
    let path = folder.join("map.yaml");
    let fields = format!(
        "image: images/hall.pgm\nresolution: 5\norigin: {origin}\nnegate: 0\n\
         occupied_thresh: 0.65\nfree_thresh: 0.25\n"
    );
    fs::write(&path, fields).unwrap();
    path
}

/// A layout with one path along x = 100, which is outside of the pictures.
fn far(folder: &Path) -> PathBuf {
    lines(folder, "far.geojson", &[[100.0, 0.0, 100.0, 5.0]])
}

fn lines(folder: &Path, name: &str, lines: &[[f64; 4]]) -> PathBuf {
    let feature = |&[x0, y0, x1, y1]: &[f64; 4]| {
        serde_json::json!({"type": "Feature", "properties": {},
            "geometry": {"type": "LineString", "coordinates": [[x0, y0], [x1, y1]]}})
    };
    let features: Vec<Value> = lines.iter().map(feature).collect();
    let crs = serde_json::json!({"type": "name", "properties": {"name": "EPSG:25832"}});
    let file = serde_json::json!(
        {"type": "FeatureCollection", "crs": crs, "features": features});
    let path = folder.join(name);
    fs::write(&path, file.to_string()).unwrap();
    path
}

/// A picture of the square from (-40, -40) to (40, 40) m, with a pixel per meter.
struct Picture(Vec<u8>);

impl Picture {
    fn of(folder: &Path, plan: &str) -> Self {
        let (layout, picture) = (far(folder), folder.join("a.png"));
        let view = ["--size", "80x80", "--center", "0,0", "--scale", "1"];
        let mut args = vec![
            "render",
            text(&layout),
            "-o",
            text(&picture),
            "--method",
            "cpu",
        ];
        args.extend(view);
        args.extend(["--floor-plan", plan]);
        let output = run(&args);
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
        let (width, height, pixels) = read_png(&picture);
        assert_eq!((width, height), (80, 80));
        Self(pixels)
    }

    /// The color of the pixel whose lower left corner is at a point.
    fn at(&self, x: i32, y: i32) -> [u8; 4] {
        let index = ((39 - y) * 80 + x + 40) as usize * 4;
        self.0[index..index + 4].try_into().unwrap()
    }
}

#[test]
fn map_is_drawn_at_its_origin_and_resolution() {
    let folder = tempfile::tempdir().unwrap();
    let map = map(folder.path(), "[-10, 20, 0]");
    let picture = Picture::of(folder.path(), text(&map));
    assert_eq!(picture.at(-8, 27), WALL);
    assert_eq!(picture.at(-3, 27), UNKNOWN);
    assert_eq!(picture.at(-8, 22), WHITE);
    assert_eq!(picture.at(7, 22), WALL);
    assert_eq!(picture.at(7, 27), WHITE);
    assert_eq!(picture.at(11, 22), WHITE, "beyond the map");
}

#[test]
fn map_is_turned_by_its_yaw_and_by_the_keys_after_its_name() {
    let folder = tempfile::tempdir().unwrap();
    let map = map(folder.path(), "[-10, 20, 1.5707963267948966]");
    // The rows of the map go upward now, and its upper side lies to the left.
    let picture = Picture::of(folder.path(), text(&map));
    assert_eq!(picture.at(-18, 22), WALL);
    assert_eq!(picture.at(-18, 27), UNKNOWN);
    assert_eq!(picture.at(-13, 37), WALL);
    assert_eq!(picture.at(-13, 22), WHITE);
    // Turned about the origin by another quarter: (x, y) is at (-y, x), 30 m higher.
    let turned = format!("{}@rotate=90,offset=0,30", text(&map));
    let picture = Picture::of(folder.path(), &turned);
    assert_eq!(picture.at(-23, 12), WALL);
    assert_eq!(picture.at(-38, 17), WALL);
    assert_eq!(picture.at(-28, 12), UNKNOWN);
}

#[test]
fn map_is_embedded_in_svg() {
    let folder = tempfile::tempdir().unwrap();
    let map = map(folder.path(), "[-10, 20, 0]");
    let (layout, picture) = (far(folder.path()), folder.path().join("a.svg"));
    let plan = ["--floor-plan", text(&map)];
    let args = [&["render", text(&layout), "-o", text(&picture)], &plan[..]].concat();
    let output = run(&args);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    assert!(
        fs::read_to_string(&picture)
            .unwrap()
            .contains("data:image/png;base64,iVBOR")
    );
}

/// A page of a PDF that the command wrote lies where an image of it would.
#[test]
fn page_of_a_pdf_is_a_floor_plan() {
    if Command::new("pdftoppm").arg("-v").output().is_err() {
        println!("SKIPPED: this needs pdftoppm of Poppler");
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let wall = lines(folder.path(), "wall.geojson", &[[-10.0, -2.0, 10.0, -2.0]]);
    let pdf = folder.path().join("wall.pdf");
    let args = ["render", text(&wall), "-o", text(&pdf), "--min-px", "4"];
    let view = ["--size", "80x80", "--center", "0,0", "--scale", "1"];
    let output = run([&args[..], &view].concat());
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    // The page has 96 pixels per inch, its image 200.
    let place = "px-per-m=2.083333,offset=-40,-40";
    let plan = |page: u32| format!("{}@page={page},{place}", text(&pdf));
    let picture = Picture::of(folder.path(), &plan(1));
    assert_eq!((picture.at(0, 10), picture.at(20, -2)), (WHITE, WHITE));
    assert!(picture.at(0, -2)[1] < 128, "{:?}", picture.at(0, -2));
    let layout = far(folder.path());
    let no_page = plan(2);
    let args = ["render", text(&layout), "-o", "-", "--floor-plan", &no_page];
    let output = run(args);
    assert_eq!(output.status.code(), Some(2));
    assert!(
        stderr(&output).contains("fewer pages"),
        "{}",
        stderr(&output)
    );
}

/// Messages of `check` about walls nearer than 0.3 m to a vehicle of 2 m x 1 m.
fn wall_findings(layout: &Path, plan: &str) -> Vec<String> {
    let vehicle = ["--envelope", "2x1", "--clearance", "0.3"];
    let args = ["check", "--json", text(layout), "--floor-plan", plan];
    let report = json(&run(args.into_iter().chain(vehicle)), "check");
    let findings = report["findings"].as_array().unwrap().clone();
    let walls = findings
        .into_iter()
        .filter(|f| f["code"] == "wall-clearance");
    walls.map(|f| f["message"].to_string()).collect()
}

#[test]
fn walls_of_a_map_are_checked() {
    let folder = tempfile::tempdir().unwrap();
    let map = map(folder.path(), "[0, 0, 0]");
    // Walls: (0, 5) to (5, 10) m, and (15, 0) to (20, 5) m.
    let paths = [[6.0, 8.0, 12.0, 8.0], [6.0, 2.0, 12.0, 2.0]];
    let layout = lines(folder.path(), "layout.geojson", &paths);
    let near = wall_findings(&layout, text(&map));
    assert_eq!(near.len(), 1, "{near:?}");
    assert!(near[0].contains("wall 1"), "{near:?}");
    let away = format!("{}@offset=0,50", text(&map));
    assert_eq!(wall_findings(&layout, &away).len(), 0);
}

#[test]
fn vehicles_inside_a_thick_wall_are_found() {
    let folder = tempfile::tempdir().unwrap();
    let path = map(folder.path(), "[0, 0, 0]");
    let fields = fs::read_to_string(&path).unwrap();
    fs::write(&path, fields.replace("resolution: 5", "resolution: 0.5")).unwrap();
    // A block of 10 m x 10 m.
    let block = [&b"P5 20 20 255\n"[..], &[0; 400]].concat();
    fs::write(folder.path().join("images/hall.pgm"), block).unwrap();
    let layout = lines(folder.path(), "layout.geojson", &[[4.0, 5.0, 6.0, 5.0]]);
    let found = wall_findings(&layout, text(&path));
    assert!(
        found.len() == 1 && found[0].contains("inside of walls"),
        "{found:?}"
    );
}

#[test]
fn errors_name_the_file_and_the_remedy() {
    let folder = tempfile::tempdir().unwrap();
    let map = map(folder.path(), "[0, 0, 0]");
    // The content says what an image is, the name where a picture may go.
    let image = folder.path().join("images/hall.png");
    fs::rename(image.with_extension("pgm"), &image).unwrap();
    let fields = fs::read_to_string(&map).unwrap();
    fs::write(&map, fields.replace("hall.pgm", "hall.png")).unwrap();
    let picture = folder.path().join("a.png");
    let layout = site();
    let render = |plan: &str, picture: &Path| {
        let args = [
            "render",
            text(&layout),
            "-o",
            text(picture),
            "--floor-plan",
            plan,
        ];
        run(args)
    };
    let scaled = format!("{}@px-per-m=3", text(&map));
    for (output, said) in [
        (run(["info", text(&map)]), "--floor-plan map.yaml"),
        (
            run(["convert", text(&map), "a.dxf"]),
            "an image of the floor",
        ),
        (render(&scaled, &picture), "`resolution` in the map file"),
        (render(text(&map), &image), "would replace an input"),
        (render(text(&image), &picture), "px-per-m=20"),
        (
            run([
                "check",
                text(&layout),
                "--clearance",
                "1",
                "--floor-plan",
                text(&image),
            ]),
            "map.yaml",
        ),
    ] {
        assert_eq!(output.status.code(), Some(2));
        assert!(
            stderr(&output).contains(said),
            "{said}: {}",
            stderr(&output)
        );
    }
    fs::remove_file(&image).unwrap();
    let output = render(text(&map), &picture);
    assert_eq!(output.status.code(), Some(2));
    assert!(
        stderr(&output).contains("images/hall.png"),
        "{}",
        stderr(&output)
    );
}

#[test]
fn real_map_has_walls_below_and_free_space_above() {
    let map = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/cases/network/hall.yaml");
    if !map.is_file() {
        println!("SKIPPED: the map of a hall is not at {}", map.display());
        return;
    }
    // 10 m x 5 m from (-5, -2.5), the lower half occupied.
    let folder = tempfile::tempdir().unwrap();
    let picture = Picture::of(folder.path(), text(&map));
    assert_eq!(picture.at(0, -2), WALL);
    assert_eq!(picture.at(0, 1), WHITE);
    assert_eq!(picture.at(0, -4), WHITE, "below the map");
    assert_eq!(picture.at(6, -2), WHITE, "beside the map");
}
