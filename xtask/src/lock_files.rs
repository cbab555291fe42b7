//! Checks every lock file: that it fits its manifests, and that nothing in it is advised against.

use std::path::Path;

use anyhow::{Result, bail};

use crate::step::{self, cargo};

/// Workspaces with a lock file of their own.
const WORKSPACES: [&str; 4] = [
    "Cargo.toml",
    "fuzz/Cargo.toml",
    "bench/peers/Cargo.toml",
    "bench/readers/Cargo.toml",
];

/// Checks the lock file of each workspace with `cargo deny`.
pub(crate) fn check(deny: &Path) -> Result<()> {
    for manifest in WORKSPACES {
        // A dependency that changed is in the files of other workspaces too.
        let locked = ["update", "--quiet", "--workspace", "--locked"];
        cargo(&locked).args(["--manifest-path", manifest]).run()?;
        check_advisories(deny, manifest)?;
    }
    Ok(())
}

/// Fails for an advisory about a version in a lock file, or a yanked one.
fn check_advisories(deny: &Path, manifest: &str) -> Result<()> {
    let checked = step::command(deny)
        .args(["--manifest-path", manifest, "--config", "deny.toml"])
        .args(["--locked", "check", "advisories"])
        .capture()?;
    // Without a network there is no advisory database: report that, and do not fail.
    let offline = [
        "failed to fetch",
        "failed to download",
        "Could not resolve host",
    ];
    if checked.succeeded {
        println!("{manifest}: none");
    } else if offline.iter().any(|reason| checked.stderr.contains(reason)) {
        println!("NOT CHECKED: {manifest}: the registry cannot be reached from this machine");
    } else {
        bail!(
            "cargo deny found an advisory for {manifest}:\n{}",
            checked.stderr
        );
    }
    Ok(())
}
