//! `cargo xtask dist`: builds a release and packs it.

use std::fs;
use std::path::Path;

use anyhow::{Context, Result};
use xtask::dist::{
    Compression, archive, checksums, deb, dependencies, notices, release, sbom, stage,
};

use crate::step::heading;

/// Packs the repository in the current folder.
pub(crate) fn run() -> Result<()> {
    let top = std::env::current_dir()?;
    heading("release build");
    let binaries = release(&top)?;
    heading("packages");
    let dependencies = dependencies(&top)?;
    let own = dependencies.iter().find(|krate| krate.name == "guideway");
    let version = &own.context("the list has the command")?.version;
    let folder = top.join("target/dist/packages");
    let work = top.join("target/dist/stage");
    for fresh in [&folder, &work] {
        if fresh.exists() {
            fs::remove_dir_all(fresh)?;
        }
        fs::create_dir_all(fresh)?;
    }
    let root = work.join("root");
    let notices = notices(&dependencies)?;
    stage(&top, &binaries, &notices, &root.join("usr"))?;
    let package = deb(version, &binaries, &root, &folder, Compression::Xz)?;
    let name = format!("guideway-{version}-{}-linux", std::env::consts::ARCH);
    fs::rename(root.join("usr"), work.join(&name))?;
    let archive = archive(&work, &name, &folder)?;
    let bill = folder.join(format!("guideway-{version}.cdx.json"));
    fs::write(
        &bill,
        serde_json::to_string_pretty(&sbom(version, &dependencies))? + "\n",
    )?;
    let files = [package, archive, bill];
    checksums(&folder, &files)?;
    for file in &files {
        println!(
            "{:>12} bytes  {}",
            fs::metadata(file)?.len(),
            shown(file, &top)
        );
    }
    Ok(())
}

fn shown(file: &Path, top: &Path) -> String {
    file.strip_prefix(top)
        .unwrap_or(file)
        .to_string_lossy()
        .into_owned()
}
