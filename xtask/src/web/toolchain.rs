//! The compiler for browsers: Debian's `rustc-web`, unpacked under `target/` and not installed. It
//! comes with the sources of the standard library, which cargo builds for `wasm32`.

use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail};

use crate::prerequisites::{apt, apt_install};
use crate::step::{Step, cargo, command};

/// Packages whose names have no version; those that they need have one.
const PACKAGES: [&str; 3] = ["rustc-web", "rust-web-src", "libstd-rust-web-dev"];
/// Beginnings of the names of packages that they need.
const NEEDED: [&str; 2] = ["libllvm", "libstd-rust-web-"];

/// The folder of the unpacked packages.
pub(super) struct Toolchain(PathBuf);

impl Toolchain {
    /// Fetches and unpacks the packages where that was not done before.
    pub(super) fn ensure(folder: &Path) -> Result<Self> {
        let toolchain = Self(folder.join("toolchain"));
        if !command("clang").args(["--version"]).succeeds() {
            // For zstd, which is C.
            apt_install(&["clang"])?;
        }
        if !command("node").args(["--version"]).succeeds() {
            apt_install(&["nodejs", "npm"])?;
        }
        if toolchain.rustc("rustc").args(["--version"]).succeeds() {
            return Ok(toolchain);
        }
        let packages = folder.join("packages");
        std::fs::create_dir_all(&packages)?;
        apt(&["update", "-q"])?;
        let mut names: Vec<String> = PACKAGES.map(str::to_owned).to_vec();
        let mut known = 0;
        // Each round adds the packages that those of the last one need.
        while known < names.len() {
            known = names.len();
            let depends = command("apt-cache").args(["depends"]).args(&names);
            let depends = depends.capture()?.stdout;
            let needed = depends
                .lines()
                .filter_map(|line| line.trim().strip_prefix("Depends: "));
            let needed = needed.filter(|name| NEEDED.iter().any(|start| name.starts_with(start)));
            names.extend(needed.map(str::to_owned));
            names.sort();
            names.dedup();
        }
        let download = command("apt-get").args(["download"]).args(&names);
        download.current_dir(&packages).run()?;
        for package in std::fs::read_dir(&packages)? {
            let package = package?.path();
            command("dpkg")
                .args(["-x".as_ref(), package.as_os_str(), toolchain.0.as_os_str()])
                .run()?;
        }
        std::fs::remove_dir_all(&packages)?;
        Ok(toolchain)
    }

    /// A step that runs or calls the compiler.
    pub(super) fn rustc(&self, program: &str) -> Step {
        let lib = self.0.join("usr/lib/x86_64-linux-gnu");
        let program = match program {
            "rustc" => self.0.join("usr/bin/rustc"),
            other => PathBuf::from(other),
        };
        command(program)
            .env("LD_LIBRARY_PATH", lib)
            .env("RUSTC", self.0.join("usr/bin/rustc"))
            // A stable compiler builds its standard library, but takes the option only so.
            .env("RUSTC_BOOTSTRAP", "1")
    }
}

/// The linker of rustup's own compiler: Debian's package has none.
pub(super) fn linker() -> Result<PathBuf> {
    let sysroot = command("rustc").args(["--print", "sysroot"]).capture()?;
    let linker =
        Path::new(sysroot.stdout.trim()).join("lib/rustlib/x86_64-unknown-linux-gnu/bin/rust-lld");
    match linker.exists() {
        true => Ok(linker),
        false => bail!("no {}: install Rust with rustup", linker.display()),
    }
}

/// The program that writes the calls of the engine in JavaScript, of the version of the lock file.
pub(super) fn wasm_bindgen(folder: &Path) -> Result<PathBuf> {
    let lock = std::fs::read_to_string("Cargo.lock")?;
    let (_, rest) = lock
        .split_once("name = \"wasm-bindgen\"\nversion = \"")
        .context("Cargo.lock has no wasm-bindgen")?;
    let version = rest.split('"').next().unwrap_or_default();
    let program = folder.join("tools/bin/wasm-bindgen");
    let found = command(&program).args(["--version"]).capture();
    if found.is_ok_and(|found| found.stdout.trim().ends_with(version)) {
        return Ok(program);
    }
    println!("installing wasm-bindgen-cli {version}, once");
    // Unoptimized: it runs for seconds, and this saves minutes of building.
    cargo(&["install", "wasm-bindgen-cli", "--version", version])
        .args(["--quiet", "--debug", "--config", "profile.dev.debug=0"])
        .args(["--root".as_ref(), folder.join("tools").as_os_str()])
        .run()?;
    Ok(program)
}
