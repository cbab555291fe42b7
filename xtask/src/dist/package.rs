//! Packages of a staged installation: a `.deb` for Debian and Ubuntu, a `.tar.xz` for any Linux,
//! and the checksums of both.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context, Result, bail};

use super::{Binaries, Library};

/// The compression of a package.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Compression {
    /// For releases: as small as the format gets by LZMA, zips by deflate.
    Xz,
    /// For tests, which build packages in a second.
    Fast,
}

const MAINTAINER: &str = "Guideway developers <guideway@users.noreply.github.com>";

/// The content of a Debian package.
pub struct Package<'a> {
    name: &'a str,
    version: &'a str,
    /// Programs and libraries, which need a version of glibc.
    binaries: Vec<&'a Path>,
    recommends: &'a str,
    section: &'a str,
    /// One line, then the lines of a paragraph, each after a space.
    description: &'a str,
}

impl<'a> Package<'a> {
    /// The command and the window.
    pub fn programs(version: &'a str, binaries: &'a Binaries) -> Self {
        Self {
            name: "guideway",
            version,
            binaries: vec![&binaries.command, &binaries.window],
            // The window needs a driver, a keyboard map and, without a graphics card, Mesa.
            recommends: "libvulkan1, mesa-vulkan-drivers, libegl1, libxkbcommon-x11-0",
            section: "science",
            description: "path layouts of automated guided vehicles\n \
                Draws, checks, edits and converts layouts in LIF, VDA 5050, openTCS, DXF,\n \
                Open-RMF, OpenDRIVE, Lanelet2, GeoJSON, SVG and Arrow, by a command and in a\n \
                window.",
        }
    }

    /// The C library with its header.
    pub fn library(version: &'a str, library: &'a Library) -> Self {
        Self {
            name: "libguideway-dev",
            version,
            binaries: vec![&library.shared],
            recommends: "pkg-config",
            section: "libdevel",
            description: "path layouts of automated guided vehicles, for C and C++\n \
                Reads, checks, draws and converts layouts by a library with a header in C.",
        }
    }
}

/// Builds `NAME_VERSION_ARCHITECTURE.deb` in `folder` of an installation below `root`/usr.
///
/// # Errors
/// When `dpkg` is missing or fails.
pub fn deb(
    package: &Package<'_>,
    root: &Path,
    folder: &Path,
    compression: Compression,
) -> Result<PathBuf> {
    let Package {
        name,
        version,
        binaries,
        recommends,
        section,
        description,
    } = package;
    let architecture = said(Command::new("dpkg").arg("--print-architecture"))?;
    let size = said(
        Command::new("du")
            .args(["-sk", "--apparent-size"])
            .arg(root),
    )?;
    let kib = size.split_whitespace().next().unwrap_or("0");
    let mut glibc = None;
    for binary in binaries {
        glibc = glibc.max(newest_glibc(&fs::read(binary)?));
    }
    let (major, minor) = glibc.context("the programs name no version of glibc")?;
    let control = format!(
        "Package: {name}\n\
         Version: {version}\n\
         Architecture: {architecture}\n\
         Maintainer: {MAINTAINER}\n\
         Installed-Size: {kib}\n\
         Depends: libc6 (>= {major}.{minor}), libgcc-s1\n\
         Recommends: {recommends}\n\
         Section: {section}\n\
         Priority: optional\n\
         Homepage: https://github.com/guideway/guideway\n\
         Description: {description}\n"
    );
    let about = root.join("DEBIAN");
    fs::create_dir_all(&about)?;
    fs::write(about.join("control"), control)?;
    let file = folder.join(format!("{name}_{version}_{architecture}.deb"));
    let options: &[&str] = match compression {
        Compression::Xz => &["-Zxz"],
        Compression::Fast => &["-Zgzip", "-z1"],
    };
    run(Command::new("dpkg-deb")
        .args(["--root-owner-group", "--build"])
        .args(options)
        .arg(root)
        .arg(&file))?;
    fs::remove_dir_all(about)?;
    Ok(file)
}

/// Packs the folder `name` in `parent` as `name.tar.xz` in `folder`.
///
/// # Errors
/// When `tar` fails.
pub fn archive(parent: &Path, name: &str, folder: &Path) -> Result<PathBuf> {
    let file = folder.join(format!("{name}.tar.xz"));
    run(Command::new("tar")
        .args(["--create", "--xz", "--sort=name", "--mtime=@0"])
        .args(["--owner=0", "--group=0", "--numeric-owner", "--file"])
        .arg(&file)
        .arg("--directory")
        .arg(parent)
        .arg(name))?;
    Ok(file)
}

/// Writes the SHA-256 of the files beside them, in the form that `sha256sum --check` takes.
///
/// # Errors
/// When `sha256sum` fails.
pub fn checksums(folder: &Path, files: &[PathBuf]) -> Result<()> {
    let names: BTreeSet<_> = files.iter().filter_map(|file| file.file_name()).collect();
    let mut command = Command::new("sha256sum");
    let sums = said(command.current_dir(folder).arg("--").args(names))?;
    fs::write(folder.join("SHA256SUMS"), sums + "\n")?;
    Ok(())
}

/// The newest version of glibc that a program names, as `GLIBC_2.34`.
fn newest_glibc(program: &[u8]) -> Option<(u32, u32)> {
    const MARK: &[u8] = b"GLIBC_";
    let named = program.windows(MARK.len()).enumerate();
    let named = named.filter(|(_, window)| *window == MARK);
    let versions = named.filter_map(|(at, _)| {
        let rest = &program[at + MARK.len()..];
        let end = rest
            .iter()
            .position(|byte| !byte.is_ascii_digit() && *byte != b'.')?;
        let (major, minor) = std::str::from_utf8(&rest[..end]).ok()?.split_once('.')?;
        // A patch version follows in `2.2.5`.
        let minor = minor.split('.').next()?;
        Some((major.parse().ok()?, minor.parse().ok()?))
    });
    versions.max()
}

pub(super) fn run(command: &mut Command) -> Result<()> {
    said(command).map(drop)
}

/// The standard output of a program that must succeed.
fn said(command: &mut Command) -> Result<String> {
    let output = command.output();
    let output = output.with_context(|| format!("cannot start {command:?}"))?;
    if !output.status.success() {
        bail!("{command:?}: {}", String::from_utf8_lossy(&output.stderr));
    }
    Ok(String::from_utf8_lossy(&output.stdout).trim().to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_the_newest_glibc_of_a_program() {
        let program = b"\0GLIBC_2.2.5\0GLIBC_2.34\0GLIBC_2.9\0GLIBC_PRIVATE\0";
        assert_eq!(newest_glibc(program), Some((2, 34)));
        assert_eq!(newest_glibc(b"static"), None);
    }
}
