//! The crates that are linked into the programs, from `cargo metadata` and the lock file.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context, Result, bail};
use serde_json::Value;

/// A crate in the programs.
#[derive(Clone, Debug)]
pub struct Dependency {
    /// Its name on crates.io, or in the workspace.
    pub name: String,
    /// Its version.
    pub version: String,
    /// Its license as an SPDX expression; empty if it names a file instead.
    pub license: String,
    /// Its repository; empty if it names none.
    pub repository: String,
    /// The folder of its sources.
    pub folder: PathBuf,
    /// SHA-256 of its archive in hexadecimal digits; `None` for a crate of the workspace.
    pub checksum: Option<String>,
    /// The crates that it links, by name and version.
    pub links: Vec<(String, String)>,
}

impl Dependency {
    /// Returns `true` if the crate is part of this workspace.
    pub fn is_own(&self) -> bool {
        self.checksum.is_none()
    }
}

/// The programs whose crates are listed.
const ROOTS: [&str; 3] = ["guideway", "guideway-c", "guideway-window"];

/// Every crate that the programs link for a target, by default this computer's system, sorted by
/// name and version.
///
/// # Errors
/// When cargo fails, or its answer has another form.
pub fn dependencies(top: &Path, target: Option<&str>) -> Result<Vec<Dependency>> {
    let target = target.map_or_else(host, |target| Ok(target.to_owned()))?;
    let listed = Command::new(env!("CARGO"))
        .args(["metadata", "--format-version", "1", "--locked"])
        .args(["--filter-platform", &target])
        .current_dir(top)
        .output()
        .context("cannot start cargo")?;
    if !listed.status.success() {
        bail!("{}", String::from_utf8_lossy(&listed.stderr));
    }
    let metadata: Value = serde_json::from_slice(&listed.stdout)?;
    let lock = std::fs::read_to_string(top.join("Cargo.lock"))?;
    linked(&metadata, &checksums(&lock)).context("cargo metadata has another form")
}

fn host() -> Result<String> {
    let said = Command::new("rustc").arg("-vV").output()?;
    let said = String::from_utf8_lossy(&said.stdout).into_owned();
    let host = said.lines().find_map(|line| line.strip_prefix("host: "));
    Ok(host.context("rustc does not name its host")?.to_owned())
}

/// Checksums of the lock file by name and version.
fn checksums(lock: &str) -> BTreeMap<(String, String), String> {
    let field = |entry: &str, name: &str| {
        let found = entry.lines().find_map(|line| {
            let value = line.strip_prefix(name)?.strip_prefix(" = \"")?;
            value.strip_suffix('"')
        });
        found.map(str::to_owned)
    };
    let packages = lock.split("[[package]]").filter_map(|entry| {
        let key = (field(entry, "name")?, field(entry, "version")?);
        Some((key, field(entry, "checksum")?))
    });
    packages.collect()
}

/// Follows the normal dependencies of the roots. Macros are built, not linked.
fn linked(
    metadata: &Value,
    checksums: &BTreeMap<(String, String), String>,
) -> Option<Vec<Dependency>> {
    let packages: BTreeMap<&str, &Value> = metadata["packages"]
        .as_array()?
        .iter()
        .filter_map(|package| Some((package["id"].as_str()?, package)))
        .collect();
    let nodes: BTreeMap<&str, &Value> = metadata["resolve"]["nodes"]
        .as_array()?
        .iter()
        .filter_map(|node| Some((node["id"].as_str()?, node)))
        .collect();
    let of_roots = packages.iter().filter(|(_, package)| {
        let name = package["name"].as_str();
        package["source"].is_null() && name.is_some_and(|name| ROOTS.contains(&name))
    });
    let mut next: Vec<&str> = of_roots.map(|(id, _)| *id).collect();
    let mut seen = BTreeSet::new();
    let mut found = Vec::new();
    while let Some(id) = next.pop() {
        if !seen.insert(id) {
            continue;
        }
        let package = packages.get(id)?;
        let links: Vec<&str> = links(nodes.get(id)?)?
            .into_iter()
            .filter(|id| packages.get(id).is_some_and(|package| !is_macro(package)))
            .collect();
        found.push(dependency(package, &links, &packages, checksums)?);
        next.extend(links);
    }
    found.sort_by(|a, b| (&a.name, &a.version).cmp(&(&b.name, &b.version)));
    Some(found)
}

/// The identifiers of the normal dependencies of a node.
fn links(node: &Value) -> Option<Vec<&str>> {
    let dependencies = node["deps"].as_array()?.iter();
    let normal = dependencies.filter(|dependency| {
        let kinds = dependency["dep_kinds"].as_array();
        kinds.is_some_and(|kinds| kinds.iter().any(|kind| kind["kind"].is_null()))
    });
    normal
        .map(|dependency| dependency["pkg"].as_str())
        .collect()
}

fn is_macro(package: &Value) -> bool {
    let targets = package["targets"].as_array().into_iter().flatten();
    targets
        .filter_map(|target| target["kind"].as_array())
        .any(|kinds| kinds.iter().any(|kind| kind == "proc-macro"))
}

fn dependency(
    package: &Value,
    links: &[&str],
    packages: &BTreeMap<&str, &Value>,
    checksums: &BTreeMap<(String, String), String>,
) -> Option<Dependency> {
    let text = |name: &str| package[name].as_str().unwrap_or_default().to_owned();
    let manifest = Path::new(package["manifest_path"].as_str()?);
    let key = |package: &Value| {
        let field = |name: &str| Some(package[name].as_str()?.to_owned());
        Some((field("name")?, field("version")?))
    };
    let links = links.iter().map(|id| key(packages.get(id)?));
    Some(Dependency {
        name: text("name"),
        version: text("version"),
        license: text("license"),
        repository: text("repository"),
        folder: manifest.parent()?.to_owned(),
        checksum: checksums.get(&key(package)?).cloned(),
        links: links.collect::<Option<_>>()?,
    })
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    #[test]
    fn lists_what_is_linked_and_nothing_else() {
        let package = |id: &str, source: Option<&str>, kind: &str| {
            json!({
                "id": id, "name": id, "version": "1.0.0", "license": "MIT", "source": source,
                "manifest_path": format!("/src/{id}/Cargo.toml"),
                "targets": [{ "kind": [kind] }],
            })
        };
        let link =
            |id: &str, kind: Option<&str>| json!({ "pkg": id, "dep_kinds": [{ "kind": kind }] });
        let registry = Some("registry");
        let metadata = json!({
            "packages": [
                package("guideway", None, "lib"),
                package("linked", registry, "lib"),
                package("deep", registry, "lib"),
                package("derive", registry, "proc-macro"),
                package("built", registry, "lib"),
                package("tested", registry, "lib"),
                package("other", None, "lib"),
            ],
            "resolve": { "nodes": [
                { "id": "guideway", "deps": [
                    link("linked", None), link("derive", None), link("built", Some("build")),
                    link("tested", Some("dev")),
                ]},
                { "id": "linked", "deps": [link("deep", None)] },
                { "id": "deep", "deps": [] },
                { "id": "other", "deps": [link("tested", None)] },
            ]},
        });
        let lock = "[[package]]\nname = \"deep\"\nversion = \"1.0.0\"\nchecksum = \"0a\"\n";
        let found = linked(&metadata, &checksums(lock)).unwrap();
        let names: Vec<&str> = found.iter().map(|krate| krate.name.as_str()).collect();
        assert_eq!(names, ["deep", "guideway", "linked"]);
        assert_eq!(found[0].checksum.as_deref(), Some("0a"));
        assert!(found[1].is_own());
        assert_eq!(found[1].links, [("linked".to_owned(), "1.0.0".to_owned())]);
    }
}
