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

/// The profile of the command, whose panics end it.
pub const PROFILE: &str = "dist";
/// The profile of the window and of the C library, which go on after a panic.
pub const UNWINDING_PROFILE: &str = "dist-unwinding";

/// Arguments of cargo that build the command. The last optimization, of all crates together, is
/// that of its last crate.
pub const COMMAND: [&str; 7] = [
    "rustc",
    "--package=guideway",
    "--bin=guideway",
    "--features=gpu,gl",
    "--profile=dist",
    "--",
    "-Copt-level=3",
];

/// Arguments of cargo that build the window.
pub const WINDOW: [&str; 6] = [
    "rustc",
    "--package=guideway-window",
    "--bin=guideway-window",
    "--profile=dist-unwinding",
    "--",
    "-Copt-level=3",
];

/// Joins functions of the same instructions, of which generic code has many: a fortieth of the
/// program. Nothing here compares functions by their addresses.
const FOLDED: &str = "-Clink-arg=-Wl,--icf=all";

/// Flags of the C compiler that leave out what no level of compression in use needs of zstd.
pub const ZSTD_FLAGS: &str = "-DZSTD_EXCLUDE_GREEDY_BLOCK_COMPRESSOR \
     -DZSTD_EXCLUDE_LAZY_BLOCK_COMPRESSOR -DZSTD_EXCLUDE_LAZY2_BLOCK_COMPRESSOR \
     -DZSTD_EXCLUDE_BTLAZY2_BLOCK_COMPRESSOR -DZSTD_EXCLUDE_BTOPT_BLOCK_COMPRESSOR \
     -DZSTD_EXCLUDE_BTULTRA_BLOCK_COMPRESSOR";

/// Builds command and window, optimized and stripped, with all methods.
///
/// # Errors
/// When cargo fails.
pub fn release(top: &Path) -> Result<Binaries> {
    let script = top.join("packaging/no-unwinding.ld");
    let script = format!("-Clink-arg=-Wl,-T,{}", script.display());
    // The linkers of other systems know no such script, and the tables stay.
    let tables: &[&str] = match cfg!(target_os = "linux") {
        true => &[&script, "-Clink-arg=-Wl,--no-eh-frame-hdr"],
        false => &[],
    };
    // Rust links by LLD there, and elsewhere by linkers that may not fold.
    let folded: &[&str] = match cfg!(all(target_os = "linux", target_arch = "x86_64")) {
        true => &[FOLDED],
        false => &[],
    };
    let folder = build(top, &[&COMMAND, folded, tables].concat(), PROFILE)?;
    let command = Binaries::in_folder(&folder).command;
    let folder = build(top, &[&WINDOW, folded].concat(), UNWINDING_PROFILE)?;
    let window = Binaries::in_folder(&folder).window;
    Ok(Binaries { command, window })
}

/// Builds the C library, optimized.
///
/// # Errors
/// When cargo fails.
pub fn release_library(top: &Path) -> Result<Library> {
    let library = [
        "rustc",
        "--package=guideway-c",
        "--crate-type=cdylib,staticlib",
        "--profile=dist-unwinding",
    ];
    let folder = build(top, &library, UNWINDING_PROFILE)?;
    Ok(Library::in_folder(&folder))
}

/// Runs a task of cargo's and returns the folder of what it built.
fn build(top: &Path, task: &[&str], profile: &str) -> Result<PathBuf> {
    let target = top.join("target").join("dist");
    let (task, rest) = task.split_at(1);
    let built = Command::new(env!("CARGO"))
        .args(task)
        .arg("--locked")
        .args(rest)
        .current_dir(top)
        .env("CARGO_TARGET_DIR", &target)
        .env("CFLAGS", ZSTD_FLAGS)
        .env("RUSTFLAGS", remapped_paths(top)?)
        .status()
        .context("cannot start cargo")?;
    if !built.success() {
        bail!("the release build failed: {built}");
    }
    Ok(target.join(profile))
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
