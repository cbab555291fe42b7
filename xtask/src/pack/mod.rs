//! `cargo xtask dist`: builds a release and packs it: the programs, the command as one file for any
//! Linux, and the C library.

mod build;
mod musl;

use std::fs;
use std::path::Path;

use anyhow::{Context, Result};
use xtask::dist::{
    Compression, Package, archive, checksums, deb, dependencies, notices, sbom, stage,
    stage_command, stage_library, stage_notices,
};

use crate::step::heading;

/// Packs the repository in the current folder.
pub(crate) fn run() -> Result<()> {
    let top = std::env::current_dir()?;
    heading("release build");
    let binaries = build::programs(&top)?;
    let alone = build::IS_HOST.then(|| musl::static_command(&top));
    let alone = alone.transpose()?;
    let library = build::library(&top)?;
    heading("packages");
    let dependencies = dependencies(&top, None)?;
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
    let notices = notices(&dependencies)?;
    let archive_of = |name: &str, stage: &dyn Fn(&Path) -> Result<()>| {
        let name = format!("{name}-{version}-{}-linux", std::env::consts::ARCH);
        stage(&work.join(&name))?;
        archive(&work, &name, &folder)
    };
    // A `.deb` of the files below a folder, and an archive of them under another name.
    let pack = |package: &Package<'_>, name: &str, stage: &dyn Fn(&Path) -> Result<()>| {
        let root = work.join("root");
        stage(&root.join("usr"))?;
        let package = deb(package, &root, &folder, Compression::Xz)?;
        let archive = archive_of(name, &|place| Ok(fs::rename(root.join("usr"), place)?))?;
        anyhow::Ok([package, archive])
    };
    let programs = pack(&Package::programs(version, &binaries), "guideway", &|usr| {
        stage(&top, &binaries, &notices, usr)
    })?;
    let alone = alone.map(|command| {
        archive_of("guideway-static", &|prefix| {
            let notices = format!("{notices}\nmusl\n\n{}", musl::license()?);
            stage_command(&top, &command, &notices, prefix)
        })
    });
    let alone = alone.transpose()?;
    let library = pack(
        &Package::library(version, &library),
        "libguideway",
        &|usr| {
            stage_library(&top, version, &library, usr)?;
            stage_notices(&top, &notices, &usr.join("share/doc/libguideway-dev"))
        },
    )?;
    let bill = folder.join(format!("guideway-{version}.cdx.json"));
    fs::write(
        &bill,
        serde_json::to_string_pretty(&sbom(version, &dependencies))? + "\n",
    )?;
    let files = [&programs[..], alone.as_slice(), &library, &[bill]].concat();
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
