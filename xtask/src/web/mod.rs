//! `cargo xtask web`: builds the engine for browsers, the page and the npm package around it, and
//! tests them.
//!
//! | module | input | output |
//! |---|---|---|
//! | `tools` | packages | Node, clang and `wasm-bindgen` |
//! | `build` | `crates/guideway-web`, `web/` | `crates/guideway/page`, `target/web`, `web/dist` |
//! | `threads` | | flags of the engine of several threads |
//! | `sources` | the files that the page is made of | their hash, which says whether it is stale |
//!
//! The tests run the page in Debian's Chromium and Firefox ESR: `web/tests`.

mod build;
mod sources;
mod threads;
mod tools;

use anyhow::{Result, bail};

use crate::prerequisites::apt_install;
use crate::step::{self, cargo, heading};

/// Builds the page; with `--test` also tests it, with `--check` only says whether it is stale.
pub(crate) fn run(args: &[String]) -> Result<()> {
    match args {
        [] => build::page(),
        [arg] if arg == "--check" => sources::check(),
        [arg] if arg == "--test" => {
            build::page()?;
            test()
        }
        _ => bail!("write `web`, `web --test` or `web --check`"),
    }
}

/// Opens files in the page and the element, and compares their pictures with those of the command.
fn test() -> Result<()> {
    heading("the page in browsers");
    for browser in ["chromium", "firefox-esr"] {
        if !step::command(browser).args(["--version"]).succeeds() {
            apt_install(&[browser])?;
        }
    }
    cargo(&["build", "--quiet", "--workspace", "--bin", "guideway"]).run()?;
    // The files of `shaders`.
    let write = ["--", "--quiet", "--ignored", "write_every_shader"];
    cargo(&["test", "--quiet", "--workspace", "--lib"])
        .args(write)
        .run()?;
    for test in [
        "browser", "element", "threads", "widget", "firefox", "shaders",
    ] {
        step::command("node")
            .args([format!("web/tests/{test}.mjs")])
            .run()?;
    }
    Ok(())
}
