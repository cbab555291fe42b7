//! Builds the optimized binaries in a target folder of their own.

use std::env;
use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context, Result, bail};

use super::Library;

/// The programs of an installation.
#[derive(Clone, Debug)]
pub struct Binaries {
    /// The command.
    pub command: PathBuf,
    /// The program of the window.
    pub window: PathBuf,
}

impl Binaries {
    /// The programs in a folder of cargo's, for this system.
    pub fn in_folder(folder: &Path) -> Self {
        Self::with_suffix(folder, env::consts::EXE_SUFFIX)
    }

    /// The programs in a folder of cargo's, with the suffix of their system.
    pub fn with_suffix(folder: &Path, suffix: &str) -> Self {
        let program = |name: &str| folder.join(format!("{name}{suffix}"));
        Self {
            command: program("guideway"),
            window: program("guideway-window"),
        }
    }
}

/// The profile of the programs that users get.
pub const PROFILE: &str = "dist";

/// Builds command and window, optimized and stripped, with all methods.
///
/// # Errors
/// When cargo fails.
pub fn release(top: &Path) -> Result<Binaries> {
    let packages = ["--package", "guideway", "--package", "guideway-window"];
    let features = ["--features", "guideway/gpu,guideway/gl"];
    let folder = build(top, &[&["build"], &packages[..], &features].concat())?;
    Ok(Binaries::in_folder(&folder))
}

/// Builds the C library, optimized.
///
/// # Errors
/// When cargo fails.
pub fn release_library(top: &Path) -> Result<Library> {
    let types = ["--crate-type", "cdylib,staticlib"];
    let folder = build(
        top,
        &[&["rustc", "--package", "guideway-c"], &types[..]].concat(),
    )?;
    Ok(Library::in_folder(&folder))
}

/// Runs a task of cargo's and returns the folder of what it built.
fn build(top: &Path, task: &[&str]) -> Result<PathBuf> {
    let target = top.join("target").join("dist");
    let built = Command::new(env!("CARGO"))
        .args(task)
        .args(["--profile", PROFILE, "--locked"])
        .current_dir(top)
        .env("CARGO_TARGET_DIR", &target)
        .env("RUSTFLAGS", remapped_paths(top)?)
        .status()
        .context("cannot start cargo")?;
    if !built.success() {
        bail!("the release build failed: {built}");
    }
    Ok(target.join(PROFILE))
}

/// Compiler flags by which messages of panics name files without the folders of this machine.
///
/// # Errors
/// When the environment does not say where cargo keeps its sources.
pub fn remapped_paths(top: &Path) -> Result<String> {
    let home = env::var_os("CARGO_HOME").map(PathBuf::from);
    let home = home.or_else(|| Some(PathBuf::from(env::var_os("HOME")?).join(".cargo")));
    let home = home.context("neither CARGO_HOME nor HOME is set")?;
    let flag = |from: &Path, to: &str| format!("--remap-path-prefix={}={to}", from.display());
    Ok([flag(&home, "/cargo"), flag(top, "/guideway")].join(" "))
}
