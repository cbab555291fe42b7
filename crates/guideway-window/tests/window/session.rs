//! A window on a virtual screen, driven by `xdotool`.

use std::fs;
use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Child, Command, ExitStatus, Stdio};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::Duration;

use guideway::layout::Layout;
use tempfile::TempDir;

/// Polls before a wait fails: one minute.
const MAX_POLLS: usize = 600;
pub(super) const MAX_TRIES: u32 = 20;

/// One session at a time: keys and clicks do not wait for a window slowed down by another.
static EXCLUSIVE: Mutex<()> = Mutex::new(());

/// A virtual screen with a window; both end with the test.
pub(super) struct WindowSession {
    _exclusive: MutexGuard<'static, ()>,
    screen: Child,
    pub(super) viewer: Child,
    display: String,
    /// Folder of the file with the pixels of the screen, in the X window dump format.
    pixels: TempDir,
}

impl WindowSession {
    /// Starts a screen and a window with files. `None` if no screen starts.
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
                // Keeps the screen alive when its only client crashes.
                "-noreset",
                // No key repeat: a late release would count several times.
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
        let session = Self {
            _exclusive: EXCLUSIVE.lock().unwrap_or_else(PoisonError::into_inner),
            viewer: start(&display, files),
            screen,
            display,
            pixels,
        };
        session.focus();
        Some(session)
    }

    /// Kills the window without a chance to clean up, and starts it again.
    pub(super) fn crash(&mut self, files: &[&Path]) {
        self.viewer.kill().expect("it still runs");
        self.viewer.wait().expect("it ends");
        self.viewer = start(&self.display, files);
        self.focus();
    }

    fn focus(&self) {
        // Without a window manager the window does not receive the keyboard focus.
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
        // Longer than the interval of a double click.
        thread::sleep(Duration::from_millis(600));
    }

    /// Drags from the first position over the others to the last.
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

    /// Waits until the window closes.
    pub(super) fn wait_for_exit(&mut self) -> Option<ExitStatus> {
        polls().find_map(|()| self.viewer.try_wait().expect("it was started"))
    }

    /// Saves under another name and reads the file.
    pub(super) fn saved_as(&self, path: &Path) -> Layout {
        let saved = (0..MAX_TRIES).find_map(|_| self.try_to_save_as(path));
        saved.unwrap_or_else(|| panic!("{} was not written", path.display()))
    }

    /// `None` if there is nothing to save, such as a file that is not read yet.
    fn try_to_save_as(&self, path: &Path) -> Option<Layout> {
        let is_filled = self.fill_dialog("ctrl+shift+s", path);
        let is_written = is_filled && polls().take(30).any(|()| path.exists());
        is_written.then(|| guideway::open(path).expect("what was saved can be read"))
    }

    /// Opens a file dialog by keys and types a file name into it. Returns false if no dialog opens:
    /// text typed without a dialog would be taken for commands.
    pub(super) fn fill_dialog(&self, keys: &str, path: &Path) -> bool {
        self.keys(&[keys]);
        let has_dialog = polls().take(30).any(|()| self.has_dialog());
        if has_dialog {
            self.keys(&["ctrl+a"]);
            self.type_text(&path.display().to_string());
            self.keys(&["Return"]);
        }
        has_dialog
    }

    /// Returns `true` if a dialog is open: it dims the rest of the window, which is mostly white,
    /// to gray.
    pub(super) fn has_dialog(&self) -> bool {
        const COLOR_BYTES: usize = 12;
        let file = self.pixels.path().join("Xvfb_screen0");
        let dump = fs::read(file).expect("the screen runs");
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

/// The command beside the program of the window, which it starts.
pub(super) fn command() -> Command {
    let command = Path::new(env!("CARGO_BIN_EXE_guideway-window")).with_file_name("guideway");
    assert!(
        command.exists(),
        "build the command too: cargo build --workspace"
    );
    Command::new(command)
}

/// Starts a window with files on a screen.
fn start(display: &str, files: &[&Path]) -> Child {
    let state = files[0].with_file_name("state");
    // The dialogs of a desktop, if there is one, would be no part of the window.
    let settings = state.join("guideway");
    fs::create_dir_all(&settings).expect("the folder is new");
    let text = "[look]\nuses-desktop-dialogs = false\n";
    fs::write(settings.join("window.toml"), text).expect("the folder is there");
    command()
        .args(["view", "--method", "cpu"])
        .args(files)
        .env("DISPLAY", display)
        .env_remove("WAYLAND_DISPLAY")
        // Keeps the recent files and settings of the user unchanged.
        .env("XDG_STATE_HOME", state)
        .spawn()
        .expect("the command starts")
}

/// Waits a tenth of a second per item, for at most a minute.
pub(super) fn polls() -> impl Iterator<Item = ()> {
    (0..MAX_POLLS).map(|_| thread::sleep(Duration::from_millis(100)))
}

impl Drop for WindowSession {
    fn drop(&mut self) {
        for child in [&mut self.viewer, &mut self.screen] {
            // It may have ended already.
            let _ = child.kill();
            let _ = child.wait();
        }
    }
}

/// Returns `true` if the programs and the driver that the tests need are installed.
pub(super) fn is_installed() -> bool {
    let runs = |program: &str| Command::new(program).arg("-version").output().is_ok();
    let has_driver = guideway::methods()
        .iter()
        .any(|m| m.info.name == "gpu" && m.unavailable.is_none());
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
