use std::fs;
use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Child, Command, ExitStatus, Stdio};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::Duration;

use guideway::layout::Layout;
use tempfile::TempDir;

/// How often something is looked for before it is given up.
const MOST_LOOKS: usize = 600;
pub(super) const MOST_TRIES: u32 = 20;

/// Two at once would take time from each other, which keys and clicks do not wait for.
static ONE: Mutex<()> = Mutex::new(());

/// A screen with a viewer on it; both end with the test.
pub(super) struct Desk {
    _alone: MutexGuard<'static, ()>,
    screen: Child,
    pub(super) viewer: Child,
    display: String,
    /// Where the screen keeps its pixels, as a file of the X window dump format.
    pixels: TempDir,
}

impl Desk {
    /// None where this computer lacks a screen to run on.
    pub(super) fn with(files: &[&Path]) -> Option<Self> {
        let pixels = tempfile::tempdir().ok()?;
        let mut screen = Command::new("Xvfb")
            .arg("-fbdir")
            .arg(pixels.path())
            .args([
                "-displayfd",
                "1",
                "-screen",
                "0",
                "1280x800x24",
                "-nolisten",
                "tcp",
                // Else it starts anew when its only viewer crashes, and refuses the next one meanwhile.
                "-noreset",
                // Else a key whose release is late counts several times.
                "-r",
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
        let desk = Self {
            _alone: ONE.lock().unwrap_or_else(PoisonError::into_inner),
            viewer: start(&display, files),
            screen,
            display,
            pixels,
        };
        desk.focus();
        Some(desk)
    }

    /// The viewer comes down with no chance to tidy up, and is started again.
    pub(super) fn crash(&mut self, files: &[&Path]) {
        self.viewer.kill().expect("it still runs");
        self.viewer.wait().expect("it ends");
        self.viewer = start(&self.display, files);
        self.focus();
    }

    fn focus(&self) {
        // Without a window manager nothing else gives the window the keyboard.
        let window = ["search", "--sync", "--onlyvisible", "--name", "Guideway"];
        let focus = ["windowsize", "1280", "800", "windowfocus", "--sync"];
        self.xdotool(&[&window[..], &focus].concat());
    }

    pub(super) fn xdotool(&self, args: &[&str]) {
        let status = Command::new("xdotool")
            .args(args)
            .env("DISPLAY", &self.display)
            .stdout(Stdio::null())
            .status()
            .expect("xdotool starts");
        assert!(status.success(), "xdotool {args:?}");
    }

    pub(super) fn keys(&self, keys: &[&str]) {
        for key in keys {
            self.xdotool(&["key", key]);
            thread::sleep(Duration::from_millis(100));
        }
    }

    pub(super) fn type_text(&self, text: &str) {
        self.xdotool(&["type", "--delay", "20", text]);
    }

    pub(super) fn click(&self, x: u32, y: u32) {
        self.xdotool(&["mousemove", &x.to_string(), &y.to_string()]);
        thread::sleep(Duration::from_millis(100));
        self.xdotool(&["click", "1"]);
        // So that the next one is no double click.
        thread::sleep(Duration::from_millis(600));
    }

    /// Drags from the first of these places to the last.
    pub(super) fn drag(&self, places: &[(u32, u32)]) {
        for (i, (x, y)) in places.iter().enumerate() {
            self.xdotool(&["mousemove", &x.to_string(), &y.to_string()]);
            thread::sleep(Duration::from_millis(300));
            if i == 0 {
                self.xdotool(&["mousedown", "1"]);
                thread::sleep(Duration::from_millis(300));
            }
        }
        self.xdotool(&["mouseup", "1"]);
        thread::sleep(Duration::from_millis(600));
    }

    /// Waits until the viewer ends by itself.
    pub(super) fn ended(&mut self) -> Option<ExitStatus> {
        looks().find_map(|()| self.viewer.try_wait().expect("it was started"))
    }

    /// Saves as another file and reads that: what is seen is what is written.
    pub(super) fn saved_as(&self, path: &Path) -> Layout {
        let saved = (0..MOST_TRIES).find_map(|_| self.try_to_save_as(path));
        saved.unwrap_or_else(|| panic!("{} was not written", path.display()))
    }

    /// None where there is nothing to save, such as a file that is not read yet.
    fn try_to_save_as(&self, path: &Path) -> Option<Layout> {
        let is_answered = self.answer("ctrl+shift+s", path);
        let is_written = is_answered && looks().take(30).any(|()| path.exists());
        is_written.then(|| guideway::open(path).expect("what was saved can be read"))
    }

    /// Names a file where these keys have the window ask for one. What is typed before it asks would be taken for
    /// commands, such as to hide what is selected. False if it does not ask.
    pub(super) fn answer(&self, keys: &str, path: &Path) -> bool {
        self.keys(&[keys]);
        let is_asked = looks().take(30).any(|()| self.is_asked());
        if is_asked {
            self.keys(&["ctrl+a"]);
            self.type_text(&path.display().to_string());
            self.keys(&["Return"]);
        }
        is_asked
    }

    /// Whether the window asks something: all else, which is mostly white, is gray then.
    pub(super) fn is_asked(&self) -> bool {
        const COLOR_BYTES: usize = 12;
        let file = self.pixels.path().join("Xvfb_screen0");
        let dump = fs::read(file).expect("the screen is on");
        let number = |index: usize| {
            let bytes = dump[4 * index..][..4].try_into();
            u32::from_be_bytes(bytes.expect("four of them")) as usize
        };
        let (header_len, color_count) = (number(0), number(19));
        let (pixels, _) = dump[header_len + COLOR_BYTES * color_count..].as_chunks::<4>();
        let is_dimmed = |pixel: &&[u8; 4]| {
            let [first, second, third, _] = **pixel;
            first == second && second == third && (128..192).contains(&first)
        };
        pixels.iter().filter(is_dimmed).count() > pixels.len() / 2
    }
}

/// Starts the viewer with files on a screen.
fn start(display: &str, files: &[&Path]) -> Child {
    Command::new(env!("CARGO_BIN_EXE_guideway"))
        .args(["view", "--method", "cpu"])
        .args(files)
        .env("DISPLAY", display)
        .env_remove("WAYLAND_DISPLAY")
        // The recent files of whoever runs the tests stay as they are.
        .env("XDG_STATE_HOME", files[0].with_file_name("state"))
        .spawn()
        .expect("the command starts")
}

/// A tenth of a second apart, as long as anything is waited for.
pub(super) fn looks() -> impl Iterator<Item = ()> {
    (0..MOST_LOOKS).map(|_| thread::sleep(Duration::from_millis(100)))
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

pub(super) fn is_installed() -> bool {
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
