//! Builds engine, page and npm package, and puts page and engine where the command takes them from.

use std::path::{Path, PathBuf};

use anyhow::{Context, Result};

use super::sources::{self, PAGE};
use super::threads;
use super::tools::{self, wasm_bindgen};
use crate::debian_rust::{DebianRust, linker};
use crate::step::{command, heading};

const TARGET: &str = "wasm32-unknown-unknown";
/// The folder of what is fetched and built.
const FOLDER: &str = "target/web";
const IMMEDIATE_ABORT: &str = "profile.web.panic=\"immediate-abort\"";
/// Compressors of zstd: the engine reads compressed files, and writes none.
const COMPRESSORS: [&str; 7] = [
    "DFAST", "GREEDY", "LAZY", "LAZY2", "BTLAZY2", "BTOPT", "BTULTRA",
];

/// Builds the page from its sources.
pub(super) fn page() -> Result<()> {
    let folder = std::env::current_dir()?.join(FOLDER);
    std::fs::create_dir_all(&folder)?;
    heading("tools for browsers");
    tools::ensure()?;
    let rust = DebianRust::ensure()?;
    let bindgen = wasm_bindgen(&folder)?;
    let whole = Engine {
        title: "the engine",
        name: "engine",
        features: "files,formats",
        target: "cargo",
        flags: "-C target-feature=+simd128".to_owned(),
        c_flags: "",
    };
    let of_arrow = Engine {
        title: "the engine that reads Arrow",
        name: "engine-arrow",
        features: "arrow",
        flags: whole.flags.clone(),
        ..whole
    };
    let threaded = Engine {
        title: "the engine of several threads",
        name: "engine-threads",
        features: "files,formats,threads",
        target: "cargo-threads",
        flags: threads::flags(),
        c_flags: threads::C_FLAGS,
    };
    for engine in [whole, of_arrow, threaded] {
        heading(engine.title);
        engine.build(&rust, &bindgen, &folder)?;
    }
    heading("the page");
    let npm = |args: &[&str]| command("npm").args(args).current_dir("web").run();
    // The packages' own scripts are not needed, and others' code need not run here.
    npm(&["ci", "--ignore-scripts", "--no-fund", "--no-audit"])?;
    npm(&["exec", "tsc", "--", "--project", "."])?;
    command("node")
        .args(["web/build.mjs", FOLDER, PAGE])
        .args([fonts(&folder)?])
        .run()?;
    sources::record()?;
    let page = Path::new(FOLDER).join("guideway.html");
    println!("\nthe page is in {}: open it in a browser", page.display());
    println!("the npm package is in web: npm pack");
    println!("the command shares it as soon as it is built again: guideway share SITE");
    Ok(())
}

/// One of the engines.
struct Engine {
    title: &'static str,
    /// The folder under `web` for what `wasm-bindgen` makes of it.
    name: &'static str,
    features: &'static str,
    /// The folder of cargo's: the flags are those of the standard library too.
    target: &'static str,
    flags: String,
    c_flags: &'static str,
}

impl Engine {
    fn build(&self, rust: &DebianRust, bindgen: &Path, folder: &Path) -> Result<()> {
        let target = folder.join(self.target);
        let flags = format!("{} {}", self.flags, rust.remapped_paths()?);
        let c_flags = format!("{} {}", zstd_flags(), self.c_flags);
        rust.cargo(&["rustc", "--locked", "--package", "guideway-web", "--lib"])
            .args(["--no-default-features", "--features", self.features])
            .args(["--crate-type", "cdylib", "--profile", "web"])
            .args(["--target", TARGET, "-Zbuild-std=std,panic_abort"])
            // Smaller ways to sort and to write numbers; measured: no picture takes longer.
            .args(["-Zbuild-std-features=optimize_for_size"])
            // A page hears of a panic as of any trap, and its text is a tenth of the engine.
            .args(["-Zpanic-immediate-abort", "--config", IMMEDIATE_ABORT])
            .env("CFLAGS_wasm32_unknown_unknown", c_flags)
            .env("CARGO_TARGET_DIR", &target)
            .env("CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_LINKER", linker()?)
            .env("RUSTFLAGS", flags)
            .run()?;
        let built = target.join(TARGET).join("web/guideway_web.wasm");
        let to = Path::new("web").join(self.name);
        command(bindgen)
            .args(["--target", "web", "--out-dir"])
            .args([&to, &built])
            .run()
    }
}

/// Flags that leave unused parts out of zstd.
fn zstd_flags() -> String {
    let excluded = COMPRESSORS.map(|name| format!("-DZSTD_EXCLUDE_{name}_BLOCK_COMPRESSOR"));
    let short = [
        "-DHUF_FORCE_DECOMPRESS_X1",
        "-DZSTD_FORCE_DECOMPRESS_SEQUENCES_SHORT",
    ];
    format!("{} {}", excluded.join(" "), short.join(" "))
}

/// The folder with the fonts that the last build of an engine has written.
fn fonts(folder: &Path) -> Result<PathBuf> {
    let built = folder.join("cargo").join(TARGET).join("web/build");
    let mut found = Vec::new();
    for entry in std::fs::read_dir(&built)? {
        let fonts = entry?.path().join("out");
        if let Ok(letters) = std::fs::metadata(fonts.join("letters.ttf")) {
            found.push((letters.modified()?, fonts));
        }
    }
    let newest = found.into_iter().max();
    let (_, fonts) = newest.with_context(|| format!("no fonts in {}", built.display()))?;
    Ok(fonts)
}
