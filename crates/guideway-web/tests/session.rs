//! Tests of the engine of the page, without a browser.

#![expect(clippy::unwrap_used, reason = "helpers of tests may panic")]

use std::path::Path;
use std::sync::Arc;

use guideway::compose::{Decorations, NoProgress, Picture, Viewport};
use guideway::cpu::Cpu;
use guideway::formats::{ReadOptions, Target, read_bytes};
use guideway::layout::UserError;
use guideway::scene::{FrameSize, Scene, SceneOptions};
use guideway::spline::Point;
use guideway_web::Session;
use serde_json::{Value, json};

const SITE: &str = "../guideway/examples/site.lif.json";

fn bytes(path: &str) -> Vec<u8> {
    std::fs::read(Path::new(env!("CARGO_MANIFEST_DIR")).join(path)).unwrap()
}

fn site() -> Session {
    Session::open("site.lif.json", &&bytes(SITE)[..], &NoProgress).unwrap()
}

fn parsed(answer: &str) -> Value {
    serde_json::from_str(answer).unwrap()
}

fn look() -> Value {
    json!({
        "width": 320, "height": 200, "center": [36.0, 8.0], "pxPerM": 12.5,
        "arrows": true, "stations": true, "labels": true,
    })
}

#[test]
fn picture_is_that_of_the_compositor_also_after_another_view() {
    let mut session = site();
    let mut other = look();
    other["pxPerM"] = json!(3.0);
    session.render(&other.to_string()).unwrap();
    let drawn = session.render(&look().to_string()).unwrap();

    let layout = read_bytes("site", &bytes(SITE), &ReadOptions::default()).unwrap();
    let options = SceneOptions {
        has_gray_structure: true,
        ..SceneOptions::default()
    };
    let scene = Scene::new(Arc::new(layout), &options).unwrap();
    let size = FrameSize::new(320, 200).unwrap();
    let mut picture = Picture::new(Arc::new(scene), size);
    picture.viewport = Viewport {
        size,
        center_m: Some(Point::new(36.0, 8.0)),
        px_per_m: Some(12.5),
    };
    picture.decorations = Decorations {
        has_zones: true,
        has_arrows: true,
        has_stations: true,
        has_labels: true,
        ..Decorations::default()
    };
    let (frame, _) = picture.render_frame(&Cpu, &NoProgress).unwrap();
    assert!(drawn.rgba == frame.bytes(), "the pixels differ");
    let report = parsed(&drawn.report);
    assert_eq!(
        (&report["total"], &report["pxPerM"]),
        (&json!(326), &json!(12.5))
    );
}

#[test]
fn floor_plan_and_swept_areas_lie_below_the_paths() {
    let mut session = site();
    let mut look = look();
    let mut bytes_of = |session: &mut Session, more: &[(&str, Value)]| {
        for (name, value) in more {
            look[*name] = value.clone();
        }
        session.render(&look.to_string()).unwrap().rgba
    };
    let plain = bytes_of(&mut session, &[]);
    assert!(plain == bytes_of(&mut session, &[("floorPlan", json!(true))]));
    let drawing = br#"<svg xmlns="http://www.w3.org/2000/svg" width="90" height="30">
        <path d="M0 0 L90 30" stroke="black" fill="none"/></svg>"#;
    let set = session.set_floor_plan("hall.svg", drawing.to_vec(), "null");
    set.unwrap();
    let with_drawing = bytes_of(&mut session, &[]);
    assert!(plain != with_drawing, "the drawing shows");
    let image = b"P5 1 1 255\n\x80".to_vec();
    let placement = r#"{"pxPerM": 0.01, "rotateDeg": 0, "offset": [0, -20]}"#;
    session
        .set_floor_plan("hall.pgm", image, placement)
        .unwrap();
    let with_image = bytes_of(&mut session, &[]);
    assert_eq!(with_image[..4], [128, 128, 128, 255], "the corner is gray");
    assert!(plain == bytes_of(&mut session, &[("floorPlan", json!(false))]));
    let swept = bytes_of(&mut session, &[("envelope", json!("2x1.2"))]);
    assert!(plain != swept, "the areas show");

    let before = bytes_of(&mut session, &[("floorPlan", json!(true))]);
    for (name, bytes, placement) in [
        ("hall.png", &b"no image"[..], placement),
        ("hall.svg", b"no layout", "null"),
        ("hall.pgm", b"P5 1 1 255\n\x80", "{}"),
    ] {
        let refused = session.set_floor_plan(name, bytes.to_vec(), placement);
        let error = refused.unwrap_err();
        assert!(error.message.contains(name), "{}", error.message);
    }
    assert!(before == bytes_of(&mut session, &[]), "the last plan stays");
}

#[test]
fn vehicles_without_areas_are_refused() {
    let session = site();
    session.check_envelope("2x1.2,0.5").unwrap();
    for (text, said) in [("2xwide", "2xwide"), ("file", "the file gives none")] {
        let error = session.check_envelope(text).unwrap_err();
        assert!(error.message.contains(said), "{}", error.message);
    }
}

#[test]
fn numbers_have_the_colors_of_palette_and_range() {
    let mut session = site();
    let mut look = look();
    look["colorBy"] = json!("maxSpeed");
    let warm = session.render(&look.to_string()).unwrap();
    look["palette"] = json!("viridis");
    let viridis = session.render(&look.to_string()).unwrap();
    look["range"] = json!([0.0, 5.0]);
    let narrow = session.render(&look.to_string()).unwrap();
    assert!(warm.rgba != viridis.rgba && viridis.rgba != narrow.rgba);
    look["breaks"] = json!([0.9, 1.3]);
    let both = session.render(&look.to_string()).unwrap_err();
    assert!(both.message.contains("`range` and `breaks`"));
    look.as_object_mut().unwrap().remove("range");
    let classes = session.render(&look.to_string()).unwrap();
    let legend = parsed(&classes.report)["legend"].clone();
    assert_eq!(legend["entries"][1]["label"], "0.9 to 1.3");
    assert!(classes.rgba != viridis.rgba);
    look["breaks"] = json!([1.3, 0.9]);
    let error = session.render(&look.to_string()).unwrap_err();
    assert!(error.message.contains("0.9 comes after 1.3"));
    look.as_object_mut().unwrap().remove("breaks");
    look["palette"] = json!("rainbow");
    let error = session.render(&look.to_string()).unwrap_err();
    assert!(error.message.contains("rainbow"));
}

#[test]
fn length_is_left_to_calls_of_its_own() {
    let session = site();
    let info = parsed(&session.info());
    assert_eq!((&info["paths"], info.get("lengthM")), (&json!(326), None));
    let layout = read_bytes("site", &bytes(SITE), &ReadOptions::default()).unwrap();
    let whole = guideway::json::info(&layout)["lengthM"].as_f64().unwrap();
    let parts = [(0, 100), (100, 200), (300, 100), (400, 100)];
    let parts = parts.map(|(first, count)| session.length_m(first, count));
    assert!(parts[0] > 0.0 && parts[2] > 0.0 && parts[3] == 0.0);
    assert!((parts.iter().sum::<f64>() - whole).abs() < 1e-9 * whole);
}

#[test]
fn fitted_pictures_are_those_of_the_compositor() {
    let look = json!({
        "width": 640, "height": 400, "shade": "auto", "colorBy": "maxSpeed",
        "legend": true, "scaleBar": true, "arrows": true, "labels": true, "nodes": true,
    });
    let mut session = site();
    session.render(&look.to_string()).unwrap();
    let again = session.render(&look.to_string()).unwrap();

    let layout = read_bytes("site", &bytes(SITE), &ReadOptions::default()).unwrap();
    let options = SceneOptions {
        color_by: Some(guideway::scene::ColorBy {
            column: "maxSpeed".into(),
        }),
        has_gray_structure: true,
        ..SceneOptions::default()
    };
    let scene = Scene::new(Arc::new(layout), &options).unwrap();
    let mut picture = Picture::new(Arc::new(scene), FrameSize::new(640, 400).unwrap());
    picture.decorations = Decorations {
        has_zones: true,
        has_arrows: true,
        has_nodes: true,
        has_labels: true,
        has_scale_bar: true,
        has_legend: true,
        ..Decorations::default()
    };
    let view = picture.view().unwrap();
    let layout = picture.scene.layout();
    picture.style.line_rule = guideway::compose::suitable_widths(layout, &view, true);
    let (frame, _) = picture.render_frame(&Cpu, &NoProgress).unwrap();
    assert!(again.rgba == frame.bytes(), "the pixels differ");
}

#[test]
fn refused_files_are_refused_in_the_words_of_the_command() {
    let refused = |bytes: &[u8]| -> [UserError; 2] {
        let error = |of: Result<(), UserError>| of.unwrap_err();
        let read = read_bytes("bad.json", bytes, &ReadOptions::default());
        [
            error(Session::open("bad.json", &bytes, &NoProgress).map(drop)),
            error(read.map(drop).map_err(UserError::from)),
        ]
    };
    for bytes in [&b""[..], b"{", b"\0\0\0", b"<svg", b"hello"] {
        let [page, command] = refused(bytes);
        assert_eq!(page, command);
    }
}

#[test]
fn element_is_hit_described_and_found() {
    let mut session = site();
    assert_eq!(session.hit(10.0, 10.0, 5.0), "null", "before a picture");
    session.render(&look().to_string()).unwrap();
    // The dock lies at (36, 4): 50 pixels below the middle.
    let hit = parsed(&session.hit(160.0, 150.0, 4.0));
    // Of the two directions of a pair, the upper one.
    assert_eq!(hit["id"], "dock-1-003--dock-1-002");
    let row = hit["row"].as_u64().unwrap() as u32;
    let details = parsed(&session.element("path", row).unwrap());
    let cells = details["cells"].as_array().unwrap();
    let speed = cells.iter().find(|cell| cell["name"] == "maxSpeed");
    assert_eq!(speed.unwrap()["value"], "0.3");
    assert_eq!(speed.unwrap()["unit"], "m/s");
    let outline = details["outline"][0].as_array().unwrap();
    assert_eq!(outline.first(), Some(&json!([36.0, 2.0])));
    assert_eq!(outline.last(), Some(&json!([36.0, 6.0])));
    let samples = parsed(&session.sample(row, 3.0).unwrap());
    let at = |y: f64, along_m: f64| {
        let up = std::f64::consts::FRAC_PI_2;
        json!({ "alongM": along_m, "x": 36.0, "y": y, "headingRad": up })
    };
    assert_eq!(samples, json!([at(2.0, 0.0), at(4.0, 2.0), at(6.0, 4.0)]));
    for (row, spacing_m) in [(9999, 1.0), (row, 0.0), (row, f64::NAN), (row, 1e-9)] {
        assert!(session.sample(row, spacing_m).is_err(), "{row} {spacing_m}");
    }
    let found = parsed(&session.find("dock-1-003--dock-1-002", 5));
    assert_eq!(found[0]["row"], row);
    assert!(session.element("path", 9999).is_err());
    let slow = parsed(&session.query("maxSpeed < 0.5", 3).unwrap());
    assert!(slow["all"].as_u64() > Some(3) && slow["elements"].as_array().unwrap().len() == 3);
    assert!(session.query("maxSpeed <", 3).is_err());
}

#[test]
fn files_and_pictures_are_those_of_the_library() {
    let mut session = site();
    let layout = guideway::open(Path::new(env!("CARGO_MANIFEST_DIR")).join(SITE)).unwrap();
    for format in ["geojson", "dxf", "opentcs"] {
        let target = Target::from_id(format).unwrap();
        let mut expected = Vec::new();
        target.write(&layout, &mut expected).unwrap();
        assert!(
            session.save(format).unwrap().bytes == expected,
            "{format} differs"
        );
    }
    assert!(session.save("docx").is_err());
    assert!(
        session
            .png(&look().to_string())
            .unwrap()
            .starts_with(b"\x89PNG")
    );
    let svg = session.curves(&look().to_string(), "svg").unwrap();
    assert!(svg.starts_with(b"<svg"));
    let has_image = |svg: &[u8]| String::from_utf8_lossy(svg).contains("<image");
    let mut density = look();
    density["shade"] = json!("density");
    let density = session.curves(&density.to_string(), "svg").unwrap();
    assert!(has_image(&density) && !has_image(&svg));
    let unchanged = parsed(&session.diff(&site(), 10));
    assert_eq!(unchanged["changes"], json!([]));
    let findings = parsed(&session.check(10));
    assert_eq!(findings["errors"], 0);
}

#[test]
fn wrong_looks_are_errors() {
    let mut session = site();
    for (key, value) in [
        ("width", json!(0)),
        ("colorBy", json!("maxSpeeed")),
        ("level", json!("roof")),
        ("background", json!("reddish")),
        ("shadow", json!(1)),
        ("pxPerM", json!(-1.0)),
    ] {
        let mut look = look();
        look[key] = value;
        let error = session.render(&look.to_string()).unwrap_err();
        assert!(!error.remedy.is_empty(), "{key}: {error}");
    }
}

#[test]
fn edits_are_those_of_scripts_and_can_be_taken_back() {
    let mut session = site();
    let find =
        |session: &Session, name: &str| parsed(&session.find(name, 1)).as_array().unwrap().len();
    let cell = |session: &Session, name: &str| {
        let row = parsed(&session.find("dock-1-002--dock-1-003", 1))[0]["row"].clone();
        let row = u32::try_from(row.as_u64().unwrap()).unwrap();
        let details = parsed(&session.element("path", row).unwrap());
        let cells = details["cells"].as_array().unwrap().clone();
        cells.into_iter().find(|cell| cell["name"] == name).unwrap()
    };
    let before = session.render(&look().to_string()).unwrap().rgba;
    let script = json!({ "steps": [
        { "do": "rename", "node": "cross-171", "to": "gate" },
        { "do": "set", "paths": ["dock-1-002--dock-1-003"], "property": "maxSpeed", "value": 0.5 },
        { "do": "delete", "paths": ["dock-1-002--dock-1-003"] },
    ]});
    let done = parsed(&session.edit(&script.to_string()).unwrap());
    assert_eq!(done["steps"][0]["names"], json!(["gate"]));
    assert_eq!(done["steps"][1]["paths"], 1);
    assert_eq!(done["steps"][2]["paths"], 1);
    assert_eq!(parsed(&session.info())["paths"], 325);
    assert_ne!(session.render(&look().to_string()).unwrap().rgba, before);

    // A step that fails leaves all as it was, and is refused in the words of the command.
    let failing = json!({ "steps": [
        { "do": "rename", "node": "gate", "to": "door" },
        { "do": "rename", "node": "nowhere", "to": "x" },
    ]});
    let error = session.edit(&failing.to_string()).unwrap_err();
    assert!(
        error.message.contains("step 2") && error.message.contains("nowhere"),
        "{error:?}"
    );
    assert_eq!(find(&session, "gate"), 1);

    assert!(session.undo() && !session.undo());
    assert_eq!(
        (
            find(&session, "gate"),
            parsed(&session.info())["paths"].as_u64()
        ),
        (0, Some(326))
    );
    assert_eq!(session.render(&look().to_string()).unwrap().rgba, before);
    assert_eq!(cell(&session, "maxSpeed")["value"], "0.3");
    assert_eq!(cell(&session, "maxSpeed")["edited"], "number");
    assert_eq!(cell(&session, "level")["edited"], Value::Null);
    assert!(session.redo() && !session.redo());
    assert_eq!(find(&session, "gate"), 1);
}

#[test]
fn a_drawing_that_travels_as_arrow_is_drawn_as_one() {
    let drawing = br#"<svg viewBox="0 0 9 9"><path stroke="black" d="M1 1L8 8"/></svg>"#;
    let layout = read_bytes("plan.svg", drawing, &ReadOptions::default()).unwrap();
    let mut bytes = Vec::new();
    Target::Arrow.write(&layout, &mut bytes).unwrap();
    let mut session = Session::open("plan.arrow", &&bytes[..], &NoProgress).unwrap();
    let is_drawing = |session: &Session| parsed(&session.info())["isDrawing"].clone();
    assert_eq!(is_drawing(&session), false);
    session.set_origin("SVG", "1.1");
    assert_eq!(is_drawing(&session), true);
}
