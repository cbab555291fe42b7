//! `cargo xtask macos`: the compiler checks the programs for macOS, with a standard library built
//! for it. Nothing is linked or run: the libraries of macOS are on its computers alone.

use std::fs;
use std::path::{Path, PathBuf};

use anyhow::Result;

use crate::debian_rust::DebianRust;
use crate::step::command;

const TARGET: &str = "aarch64-apple-darwin";

/// Makes the empty file that a compiler or an archiver of C would write.
const NO_C: &str = "\
#!/bin/sh
while [ $# -gt 0 ]; do
    case $1 in
        -o) : > \"$2\" ;;
        *.a) : > \"$1\" ;;
    esac
    shift
done
";

/// Checks command, window and C library.
pub(crate) fn check() -> Result<()> {
    let folder = std::env::current_dir()?.join("target/macos");
    let no_c = write_no_c(&folder)?;
    let rust = DebianRust::ensure()?;
    rust.cargo(&["check", "--locked", "--target", TARGET])
        .args(["-Zbuild-std=std,panic_unwind"])
        .args([
            "--package=guideway",
            "--package=guideway-window",
            "--package=guideway-c",
        ])
        .args(["--features=guideway/gpu,guideway/gl"])
        .env("CARGO_TARGET_DIR", folder.join("cargo"))
        .env("CC_aarch64_apple_darwin", &no_c)
        .env("AR_aarch64_apple_darwin", &no_c)
        // Else the folder of its libraries is asked of a program of macOS.
        .env("SDKROOT", "/")
        .run()
}

fn write_no_c(folder: &Path) -> Result<PathBuf> {
    fs::create_dir_all(folder)?;
    let program = folder.join("no-c");
    fs::write(&program, NO_C)?;
    command("chmod")
        .args(["+x".as_ref(), program.as_os_str()])
        .run()?;
    Ok(program)
}
