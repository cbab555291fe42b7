//! The files that the page is made of, and their hash beside the page.

use std::fs;

use anyhow::{Context, Result, bail};

use crate::step::command;

/// The page as the command holds it.
pub(super) const PAGE: &str = "crates/guideway/page";
/// Folders and files whose change makes the page stale.
const SOURCES: [&str; 18] = [
    "Cargo.lock",
    "crates/guideway/src/json.rs",
    "crates/guideway/src/lib.rs",
    "crates/guideway-compose/build.rs",
    "crates/guideway-compose/src",
    "crates/guideway-cpu/src",
    "crates/guideway-document/src",
    "crates/guideway-envelope/src",
    "crates/guideway-formats/src",
    "crates/guideway-layout/src",
    "crates/guideway-network/src",
    "crates/guideway-scene/src",
    "crates/guideway-sequential/src",
    "crates/guideway-spline/src",
    "crates/guideway-web/src",
    "web/build.mjs",
    "web/package-lock.json",
    "web/src",
];

/// Writes the hash of the sources beside the page.
pub(super) fn record() -> Result<()> {
    let path = format!("{PAGE}/sources.txt");
    fs::write(&path, hash()?).with_context(|| path.clone())
}

/// Fails if the sources of the page have changed since it was built.
pub(super) fn check() -> Result<()> {
    let path = format!("{PAGE}/sources.txt");
    let recorded = fs::read_to_string(&path).with_context(|| path.clone())?;
    if recorded != hash()? {
        bail!("the page is older than its sources: run `cargo xtask web` before a release");
    }
    println!("the page is of these sources");
    Ok(())
}

/// The hash of all sources, as git computes those of files.
fn hash() -> Result<String> {
    let listed = command("git")
        .args(["ls-files", "--cached", "--others", "--exclude-standard"])
        .args(SOURCES)
        .capture()?;
    let mut names: Vec<&str> = listed.stdout.lines().collect();
    names.sort_unstable();
    names.dedup();
    names.retain(|name| fs::exists(name).unwrap_or_default());
    let hashes = command("git").args(["hash-object", "--"]).args(&names);
    let hashes = hashes.capture()?;
    if !hashes.succeeded {
        bail!("git cannot hash the sources: {}", hashes.stderr.trim());
    }
    let lines = names.iter().zip(hashes.stdout.lines());
    let list: String = lines
        .map(|(name, hash)| format!("{hash} {name}\n"))
        .collect();
    let file = std::env::current_dir()?.join("target/web/sources.txt");
    fs::create_dir_all("target/web")?;
    fs::write(&file, list)?;
    let whole = command("git")
        .args(["hash-object", "--no-filters"])
        .args([file]);
    Ok(whole.capture()?.stdout)
}
