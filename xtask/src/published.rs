//! Packs every crate that is published, as crates.io takes it, and checks what the packages hold.

use std::path::Path;

use anyhow::{Context, Result, bail};
use serde_json::Value;

use crate::step::{cargo, command};

/// Files that every package holds.
const FILES: [&str; 3] = ["LICENSE-APACHE", "LICENSE-MIT", "README.md"];

/// Packs the crates of the workspace in the current folder. Cargo warns of missing metadata and of
/// files that some systems cannot have.
pub(crate) fn check() -> Result<()> {
    let folder = Path::new("target/published");
    let metadata = cargo(&["metadata", "--no-deps", "--format-version", "1"]).capture()?;
    let metadata: Value = serde_json::from_str(&metadata.stdout)?;
    let packages = metadata["packages"].as_array().context("no packages")?;
    let names = |is_published: bool| {
        let named = packages.iter();
        let named = named.filter(move |package| package["publish"].is_null() == is_published);
        named.filter_map(|package| package["name"].as_str())
    };
    let excluded: Vec<&str> = names(false).flat_map(|name| ["--exclude", name]).collect();
    let packed = cargo(&["package", "--workspace", "--no-verify", "--allow-dirty"])
        .args(excluded)
        .args(["--color", "never", "--target-dir"])
        .args([folder])
        .capture()?;
    let (succeeded, said) = (packed.succeeded, &packed.stderr);
    let faults = said.lines().filter(|line| is_fault(line));
    let faults: Vec<&str> = faults.collect();
    if !succeeded || !faults.is_empty() {
        bail!(
            "cargo package: {}",
            if succeeded {
                faults.join("\n")
            } else {
                said.clone()
            }
        );
    }
    for package in packages
        .iter()
        .filter(|package| package["publish"].is_null())
    {
        let text = |key: &str| package[key].as_str().context("cargo has another form");
        let stem = format!("{}-{}", text("name")?, text("version")?);
        let file = folder.join("package").join(format!("{stem}.crate"));
        let listed = command("tar")
            .args(["--list", "--gzip", "--file"])
            .args([&file]);
        check_files(&stem, &listed.capture()?.stdout)?;
    }
    println!("{} crates are packed", names(true).count());
    Ok(())
}

/// Returns `true` if a line of cargo's is a warning, but for that of tests, which stay out.
fn is_fault(line: &str) -> bool {
    line.starts_with("warning: ") && !line.starts_with("warning: ignoring test ")
}

fn check_files(stem: &str, listed: &str) -> Result<()> {
    for name in FILES {
        let file = format!("{stem}/{name}");
        if !listed.lines().any(|line| line == file) {
            bail!("the package {stem} lacks {name}");
        }
    }
    let tests = format!("{stem}/tests/");
    if let Some(test) = listed.lines().find(|line| line.starts_with(&tests)) {
        bail!("the package {stem} holds a test, which needs files of the repository: {test}");
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_what_a_package_lacks_or_holds_too_much() {
        let whole = "a-1/LICENSE-APACHE\na-1/LICENSE-MIT\na-1/README.md\na-1/src/lib.rs\n";
        assert!(check_files("a-1", whole).is_ok());
        for name in FILES {
            let lacking = whole.replace(&format!("a-1/{name}\n"), "");
            let said = check_files("a-1", &lacking).unwrap_err().to_string();
            assert!(said.contains(name), "{said}");
        }
        let with_test = format!("{whole}a-1/tests/b.rs\n");
        assert!(check_files("a-1", &with_test).is_err());
        assert!(is_fault("warning: manifest has no documentation"));
        assert!(!is_fault(
            "warning: ignoring test `a` as `tests/a.rs` is not included"
        ));
    }
}
