//! Installs the programs under Wine, opens a layout as a double click does, and removes all.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Child;

use anyhow::{Context, Result, bail};
use xtask::files::files_below;

use super::build::FOLDER;
use super::packages::Packages;
use super::screen::{Screen, polls};
use super::wine::Wine;

/// Color of the lanes in the window.
const LANES: [u8; 3] = [0x5a, 0x6b, 0x7f];
/// Color of the stations, which appear when the whole file is read.
const STATIONS: [u8; 3] = [0xc8, 0x28, 0x78];
/// Pixels of each color in the fitted example site: half of what was seen. A window without the
/// site has none.
const MIN_PX: [([u8; 3], usize); 2] = [(LANES, 2000), (STATIONS, 2000)];
/// Exit code of an installer that finds its files in use.
const IN_USE: i32 = 2;

/// Installs, uses and removes the programs.
pub(super) fn test(wine: &Wine, screen: &Screen, packages: &Packages) -> Result<()> {
    let folder = install(wine, packages)?;
    // A name that no code page of one byte per letter holds.
    let site = std::env::current_dir()?
        .join(FOLDER)
        .join("Übersicht 計画.lif");
    fs::copy("crates/guideway/examples/site.lif.json", &site)?;
    call_in_terminal(wine, &site)?;

    // Wine knows the file types of the computer alone, Windows those of its users too.
    let (user, computer) = ("HKCU\\Software\\Classes", "HKLM\\Software\\Classes");
    wine.said("reg", &["copy", user, computer, "/s", "/f"])?;
    let mut window = Window::open(wine, screen, &site)?;
    let outcome = (|| {
        window.wait_for_site(screen)?;
        let again = silent(wine, &packages.installer, "")?;
        expect(again, IN_USE, "the installer beside an open window")?;
        let here = format!("_?={}", wine.path(&folder));
        let removed = silent(wine, &folder.join("uninstall.exe"), &here)?;
        expect(removed, IN_USE, "the removal of an open window")
    })();
    window.close(screen, outcome)?;
    remove(wine, &folder)
}

/// Installs the programs, and compares what is installed with what was packed.
fn install(wine: &Wine, packages: &Packages) -> Result<PathBuf> {
    expect(silent(wine, &packages.installer, "")?, 0, "the installer")?;
    let folder = programs_folder(wine)?;
    for (name, expected) in files_below(&packages.stage)? {
        let installed = fs::read(folder.join(&name)).with_context(|| name.clone())?;
        if installed != fs::read(expected)? {
            bail!("{name} is installed with other bytes");
        }
    }
    Ok(folder)
}

/// Calls the command by its name, and has it start the program of the window.
fn call_in_terminal(wine: &Wine, site: &Path) -> Result<()> {
    let version = wine.said("cmd", &["/c", "guideway", "--version"])?;
    if !version.starts_with("guideway ") {
        bail!("a terminal does not find the command: {version}");
    }
    println!("installed {}", version.trim());
    let measure = ["/c", "guideway", "view", "--measure", "--json"];
    let measured = wine.said("cmd", &[&measure[..], &[&wine.path(site)]].concat())?;
    let report: serde_json::Value =
        serde_json::from_str(&measured).with_context(|| measured.clone())?;
    if report["guideway"]["report"] != "view" {
        bail!("the command does not start the window: {measured}");
    }
    Ok(())
}

/// Removes the programs; fails when a file, a key or an entry is left.
fn remove(wine: &Wine, folder: &Path) -> Result<()> {
    let removed = silent(wine, &folder.join("uninstall.exe"), "")?;
    expect(removed, 0, "the removal")?;
    // A copy of the program in another folder does the work.
    if !polls().any(|()| !folder.exists()) {
        let left = files_below(folder)?;
        bail!("{} is still there, with {left:?}", folder.display());
    }
    let registry = wine.registry("HKEY_CURRENT_USER")?.to_lowercase();
    if let Some(line) = registry.lines().find(|line| line.contains("guideway")) {
        bail!("the registry still has {line}");
    }
    let users = files_below(&wine.drive().join("users"))?;
    let mut names = users.iter().map(|(name, _)| name);
    if let Some(name) = names.find(|name| name.ends_with("Guideway.lnk")) {
        bail!("the Start menu still has {name}");
    }
    println!("removed, with every file and entry");
    Ok(())
}

/// Runs an installer or its counterpart without questions; returns its exit code.
fn silent(wine: &Wine, program: &Path, more: &str) -> Result<Option<i32>> {
    let mut command = wine.command(program);
    command.arg("/S");
    if !more.is_empty() {
        command.arg(more);
    }
    Ok(command.status()?.code())
}

/// The window that a double click opens.
struct Window(Child);

impl Window {
    fn open(wine: &Wine, screen: &Screen, file: &Path) -> Result<Self> {
        let mut start = wine.command("start");
        start.args(["/wait", &wine.path(file)]);
        let window = Self(start.spawn().context("cannot start Wine")?);
        screen.focus_window()?;
        Ok(window)
    }

    /// Waits until the site is drawn, and keeps a picture of the screen.
    fn wait_for_site(&self, screen: &Screen) -> Result<()> {
        let file = Path::new(FOLDER).join("window.png");
        for () in polls() {
            let picture = screen.picture()?;
            if MIN_PX
                .iter()
                .all(|(color, least)| picture.count(*color) >= *least)
            {
                picture.save(&file)?;
                println!("a double click opens the window: {}", file.display());
                return Ok(());
            }
        }
        screen.picture()?.save(&file)?;
        bail!("the window does not show the site: {}", file.display())
    }

    /// Closes the window by its key, also after a failure.
    fn close(&mut self, screen: &Screen, outcome: Result<()>) -> Result<()> {
        screen.key("ctrl+q")?;
        let ended = polls().find_map(|()| self.0.try_wait().transpose());
        outcome?;
        let status = ended.context("the window does not close on Ctrl+Q")??;
        expect(status.code(), 0, "the window")
    }
}

/// The folder into which the installer put the programs of this user.
fn programs_folder(wine: &Wine) -> Result<PathBuf> {
    for user in fs::read_dir(wine.drive().join("users"))? {
        let folder = user?.path().join("AppData/Local/Programs/Guideway");
        if folder.exists() {
            return Ok(folder);
        }
    }
    bail!("the installer has made no folder")
}

fn expect(code: Option<i32>, wanted: i32, who: &str) -> Result<()> {
    match code {
        Some(code) if code == wanted => Ok(()),
        other => bail!("{who} ended with {other:?}, not {wanted}"),
    }
}
