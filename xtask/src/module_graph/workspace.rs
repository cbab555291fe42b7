//! Applies the graph to every crate of the workspace.

use std::path::{Path, PathBuf};

use super::{Circle, arrows, circles, crate_modules};

/// The root files of all crates of the repository at `top`.
///
/// # Errors
/// When a folder of crates cannot be listed.
pub fn crate_roots(top: &Path) -> std::io::Result<Vec<PathBuf>> {
    let mut packages = ["tests", "tests/bad", "tests/growth", "xtask", "fuzz/laws"]
        .map(|package| top.join(package))
        .to_vec();
    for folder in ["crates", "thesis"] {
        for entry in std::fs::read_dir(top.join(folder))? {
            packages.push(entry?.path());
        }
    }
    packages.sort();
    let roots = packages
        .iter()
        .flat_map(|package| ["lib.rs", "main.rs"].map(|file| package.join("src").join(file)));
    Ok(roots.filter(|root| root.exists()).collect())
}

/// The circles of all crates: the root file of the crate, and its circle.
///
/// # Errors
/// As [`crate_roots`].
pub fn workspace_circles(top: &Path) -> std::io::Result<Vec<(PathBuf, Circle)>> {
    let mut found = Vec::new();
    for root in crate_roots(top)? {
        let circles = circles(&arrows(&crate_modules(&root)));
        found.extend(circles.into_iter().map(|circle| (root.clone(), circle)));
    }
    Ok(found)
}
