//! What the checks need beside Rust and a C compiler, and how to get it.

use std::path::{Path, PathBuf};

use anyhow::{Result, bail};

use crate::step::{cargo, command};

const SOFTWARE_DEVICES: &[&str] = &[
    "libvulkan1",
    "mesa-vulkan-drivers",
    "libegl1",
    "libgl1-mesa-dri",
];
/// A screen that nobody sees, and hands for it: for the tests of the window.
const SCREEN: &[&str] = &["xvfb", "xdotool", "libxkbcommon-x11-0"];
const CARGO_DENY_VERSION: &str = "0.20.2";
const CARGO_FUZZ_VERSION: &str = "0.13.1";

/// `rustfmt` and `clippy`, through rustup where they are missing.
pub(crate) fn rust_components() -> Result<()> {
    for (subcommand, component) in [("fmt", "rustfmt"), ("clippy", "clippy")] {
        if cargo(&[subcommand, "--version"]).succeeds() {
            continue;
        }
        if command("rustup")
            .args(["component", "add", component])
            .run()
            .is_err()
        {
            bail!(
                "`cargo {subcommand}` is missing: install your distribution's {component}, or use rustup"
            );
        }
    }
    Ok(())
}

/// `cargo deny`, built once into cargo's own folder.
pub(crate) fn cargo_deny() -> Result<PathBuf> {
    let program = PathBuf::from("cargo-deny");
    if !command(&program).args(["--version"]).succeeds() {
        println!("installing cargo-deny {CARGO_DENY_VERSION}, a minute or two the first time");
        install_tool("cargo-deny", CARGO_DENY_VERSION)?;
    }
    if command(&program).args(["--version"]).succeeds() {
        return Ok(program);
    }
    // Installed, but cargo's folder is not on the path.
    let home = std::env::var_os("CARGO_HOME").map(PathBuf::from);
    let home = home.or_else(|| Some(PathBuf::from(std::env::var_os("HOME")?).join(".cargo")));
    match home {
        Some(home) => Ok(home.join("bin").join(program)),
        None => {
            bail!("cargo-deny is installed but not on PATH, and neither CARGO_HOME nor HOME is set")
        }
    }
}

/// `cargo fuzz`, built once into cargo's own folder.
pub(crate) fn cargo_fuzz() -> Result<()> {
    if cargo(&["fuzz", "--version"]).succeeds() {
        return Ok(());
    }
    println!("installing cargo-fuzz {CARGO_FUZZ_VERSION}, half a minute the first time");
    install_tool("cargo-fuzz", CARGO_FUZZ_VERSION)
}

/// Builds a tool into cargo's own folder. Not optimized: it runs for seconds, and that saves minutes of building.
fn install_tool(name: &str, version: &str) -> Result<()> {
    cargo(&["install", name, "--version", version, "--locked", "--quiet"])
        .args(["--debug", "--config", "profile.dev.debug=0"])
        .run()
}

/// A Python that can import pyarrow, polars and jsonschema, in a virtual environment under `target/`, for the tests
/// that look at our files from outside.
pub(crate) fn python() -> Result<PathBuf> {
    let workspace = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("..")
        .canonicalize()?;
    let folder = workspace.join("target").join("python");
    let python = folder.join("bin").join("python3");
    if imports_all(&python) {
        return Ok(python);
    }
    let make = || command("python3").args(["-m", "venv"]).args([&folder]);
    if !make().succeeds() {
        apt_install(&["python3", "python3-venv"])?;
        make().run()?;
    }
    command(&python)
        .args([
            "-m",
            "pip",
            "install",
            "--quiet",
            "pyarrow",
            "polars",
            "jsonschema",
        ])
        .run()?;
    if !imports_all(&python) {
        bail!(
            "pyarrow, polars and jsonschema were installed into {} but cannot be imported",
            folder.display()
        );
    }
    Ok(python)
}

/// Vulkan and OpenGL on the processor, and a screen, so that the methods for graphics devices and the window are
/// tested without any.
pub(crate) fn software_devices() -> Result<()> {
    if !command("dpkg").args(["--version"]).succeeds() {
        // Another system: its own drivers do, and the tests say what they miss.
        return Ok(());
    }
    let is_there = |package: &&str| command("dpkg").args(["--status", package]).succeeds();
    let packages = [SOFTWARE_DEVICES, SCREEN].concat();
    if packages.iter().all(is_there) {
        return Ok(());
    }
    apt_install(&packages)
}

fn imports_all(python: &Path) -> bool {
    command(python)
        .args(["-c", "import pyarrow, polars, jsonschema"])
        .succeeds()
}

fn apt_install(packages: &[&str]) -> Result<()> {
    let is_root = command("sh")
        .args(["-c", "test \"$(id -u)\" = 0"])
        .succeeds();
    let apt = |args: &[&str]| {
        let all: Vec<&str> = if is_root { vec![] } else { vec!["sudo", "-n"] };
        let all: Vec<&str> = all
            .into_iter()
            .chain(["apt-get"])
            .chain(args.iter().copied())
            .collect();
        command(all[0])
            .args(&all[1..])
            .env("DEBIAN_FRONTEND", "noninteractive")
            .run()
    };
    let install: Vec<&str> = ["install", "-y", "--no-install-recommends"]
        .into_iter()
        .chain(packages.iter().copied())
        .collect();
    if apt(&["update", "-q"]).and_then(|()| apt(&install)).is_err() {
        bail!(
            "this needs the packages {}, and they could not be installed (no rights, or no apt): \
             run `sudo apt-get install {}` and start again",
            packages.join(", "),
            packages.join(" ")
        );
    }
    Ok(())
}
