//! A Windows of its own for the tests: a prefix of Wine under `target/`, made anew for each run.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};

use anyhow::{Context, Result, bail};

use super::build::FOLDER;
use super::screen::Screen;
use crate::prerequisites::apt_install;
use crate::step::command;

/// Wine before version 9 lacks this library, by which Rust's standard library seeds its hash maps.
const RANDOM: &str = "
    __declspec(dllimport) unsigned char SystemFunction036(void *buffer, unsigned long bytes);
    __declspec(dllexport) int ProcessPrng(unsigned char *buffer, unsigned long long bytes) {
        return SystemFunction036(buffer, (unsigned long)bytes);
    }
";

/// Most time of a program, in seconds.
const LIMIT_S: &str = "300";

/// A prefix of Wine; its programs end with it.
pub(super) struct Wine {
    prefix: PathBuf,
    display: String,
    /// A program that waits for input: without one the services of Windows end with each program,
    /// and start anew for the next.
    session: Option<Child>,
}

impl Wine {
    /// Installs Wine where it is missing, and makes a prefix whose windows are on a screen.
    pub(super) fn ensure(screen: &Screen) -> Result<Self> {
        if !command("wine").args(["--version"]).succeeds() {
            apt_install(&["wine", "wine64"])?;
        }
        let prefix = std::env::current_dir()?.join(FOLDER).join("wine");
        if prefix.exists() {
            fs::remove_dir_all(&prefix)?;
        }
        fs::create_dir_all(&prefix)?;
        let display = screen.display().to_owned();
        let mut wine = Self {
            prefix,
            display,
            session: None,
        };
        let made = wine.command("wineboot").arg("--init").status()?;
        if !made.success() {
            bail!("wineboot: {made}");
        }
        let library = wine.drive().join("windows/system32/bcryptprimitives.dll");
        if !library.exists() {
            let source = library.with_extension("c");
            fs::write(&source, RANDOM)?;
            command("x86_64-w64-mingw32-gcc")
                .args(["-shared", "-o"])
                .args([&library, &source])
                .args(["-ladvapi32"])
                .run()?;
        }
        let mut waiting = Command::new("wine");
        wine.prepare(&mut waiting).arg("cmd");
        waiting.stdin(Stdio::piped()).stdout(Stdio::null());
        wine.session = Some(waiting.spawn().context("cannot start Wine")?);
        Ok(wine)
    }

    /// The folder that is drive `C:`.
    pub(super) fn drive(&self) -> PathBuf {
        self.prefix.join("drive_c")
    }

    /// A program of Windows, by its file or by its name on the path of Windows. One that hangs is
    /// ended, with the exit code 124.
    pub(super) fn command(&self, program: impl AsRef<Path>) -> Command {
        let mut command = Command::new("timeout");
        command.args(["--kill-after=10", LIMIT_S, "wine"]);
        self.prepare(&mut command).arg(program.as_ref());
        command
    }

    /// The name by which programs see a file.
    pub(super) fn path(&self, file: &Path) -> String {
        let (drive, rest) = match file.strip_prefix(self.drive()) {
            Ok(rest) => ("C:\\", rest),
            // All of this system.
            Err(_) => ("Z:", file),
        };
        format!("{drive}{}", rest.to_string_lossy().replace('/', "\\"))
    }

    /// The output of a program, without line ends of Windows.
    pub(super) fn said(&self, program: &str, args: &[&str]) -> Result<String> {
        let output = self.command(program).args(args).output()?;
        let text = String::from_utf8_lossy(&output.stdout).replace('\r', "");
        Ok(text + &String::from_utf8_lossy(&output.stderr))
    }

    /// All keys and values of the user below a key of the registry, as text.
    pub(super) fn registry(&self, key: &str) -> Result<String> {
        let file = self.drive().join("registry.txt");
        let exported = self
            .command("reg")
            .args(["export", key, "C:\\registry.txt", "/y"])
            .stdout(Stdio::null())
            .status()?;
        if !exported.success() {
            bail!("cannot export {key}: {exported}");
        }
        let bytes = fs::read(&file)?;
        let units: Vec<u16> = bytes
            .chunks_exact(2)
            .map(|unit| u16::from_le_bytes([unit[0], unit[1]]))
            .collect();
        String::from_utf16(&units).context("the registry is text")
    }

    fn prepare<'a>(&self, command: &'a mut Command) -> &'a mut Command {
        command
            .env("WINEPREFIX", &self.prefix)
            .env("WINEDEBUG", "-all")
            .env("DISPLAY", &self.display)
            .env_remove("WAYLAND_DISPLAY")
            // By it Wine reads the names of files and arguments.
            .env("LC_ALL", "C.UTF-8")
            // Neither .NET nor a browser, and no entries in the menus of this computer. Wine's
            // DirectX 12 loses its device on Mesa's processor, on which Vulkan runs.
            .env(
                "WINEDLLOVERRIDES",
                "mscoree,mshtml,winemenubuilder.exe,d3d12=",
            )
    }
}

impl Drop for Wine {
    fn drop(&mut self) {
        let mut server = Command::new("wineserver");
        // Without programs there is no server, which is an error to it.
        let _ = self.prepare(server.arg("-k")).status();
        if let Some(session) = &mut self.session {
            let _ = session.wait();
        }
    }
}
