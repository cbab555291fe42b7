//! Packs the programs for Windows as a zip and an installer, with checksums and a bill of
//! materials.

use std::fs;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result};
use xtask::dist::{
    Binaries, Compression, WINDOWS, checksums, dependencies, installer, notices, sbom,
    stage_windows, zip,
};

use super::build::{FOLDER, Profile};
use crate::prerequisites::apt_install;
use crate::step::command;

/// The results of packing.
pub(super) struct Packages {
    /// The folder of the files, as they are installed.
    pub(super) stage: PathBuf,
    /// The setup program.
    pub(super) installer: PathBuf,
    folder: PathBuf,
}

/// Packs programs: a release beside the packages of Linux, others in a folder of their own.
pub(super) fn pack(binaries: &Binaries, profile: Profile) -> Result<Packages> {
    for (program, package) in [("zip", "zip"), ("makensis", "nsis")] {
        if command(program).args(["-h"]).capture().is_err() {
            apt_install(&[package])?;
        }
    }
    let top = std::env::current_dir()?;
    let dependencies = dependencies(&top, Some(WINDOWS))?;
    let own = dependencies.iter().find(|krate| krate.name == "guideway");
    let version = &own.context("the list has the command")?.version;
    let (folder, compression) = match profile {
        Profile::Release => ("target/dist/packages", Compression::Xz),
        Profile::Quick => ("target/windows/packages", Compression::Fast),
    };
    let folder = top.join(folder);
    fs::create_dir_all(&folder)?;
    let work = top.join(FOLDER).join("stage");
    if work.exists() {
        fs::remove_dir_all(&work)?;
    }
    let name = format!("guideway-{version}-x86_64-windows");
    let stage = work.join(&name);
    let notices = notices(&dependencies)?;
    stage_windows(&top, version, binaries, &notices, &stage)?;
    zip(&work, &name, &folder, compression)?;
    let installer = installer(&top, version, &work, &name, &folder, compression)?;
    let bill = sbom(version, &dependencies);
    let bill = serde_json::to_string_pretty(&bill)? + "\n";
    fs::write(folder.join(format!("{name}.cdx.json")), bill)?;
    checksums(&folder, &files_in(&folder)?)?;
    Ok(Packages {
        stage,
        installer,
        folder,
    })
}

impl Packages {
    /// Prints the packages with their sizes.
    pub(super) fn list(&self) -> Result<()> {
        for file in files_in(&self.folder)? {
            println!(
                "{:>12} bytes  {}",
                fs::metadata(&file)?.len(),
                file.display()
            );
        }
        Ok(())
    }
}

/// The packages in a folder, sorted, without their checksums.
fn files_in(folder: &Path) -> Result<Vec<PathBuf>> {
    let mut files = Vec::new();
    for entry in fs::read_dir(folder)? {
        let file = entry?.path();
        if file.file_name().is_some_and(|name| name != "SHA256SUMS") {
            files.push(file);
        }
    }
    files.sort();
    Ok(files)
}
