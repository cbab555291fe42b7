//! Compares Guideway with other implementations over the real files beside the repository, by
//! `tests/conformance`: builds the command, installs the other readers, prints a table.

use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail};

use crate::prerequisites::conformance_python;
use crate::step::{build_with_workspace, command};

/// Runs the comparison with the arguments of `cargo xtask conformance`.
pub(crate) fn run(args: &[String]) -> Result<()> {
    let Some(shared) = shared_files()? else {
        println!("SKIPPED: there is no folder shared/ with real files beside the repository");
        return Ok(());
    };
    let python = conformance_python()?;
    build_with_workspace()?;
    let folder = std::env::current_exe()?;
    let folder = folder.parent().context("xtask lies in no folder")?;
    let guideway = folder.join("guideway");
    if !guideway.is_file() {
        bail!("cargo built no {}", guideway.display());
    }
    command(python)
        .args([Path::new("tests/conformance"), &guideway, &shared])
        .args(args)
        .run()
}

/// The folder of real files beside the repository; `None` where it is absent.
fn shared_files() -> Result<Option<PathBuf>> {
    let shared = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shared");
    if shared.join("layouts").is_dir() {
        return Ok(Some(shared.canonicalize()?));
    }
    Ok(None)
}
