//! The packages for Windows: a folder of files, a zip of it, and an installer by NSIS.

use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::{Duration, SystemTime};

use anyhow::{Context, Result};

use super::package::run;
use super::{Binaries, Compression};
use crate::files::files_below;

/// The target of the programs.
pub const WINDOWS: &str = "x86_64-pc-windows-gnu";

/// Files of the repository, and their names in the folder. Windows opens texts by their extension.
const FILES: [(&str, &str); 4] = [
    ("LICENSE-MIT", "LICENSE-MIT.txt"),
    ("LICENSE-APACHE", "LICENSE-APACHE.txt"),
    ("CHANGELOG.md", "CHANGELOG.md"),
    (
        "crates/guideway/examples/site.lif.json",
        "examples/site.lif.json",
    ),
];
/// Time of the files, the earliest that a zip holds in any time zone: equal files give equal zips.
const TIME: Duration = Duration::from_secs(3653 * 24 * 3600);

/// Writes the files for Windows into `folder`. `notices` are the licenses of the dependencies.
///
/// # Errors
/// When a file cannot be read or written.
pub fn stage_windows(
    top: &Path,
    version: &str,
    binaries: &Binaries,
    notices: &str,
    folder: &Path,
) -> Result<()> {
    fs::create_dir_all(folder.join("examples"))?;
    for program in [&binaries.command, &binaries.window] {
        let name = program.file_name().context("a program has a name")?;
        fs::copy(program, folder.join(name))
            .with_context(|| format!("{}: build it first", program.display()))?;
    }
    for (from, to) in FILES {
        fs::copy(top.join(from), folder.join(to)).with_context(|| from.to_owned())?;
    }
    let readme = fs::read_to_string(top.join("packaging/windows.txt"))?;
    let readme = readme.replace("@VERSION@", version);
    fs::write(folder.join("README.txt"), readme)?;
    fs::write(folder.join("THIRD-PARTY.txt"), notices)?;
    for (_, path) in files_below(folder)? {
        let file = File::options().append(true).open(path)?;
        file.set_modified(SystemTime::UNIX_EPOCH + TIME)?;
    }
    Ok(())
}

/// Packs the folder `name` in `parent` as `name.zip` in `folder`.
///
/// # Errors
/// When `zip` fails.
pub fn zip(parent: &Path, name: &str, folder: &Path, compression: Compression) -> Result<PathBuf> {
    let file = folder.join(format!("{name}.zip"));
    if file.exists() {
        fs::remove_file(&file)?;
    }
    let files = files_below(&parent.join(name))?;
    let names = files.iter().map(|(inner, _)| format!("{name}/{inner}"));
    run(Command::new("zip")
        .args(["-q", "-X"])
        .arg(match compression {
            Compression::Xz => "-9",
            Compression::Fast => "-1",
        })
        .arg(&file)
        .args(names)
        .env("TZ", "UTC")
        .current_dir(parent))?;
    Ok(file)
}

/// Makes the installer `name-setup.exe` in `folder` of the folder `name` in `parent`.
///
/// # Errors
/// When `makensis` fails, or the name of a file has letters that mean something to it.
pub fn installer(
    top: &Path,
    version: &str,
    parent: &Path,
    name: &str,
    folder: &Path,
    compression: Compression,
) -> Result<PathBuf> {
    let file = folder.join(format!("{name}-setup.exe"));
    let stage = parent.join(name);
    let removals = parent.join(format!("{name}.nsh"));
    let names = files_below(&stage)?.into_iter().map(|(name, _)| name);
    fs::write(&removals, removal(&names.collect::<Vec<_>>()))?;
    let define = |name: &str, value: &Path| format!("-D{name}={}", value.display());
    run(Command::new("makensis")
        .args(["-V2", "-WX", "-INPUTCHARSET", "UTF8"])
        .arg(match compression {
            Compression::Xz => "-XSetCompressor /SOLID lzma",
            Compression::Fast => "-XSetCompressor zlib",
        })
        .arg(format!("-DVERSION={version}"))
        .arg(define("STAGE", &stage))
        .arg(define("OUTPUT", &file))
        .arg(define("REMOVALS", &removals))
        .arg(define(
            "ICON",
            &top.join("crates/guideway-window/guideway.ico"),
        ))
        .arg(top.join("packaging/guideway.nsi")))?;
    Ok(file)
}

/// Lines for the uninstaller: removes these files, then the folders that are empty without them.
fn removal(names: &[String]) -> String {
    let windows = |name: &str| name.replace('/', "\\");
    let mut lines = String::new();
    let mut folders = Vec::new();
    for name in names {
        lines += &format!("Delete \"$INSTDIR\\{}\"\n", windows(name));
        let above = Path::new(name).ancestors().skip(1);
        let above = above.map(|folder| folder.to_string_lossy().into_owned());
        folders.extend(above.filter(|folder| !folder.is_empty()));
    }
    folders.sort();
    folders.dedup();
    // The inner ones first.
    for folder in folders.iter().rev() {
        lines += &format!("RMDir \"$INSTDIR\\{}\"\n", windows(folder));
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_uninstaller_removes_inner_folders_first_and_never_the_top() {
        let names = ["a.txt", "in/b.txt", "in/deep/c.txt"].map(str::to_owned);
        let lines = removal(&names);
        let expected = "Delete \"$INSTDIR\\a.txt\"\n\
                        Delete \"$INSTDIR\\in\\b.txt\"\n\
                        Delete \"$INSTDIR\\in\\deep\\c.txt\"\n\
                        RMDir \"$INSTDIR\\in\\deep\"\n\
                        RMDir \"$INSTDIR\\in\"\n";
        assert_eq!(lines, expected);
    }

    #[test]
    fn equal_files_give_equal_zips() {
        let runs = Command::new("zip").arg("-v").output().is_ok();
        if !runs {
            println!("SKIPPED: this system has no zip");
            return;
        }
        let top = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
        let zipped_in = |folder: &Path| {
            let fast = Compression::Fast;
            fs::read(zip(folder, "guideway", folder, fast).unwrap()).unwrap()
        };
        let zipped = |notices: &str| {
            let folder = tempfile::tempdir().unwrap();
            for name in ["guideway.exe", "guideway-window.exe"] {
                fs::write(folder.path().join(name), name).unwrap();
            }
            let binaries = Binaries::with_suffix(folder.path(), ".exe");
            let stage = folder.path().join("guideway");
            stage_windows(&top, "1.2.3", &binaries, notices, &stage).unwrap();
            let readme = fs::read_to_string(stage.join("README.txt")).unwrap();
            assert!(readme.contains("Guideway 1.2.3"), "{readme}");
            zipped_in(folder.path())
        };
        assert_eq!(zipped("notices"), zipped("notices"));
        assert_ne!(zipped("notices"), zipped("other"));
    }
}
