//! Builds engine, page and npm package, and puts page and engine where the command takes them from.

use std::path::Path;

use anyhow::Result;

use super::sources::{self, PAGE};
use super::tools::{self, linker, wasm_bindgen};
use crate::debian_rust::DebianRust;
use crate::step::{command, heading};

const TARGET: &str = "wasm32-unknown-unknown";
/// The folder of what is fetched and built.
const FOLDER: &str = "target/web";

/// Builds the page from its sources.
pub(super) fn page() -> Result<()> {
    let folder = std::env::current_dir()?.join(FOLDER);
    std::fs::create_dir_all(&folder)?;
    heading("tools for browsers");
    tools::ensure()?;
    let rust = DebianRust::ensure()?;
    let bindgen = wasm_bindgen(&folder)?;
    heading("the engine");
    let flags = format!("-C target-feature=+simd128 {}", rust.remapped_paths()?);
    rust.cargo(&["rustc", "--locked", "--package", "guideway-web", "--lib"])
        .args(["--crate-type", "cdylib", "--profile", "web"])
        .args(["--target", TARGET, "-Zbuild-std=std,panic_abort"])
        .env("CARGO_TARGET_DIR", folder.join("cargo"))
        .env("CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_LINKER", linker()?)
        .env("RUSTFLAGS", flags)
        .run()?;
    let built = folder
        .join("cargo")
        .join(TARGET)
        .join("web/guideway_web.wasm");
    command(bindgen)
        .args(["--target", "web", "--out-dir", "web/engine"])
        .args([&built])
        .run()?;
    heading("the page");
    let npm = |args: &[&str]| command("npm").args(args).current_dir("web").run();
    // The packages' own scripts are not needed, and others' code need not run here.
    npm(&["ci", "--ignore-scripts", "--no-fund", "--no-audit"])?;
    npm(&["exec", "tsc", "--", "--project", "."])?;
    command("node")
        .args(["web/build.mjs", FOLDER, PAGE])
        .run()?;
    sources::record()?;
    let page = Path::new(FOLDER).join("guideway.html");
    println!("\nthe page is in {}: open it in a browser", page.display());
    println!("the npm package is in web: npm pack");
    println!("the command shares it as soon as it is built again: guideway share SITE");
    Ok(())
}
