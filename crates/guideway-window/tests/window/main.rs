//! Tests of the window with real key and mouse events on a virtual screen.
//!
//! They need `Xvfb`, `xdotool` and a Vulkan driver, which `cargo xtask test` installs, and the
//! command, which the workspace builds beside the window.
#![cfg(target_os = "linux")]

mod session;

use std::collections::BTreeSet;
use std::fs;
use std::io::BufReader;
use std::path::Path;
use std::thread;
use std::time::Duration;

use guideway::layout::{Layout, PathRef};
use guideway::spline::Point;
use session::{MAX_TRIES, WindowSession, is_installed, polls};

/// Width of the canvas, in pixels.
const CANVAS_PX: f64 = 960.0;
/// Scale of the window when it fits the site.
const PX_PER_M: f64 = 6.8;
const SITE: &str = concat!(
    env!("CARGO_MANIFEST_DIR"),
    "/../guideway/examples/site.lif.json"
);

/// Size and pixels of a PNG file.
fn read_png(path: &Path) -> (u32, u32, Vec<u8>) {
    let file = BufReader::new(fs::File::open(path).expect("the picture is there"));
    let mut reader = png::Decoder::new(file).read_info().expect("it is a PNG");
    let mut pixels = vec![0; reader.output_buffer_size().expect("it is of some size")];
    let info = reader.next_frame(&mut pixels).expect("it is whole");
    (info.width, info.height, pixels)
}

/// Asserts that an exported picture of the window equals the output of `guideway render` with lines
/// that are as wide on the page, except for the scale bar.
fn assert_equals_render(picture: &Path, file: &Path, rendered: &Path) {
    /// Size of the area of the scale bar, from the lower left corner.
    const BAR_PX: (usize, usize) = (700, 240);
    let (width, height, of_window) = read_png(picture);
    let factor = f64::from(width) / CANVAS_PX;
    let status = session::command()
        .args(["render", "--quiet", "--size", &format!("{width}x{height}")])
        // The color of paths in the window.
        .args(["--path-color", "5a6b7f"])
        .args(["--min-px", &format!("{}", 1.5 * factor)])
        .args(["--max-px", &format!("{}", 12.0 * factor)])
        .arg(file)
        .arg("-o")
        .arg(rendered)
        .status();
    assert!(status.expect("the command starts").success());
    let (.., of_command) = read_png(rendered);
    assert_eq!(of_window.len(), of_command.len());
    let rows = |pixels: Vec<u8>| {
        let rows = pixels.chunks_exact(4 * width as usize).enumerate();
        let below = height as usize - BAR_PX.1;
        let beside = |(y, row): (usize, &[u8])| {
            let from = if y < below { 0 } else { 4 * BAR_PX.0 };
            row[from..].to_vec()
        };
        rows.map(beside).collect::<Vec<_>>()
    };
    let (of_window, of_command) = (rows(of_window), rows(of_command));
    let other = of_window.iter().zip(&of_command).position(|(a, b)| a != b);
    assert_eq!(other, None, "the first row that differs");
    let is_blank = |row: &Vec<u8>| row.iter().all(|&value| value == 255);
    assert!(!of_command.iter().all(is_blank));
}

#[test]
fn measuring_leaves_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let site = folder.path().join("site.lif.json");
    fs::copy(SITE, &site).unwrap();
    let measured = session::command()
        .args(["view", "--measure", "--json"])
        .arg(&site)
        .output();
    let measured = measured.expect("the command starts");
    assert_eq!(measured.status.code(), Some(0), "{measured:?}");
    let report: serde_json::Value = serde_json::from_slice(&measured.stdout).unwrap();
    assert_eq!(report["guideway"]["report"], "view");
    let schema = session::command().args(["schema", "view"]).output();
    let schema: serde_json::Value = serde_json::from_slice(&schema.unwrap().stdout).unwrap();
    let keys = |value: &serde_json::Value| -> BTreeSet<String> {
        value.as_object().unwrap().keys().cloned().collect()
    };
    let of_view = &schema["$defs"]["view"]["properties"];
    assert_eq!(keys(&report), keys(of_view));
    let of_movement = &of_view["movements"]["items"]["properties"];
    assert_eq!(keys(&report["movements"][0]), keys(of_movement));
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
}

#[test]
fn keys_and_mouse_edit_and_save_a_site() {
    if !is_installed() {
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let site = folder.path().join("site.lif.json");
    fs::copy(SITE, &site).unwrap();
    let paths = guideway::open(&site).unwrap().paths.len();
    let mut session = WindowSession::with(&[&site]).expect("Xvfb starts");

    let first = session.saved_as(&folder.path().join("same.arrow"));
    assert_eq!(first.paths.len(), paths);

    // Fits the site and hides everything but the paths.
    session.keys(&["f", "a", "n", "l", "g"]);
    let picture = folder.path().join("site.png");
    assert!(session.fill_dialog("ctrl+e", &picture));
    assert!(polls().any(|()| picture.exists()));
    assert_equals_render(&picture, &site, &folder.path().join("rendered.png"));

    session.keys(&["ctrl+a", "ctrl+d"]);
    let doubled = session.saved_as(&folder.path().join("doubled.arrow"));
    assert_eq!(doubled.paths.len(), 2 * paths);

    session.keys(&["Delete"]);
    let copies_gone = session.saved_as(&folder.path().join("gone.arrow"));
    assert_eq!(copies_gone.paths.len(), paths, "the copies were selected");

    // A curve below the site, away from what it would snap to.
    session.keys(&["c"]);
    for (x, y) in [(150, 715), (300, 735), (450, 715)] {
        session.click(x, y);
    }
    session.keys(&["Return"]);
    let drawn = session.saved_as(&folder.path().join("drawn.arrow"));
    assert_eq!(drawn.paths.len(), paths + 1);

    session.keys(&["ctrl+z"]);
    let undone = session.saved_as(&folder.path().join("undone.arrow"));
    assert_eq!(undone.paths.len(), paths);

    session.xdotool(&["mousemove", "400", "400", "click", "--repeat", "5", "4"]);
    session.keys(&["Left", "f", "b", "ctrl+q"]);
    let status = session
        .wait_for_exit()
        .expect("the window closes on Ctrl+Q");
    assert!(status.success(), "{status}");
}

#[test]
fn edits_survive_a_crash() {
    if !is_installed() {
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let file = |name| folder.path().join(name);
    fs::copy(SITE, file("site.lif.json")).unwrap();
    let mut session = WindowSession::with(&[&file("site.lif.json")]).expect("Xvfb starts");
    let before = session.saved_as(&file("before.arrow"));
    let site = file("moved.arrow");
    // A busy window may see a drag as a click.
    let mut tries = (0..MAX_TRIES).map(|_| {
        session.keys(&["f"]);
        thread::sleep(Duration::from_secs(1));
        // Selects the mezzanine by a box, then drags one of its paths, which moves the selection.
        session.drag(&[(590, 142), (600, 152), (800, 212), (875, 227)]);
        session.drag(&[(700, 157), (700, 152), (705, 132), (710, 117)]);
        // The file of the last try would hide a failure of this one.
        let _ = fs::remove_file(&site);
        session.saved_as(&site)
    });
    let ends = |layout: &Layout| {
        layout
            .paths
            .iter()
            .map(|path| path.ends())
            .collect::<Vec<_>>()
    };
    let moved = tries.find(|moved| ends(moved) != ends(&before));
    let moved = moved.expect("it has moved");
    let is_of_mezzanine = |path: &PathRef<'_>| path.id().starts_with("mezzanine");
    let mut ways_m = Vec::new();
    for (before, after) in before.paths.iter().zip(moved.paths.iter()) {
        let ends_m = before.ends().zip(after.ends());
        let ((from, _), (to, _)) = ends_m.expect("it is a line");
        match is_of_mezzanine(&after) {
            true => ways_m.push(to - from),
            false => assert_eq!(from, to, "{}", after.id()),
        }
    }
    let way_m = ways_m[0];
    let by_m = Point::new(10.0, 40.0) * (1.0 / PX_PER_M);
    assert!(way_m.distance(by_m) < 0.3, "{way_m:?}");
    assert!(
        ways_m.iter().all(|way| way.distance(way_m) < 1e-4),
        "{ways_m:?}"
    );

    let journal = file(".moved.arrow.guideway-journal");
    let written = || fs::metadata(&journal).map_or(0, |of| of.len());
    assert!(polls().any(|()| written() > 0));
    let before = written();
    session.keys(&["Delete"]);
    assert!(polls().any(|()| written() > before));
    session.crash(&[&site]);
    assert!(
        polls().any(|()| session.has_dialog()),
        "the window offers to recover the unsaved work"
    );
    let is_clicked = (0..MAX_TRIES).any(|_| {
        session.click(485, 417);
        !session.has_dialog()
    });
    assert!(is_clicked);
    let again = session.saved_as(&file("again.arrow"));
    let rest = moved.paths.iter().filter(|path| !is_of_mezzanine(path));
    assert!(
        again
            .paths
            .iter()
            .map(|path| path.id())
            .eq(rest.map(|path| path.id()))
    );
}
