//! Packages of the unoptimized programs: what they hold, and that they install and go again.

#![expect(clippy::unwrap_used, reason = "helpers of tests may panic")]

use std::env::consts::EXE_SUFFIX;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use xtask::dist::{
    Binaries, Compression, Package, archive, checksums, deb, dependencies, notices, sbom, stage,
};

fn top() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// The command that the workspace built, and a script in the place of the window.
fn programs(folder: &Path) -> Option<Binaries> {
    let tests = std::env::current_exe().ok()?;
    let built = tests
        .parent()?
        .parent()?
        .join(format!("guideway{EXE_SUFFIX}"));
    let window = folder.join("guideway-window");
    fs::write(&window, "#!/bin/sh\n# GLIBC_2.17\n").ok()?;
    built.exists().then_some(Binaries {
        command: built,
        window,
    })
}

fn runs(program: &str) -> bool {
    Command::new(program).arg("--version").output().is_ok()
}

/// Names of all files below a folder.
fn files_below(folder: &Path) -> Vec<String> {
    let files = xtask::files::files_below(folder).unwrap();
    files.into_iter().map(|(name, _)| name).collect()
}

#[test]
fn package_installs_runs_and_leaves_nothing_when_removed() {
    let folder = tempfile::tempdir().unwrap();
    let Some(binaries) = programs(folder.path()) else {
        println!("SKIPPED: `cargo build --workspace` builds the command first");
        return;
    };
    if !runs("dpkg-deb") {
        println!("SKIPPED: this system has no dpkg");
        return;
    }
    let root = folder.path().join("root");
    stage(&top(), &binaries, "notices", &root.join("usr")).unwrap();
    let staged = files_below(&root);
    for part in [
        "usr/bin/guideway",
        "usr/bin/guideway-window",
        "usr/share/man/man1/guideway-check.1.gz",
        "usr/share/bash-completion/completions/guideway",
        "usr/share/applications/guideway.desktop",
        "usr/share/mime/packages/guideway.xml",
        "usr/share/icons/hicolor/scalable/apps/guideway.svg",
        "usr/share/doc/guideway/copyright",
        "usr/share/doc/guideway/THIRD-PARTY.gz",
    ] {
        assert!(staged.iter().any(|name| name == part), "{part}: {staged:?}");
    }
    let contents = Package::programs("1.2.3", &binaries);
    let package = deb(&contents, &root, folder.path(), Compression::Fast).unwrap();

    // A system of its own, whose database of packages is empty.
    let system = folder.path().join("system");
    for part in ["updates", "info", "triggers"] {
        fs::create_dir_all(system.join("var/lib/dpkg").join(part)).unwrap();
    }
    for part in ["status", "available"] {
        fs::write(system.join("var/lib/dpkg").join(part), "").unwrap();
    }
    let dpkg = |args: &[&str]| {
        let mut command = Command::new("dpkg");
        command.arg(format!("--root={}", system.display()));
        // Neither libraries nor a log are there, nor need the user be root.
        let force = "--force-depends,not-root,bad-path,script-chrootless";
        command.args([force, "--log=/dev/null"]).args(args);
        command.output().unwrap()
    };
    let installed = dpkg(&["--install", &package.to_string_lossy()]);
    let said = String::from_utf8_lossy(&installed.stderr).into_owned();
    if said.contains("error setting ownership") {
        println!("SKIPPED: only root installs packages");
        return;
    }
    assert!(installed.status.success(), "{said}");
    let version = Command::new(system.join("usr/bin/guideway"))
        .arg("--version")
        .output();
    assert!(version.unwrap().status.success());
    let in_place = files_below(&system.join("usr"));
    assert_eq!(in_place, files_below(&root.join("usr")));
    let removed = dpkg(&["--remove", "guideway"]);
    assert!(removed.status.success(), "{removed:?}");
    assert!(!system.join("usr").exists(), "{:?}", files_below(&system));
}

#[test]
fn checksums_fit_and_tell_a_changed_archive() {
    let folder = tempfile::tempdir().unwrap();
    fs::create_dir(folder.path().join("inner")).unwrap();
    fs::write(folder.path().join("inner/file"), "text").unwrap();
    let packed = archive(folder.path(), "inner", folder.path()).unwrap();
    checksums(folder.path(), std::slice::from_ref(&packed)).unwrap();
    let fits = || {
        let mut check = Command::new("sha256sum");
        check.args(["--check", "--status", "SHA256SUMS"]);
        check.current_dir(folder.path()).status().unwrap().success()
    };
    assert!(fits());
    let mut bytes = fs::read(&packed).unwrap();
    bytes[20] ^= 1;
    fs::write(&packed, bytes).unwrap();
    assert!(!fits());
}

#[test]
fn every_crate_is_in_the_bill_with_its_license() {
    let all = dependencies(&top(), None).unwrap();
    let named = |name: &str| all.iter().any(|krate| krate.name == name);
    assert!(named("eframe") && named("wgpu-core") && named("guideway-formats"));
    assert!(!named("proptest") && !named("syn") && !named("cc"));
    let unlicensed: Vec<&str> = all
        .iter()
        .filter(|krate| krate.license.is_empty())
        .map(|krate| krate.name.as_str())
        .collect();
    assert!(unlicensed.is_empty(), "{unlicensed:?}");
    let bill = sbom("1.2.3", &all);
    let components = bill["components"].as_array().unwrap();
    assert_eq!(components.len(), all.len());
    let refs = |value: &serde_json::Value| value["bom-ref"].as_str().unwrap().to_owned();
    let known: Vec<String> = components.iter().map(refs).collect();
    for entry in bill["dependencies"].as_array().unwrap() {
        for on in entry["dependsOn"].as_array().unwrap() {
            assert!(known.iter().any(|name| on == name), "{on}");
        }
    }
    let texts = notices(&all).unwrap();
    for krate in all.iter().filter(|krate| !krate.is_own()) {
        let line = format!("{} {}: {}", krate.name, krate.version, krate.license);
        assert!(texts.contains(&line), "{line}");
    }
    assert!(texts.contains("Permission is hereby granted"));
}
