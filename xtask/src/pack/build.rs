//! Builds the optimized programs and the C library, in a target folder of their own.

use std::path::{Path, PathBuf};

use anyhow::Result;
use xtask::dist::{
    Binaries, COMMAND, Library, PROFILE, UNWINDING_PROFILE, WINDOW, ZSTD_FLAGS, remapped_paths,
};

use crate::debian_rust::{DebianRust, lld_folder};
use crate::step::{Step, cargo};

/// Programs for this system get a standard library of their own.
pub(super) const IS_HOST: bool = cfg!(all(target_os = "linux", target_arch = "x86_64"));
/// That system.
const HOST: &str = "x86_64-unknown-linux-gnu";
/// Smaller ways to sort and to write numbers.
const SMALL_STD: &str = "-Zbuild-std-features=optimize_for_size";
/// Joins functions of the same instructions, of which generic code has many: a fortieth of the
/// program. Nothing here compares functions by their addresses.
const FOLDED: &str = "-Clink-arg=-Wl,--icf=all";

/// Builds command and window, optimized and stripped, with all methods.
pub(super) fn programs(top: &Path) -> Result<Binaries> {
    if !IS_HOST {
        let command = plain(top, &COMMAND, PROFILE)?.command;
        let window = plain(top, &WINDOW, UNWINDING_PROFILE)?.window;
        return Ok(Binaries { command, window });
    }
    let rust = DebianRust::ensure()?;
    let without_tables = without_unwinding(top);
    let command = for_size(top, &rust, &COMMAND, HOST, PROFILE, &without_tables)?.command;
    let window = for_size(top, &rust, &WINDOW, HOST, UNWINDING_PROFILE, &[])?.window;
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

/// Builds a program for a target by Debian's compiler, with a standard library for size. `task` is
/// a call of `cargo rustc`, whose last arguments are of the compiler, as `flags` are.
pub(super) fn for_size(
    top: &Path,
    rust: &DebianRust,
    task: &[&str],
    target: &str,
    profile: &str,
    flags: &[String],
) -> Result<Binaries> {
    let std = match profile {
        PROFILE => "-Zbuild-std=std,panic_abort",
        _ => "-Zbuild-std=std,panic_unwind",
    };
    let (task, rest) = task.split_at(1);
    let task = rust
        .cargo(task)
        .args(["--locked", "--target", target, std, SMALL_STD])
        .args(rest)
        .args([format!("-Clink-arg=-B{}", lld_folder()?.display())])
        .args(["-Clink-arg=-fuse-ld=lld", FOLDED])
        .args(flags);
    let folder = run(top, task, &rust.remapped_paths()?)?;
    Ok(Binaries::in_folder(&folder.join(target).join(profile)))
}

/// Flags of the compiler that leave the tables for unwinding out of a program.
pub(super) fn without_unwinding(top: &Path) -> [String; 2] {
    let script = top.join("packaging/no-unwinding.ld");
    [
        format!("-Clink-arg=-Wl,-T,{}", script.display()),
        "-Clink-arg=-Wl,--no-eh-frame-hdr".to_owned(),
    ]
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
