//! Builds the optimized binaries in a target folder of their own.

use std::env;
use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context, Result, bail};

/// The programs of an installation.
#[derive(Clone, Debug)]
pub struct Binaries {
    /// The command.
    pub command: PathBuf,
    /// The program of the window.
    pub window: PathBuf,
}

impl Binaries {
    /// The programs in a folder of cargo's.
    pub fn in_folder(folder: &Path) -> Self {
        let program = |name: &str| folder.join(format!("{name}{}", env::consts::EXE_SUFFIX));
        Self {
            command: program("guideway"),
            window: program("guideway-window"),
        }
    }
}

/// Builds command and window, optimized and stripped, with all methods.
///
/// # Errors
/// When cargo fails.
pub fn release(top: &Path) -> Result<Binaries> {
    let target = top.join("target").join("dist");
    let packages = ["--package", "guideway", "--package", "guideway-window"];
    let built = Command::new(env!("CARGO"))
        .args(["build", "--release", "--locked"])
        .args(packages)
        .args(["--features", "guideway/gpu,guideway/gl"])
        .current_dir(top)
        .env("CARGO_TARGET_DIR", &target)
        .env("RUSTFLAGS", remapped_paths(top)?)
        .status()
        .context("cannot start cargo")?;
    if !built.success() {
        bail!("the release build failed: {built}");
    }
    Ok(Binaries::in_folder(&target.join("release")))
}

/// Compiler flags by which messages of panics name files without the folders of this machine.
fn remapped_paths(top: &Path) -> Result<String> {
    let home = env::var_os("CARGO_HOME").map(PathBuf::from);
    let home = home.or_else(|| Some(PathBuf::from(env::var_os("HOME")?).join(".cargo")));
    let home = home.context("neither CARGO_HOME nor HOME is set")?;
    let flag = |from: &Path, to: &str| format!("--remap-path-prefix={}={to}", from.display());
    Ok([flag(&home, "/cargo"), flag(top, "/guideway")].join(" "))
}
