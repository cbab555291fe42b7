//! The programs of a release, and how cargo builds them.

use std::env;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result};

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
/// that of its last crate; cargo would not strip that one, whose profile has its name.
pub const COMMAND: [&str; 8] = [
    "rustc",
    "--package=guideway",
    "--bin=guideway",
    "--features=gpu,gl",
    "--profile=dist",
    "--",
    "-Copt-level=3",
    "-Cstrip=symbols",
];

/// Arguments of cargo that build the command without graphics devices.
pub const STATIC_COMMAND: [&str; 9] = [
    "rustc",
    "--package=guideway",
    "--bin=guideway",
    "--no-default-features",
    "--features=cli",
    "--profile=dist",
    "--",
    "-Copt-level=3",
    "-Cstrip=symbols",
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

/// Flags of the C compiler that leave out what no level of compression in use needs of zstd.
pub const ZSTD_FLAGS: &str = "-DZSTD_EXCLUDE_GREEDY_BLOCK_COMPRESSOR \
     -DZSTD_EXCLUDE_LAZY_BLOCK_COMPRESSOR -DZSTD_EXCLUDE_LAZY2_BLOCK_COMPRESSOR \
     -DZSTD_EXCLUDE_BTLAZY2_BLOCK_COMPRESSOR -DZSTD_EXCLUDE_BTOPT_BLOCK_COMPRESSOR \
     -DZSTD_EXCLUDE_BTULTRA_BLOCK_COMPRESSOR";

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
