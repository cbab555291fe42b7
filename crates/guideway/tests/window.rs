//! The window, driven by real key and mouse events on a screen that nobody sees.
//!
//! Needs `Xvfb`, `xdotool` and a Vulkan driver, which `cargo xtask test` installs.
#![cfg(all(feature = "viewer", target_os = "linux"))]

use std::fs;
use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::thread;
use std::time::Duration;

use guideway::layout::Layout;

const SITE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/site.lif.json");
/// How often something is looked for, a tenth of a second apart, before it is given up.
const MOST_LOOKS: u32 = 600;
const MOST_TRIES: u32 = 20;

/// A screen with a viewer on it; both end with the test.
struct Desk {
    screen: Child,
    viewer: Child,
    display: String,
}

impl Desk {
    /// None where this computer lacks a screen to run on.
    fn with(files: &[&Path]) -> Option<Self> {
        let mut screen = Command::new("Xvfb")
            .args([
                "-displayfd",
                "1",
                "-screen",
                "0",
                "1280x800x24",
                "-nolisten",
                "tcp",
            ])
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .ok()?;
        let mut number = String::new();
        BufReader::new(screen.stdout.take()?)
            .read_line(&mut number)
            .ok()?;
        let display = format!(":{}", number.trim());
        let viewer = Command::new(env!("CARGO_BIN_EXE_guideway"))
            .args(["view", "--method", "cpu"])
            .args(files)
            .env("DISPLAY", &display)
            .env_remove("WAYLAND_DISPLAY")
            // The recent files of whoever runs the tests stay as they are.
            .env("XDG_STATE_HOME", files[0].with_file_name("state"))
            .spawn()
            .expect("the command starts");
        let desk = Self {
            screen,
            viewer,
            display,
        };
        // Without a window manager nothing else gives the window the keyboard.
        let window = ["search", "--sync", "--onlyvisible", "--name", "Guideway"];
        let focus = ["windowsize", "1280", "800", "windowfocus", "--sync"];
        desk.xdotool(&[&window[..], &focus].concat());
        Some(desk)
    }

    fn xdotool(&self, args: &[&str]) {
        let status = Command::new("xdotool")
            .args(args)
            .env("DISPLAY", &self.display)
            .stdout(Stdio::null())
            .status()
            .expect("xdotool starts");
        assert!(status.success(), "xdotool {args:?}");
    }

    fn keys(&self, keys: &[&str]) {
        for key in keys {
            self.xdotool(&["key", key]);
            thread::sleep(Duration::from_millis(100));
        }
    }

    fn type_text(&self, text: &str) {
        self.xdotool(&["type", "--delay", "20", text]);
    }

    fn click(&self, x: u32, y: u32) {
        self.xdotool(&["mousemove", &x.to_string(), &y.to_string()]);
        thread::sleep(Duration::from_millis(100));
        self.xdotool(&["click", "1"]);
        // So that the next one is no double click.
        thread::sleep(Duration::from_millis(600));
    }

    /// Saves as another file and reads that: what is seen is what is written. Where the file to be saved is not
    /// read yet there is nothing to save, so it is asked for again.
    fn saved_as(&self, path: &Path) -> Layout {
        for _ in 0..MOST_TRIES {
            self.keys(&["ctrl+shift+s"]);
            thread::sleep(Duration::from_millis(500));
            self.keys(&["ctrl+a"]);
            self.type_text(&path.display().to_string());
            self.keys(&["Return"]);
            for _ in 0..30 {
                if path.exists() {
                    return guideway::open(path).expect("what was saved can be read");
                }
                thread::sleep(Duration::from_millis(100));
            }
        }
        panic!("{} was not written", path.display());
    }
}

impl Drop for Desk {
    fn drop(&mut self) {
        for child in [&mut self.viewer, &mut self.screen] {
            // It may have ended by itself, which is as well.
            let _ = child.kill();
            let _ = child.wait();
        }
    }
}

fn is_installed() -> bool {
    let runs = |program: &str| Command::new(program).arg("-version").output().is_ok();
    let has_driver = guideway::methods()
        .iter()
        .any(|m| m.info.name == "gpu" && m.why_not.is_none());
    let is_there = runs("Xvfb") && runs("xdotool") && has_driver;
    assert!(
        is_there || std::env::var("GUIDEWAY_REQUIRE_DEVICES").as_deref() != Ok("1"),
        "Xvfb, xdotool or a Vulkan driver is missing"
    );
    if !is_there {
        println!("SKIPPED: this needs Xvfb, xdotool and a Vulkan driver");
    }
    is_there
}

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
    desk.keys(&["ctrl+e"]);
    thread::sleep(Duration::from_millis(500));
    desk.keys(&["ctrl+a"]);
    desk.type_text(&picture.display().to_string());
    desk.keys(&["Return"]);
    let is_written = (0..MOST_LOOKS).any(|_| {
        thread::sleep(Duration::from_millis(100));
        picture.exists()
    });
    assert!(is_written);
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
    for _ in 0..MOST_LOOKS {
        if let Some(status) = desk.viewer.try_wait().unwrap() {
            assert!(status.success(), "{status}");
            return;
        }
        thread::sleep(Duration::from_millis(100));
    }
    panic!("it does not end when it is asked to");
}
