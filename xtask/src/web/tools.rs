//! Tools of the page: a C compiler, Node and `wasm-bindgen`.

use std::path::{Path, PathBuf};

use anyhow::{Context, Result};

use crate::prerequisites::apt_install;
use crate::step::{cargo, command};

/// Installs a C compiler for zstd, and Node.
pub(super) fn ensure() -> Result<()> {
    if !command("clang").args(["--version"]).succeeds() {
        apt_install(&["clang"])?;
    }
    if !command("node").args(["--version"]).succeeds() {
        apt_install(&["nodejs", "npm"])?;
    }
    Ok(())
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
