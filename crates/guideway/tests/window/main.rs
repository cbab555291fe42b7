//! The window, driven by real key and mouse events on a screen that nobody sees.
//!
//! Needs `Xvfb`, `xdotool` and a Vulkan driver, which `cargo xtask test` installs.
#![cfg(all(feature = "viewer", target_os = "linux"))]

mod desk;

use std::fs;
use std::io::BufReader;
use std::path::Path;
use std::process::Command;
use std::thread;
use std::time::Duration;

use desk::{Desk, MOST_TRIES, is_installed, looks};
use guideway::layout::{Layout, PathRef};
use guideway::spline::Point;

/// Scale of the window when all of the site is in it.
const PX_PER_M: f64 = 6.8;
const SITE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/site.lif.json");

/// Size and pixels of a PNG file.
fn read_png(path: &Path) -> (u32, u32, Vec<u8>) {
    let file = BufReader::new(fs::File::open(path).expect("the picture is there"));
    let mut reader = png::Decoder::new(file).read_info().expect("it is a PNG");
    let mut pixels = vec![0; reader.output_buffer_size().expect("it is of some size")];
    let info = reader.next_frame(&mut pixels).expect("it is whole");
    (info.width, info.height, pixels)
}

/// Holds a picture of the window, all of a file in it, to what `guideway render` makes of the file. Only the scale bar is
/// more.
fn assert_is_as_rendered(picture: &Path, file: &Path, rendered: &Path) {
    /// What the scale bar may cover, from the lower left corner.
    const BAR_PX: (usize, usize) = (700, 240);
    let (width, height, of_window) = read_png(picture);
    let status = Command::new(env!("CARGO_BIN_EXE_guideway"))
        .args(["render", "--quiet", "--size", &format!("{width}x{height}")])
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
fn a_site_is_edited_by_keys_and_mouse_and_saved() {
    if !is_installed() {
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let site = folder.path().join("site.lif.json");
    fs::copy(SITE, &site).unwrap();
    let paths = guideway::open(&site).unwrap().paths.len();
    let mut desk = Desk::with(&[&site]).expect("Xvfb starts");

    let first = desk.saved_as(&folder.path().join("same.arrow"));
    assert_eq!(first.paths.len(), paths);

    // All of it, and nothing but paths.
    desk.keys(&["f", "a", "n", "l", "g"]);
    let picture = folder.path().join("site.png");
    assert!(desk.answer("ctrl+e", &picture));
    assert!(looks().any(|()| picture.exists()));
    assert_is_as_rendered(&picture, &site, &folder.path().join("rendered.png"));

    desk.keys(&["ctrl+a", "ctrl+d"]);
    let doubled = desk.saved_as(&folder.path().join("doubled.arrow"));
    assert_eq!(doubled.paths.len(), 2 * paths);

    desk.keys(&["Delete"]);
    let copies_gone = desk.saved_as(&folder.path().join("gone.arrow"));
    assert_eq!(copies_gone.paths.len(), paths, "the copies were selected");

    desk.keys(&["d"]);
    for (x, y) in [(200, 200), (400, 300), (600, 250)] {
        desk.click(x, y);
    }
    desk.keys(&["Return"]);
    let drawn = desk.saved_as(&folder.path().join("drawn.arrow"));
    assert_eq!(drawn.paths.len(), paths + 1);

    desk.keys(&["ctrl+z"]);
    let undone = desk.saved_as(&folder.path().join("undone.arrow"));
    assert_eq!(undone.paths.len(), paths);

    desk.xdotool(&["mousemove", "400", "400", "click", "--repeat", "5", "4"]);
    desk.keys(&["Left", "f", "b", "ctrl+q"]);
    let status = desk.ended().expect("it ends when it is asked to");
    assert!(status.success(), "{status}");
}

#[test]
fn what_a_hand_has_done_outlives_a_crash() {
    if !is_installed() {
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let file = |name| folder.path().join(name);
    fs::copy(SITE, file("site.lif.json")).unwrap();
    let mut desk = Desk::with(&[&file("site.lif.json")]).expect("Xvfb starts");
    let before = desk.saved_as(&file("before.arrow"));
    let site = file("moved.arrow");
    // A window that is kept waiting may see no more of a drag than a click.
    let mut tries = (0..MOST_TRIES).map(|_| {
        desk.keys(&["f"]);
        thread::sleep(Duration::from_secs(1));
        // A box about the mezzanine, which is by itself at the top; then one of its paths, and all with it.
        desk.drag(&[(590, 130), (600, 140), (800, 200), (875, 215)]);
        desk.drag(&[(700, 145), (700, 140), (705, 120), (710, 105)]);
        // What was written by the last try is no answer to this one.
        let _ = fs::remove_file(&site);
        desk.saved_as(&site)
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
    assert!(looks().any(|()| written() > 0));
    let before = written();
    desk.keys(&["Delete"]);
    assert!(looks().any(|()| written() > before));
    desk.crash(&[&site]);
    assert!(
        looks().any(|()| desk.is_asked()),
        "whether the work of last time is to be done again"
    );
    let is_clicked = (0..MOST_TRIES).any(|_| {
        desk.click(498, 409);
        !desk.is_asked()
    });
    assert!(is_clicked);
    let again = desk.saved_as(&file("again.arrow"));
    let rest = moved.paths.iter().filter(|path| !is_of_mezzanine(path));
    assert!(
        again
            .paths
            .iter()
            .map(|path| path.id())
            .eq(rest.map(|path| path.id()))
    );
}
