//! Tests of what `guideway render` chooses by itself, and of the formats of pictures.

use std::fs;
use std::path::Path;

use crate::support::{command, ink, json, names_in, read_png, render, run, site, stderr, stdout};

fn text(path: &Path) -> &str {
    path.to_str().expect("UTF-8")
}

/// The first pixel of a PNG file.
fn corner(path: &Path) -> [u8; 4] {
    let pixels = read_png(path).2;
    [pixels[0], pixels[1], pixels[2], pixels[3]]
}

#[test]
fn pdf_and_svg_go_to_files_and_to_standard_output() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("a.pdf");
    let args = ["--size", "640x360", "--site", "--color-by", "maxSpeed"];
    let output = render(&file, &args);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let pdf = fs::read(&file).unwrap();
    assert!(pdf.starts_with(b"%PDF-1.6") && pdf.ends_with(b"%%EOF\n"));
    let begin = String::from_utf8_lossy(&pdf[..1000.min(pdf.len())]).into_owned();
    assert!(begin.contains("/MediaBox[0 0 480 270]"), "{begin}");
    let streamed = render(Path::new("-"), &[&args[..], &["--to", "pdf"]].concat());
    assert!(streamed.stdout == pdf, "{}", stderr(&streamed));
    let svg = render(Path::new("-"), &["--to", "svg"]);
    assert!(stdout(&svg).starts_with("<svg"), "{}", stderr(&svg));
    assert!(stderr(&svg).contains("drawn by svg"), "{}", stderr(&svg));
    let nameless = folder.path().join("picture");
    assert!(render(&nameless, &["--to", "svg"]).status.success());
    let both = render(&folder.path().join("b.png"), &["--to", "svg"]);
    assert_eq!(both.status.code(), Some(2));
    assert_eq!(names_in(folder.path()), ["a.pdf", "picture"]);
}

#[test]
fn density_goes_into_pdf_and_svg_with_its_scale() {
    let folder = tempfile::tempdir().unwrap();
    for name in ["a.svg", "a.pdf"] {
        let file = folder.path().join(name);
        let output = render(&file, &["--size", "640x360", "--shade", "density"]);
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    }
    let svg = fs::read_to_string(folder.path().join("a.svg")).unwrap();
    assert!(svg.contains("data:image/png;base64,") && svg.contains("paths per pixel"));
    assert!(!svg.contains("<path id="), "curves would show through");
    let pdf = fs::read(folder.path().join("a.pdf")).unwrap();
    let sizes = b"/Width 2560/Height 1440";
    assert!(pdf.windows(sizes.len()).any(|bytes| bytes == sizes));
}

#[test]
fn a_background_of_none_is_transparent() {
    let folder = tempfile::tempdir().unwrap();
    let png = folder.path().join("a.png");
    assert!(render(&png, &["--background", "none"]).status.success());
    assert_eq!(corner(&png)[3], 0);
    assert!(render(&png, &[]).status.success());
    assert_eq!(corner(&png), [255; 4]);
    let svg = folder.path().join("a.svg");
    assert!(render(&svg, &["--background", "none"]).status.success());
    assert!(!fs::read_to_string(&svg).unwrap().contains("<rect"));
}

#[test]
fn a_crowd_is_shown_as_density_with_its_scale() {
    let folder = tempfile::tempdir().unwrap();
    let crowd = folder.path().join("crowd.arrow");
    let made = run(["generate", "d2", "--paths", "30k", "-o", text(&crowd)]);
    assert!(made.status.success(), "{}", stderr(&made));
    let picture = folder.path().join("a.png");
    let drawn = |more: &[&str]| {
        let args = [
            "render",
            text(&crowd),
            "-o",
            text(&picture),
            "--size",
            "400x300",
            "--json",
        ];
        let report = json(&run([&args, more].concat()), "render");
        let notes = report["notes"].to_string();
        (report["legend"].clone(), notes.contains("--shade lines"))
    };
    let (legend, is_chosen) = drawn(&[]);
    assert!(is_chosen);
    assert_eq!(legend["column"], "paths per pixel");
    let first = &legend["entries"][0];
    assert_eq!(first["label"], "1");
    for asked in [
        &["--shade", "lines"][..],
        &["--path-color", "0000ff"],
        &["--color-by", "kind"],
        &["--plain"],
    ] {
        let (legend, is_chosen) = drawn(asked);
        assert!(
            !is_chosen && legend["column"] != "paths per pixel",
            "{asked:?}"
        );
    }
    let few = json(&render(&picture, &["--json"]), "render");
    assert!(few["legend"].is_null(), "a site is no crowd");
}

#[test]
fn drawings_have_hairlines_and_ways_two_pixels() {
    let folder = tempfile::tempdir().unwrap();
    let plan = folder.path().join("plan.dxf");
    assert!(
        run(["convert", text(&site()), text(&plan)])
            .status
            .success()
    );
    let picture = folder.path().join("a.png");
    let inked = |file: &Path, more: &[&str]| {
        let mut all = command();
        all.arg("render").arg(file).arg("-o").arg(&picture);
        let output = all.args(["--size", "300x300"]).args(more).output().unwrap();
        assert!(output.status.success(), "{}", stderr(&output));
        ink(&read_png(&picture).2)
    };
    let near = ["--center", "40,14", "--scale", "40"];
    let plain = inked(&plan, &[&near[..], &["--plain"]].concat());
    let hairlines = inked(&plan, &near);
    assert!(hairlines * 2 < plain, "{hairlines} of {plain}");
    let (ways, wide) = (inked(&site(), &[]), inked(&site(), &["--min-px", "6"]));
    assert!(ways * 3 / 2 < wide, "{ways} of {wide}");
}

#[test]
fn levels_stand_side_by_side() {
    let folder = tempfile::tempdir().unwrap();
    let each = folder.path().join("each.png");
    let args = ["--level", "each", "--size", "800x300", "--json"];
    let report = json(&render(&each, &args), "render");
    assert_eq!(report["paths"]["drawn"], report["paths"]["total"]);
    let (width, height, pixels) = read_png(&each);
    assert_eq!((width, height), (800, 300));
    let half = |from: usize| {
        let rows = pixels.chunks_exact(4 * 800);
        let inked = rows.map(|row| ink(&row[4 * from..4 * (from + 400)]));
        inked.sum::<usize>()
    };
    assert!(
        half(0) > 1000 && half(400) > 100,
        "{} {}",
        half(0),
        half(400)
    );
    // Their curves are those of the site, each once.
    let svg = folder.path().join("each.svg");
    let report = json(&render(&svg, &args), "render");
    assert_eq!(report["paths"]["drawn"], report["paths"]["total"]);
    assert_eq!(report["size_px"], serde_json::json!([800, 300]));
    let drawn = fs::read_to_string(&svg).unwrap();
    for (part, count) in [("<svg x=", 2), (r#"id="dock-1-002--dock-1-003""#, 1)] {
        assert_eq!(drawn.matches(part).count(), count, "{part}");
    }
    let info = json(&run(["info", text(&svg), "--json"]), "info");
    assert!(info["paths"].as_u64() >= report["paths"]["total"].as_u64());
    let pdf = render(
        Path::new("-"),
        &["--level", "each", "--to", "pdf", "--size", "80x30"],
    );
    assert!(pdf.stdout.starts_with(b"%PDF"), "{}", stderr(&pdf));
    let placed = render(&each, &["--level", "each", "--world-file"]);
    assert_eq!(placed.status.code(), Some(2));
    assert!(stderr(&placed).contains("one view"), "{}", stderr(&placed));
}

#[test]
fn pictures_have_a_size_on_paper() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("a.png");
    // 96 dpi are 3780 pixels per meter; a picture of twice the height has twice as many.
    for (size, px_per_m) in [("1920x1080", 3780), ("3840x2160", 7559)] {
        assert!(render(&file, &["--size", size]).status.success());
        let bytes = std::io::BufReader::new(fs::File::open(&file).unwrap());
        let info = png::Decoder::new(bytes).read_info().unwrap();
        let printed = info.info().pixel_dims.expect("a size on paper");
        assert_eq!((printed.xppu, printed.yppu), (px_per_m, px_per_m), "{size}");
        assert!(matches!(printed.unit, png::Unit::Meter));
    }
}

#[test]
fn findings_have_a_picture() {
    let folder = tempfile::tempdir().unwrap();
    let broken = folder.path().join("broken.lif.json");
    let whole = fs::read_to_string(site()).unwrap();
    let moved = whole.replace(r#""nodePosition":{"x":"#, r#""nodePosition":{"x":1"#);
    assert_ne!(moved, whole);
    // The finding about this end has the place of its edge in the file.
    let end = r#""endNodeId":"dock-1-003""#;
    assert!(moved.contains(end));
    fs::write(&broken, moved.replacen(end, r#""endNodeId":"none""#, 1)).unwrap();
    let svg = folder.path().join("a.svg");
    let checked = run(["check", text(&broken), "--picture", text(&svg)]);
    assert!(checked.status.code() < Some(2), "{}", stderr(&checked));
    let drawn = fs::read_to_string(&svg).unwrap();
    for part in ["node-gap", "broken.lif.json: ", "#e07800", "#d62728"] {
        assert!(drawn.contains(part), "{part}");
    }
    let two = run([
        "check",
        text(&broken),
        text(&site()),
        "--picture",
        text(&svg),
    ]);
    assert_eq!(two.status.code(), Some(2));
    assert!(stderr(&two).contains("one file"), "{}", stderr(&two));
}
