//! Builds the optimized programs and the C library, in a target folder of their own.

use std::path::{Path, PathBuf};

use anyhow::Result;
use xtask::dist::{
    Binaries, COMMAND, Library, PROFILE, UNWINDING_PROFILE, WINDOW, ZSTD_FLAGS, remapped_paths,
};

use crate::debian_rust::{DebianRust, lld_folder};
use crate::step::{Step, cargo};

/// The system whose programs get a standard library of their own.
const HOST: &str = "x86_64-unknown-linux-gnu";
/// Smaller ways to sort and to write numbers.
const SMALL_STD: &str = "-Zbuild-std-features=optimize_for_size";
/// Joins functions of the same instructions, of which generic code has many: a fortieth of the
/// program. Nothing here compares functions by their addresses.
const FOLDED: &str = "-Clink-arg=-Wl,--icf=all";

/// Builds command and window, optimized and stripped, with all methods.
pub(super) fn programs(top: &Path) -> Result<Binaries> {
    if !cfg!(all(target_os = "linux", target_arch = "x86_64")) {
        let command = plain(top, &COMMAND, PROFILE)?.command;
        let window = plain(top, &WINDOW, UNWINDING_PROFILE)?.window;
        return Ok(Binaries { command, window });
    }
    let rust = DebianRust::ensure()?;
    let script = top.join("packaging/no-unwinding.ld");
    let script = format!("-Clink-arg=-Wl,-T,{}", script.display());
    let without_tables = [script.as_str(), "-Clink-arg=-Wl,--no-eh-frame-hdr"];
    let lld = format!("-Clink-arg=-B{}", lld_folder()?.display());
    let build = |task: &[&str], std: &str, more: &[&str], profile: &str| {
        let (task, rest) = task.split_at(1);
        let task = rust
            .cargo(task)
            .args(["--locked", "--target", HOST, std, SMALL_STD]);
        let task = task
            .args(rest)
            .args([lld.as_str(), "-Clink-arg=-fuse-ld=lld", FOLDED]);
        let folder = run(top, task.args(more), &rust.remapped_paths()?)?;
        anyhow::Ok(Binaries::in_folder(&folder.join(HOST).join(profile)))
    };
    let std = "-Zbuild-std=std,panic_abort";
    let command = build(&COMMAND, std, &without_tables, PROFILE)?.command;
    let std = "-Zbuild-std=std,panic_unwind";
    let window = build(&WINDOW, std, &[], UNWINDING_PROFILE)?.window;
    Ok(Binaries { command, window })
}

/// Builds the C library, optimized.
pub(super) fn library(top: &Path) -> Result<Library> {
    let task = [
        "rustc",
        "--locked",
        "--package=guideway-c",
        "--crate-type=cdylib,staticlib",
        "--profile=dist-unwinding",
    ];
    let folder = run(top, cargo(&task), &remapped_paths(top)?)?;
    Ok(Library::in_folder(&folder.join(UNWINDING_PROFILE)))
}

/// Builds a program with the standard library that comes with the compiler.
fn plain(top: &Path, task: &[&str], profile: &str) -> Result<Binaries> {
    let (task, rest) = task.split_at(1);
    let task = cargo(task).args(["--locked"]).args(rest);
    let folder = run(top, task, &remapped_paths(top)?)?;
    Ok(Binaries::in_folder(&folder.join(profile)))
}

/// Runs a task of cargo's, and returns its target folder.
fn run(top: &Path, task: Step, flags: &str) -> Result<PathBuf> {
    let target = top.join("target/dist");
    task.env("CARGO_TARGET_DIR", &target)
        .env("CFLAGS", ZSTD_FLAGS)
        .env("RUSTFLAGS", flags)
        .run()?;
    Ok(target)
}
